"""The README: short, its digits certified, its commands those that CI runs."""

import re
import tomllib
from pathlib import Path

import cap

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
CI, BESIDE = ((ROOT / ".ci" / name).read_text("utf-8").splitlines() for name in ("run", "beside"))


def test_it_is_short():
    """At most 10 KB."""
    assert (ROOT / "README.md").stat().st_size <= 10_000


def test_the_theorem():
    """The digits of the theorem's table are those certified, none rounded up."""
    text = (ROOT / "certificates/elliptic.json").read_text("utf-8")
    digits = [
        line.removesuffix(" |").rpartition("| ")[2]
        for line in README.splitlines()
        if line.endswith("… |")
    ]
    assert len(digits) == 6
    for number in digits:
        assert f'"{number.rstrip("…")}' in text, number


def test_two_commands():
    """They can be copied: two lines of shell and nothing else, which CI runs as they are."""
    (block,) = re.findall(r"^```sh\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)
    first, second = block.splitlines()
    assert first.endswith("-m cap.prove elliptic")
    assert second.endswith("-m pytest")
    commands = [line for line in CI if line and not line.startswith("#")]
    assert first in commands
    assert commands[-1] == second


def test_slow_tests_are_run():
    """By CI, since the README's command leaves them out; those in a browser, and that repeat."""
    with (ROOT / "pyproject.toml").open("rb") as file:
        options = tomllib.load(file)["tool"]["pytest"]["ini_options"]["addopts"]
    assert options[-2:] == ["-m", "not slow and not browser"]
    assert 'python -m pytest -m "slow and not beside"' in CI
    assert "python -m pytest -m beside" in BESIDE
    assert "python -m pytest -n0 -m browser" in BESIDE


def test_every_step():
    """No step of CI is written and not run."""
    text = "\n".join(CI)
    written = set(re.findall(r"^(\w+)\(\) {", text, re.MULTILINE)) - {"begin", "finish"}
    (run,) = re.findall(r"^for step in (.*); do", text, re.MULTILINE)
    assert len(written) == 5
    assert sorted(run.split()) == sorted(written)


def test_the_citation():
    """`CITATION.cff` and `CHANGELOG.md` know the version."""
    assert f"\nversion: {cap.__version__}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    release, dev, _ = cap.__version__.partition(".dev")
    heading = f"\n## {release} (not yet released)\n" if dev else f"\n## {release}\n"
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert changes.index(heading) == changes.index("\n## ")


def test_the_workflow():
    """The server runs the same scripts, at every minor version from the oldest that is allowed."""
    workflow = (ROOT / ".github/workflows/ci.yml").read_text("utf-8")
    for script in ("bash .ci/run", "bash .ci/beside", 'PATH="$PWD/.venv/bin:$PATH" .ci/formal'):
        assert f"- run: {script}\n" in workflow
    assert all(f" .ci/{script.name}\n" in workflow for script in (ROOT / ".ci").iterdir())
    with (ROOT / "pyproject.toml").open("rb") as file:
        oldest = tomllib.load(file)["project"]["requires-python"].removeprefix(">=")
    versions = list(dict.fromkeys(re.findall(r'"(3\.\d+)"', workflow)))
    assert versions[0] == oldest
    assert [int(v.partition(".")[2]) for v in versions] == [11 + n for n in range(len(versions))]
