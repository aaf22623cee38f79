"""What the README shows is what the commands print."""

from pathlib import Path

from cap import prove, verify

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def block(first):
    """Return the lines of the indented block of the README that begins with ``first``."""
    lines = README.splitlines()
    start = next(n for n, line in enumerate(lines) if line.startswith("    " + first))
    end = next(n for n in range(start, len(lines)) if lines[n] and not lines[n].startswith("    "))
    return [line.strip() for line in lines[start:end] if line.strip()]


def test_the_verdict(capsys, monkeypatch):
    """The line of `cap.verify`, but for its wrapping."""
    monkeypatch.chdir(ROOT)
    assert verify.main(["certificates/elliptic.json"]) == 0
    assert " ".join(block("VERIFIED:")) == capsys.readouterr().out.strip()


def test_the_proof(capsys, tmp_path):
    """The first lines of `cap.prove elliptic`."""
    assert prove.main(["elliptic", "--out", str(tmp_path)]) == 0
    printed = [line.strip() for line in capsys.readouterr().out.splitlines() if line.strip()]
    shown = block("Found 2 elliptic orbits")
    assert shown == printed[: len(shown)]


def test_the_theorem():
    """The digits of the theorem's table are those certified, none rounded up."""
    text = (ROOT / "certificates/elliptic.json").read_text()
    digits = [
        line.removesuffix(" |").rpartition("| ")[2]
        for line in README.splitlines()
        if line.endswith("… |")
    ]
    assert len(digits) == 6
    for number in digits:
        assert f'"{number.rstrip("…")}' in text, number


def test_the_commands():
    """CI installs and tests with the README's own words."""
    script = (ROOT / ".ci/run").read_text()
    for command in ("python3 -m venv .venv && .venv/bin/pip install -q -e '.[dev]'",):
        assert command in README
        assert command in script
    assert "python -m pytest\n" in script
