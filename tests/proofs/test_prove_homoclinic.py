"""The theorem ``homoclinic``: points found, followed otherwise, and what is not proved."""

from fractions import Fraction

import numpy as np
import pytest
from conftest import STARTS

from cap.errors import BadInput, NotProved
from cap.floats.diagnostics.manifold import manifolds
from cap.floats.engine import swarm
from cap.floats.engine.reversal import retrace
from cap.maps.cones import cones
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs.fixed_point import Located, Setting
from cap.proofs.homoclinic import POINTS, lemma_4_curves, prove, with_room
from cap.proofs.theorems import THEOREMS, accepted
from cap.sets import interval


def setting(start, points=1):
    """Return the setting of a short proof."""
    return Setting(PAPER, start, 6, options={POINTS.name: points})


@pytest.fixture(scope="module")
def proved():
    """Return a certificate with two points, which the checker accepts."""
    return accepted(THEOREMS["homoclinic"], setting(STARTS["saddle"], 2))


def middles(point):
    """Return x and v in floats."""
    return np.array([float(sum(map(Fraction, point[z])) / 2) for z in ("x", "v")])


def test_orbits_go_to_the_saddle_both_ways(proved):
    """In floats orbits from a point come close to P*, forwards and backwards, before they leave."""
    saddle = middles(proved["claims"])
    for point in proved["claims"]["points"]:
        for follow in (
            lambda z, n: swarm.follow(PAPER, z, n).states,
            lambda z, n: retrace(PAPER, z, n),
        ):
            away = [np.hypot(*(follow(middles(point)[None], n)[0] - saddle)) for n in range(12)]
            assert away[0] > 0.2
            assert min(away) < 1e-4


@pytest.mark.slow
def test_angles_are_those_of_the_curves_in_floats(proved):
    """The curves in floats cross at these points, at these angles."""
    found = manifolds(PAPER, orbit=tuple(middles(proved["claims"])), length=1.5, spacing=0.02)
    for point in proved["claims"]["points"]:
        nearest = np.argmin(np.hypot(*(found.homoclinic - middles(point)).T))
        assert np.allclose(found.homoclinic[nearest], middles(point), atol=4e-3)
        claimed = float(Fraction(point["angle"][0]))
        assert abs(found.angles[nearest] - claimed) < 1


def test_what_is_not_proved():
    """A saddle without homoclinic points that are found; orbits that turn; no saddle."""
    with pytest.raises(NotProved, match="no homoclinic point was found"):
        prove(setting(STARTS["second saddle"]))
    with pytest.raises(NotProved, match=r"trace may lie in \[-2, 2\]"):
        prove(setting(STARTS["elliptic"]))
    with pytest.raises(BadInput, match="hits only"):
        prove(setting(Start(0.0, 1.0, (("hit r", 1.0), ("stick", 2.0)))))


def test_cones_along_other_directions():
    """Cones around other directions than those of the curves are refused, with Φ' in this frame."""
    with interval.workprec(300):
        orbit = Located.of(with_room(setting(STARTS["saddle"])))
        near = lemma_4_curves(orbit)
        assert near.slope < Fraction(1, 10**4)
        exchanged = near.frame[0][::-1], near.frame[1][::-1]
        with pytest.raises(NotProved, match="frame is not that of a saddle"):
            cones(orbit.osc, orbit.point, exchanged, near.reach)
