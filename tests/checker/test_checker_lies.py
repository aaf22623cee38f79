"""Lies about fixed points and captures, each rejected for the reason named: nearly all is true."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, mpf

from checker.altered import changed, rejected, verify
from checker.forge import PARAMETERS, forge
from checker.forge_impact import WALLS, System

pytestmark = pytest.mark.usefixtures("orbits_computed_once")

F = Fraction


def symmetric(trace, digits):
    """Return a certificate of the symmetric orbit at the friction at which it has this trace."""
    with mp.workdps(60):
        system = System(WALLS)

        def excess(alpha):
            return system.symmetric(alpha, 1).trace - mpf(trace)

        alpha = mp.findroot(excess, (mpf("0.5"), mpf("0.55")), solver="anderson", tol=1e-50)
        f, *start = (mp.nstr(q, 40) for q in (alpha, *system.symmetric(alpha, 1).start))
    return forge(parameters=PARAMETERS | {"f": f}, orbit=start, digits=digits)


@pytest.mark.parametrize(("trace", "name"), [("1e-9", "1/4"), ("-1.000000001", "1/3")])
def test_a_rotation_number_near_a_resonance(trace, name):
    """Within 1e-10 of 1/4 or of 1/3, which six digits do not tell; twelve do."""
    certificate = symmetric(trace, 6)
    distances = certificate["claims"]["resonance_distances"]
    assert [q for q, ends in distances.items() if F(ends[0]) <= 0] == [name]
    rejected(certificate, "a resonance distance is not positive")
    verify(symmetric(trace, 12))


def test_a_twist_near_zero():
    """Where the twist of the asymmetric pair changes its sign six digits do not tell it from 0."""
    with mp.workdps(40):
        orbit = System(WALLS).pair(mpf("0.36226226705284"))
        f, *start = (mp.nstr(q, 30) for q in (orbit.alpha, *orbit.start))
    certificate = forge(parameters=PARAMETERS | {"f": f}, orbit=start, digits=6)
    rejected(certificate, "twist does not exclude 0")
    touching = changed(certificate, "claims", "twist", ["-0.0000001", "0"])
    rejected(touching, "twist does not exclude 0")
