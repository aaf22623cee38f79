"""The line that says how far a computation is, on terminals of any width and in logs."""

import os
import sys

import pytest

from cap.command import progress
from cap.command.progress import Progress


class Screen:
    """A standard error that keeps what is printed, a terminal or not."""

    def __init__(self, *, terminal, columns=80):
        self.text, self.terminal, self.columns = "", terminal, columns

    def isatty(self):
        """Return whether it is a terminal."""
        return self.terminal

    def fileno(self):
        """Return a number for `os.get_terminal_size`."""
        return 2

    def write(self, text):
        """Keep what is written."""
        self.text += text

    def flush(self):
        """Do nothing."""


class Clock:
    """A clock that stands until it is told to go on."""

    now = 1000.0

    def monotonic(self):
        """Return the time."""
        return self.now


@pytest.fixture
def clock(monkeypatch):
    """Return the clock of the progress."""
    found = Clock()
    monkeypatch.setattr(progress, "time", found)
    return found


def screen(monkeypatch, *, terminal, columns=80):
    """Return what stands for standard error."""
    found = Screen(terminal=terminal, columns=columns)
    monkeypatch.setattr(sys, "stderr", found)
    size = os.terminal_size((columns, 24))
    monkeypatch.setattr("os.get_terminal_size", lambda _number: size)
    return found


@pytest.mark.parametrize("columns", [20, 40, 75, 80, 200])
def test_a_line_never_wraps(monkeypatch, clock, columns):
    """Neither words of any length nor a bar, with days left, reach the last column."""
    err, line = screen(monkeypatch, terminal=True, columns=columns), Progress()
    clock.now += 100000
    line.tell("x" * 300)
    clock.now += 1
    line.tell("a long description of a part", 0.001)
    clock.now += 100000
    line.tell("a long description of a part", 0.002)
    line.clear()
    shown = [part for part in err.text.split("\r") if part]
    assert len(shown) == 3
    assert {len(part) for part in shown} == {columns - 1}
    assert shown[-1].strip() == ""


def test_a_bar(monkeypatch, clock):
    """After a second, with the time that the rest may take; nothing of what is done at once."""
    err, bar = screen(monkeypatch, terminal=True), Progress()
    bar.tell("sali", 0.0)
    clock.now += 0.5
    bar.tell("sali", 0.4)
    assert err.text == ""
    bar.clear()
    assert err.text == ""
    clock.now += 300
    bar.tell("sali", 0.5)
    assert f"sali{' ' * 37}[{'#' * 8}{' ' * 8}]  50%  5 min left" in err.text
    before = err.text
    clock.now += 0.01
    bar.tell("sali", 0.51)
    assert err.text == before


def test_words_clear_the_line(monkeypatch, clock):
    """No words clear what is there, and only that."""
    err, line = screen(monkeypatch, terminal=True), Progress()
    line.tell("")
    assert err.text == ""
    clock.now += 1
    line.tell("three cells")
    line.tell("")
    line.tell("")
    assert err.text == f"\r{'three cells':<79}\r\r{'':<79}\r"


def test_a_log_has_a_line_now_and_then(monkeypatch, clock):
    """Of a run of ten minutes at most twenty lines, whole ones; of one of seconds, none."""
    err, line = screen(monkeypatch, terminal=False), Progress()
    for second in range(600):
        clock.now += 1
        line.tell(f"{second} cells")
        line.tell("basin", second / 600)
        if second == 20:
            assert err.text == ""
    line.clear()
    lines = err.text.splitlines()
    assert len(lines) == 20
    assert "\r" not in err.text
    assert lines[0] == "29 cells"


def test_a_log_says_how_long(monkeypatch, clock):
    """The part that is done, and the time that the rest may take."""
    err, line = screen(monkeypatch, terminal=False), Progress()
    line.tell("basin", 0.0)
    clock.now += 40
    line.tell("basin", 0.01)
    assert err.text == "basin: 1%  66 min left\n"


def test_phases_have_one_estimate(monkeypatch, clock):
    """Of all of them, from the time since the first; what begins anew is estimated anew."""
    err, line = screen(monkeypatch, terminal=True), Progress()
    line.tell("a search", 0.25)
    clock.now += 100
    line.tell("a search", 0.5)
    assert "50%  3 min left" in err.text
    clock.now += 20
    line.tell("what is looked at between", None)
    clock.now += 80
    line.tell("its check", 0.75)
    assert "its check" in err.text
    assert "75%  100 s left" in err.text
    clock.now += 1000
    line.tell("again", 0.5)
    clock.now += 10
    line.tell("its check", 0.75)
    assert err.text.rstrip().endswith("75%  10 s left")


def test_no_standard_error(monkeypatch):
    """Where it is closed, nobody is told."""
    monkeypatch.setattr(sys, "stderr", None)
    Progress().tell("words")
    Progress().tell("words", 0.5)
    Progress().clear()
