"""The next releases from intervals of places: as orbits in floats, and as the checker says."""

import math
from fractions import Fraction

import numpy as np
import pytest
from support import seeded

from cap.areas.folded.basins import compiled_basins
from cap.areas.folded.constants import system_of
from cap.areas.folded.next_releases import HELD, next_release, next_releases
from cap.areas.folded.paths import LOST, RELEASED
from cap.areas.folded.rests import height
from cap.checker.attracting.segment import Strip
from cap.checker.attracting.sinks import Ellipse
from cap.checker.folded.basins import Basins, Row
from cap.checker.folded.motion import Releases
from cap.checker.folded.paths import next_release as followed
from cap.checker.folded.rests import height as resting
from cap.checker.folded.table import ATTRACTOR, SEGMENT
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.walls import Parameters as Given
from cap.floats.engine import swarm
from cap.parameters import PAPER, Parameters

# compiled anew in a fresh clone: tens of seconds; the checker has its own code
pytestmark = pytest.mark.slow

OTHER = Parameters(
    **{k: Fraction(z) for k, z in {"F": 3, "omega": 2, "f": "4/3", "l": "-1/2", "r": "3/4"}.items()}
)
NOWHERE = Basins()
AT = np.array([-0.99, -0.4, 0.5, 0.99])


def given(p):
    """Return parameters for the checker."""
    return Given(p.F, p.omega, p.f, p.l, p.r)


def drawn(random, width, count):
    """Return intervals of several sizes."""
    sizes = [width * 10 ** -random.uniform(1, 5) for _ in range(count)]
    lows = [random.uniform(0, width - size) for size in sizes]
    return np.array([(low, low + size) for low, size in zip(lows, sizes, strict=True)])


def later(p, places):
    """Return the distances to the wall ahead at the next releases, in floats."""
    scale = float(p.omega**2 / p.F)
    first = (math.pi - math.acos(p.f / p.F)) / 2 / math.pi - 1e-9  # to the left
    states = [(float(p.l) + place / scale, 0.0) for place in places]
    found = np.full(len(places), math.nan)
    for n in range(1, 50):
        states = swarm.follow(
            p, states, 0.5, (first + (n - 1) / 2) * 2 * math.pi / float(p.omega)
        ).states
        for k, (x, v) in enumerate(states):
            if v == 0 and math.isnan(found[k]):
                found[k] = scale * (float(p.r) - x if n % 2 else x - float(p.l))
    return found


@pytest.mark.parametrize("p", [PAPER, OTHER], ids=["paper", "other"])
def test_orbits_in_floats(p):
    """They are in the models, with their difference quotients."""
    y, random = system_of(p, forwards=True), seeded("next releases")
    places = drawn(random, y.width, 30)
    found, compared = next_releases(y, NOWHERE, places), 0
    for (low, high), kind, model in zip(places, found.kinds, found.models, strict=True):
        if kind != RELEASED:
            continue
        near = later(p, low + (high - low) * (AT + 1) / 2)
        value = sum(c * AT**k for k, c in enumerate(model[:7]))
        assert (abs(value - near) <= model[7] + 1e-7).all()
        rates = sum(k * c * AT[1:3] ** (k - 1) for k, c in enumerate(model[:7]) if k)
        rate = (near[2] - near[1]) / (AT[2] - AT[1])
        bend = sum(k * (k - 1) * abs(c) for k, c in enumerate(model[:7]))
        assert abs(rates.mean() - rate) <= 4 * model[7] + bend + 1e-6
        compared += 1
    assert compared > 8


@pytest.mark.parametrize("p", [PAPER, OTHER], ids=["paper", "other"])
def test_the_checker_follows_the_same(p):
    """The same intervals, and to the same places."""
    y, other, random = (
        system_of(p, forwards=True),
        Releases(given(p)),
        seeded("next releases, twice"),
    )
    places = drawn(random, y.width, 250)
    found = next_releases(y, NOWHERE, places)
    assert 30 < (found.kinds == RELEASED).sum() < 245
    for ends, kind, model in zip(places.tolist(), found.kinds, found.models, strict=True):
        try:
            c, e = followed(other, NOWHERE, tuple(ends))
        except Rejected:
            assert kind == LOST
            continue
        assert kind == RELEASED
        assert model[:7] == pytest.approx(c, abs=1e-9 + 1e-3 * e)
        assert model[7] == pytest.approx(e, rel=0.05, abs=1e-10)


def test_a_basin_holds_orbits():
    """All that pass the time 0 in one as large as the plane; none in one that is thin, or far."""
    y, (low, high) = system_of(PAPER, forwards=True), (0.731, 0.7311)
    all_p, all_s, both = Row(1.0, 0.0, -99.0, 99.0), Row(0.0, 1.0, -99.0, 99.0), Row(1, 1, -99, 99)
    room = np.zeros((5, 7))

    def becomes(basins):
        found = next_release(y, compiled_basins(basins), low, high, room)[0]
        same = followed(Releases(given(PAPER)), basins, (low, high))
        assert (found == HELD + same) if isinstance(same, int) else (found == RELEASED)
        return found

    assert becomes(Basins((Strip((all_p, all_s, both)),))) == HELD + SEGMENT
    for rows in (
        (all_p._replace(high=-98.0), all_s, both),
        (all_p, all_s._replace(low=0.3, high=0.3 + 1e-9), both),
        (all_p, all_s, both._replace(low=98.0)),
    ):
        assert becomes(Basins((Strip(rows),))) == RELEASED
    wide = Row(0.01, 0.0, -1.0, 1.0), Row(0.0, 0.01, -1.0, 1.0)
    assert becomes(Basins(ellipses=(Ellipse(wide),))) == HELD + ATTRACTOR
    for rows in (
        (wide[0], Row(0.0, 1e9, -1.0, 1.0)),
        (wide[0], Row(0.0, 0.01, 1.0, 3.0)),
        (Row(0.01, 0.0, 0.0, 2.0), wide[1]),
    ):
        assert becomes(Basins(ellipses=(Ellipse(rows),))) == RELEASED


def test_nothing_is_followed_across_a_border():
    """An interval whose orbits meet other events; all places at once; what is not a number."""
    places = np.array([(0.0, 2.0), (0.5, 1.0), (1.2, 1.3), (math.nan, 1.0)])
    assert (next_releases(system_of(PAPER, forwards=True), NOWHERE, places).kinds == LOST).all()


def test_rests_after_slow_hits():
    """As the checker finds them, but for what is close to the border."""
    y, other, random = system_of(PAPER, forwards=True), Releases(given(PAPER)), seeded("rests")
    resting_near = [0, 0, 0]
    for _ in range(3000):
        t, speed = random.uniform(-1.5, 1.5), 10 ** random.uniform(-3, -0.3)
        ends = t, t + 10 ** random.uniform(-9, -3)
        found, known = height(y, ends, speed), resting(other, ends, speed)
        if known is None:
            assert found == -1
        elif found >= 0:
            assert found == pytest.approx(known, abs=1e-15)
        resting_near[0 if found < 0 else 1 + (found > 0)] += 1
    assert min(resting_near) > 10
