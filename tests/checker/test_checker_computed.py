"""The numbers on the way to each verdict are those that were recorded: see ``computed``."""

import pytest

from cap.checker.kernel.interval import Interval
from checker import computed

QUICK = "capture impulse segment sliding symmetric pitchfork saddle elliptic island contacts-"
SMALL = "certificates/segment.json"


def paths():
    """Return the certificates, for `parametrize`; what takes longer is slow."""
    quick = tuple(f"certificates/{word}" for word in QUICK.split())
    return [
        pytest.param(path, marks=[] if path.startswith(quick) else [pytest.mark.slow])
        for path in computed.kept()
    ]


@pytest.mark.parametrize("path", paths())
def test_every_number_on_the_way(path):
    """A digest for each module: a change that is meant is to be recorded anew."""
    assert computed.digests(path) == computed.kept()[path]


def test_a_slip_is_noticed(monkeypatch):
    """A root that is rounded the other way, of numbers with room, changes no verdict."""
    sqrt = Interval.sqrt

    def slipped(x):
        root = sqrt(x)
        return Interval(root.lo, root.hi + 1, root.bits)

    monkeypatch.setattr(Interval, "sqrt", slipped)
    found, kept = computed.digests(SMALL), computed.kept()[SMALL]
    assert {name for name in kept if found[name] != kept[name]} >= {"kernel.interval"}


def test_what_is_patched_is_restored():
    """Functions of the checker and of the library."""
    before = Interval.__add__, Interval.enclosing, Interval.lower, computed.math.cos
    computed.digests(SMALL)
    assert before == (Interval.__add__, Interval.enclosing, Interval.lower, computed.math.cos)
