"""The command ``cap.verify``: verdicts in one line and in bounded time, whatever the files are."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from fractions import Fraction

import pytest

from cap import verify
from cap.checker.kernel.rejection import Rejected
from cap.command import progress, verifier
from checker.altered import encode
from checker.forge import forge


@pytest.fixture(scope="module")
def good():
    """Return a valid certificate of few digits."""
    return forge(digits=8)


@pytest.fixture
def files(tmp_path, good):
    """Return a directory with a valid certificate and bad files of all sorts."""
    (tmp_path / "good.json").write_bytes(encode(good))
    with (tmp_path / "huge.json").open("wb") as huge:
        huge.truncate(1 << 30)
    (tmp_path / "deep.json").write_bytes(b"[" * 500000)
    (tmp_path / "empty.json").write_bytes(b"")
    (tmp_path / "bad\nname\x1b.json").write_bytes(b"\x1b[31m")
    hostile = {**good, "theorem": "\x1b[31m\n" * 1000, "\r\nVERIFIED: ": "1"}
    (tmp_path / "hostile.json").write_bytes(encode(hostile))
    os.mkfifo(tmp_path / "fifo.json")
    return tmp_path


def test_how_far_a_long_check_is(files, monkeypatch, capsys):
    """On a terminal a line says it, and is cleared before the verdict; in a log nothing does."""

    def told(_data, _step, _jobs, tell):
        tell("turns are followed", 0.0)
        tell("turns are followed", 0.5)
        raise Rejected("no")

    monkeypatch.setattr(verifier, "check", told)
    monkeypatch.setattr(progress, "PATIENCE", 0)
    assert verify.main([str(files / "good.json")]) == 1
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    assert verify.main([str(files / "good.json")]) == 1
    out, err = capsys.readouterr()
    assert out.startswith("REJECTED: ")
    assert "turns are followed" in err
    assert err.rpartition("turns are followed")[2].endswith(f"\r{'':<79}\r")


@pytest.mark.parametrize(
    "name",
    [
        "huge.json",
        "deep.json",
        "empty.json",
        "bad\nname\x1b.json",
        "hostile.json",
        "fifo.json",
        ".",
        "none",
    ],
)
def test_bad_files_are_rejected_in_one_line_and_soon(files, capsys, name):
    """Huge, deep, empty, hostile, no file: one printable line, exit status 1, bounded time."""
    start = time.process_time()
    assert verify.main([str(files / name)]) == 1
    assert time.process_time() - start < 20
    out, err = capsys.readouterr()
    assert err == ""
    assert out.startswith("REJECTED: ")
    assert out.count("\n") == 1
    assert out[:-1].isprintable()
    assert len(out) < 800


def test_the_exit_status(files, capsys):
    """0 if all files are verified, 1 if any is rejected, 2 for no file."""
    good, bad = str(files / "good.json"), str(files / "empty.json")
    assert verify.main([good]) == 0
    assert verify.main([good, bad]) == 1
    assert verify.main([bad, good]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert [line.split(":")[0] for line in lines] == [
        "VERIFIED",
        "VERIFIED",
        "REJECTED",
        "REJECTED",
        "VERIFIED",
    ]
    with pytest.raises(SystemExit) as usage:
        verify.main([])
    assert usage.value.code == 2


def test_any_exception_is_a_rejection(files, capsys, monkeypatch):
    """An unforeseen exception is reported by its type alone, in one line."""

    def fail(*_):
        raise ZeroDivisionError("x" * 10000 + "\n")

    monkeypatch.setattr(verifier, "check", fail)
    assert verify.main([str(files / "good.json")]) == 1
    assert capsys.readouterr().out.endswith("ZeroDivisionError while checking\n")


def test_an_interrupt_exits_130(files, monkeypatch):
    """Ctrl-C ends with the customary status, not with a verdict."""

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(verifier, "check", interrupt)
    assert verify.main([str(files / "good.json")]) == 130


def test_the_command_under_python_o(files):
    """The verdicts are the same under ``python -O``, and nothing goes to stderr."""
    command = [sys.executable, "-O", "-m", "cap.verify", "--explain"]
    for name, status in (("good.json", 0), ("hostile.json", 1)):
        done = subprocess.run(
            [*command, str(files / name)], capture_output=True, text=True, check=False
        )
        assert done.returncode == status
        assert done.stderr == ""
        verdict = done.stdout.splitlines()[-1]
        assert verdict.startswith("VERIFIED: " if status == 0 else "REJECTED: ")


def test_explain_prints_the_steps_before_the_verdict(files, capsys):
    """At least eight indented steps, then the verdict as the last line."""
    assert verify.main(["--explain", str(files / "good.json")]) == 0
    *steps, verdict = capsys.readouterr().out.splitlines()
    assert verdict.startswith("VERIFIED: ")
    assert len(steps) >= 8
    assert all(step.startswith("  ") for step in steps)


def test_latex(files, capsys, good):
    """Macros are outward roundings of the claims; a rejected file gives none."""
    arguments = ["--latex", "--latex-digits", "5", str(files / "good.json")]
    assert verify.main(arguments) == 0
    out, err = capsys.readouterr()
    assert err.startswith("VERIFIED: ")
    macros = dict(
        line.removeprefix("\\newcommand{\\cap").split("}{", 1)
        for line in out.splitlines()
        if not line.startswith("% ")
    )
    assert macros["GoodTrace"] == "[-0.46029, -0.46028]}"
    lower, upper = json.loads(
        macros["GoodBoxX"][:-1].replace("[", '["').replace("]", '"]').replace(", ", '", "')
    )
    claim = good["claims"]["box"]["x"]
    assert Fraction(lower) <= Fraction(claim[0])
    assert Fraction(claim[1]) <= Fraction(upper)
    assert "\\cdot 10^{" in macros["GoodRemainderX"]
    assert all(name.isalpha() for name in macros)
    assert verify.main(["--latex", str(files / "empty.json")]) == 1
    assert capsys.readouterr().out == ""
