"""One file that checks: bare Python runs it anywhere, and it says what `cap.verify` says."""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from cap.checker.theorems import NAMES
from cap.command import archive, entry

CERTIFICATES = Path(__file__).parents[2] / "certificates"
FOREIGN = "import sys; sys.path[:] = [p for p in sys.path if 'site-packages' not in p]"


@pytest.fixture(scope="module")
def checker(tmp_path_factory):
    """Write the archive; return its path."""
    path = tmp_path_factory.mktemp("archive") / "cap-check.pyz"
    assert archive.main([str(path)]) == 0
    return path


def run(checker, *words):
    """Run it without the tree, the libraries and the environment; return status and output."""
    command = [sys.executable, "-I", "-S", str(checker), *map(str, words)]
    how = {"cwd": checker.parent, "env": {}, "capture_output": True, "text": True}
    done = subprocess.run(command, check=False, **how)
    return done.returncode, done.stdout, done.stderr


def test_what_it_says_is_what_the_package_says(checker, capsys):
    """Word for word, the steps included; several files in two processes."""
    names = [CERTIFICATES / f"{name}.json" for name in ("impulse-1", "saddle", "capture")]
    status, told, told_beside = run(checker, "--explain", "--jobs", "2", *names)
    assert entry.run("cap.command.verifier:main", ["--explain", *map(str, names)]) == status == 0
    here = capsys.readouterr()
    assert told == here.out
    assert told.count("VERIFIED: ") == 3
    assert told_beside.startswith("3 of 3 verified in ")


def test_it_holds_every_theorem(checker):
    """Each can be read by its name: nothing that a theorem needs was left out."""
    with zipfile.ZipFile(checker) as file:
        held = set(file.namelist())
    assert {f"cap/checker/theorems/{name}.py" for name in NAMES} <= held
    load = f"sys.path.insert(0, {str(checker)!r}); from cap.checker.theorems import NAMES, load\n"
    code = f"{FOREIGN}\n{load}print(*[load(n).__name__ for n in NAMES])"
    words = [sys.executable, "-I", "-S", "-c", code]
    done = subprocess.run(words, env={}, capture_output=True, text=True, check=True)
    assert len(done.stdout.split()) == len(NAMES)


def test_it_is_the_same_each_time_and_small(checker):
    """Made again it has the same bytes, about half a million."""
    assert archive.archive() == checker.read_bytes()
    assert checker.stat().st_size < 550_000


def test_what_else_it_can_do(checker):
    """It lists what to read, prints macros, complains in a line, and says what it cannot do."""
    status, told, _ = run(checker, "--reading", "impulse")
    assert status == 0
    assert "theorems/impulse.py" in told
    status, told, _ = run(checker, "--latex", CERTIFICATES / "impulse-1.json")
    assert status == 0
    assert told.startswith("%")
    status, told, complaint = run(checker, "--formal", CERTIFICATES / "saddle.json")
    assert (status, told) == (2, "")
    assert "whole package" in complaint
    assert complaint.count("\n") == 1
    status, told, _ = run(checker, "elliptic")
    assert status == 2
    assert told.startswith('CANNOT READ: "elliptic"')
    assert "python cap-check.pyz" in run(checker, "--help")[1]


def test_where_it_cannot_be_written(tmp_path, capsys):
    """One line, status 2, nothing half-written."""
    for path in (tmp_path, tmp_path / "none" / "x.pyz"):
        assert archive_refused(path)
    assert not list(tmp_path.iterdir())
    assert capsys.readouterr().err.count("\n") == 2


def archive_refused(path):
    """Tell whether a path is refused."""
    with pytest.raises(SystemExit) as ended:
        archive.main([str(path)])
    return ended.value.code == 2
