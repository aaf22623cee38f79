"""The compiled flow and the mechanics of `cap.flow.model` are the same, to rounding."""

import math
from fractions import Fraction

import pytest
from support import rounds, seeded

from cap.errors import NotProved
from cap.floats.engine import swarm
from cap.flow.itinerary import itinerary
from cap.flow.propagation import after_periods
from cap.parameters import PAPER, Parameters
from cap.sets import interval

SETS = {
    "paper": PAPER,
    "strong": Parameters(*map(Fraction, (3, 1, "2/5", -1, 1))),
    "soft": Parameters(*map(Fraction, (2, "3/2", "1/3", -1, "1/2", "9/10", 0))),
    "viscous": Parameters(*map(Fraction, (2, 1, "1/2", 0, 3, "19/20", "1/8"))),
}


def size(monodromy):
    """Return the largest entry, at least 1: by so much a rounding error may grow."""
    return 1 + max(abs(float(entry)) for row in monodromy for entry in row)


@pytest.mark.parametrize("name", SETS)
def test_against_the_model_in_floats(name):
    """The same words at the same times, the same state and derivative, on random orbits."""
    p, random = SETS[name], seeded(name)
    T = 2 * math.pi / float(p.omega)
    for _ in range(rounds(40)):
        x = random.uniform(float(p.l), float(p.r))
        v = random.uniform(-2, 2) * float(p.F / p.omega)
        path = itinerary(p, x, v, T)
        events = [e for e in swarm.itinerary(p, (x, v), 1) if not e.word.startswith("capture")]
        result = swarm.follow(p, [(x, v)], 1, derivative=True)
        if any(word.startswith("capture") for word in path.words):
            continue  # one bounces longer than the other before it is captured
        error = 1e-13 * size(path.monodromy) ** 2
        assert tuple(e.word for e in events) == path.words
        assert [e.time for e in events] == pytest.approx([e.time for e in path.events], abs=error)
        assert result.states[0] == pytest.approx(path.end, abs=error)
        for row, mine in zip(result.monodromy[0], path.monodromy, strict=True):
            assert row == pytest.approx(mine, abs=1e-12 * size(path.monodromy) ** 3)


@pytest.mark.slow
@pytest.mark.parametrize("name", SETS)
def test_against_certified_enclosures(name):
    """A point is followed in balls; where its events are proved, the floats are where they are."""
    p, random, proved = SETS[name], seeded(name + "balls"), 0
    for _ in range(rounds(12)):
        x = random.uniform(float(p.l), float(p.r))
        v = random.uniform(-2, 2) * float(p.F / p.omega)
        result = swarm.follow(p, [(x, v)], 2, derivative=True)
        with interval.workprec(200):
            try:
                image = after_periods(p, interval.Ball(x), interval.Ball(v), 2)
            except NotProved:
                continue
            proved += 1
            error = 1e-13 * size(result.monodromy[0]) ** 2
            for mine, certified in zip(result.states[0], image.state, strict=True):
                assert abs(mine - float(certified.mid())) < error
                assert 2 * certified.rad() < 1e-30
    assert proved >= rounds(12) * 3 // 4
