"""The command ``cap.verify``: verdicts in one line and in bounded time, whatever the files are."""

from __future__ import annotations

import fcntl
import json
import os
import pty
import struct
import subprocess
import sys
import termios
import time
from fractions import Fraction

import pytest

from cap import verify
from cap.checker.kernel.rejection import Rejected
from cap.command import outcome, progress, verifier
from checker.altered import encode
from checker.forge import forge

NO_FILES = ("fifo.json", ".", "none", "no\0name")  # nothing to be read


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


def test_how_long_a_check_takes(capsys, monkeypatch, files):
    """It is said before, of large files whose time is known, and not short."""
    assert 5 < outcome.expected("island-2") < 60
    assert outcome.expected("elliptic") == outcome.expected(str(files / "deep.json")) == 0
    for name in ("island-2", "island", "none", "mixed"):
        verifier.announce(name)
    assert capsys.readouterr().err == f'"island-2": about {outcome.expected("island-2")} s\n'


def test_how_far_a_long_check_is(files, monkeypatch, capsys):
    """On a terminal a line says it, and is cleared before the verdict; in a log nothing does."""

    def told(_data, _step, _jobs, tell):
        tell("turns are followed", 0.0)
        tell("turns are followed", 0.5)
        raise Rejected("no")

    monkeypatch.setattr(outcome, "check", told)
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
        "no\0name",
    ],
)
def test_bad_files_are_refused_in_one_line_and_soon(files, capsys, name):
    """Huge, deep, empty, hostile, no file: one printable line, no status 0, bounded time."""
    status, verdict = (2, "CANNOT READ: ") if name in NO_FILES else (1, "REJECTED: ")
    start = time.process_time()
    assert verify.main([str(files / name)]) == status
    assert time.process_time() - start < 20
    out, err = capsys.readouterr()
    assert err == ""
    assert out.startswith(verdict)
    assert out.count("\n") == 1
    assert out[:-1].isprintable()
    assert len(out) < 800


def test_the_exit_status(files, capsys):
    """0 if all files are verified, 1 if any is rejected, 2 if any cannot be read, or for none."""
    good, bad, none = (str(files / name) for name in ("good.json", "empty.json", "none"))
    for names in ([none], [none, bad], [good, none], [bad, none, good]):
        assert verify.main(names) == 2
    assert capsys.readouterr().out.count("CANNOT READ") == 4
    assert verify.main([good]) == 0
    assert verify.main([good, bad]) == 1
    assert verify.main([bad, good]) == 1
    lines = capsys.readouterr().out.splitlines()
    small_ones_first = ["VERIFIED", "REJECTED", "VERIFIED", "REJECTED", "VERIFIED"]
    assert [line.split(":")[0] for line in lines] == small_ones_first
    with pytest.raises(SystemExit) as usage:
        verify.main([])
    assert usage.value.code == 2


def test_any_exception_is_a_rejection(files, capsys, monkeypatch):
    """An unforeseen exception is reported by its type alone, in one line."""

    def fail(*_):
        raise ZeroDivisionError("x" * 10000 + "\n")

    monkeypatch.setattr(outcome, "check", fail)
    assert verify.main([str(files / "good.json")]) == 1
    assert capsys.readouterr().out.endswith("ZeroDivisionError while checking\n")


def test_an_interrupt_exits_130(files, monkeypatch):
    """Ctrl-C ends with the customary status, not with a verdict."""

    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(outcome, "check", interrupt)
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


def on_a_terminal(columns, *words):
    """Return what a command prints on a terminal of this width."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 50, columns, 0, 0))
    try:
        command = [sys.executable, "-m", *words]
        subprocess.run(command, stdout=theirs, stderr=subprocess.DEVNULL, check=False)
        os.set_blocking(ours, False)
        return os.read(ours, 100_000).decode().replace("\r\n", "\n")
    finally:
        os.close(theirs)
        os.close(ours)


def test_a_verdict_is_laid_out_on_a_terminal(files, capsys):
    """At its width, and nothing else begins a line; elsewhere it is one line."""
    assert verify.main([str(files / "good.json")]) == 0
    whole = capsys.readouterr().out
    assert whole.count("\n") == 1
    shown = on_a_terminal(70, "cap.verify", str(files / "good.json"))
    first, *others = shown.splitlines()
    assert len(others) > 8
    assert first.startswith("VERIFIED: ")
    assert all(line.startswith("  ") for line in others)
    assert max(len(line) for line in others[:-1]) <= 70
    assert shown.endswith(whole.rpartition(" (")[2])
    shown = on_a_terminal(70, "cap.verify", "--one-line", str(files / "good.json"))
    assert shown == whole


def test_a_theorem_is_wrapped_at_the_width_of_the_terminal(tmp_path):
    """Its sentence is; a table is left as it is."""
    words = ("cap.prove", "segment", "--digits", "6", "--out", str(tmp_path / "x.json"))
    for width in (60, 90):
        sentence = on_a_terminal(width, *words).split("Theorem (segment).")[1].split("\n\n")[0]
        assert width - 20 < max(len(line) for line in sentence.splitlines()) <= width
