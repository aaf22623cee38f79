"""Constants, and the numbers on the way to each verdict, are as recorded: see ``computed``."""

from collections import defaultdict
from hashlib import sha256
from pathlib import Path

import pytest

from cap.checker.kernel import line
from cap.checker.kernel.interval import Interval
from cap.checker.theorems import NAMES
from checker import computed

SMALL = "certificates/segment.json"
QUICK = (
    *("contact_capture_oscillator", "contact_capture-1", "contact_elliptic-1", "capture-3"),
    *("contacts-1", "elliptic", "impulse-1", "pitchfork", "saddle", "segment", "sliding"),
    *("symmetric", "symmetric-2"),
)


def paths():
    """Return the certificates, for `parametrize`; what takes longer is slow."""
    slow = {path: Path(path).stem not in QUICK for path in computed.kept()["certificates"]}
    return [pytest.param(path, marks=[pytest.mark.slow] * slow[path]) for path in slow]


@pytest.mark.parametrize("path", paths())
def test_every_number_on_the_way(path):
    """A digest for each module: a change that is meant is to be recorded anew."""
    assert computed.digests(path) == computed.kept()["certificates"][path]


def test_every_constant():
    """Of modules and classes, and defaults of functions: all that is not computed."""
    assert computed.constants() == computed.kept()["constants"]


def test_each_theorem_is_there():
    """By the check of one certificate, at least."""
    modules = {module for found in computed.kept()["certificates"].values() for module in found}
    assert {f"theorems.{name}" for name in NAMES} <= modules


def test_a_slip_is_noticed(monkeypatch):
    """A root that is rounded the other way, of numbers with room, changes no verdict."""
    sqrt = Interval.sqrt

    def slipped(x):
        root = sqrt(x)
        return Interval(root.lo, root.hi + 1, root.bits)

    monkeypatch.setattr(Interval, "sqrt", slipped)
    found, kept = computed.digests(SMALL), computed.kept()["certificates"][SMALL]
    assert {name for name in kept if found[name] != kept[name]} >= {"kernel.interval"}


MARGIN = 0.0


def decides(x):
    """Return what is decided by a variable."""
    reach = x + MARGIN
    return reach > 0


def yields(x):
    """Give a number and another."""
    yield x
    yield x + MARGIN


@pytest.mark.parametrize("f", [decides, yields])
def test_what_is_noted(monkeypatch, f):
    """A variable, even where no more depends on it, and what is yielded."""
    digests = []
    for margin in (0.0, 0.0, 1e-12):
        monkeypatch.setitem(globals(), "MARGIN", margin)
        found = defaultdict(sha256)
        value = computed.noting(f, found)(1.0)
        assert value is True or len(list(value)) == 2
        digests.append([each.digest() for each in found.values()])
    assert digests[0] == digests[1] != digests[2]


def test_a_constant_is_noticed(monkeypatch):
    """A margin of a module, another default."""
    kept = computed.constants()
    monkeypatch.setattr(line, "BEND", line.BEND + 1e-9)
    monkeypatch.setattr(Interval.__init__, "__defaults__", (7,))
    altered = {name for name, digest in computed.constants().items() if digest != kept[name]}
    assert altered == {"kernel.interval", "kernel.line"}


def test_what_is_patched_is_restored():
    """Functions of the checker and of the library."""
    before = Interval.__add__, Interval.enclosing, Interval.lower, computed.math.cos
    computed.digests(SMALL)
    assert before == (Interval.__add__, Interval.enclosing, Interval.lower, computed.math.cos)
