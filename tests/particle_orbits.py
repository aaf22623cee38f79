"""Orbits of two masses for tests: found once, located at a precision."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

from cap.floats.candidates import Request, particles
from cap.parameters import PAPER
from cap.proofs.fixed_point import Setting
from cap.proofs.particle_orbit import located
from cap.sets import interval

STORED = Path(__file__).parents[1] / "certificates"
MASSES = Fraction(1), Fraction(9, 10)
A = replace(PAPER, f=Fraction(91, 200))
B = replace(PAPER, l=Fraction(-11, 10), r=Fraction(11, 10))
NEGATIVE = PAPER


@cache
def setting(p=A, kind="particles", digits=30, guard=15):
    """Return the setting of a proof."""
    found = particles(Request(kind, p, options={"masses": MASSES})).candidates[0]
    return Setting(p, found.guess, digits, guard=guard)


@cache
def orbit(p=A, kind="particles", digits=30):
    """Return an orbit proved to exist."""
    asked = setting(p, kind, digits)
    with interval.workprec(asked.bits):
        return located(asked, asked.particles)


def state_of(orbit):
    """Return the state at t = 0, (x, v), in floats."""
    return [float(q.mid()) for q in orbit.strobe.point]
