"""A spring between two walls, driven by two harmonics of one clock, the second as two variables."""

from fractions import Fraction

import numpy as np
import pytest

from cap import Bounce, Guard, Mode, System, variables
from cap.certificate.writer import dumps
from cap.checker.verdict import check
from cap.floats.models.engine import Engine
from cap.floats.models.periodic import near
from cap.proofs import contacts

y, v, p, q, cos, sin = variables("y v p q cos sin")


def spring(a=2, b=Fraction(1, 2), k=2, c=Fraction(1, 10), g=Fraction(1, 4), e=Fraction(4, 5)):
    """Return y'' = a cos t + b cos 2t - k y - c y' - g between walls at -1 and 1."""
    rates = {"y": v, "v": a * cos + b * p - k * y - c * v - g, "p": -2 * q, "q": 2 * p}

    def copy(mode, other, sign):
        floor, ceiling = (Guard(1 + s * y, mode, Bounce(e)) for s in (1, -1))
        tick = Guard(sign * cos, other, {"p": -1, "q": 0})
        return Mode(rates, {"floor": floor, "ceiling": ceiling, "tick": tick})

    modes = {"right": copy("right", "left", 1), "left": copy("left", "right", -1)}
    return System("y v p q", 1, modes)


@pytest.mark.slow
def test_two_harmonics():
    """The variables are cos 2t and sin 2t whatever they were; an orbit with both hits is proved."""
    system = spring()
    engine = Engine(system)
    ends = engine.follow([[0.0, 0.0, 7.0, -3.0]], ["right"], periods=300, log=4000)
    for _, t, _, _, _, _, *pair in ends.log[2:200]:
        assert np.allclose(pair, (np.cos(2 * t), np.sin(2 * t)), atol=1e-9)
    orbit = near(system, ends.states[0].tolist(), "right", 1)
    assert [c.guard for c in orbit.itinerary.contacts] == ["ceiling", "tick", "floor", "tick"]
    assert orbit.attracts
    found = check(dumps(contacts.prove(orbit.itinerary, orbit.guess, 12)).encode(), lambda _: None)
    assert found
