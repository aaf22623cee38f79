"""The page on own systems: its model is the example's; its commands and code print what it says."""

import doctest
import re
import shlex
from contextlib import suppress
from pathlib import Path
from textwrap import dedent

import pytest

from cap import prove, verify
from cap.explore import __main__ as explore

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs/own-system.md"
MODULES = {"cap.explore": explore, "cap.prove": prove, "cap.verify": verify}


def test_the_model():
    """The ten lines are those of the file."""
    text = PAGE.read_text(encoding="utf-8")
    block = text[text.index("    from fractions") : text.index("\n- **Names.**")]
    file = (ROOT / "examples/ball.py").read_text(encoding="utf-8")
    assert dedent(block).strip() == file[file.index("from fractions") :].strip()


def test_all_examples_are_listed():
    """Each with a link."""
    text = PAGE.read_text(encoding="utf-8")
    for path in (ROOT / "examples").glob("*.py"):
        assert f"(../examples/{path.name})" in text
        page = ROOT / f"docs/examples/{path.stem}.md"
        words = page.read_text(encoding="utf-8")
        assert f"(../../examples/{path.name})" in words
        (picture,) = re.findall(r"^!\[.*\]\((\S+)\)$", words, re.MULTILINE)
        assert f"--model examples/{path.name}" in words
        assert f"--out {picture}" in words
        assert 20_000 < (page.parent / picture).stat().st_size < 150_000


def test_the_examples(monkeypatch):
    """In the root of the repository."""
    monkeypatch.chdir(ROOT)
    options = doctest.ELLIPSIS | doctest.REPORT_NDIFF
    found = doctest.testfile(str(PAGE), module_relative=False, optionflags=options)
    assert found.attempted > 15
    assert found.failed == 0


@pytest.mark.slow
def test_the_commands(monkeypatch, tmp_path, capsys):
    """From a blank file to a picture and a verdict: in an empty directory, in their order."""
    monkeypatch.chdir(tmp_path)
    text = PAGE.read_text(encoding="utf-8")
    for name in ("ball", "spring"):
        ten = rf"^    from fractions.*\n(?:    .*\n|\n)+?    def {name}\(.*\n(?:    .*\n)+"
        block = re.search(ten, text, re.MULTILINE)
        Path(f"{name}.py").write_text(dedent(block[0]), encoding="utf-8")
    ran = 0
    for block in re.findall(r"```console\n(.*?)```", text, re.DOTALL):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, *shown = part.splitlines()
            _, _, module, *words = shlex.split(command)
            with suppress(SystemExit):
                MODULES[module].main(words)
            out, err = capsys.readouterr()
            for line in shown:
                assert line in out + err
            ran += 1
    assert ran == 9
    assert Path("orbit.svg").stat().st_size > 10_000
