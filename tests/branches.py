"""Certificates of curves of periodic orbits, each proved once."""

from copy import deepcopy
from fractions import Fraction
from functools import cache

import models

from cap.orbits.itinerary import Contact, Itinerary
from cap.proofs.contacts_branch import prove
from cap.system.files import read
from cap.system.moving import moving
from cap.system.symmetry import symmetries

ENDS = Fraction("1.045"), Fraction("1.06")
FLIP = Fraction("1.5"), Fraction("1.55")
TURN = [("back", "turn", "coming"), ("coming", "kick", "going"), ("going", "stop", "back")]


def ball(ends, guess):
    """Return the curve of a ball over an amplitude."""
    system = moving(lambda A: models.ball(A=A), "A", ends, ["fly"])
    return prove(Itinerary(system, [Contact("fly", "table", "fly")]), guess, ends)


def clock():
    """Return the curve of the clock over its dry friction."""
    ends = Fraction(0), Fraction("0.01")
    system = moving(lambda f: read("examples/clock.py", {"f": f}), "f", ends, ["going"])
    guess = [6.292138, -1.403255, 0, 1.626726, 0, 1.288769, 3.146611, 1.653107, 0, 0.005]
    return prove(Itinerary(system, [Contact(*names) for names in TURN]), guess, ends)


def pair(range_=("0.17", "0.19")):
    """Return the curve of an impact pair, to where it touches an end once more."""
    ends = Fraction(range_[0]), Fraction(range_[1])
    system = moving(lambda s: read("examples/harvester.py", {"s": s}), "s", ends, ["free"])
    contacts = [Contact("free", end, "free") for end in ("top", "bottom")]
    guess = [-0.01301, 0.09178, 0.57762, 1.45939, -0.09178, -0.44429, 0.18357]
    return prove(Itinerary(system, contacts), guess, ends)


def level(range_=("0.0608", "0.0625")):
    """Return the curve of symmetric orbits of a level pair, to where each end is touched again."""
    ends = Fraction(range_[0]), Fraction(range_[1])

    def at(s):
        return read("examples/harvester.py", {"s": s, "G": 0})

    system = moving(at, "s", ends, ["free"])
    (found,) = symmetries(system, ["s"])
    contacts = [Contact("free", "top", "free")]
    return prove(Itinerary(system, contacts, 1, found), [0.0866, 0.0308, 0.3423, 0.0616], ends)


def thrice(range_=("0.173", "0.178")):
    """Return the curve of an impact pair with two hits of the top, to where one of them is lost."""
    ends = Fraction(range_[0]), Fraction(range_[1])
    system = moving(lambda s: read("examples/harvester.py", {"s": s}), "s", ends, ["free"])
    contacts = [Contact("free", end, "free") for end in ("top", "bottom", "top")]
    guess = [0.7976, 0.088645, 0.006581, 1.466816, -0.088645, -0.441985, 1.979846, 0.088645]
    return prove(Itinerary(system, contacts), [*guess, 0.568737, 0.17729], ends)


def wall():
    """Return the curve of a spring that hits a wall, to where it only touches it."""
    ends = Fraction("0.189"), Fraction("0.191")

    def at(gap):
        return read("examples/impact_oscillator.py", {"omega": "5/2", "gap": gap})

    system = moving(at, "gap", ends, ["free"])
    contacts = [Contact("free", "wall", "free")]
    return prove(Itinerary(system, contacts), [1.2374, 0.19, 0.0007, 0.19], ends)


def symmetric(range_=("0.465", "0.467")):
    """Return the curve of symmetric orbits of the oscillator over its friction."""
    ends = Fraction(range_[0]), Fraction(range_[1])
    system = moving(lambda f: read("examples/oscillator.py", {"f": f}), "f", ends, ["right"])
    (found,) = symmetries(system, ["f"])
    contacts = [Contact("right", "wall", "left")]
    return prove(Itinerary(system, contacts, 1, found), [0.8, 1, 1.07, 0.466], ends)


CASES = {
    "pitchfork": symmetric,
    "fold": lambda: ball(ENDS, [0.1, 0.1, -3.14159, 1.0525]),
    "flip": lambda: ball(FLIP, [0.8, 1.1, -3.14159, 1.525]),
    "clock": clock,
    "graze": pair,
    "level": level,
    "thrice": thrice,
    "wall": wall,
}


def certificate(name):
    """Return a certificate, which may be changed, and why the curve ends."""
    return deepcopy(_proved(name)[0])


@cache
def _proved(name):
    return CASES[name]()
