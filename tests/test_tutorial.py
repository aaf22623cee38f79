"""The tutorial's page and its pictures, and what makes them; CI runs all of it."""

import importlib.util
import re
import shlex
from pathlib import Path

import pytest

from cap.explore import explorer

DOCS = Path(__file__).parent.parent / "docs"
SCRIPT = (DOCS / "tutorial.py").read_text(encoding="utf-8")
PAGE = (DOCS / "tutorial.md").read_text(encoding="utf-8")
TINY = """print("not shown")

# %% [markdown]
# # Title
#
# Prose *and* x.

# %%
from pathlib import Path

x = 2 / 3
Path("pictures/a.svg").write_text("<svg>" + 2000 * " ")
print("x =", x)

# %% [markdown]
# ![A picture](pictures/a.svg)

# %%
# !python -c "print('of a command')"

# %%
# !python -c "import sys; print('half is done', file=sys.stderr)"

# %% tags=["raises-exception"]
# !python -c "raise SystemExit('an error')"
"""
SHOWN = """# Title

Prose *and* x.

```python
from pathlib import Path

x = 2 / 3
Path("pictures/a.svg").write_text("<svg>" + 2000 * " ")
print("x =", x)
```

```text
x = 0.6666666666666666
```

![A picture](pictures/a.svg)

```console
$ python -c "print('of a command')"
of a command
```

```console
$ python -c "import sys; print('half is done', file=sys.stderr)"

```

```console
$ python -c "raise SystemExit('an error')"
an error
```
"""


@pytest.fixture(scope="module")
def render():
    """Return the module that makes the page."""
    spec = importlib.util.spec_from_file_location("render", DOCS / "render.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def tiny(tmp_path):
    """Return a script with one cell of each kind."""
    path = tmp_path / "tiny.py"
    path.write_text(TINY, encoding="utf-8")
    return path


def test_a_page(render, tiny, capsys):
    """Prose, Python, commands and pictures are written; then all is as stored."""
    assert render.main(str(tiny), []) == 0
    assert tiny.with_suffix(".md").read_text(encoding="utf-8") == SHOWN
    assert (tiny.parent / "pictures/a.svg").stat().st_size > 2000
    assert render.main(str(tiny), ["--check"]) == 0
    assert capsys.readouterr().out == "tiny.md: written\ntiny.md: as stored\n"


@pytest.mark.parametrize(
    ("old", "new"), [("2 / 3", "2 / 3.001"), ("of a command", "of commands"), ("2 / 3", "2 // 3")]
)
def test_another_page(render, tiny, capsys, old, new):
    """The check shows what differs, and writes nothing."""
    render.main(str(tiny), [])
    tiny.write_text(TINY.replace(old, new), encoding="utf-8")
    assert render.main(str(tiny), ["--check"]) == 1
    assert f"-{next(line for line in SHOWN.splitlines() if old in line)}" in capsys.readouterr().err
    assert tiny.with_suffix(".md").read_text(encoding="utf-8") == SHOWN


@pytest.mark.parametrize(
    ("old", "new", "reason"),
    [
        ('2000 * " "', "str()", "5 bytes"),
        ('2000 * " "', '300_000 * " "', "300005 bytes"),
        ("![A picture](pictures/a.svg)", "None.", "pictures missing or not shown: pictures/a.svg"),
        ("print('of a command')", "raise SystemExit(3)", "exit status 3"),
        ('# %%\n# !', '# %% tags=["raises-exception"]\n# !', "exit status 0"),
    ],
)  # fmt: skip
def test_no_page(render, tiny, capsys, old, new, reason):
    """Pictures too small, too large or not shown, and commands that fail, or should."""
    tiny.write_text(TINY.replace(old, new), encoding="utf-8")
    assert render.main(str(tiny), []) == 1
    assert reason in capsys.readouterr().err
    assert not tiny.with_suffix(".md").exists()


LINE = "f = 0.4659034097  12 orbits, det 0, log -inf"


@pytest.mark.parametrize(("old", "new"), [("4097", "4111"), ("det 0", "det 1.8e-15"), ("  ", " ")])
def test_rounding(render, old, new):
    """Decimals may differ in their last digits, and blanks in number."""
    assert render.difference(LINE, LINE.replace(old, new)) == ""


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("0.4659", "0.4660"),
        ("12", "13"),
        ("det 0", "det 0.1"),
        ("-inf", "-9.5"),
        ("orbits", "pairs"),
    ],
)
def test_no_rounding(render, old, new):
    """Integers and words must be the same."""
    assert f"+{LINE.replace(old, new)}" in render.difference(LINE, LINE.replace(old, new))


def test_eleven_steps(render):
    """The page has eleven steps, and is the prose of the script with nothing left out."""
    assert re.findall(r"^## (\d+)\. ", PAGE, flags=re.MULTILINE) == [str(k) for k in range(1, 12)]
    cells = render.cells(SCRIPT)
    for cell in cells:
        if cell.head.startswith("[markdown]"):
            assert cell.prose in PAGE
        elif not cell.commands:
            assert f"```python\n{cell.body}\n```" in PAGE
    commands = [words for cell in cells for words in cell.commands]
    assert [f"$ {words}" for words in commands] == re.findall(r"^\$ .*$", PAGE, flags=re.MULTILINE)


def test_pictures(render):
    """Every picture shown exists, is not large, and there is no other."""
    render.check_pictures(PAGE, DOCS)


def test_no_machine(render):
    """No path of the machine that wrote the page, and no time, is in it."""
    assert not re.search(r"/(home|tmp|usr|root|work)\b|\d s left|\bseconds?\b: ", PAGE)
    assert all(len(line) <= render.WIDTH + 10 for line in PAGE.splitlines())


def test_commands(render):
    """What the page explores is understood; its prover and checker are run by CI only."""
    commands = [words for cell in render.cells(SCRIPT) for words in cell.commands]
    assert len(commands) >= 10
    for words in commands:
        python, m, module, *rest = shlex.split(words)
        assert (python, m) == ("python", "-m")
        if module == "cap.explore":
            explorer.parser().parse_args(rest)
        else:
            assert module in ("cap.prove", "cap.verify")


def test_ci():
    """CI runs the tutorial."""
    assert "python docs/tutorial.py --check" in (DOCS.parent / ".ci/run").read_text("utf-8")
