"""Fixed points in a sweep, and flights from wall to wall over boxes of launches."""

from dataclasses import fields, replace
from fractions import Fraction

import numpy as np
import pytest
from conftest import ORBITS
from support import seeded

from boxes.drawn import SHIFTED, system
from cap.boxes.existence import FixedPoints, fixed_points
from cap.boxes.flow import flow, number_of
from cap.boxes.launch import EITHER, HITS, STOPS, launches
from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.engine.flow import one_period
from cap.flow.itinerary import oscillator
from cap.parameters import PAPER

# compiled anew in a fresh clone: tens of seconds; no theorem uses it
pytestmark = pytest.mark.slow

TRACES = {"elliptic": -0.46029, "mirror": -0.46029, "saddle": 3.3755, "second saddle": 1336.05}


def boxes(half, *, shift=0.0):
    """Return boxes around the four orbits of the paper."""
    return np.array(
        [
            [x + shift - half, x + shift + half, v - half, v + half]
            for x, v in (refined(*orbit[:2]) for orbit in ORBITS.values())
        ]
    )


def refined(x, v):
    """Return a fixed point in floats, by Newton's method."""
    osc, z = oscillator(PAPER), np.array([x, v])
    for _ in range(8):
        orbit = one_period(osc, *z)
        z = z - np.linalg.solve(np.array(orbit.monodromy) - np.eye(2), np.array(orbit.end) - z)
    return tuple(z)


@pytest.mark.parametrize(("half", "all_but"), [(1e-9, 0), (1e-7, 1), (1e-5, 1)])
def test_fixed_points_are_proved(half, all_but):
    """With their itineraries, in the interior of the boxes; the wildest only in a small one."""
    cells = boxes(half)
    found = fixed_points(PAPER, cells)
    assert found.proved.tolist() == [True] * (4 - all_but) + [False] * all_but
    cells, keep = cells[found.proved], np.flatnonzero(found.proved)
    found = FixedPoints(*(getattr(found, field.name)[keep] for field in fields(FixedPoints)))
    inner = found.boxes.reshape(-1, 4)
    assert (inner[:, 0::2] > cells[:, 0::2]).all()
    assert (inner[:, 1::2] < cells[:, 1::2]).all()
    right, left = number_of(("hit r", "hit l")), number_of(("hit l", "hit r"))
    words = [right if x[1] > 0 else left for x in ORBITS.values()]
    assert found.itinerary.tolist() == words[: 4 - all_but]
    for (low, high), trace in zip(found.trace, TRACES.values(), strict=False):
        assert low - 1e-2 < trace < high + 1e-2
    assert np.isnan(found.rotation[2:]).all()
    assert abs(found.rotation[:2] - 0.28695976518).max() < 1e-2
    flown = flow(PAPER, cells, 1).derivative
    low, high = (flown[:, 0, 0, k] + flown[:, 1, 1, k] for k in (0, 1))
    assert ((found.trace[:, 0] <= high) & (low <= found.trace[:, 1])).all()


def test_no_fixed_point_is_proved_where_there_is_none():
    """Boxes beside the fixed points, boxes with one on the edge, boxes that are not smooth."""
    half = 1e-6
    assert not fixed_points(PAPER, boxes(half, shift=3 * half)).proved.any()
    assert not fixed_points(PAPER, boxes(half, shift=half)).proved.any()
    vague = fixed_points(PAPER, [[-0.5, 0.5, -1.0, 1.0]])
    assert not vague.proved[0]
    assert vague.itinerary[0] == -1
    assert np.isnan(vague.trace).all()


def test_ranges_of_friction():
    """Proved for a range: so for each friction in it; refused where the orbit leaves the box."""
    cells = boxes(1e-4)[:1]
    assert fixed_points(PAPER, cells, frictions=[[0.4 - 1e-6, 0.4 + 1e-6]]).proved[0]
    assert not fixed_points(PAPER, cells, frictions=[[0.4, 0.42]]).proved[0]
    for alpha in (0.4 - 1e-6, 0.4 + 1e-6):
        exactly = replace(PAPER, f=Fraction(alpha))
        assert fixed_points(exactly, cells).proved[0]
    for bad in ([[0.4, 0.3]], [[0.4, 1.0]], [[-0.1, 0.2]], [[0.1]]):
        with pytest.raises(BadInput, match="f/F"):
            fixed_points(PAPER, cells, frictions=bad)


def launched(p, t, u):
    """Return what the float flow says of a launch from the left wall: (t1, u1), or None."""
    unit = float(p.F / p.omega)
    x = float(p.l) + 1e-13 * float(p.R)
    for event in swarm.itinerary(p, (x, u * unit), 2.0, t / float(p.omega)):
        if event.time > t / float(p.omega) + 1e-9:
            if event.word == "hit r":
                return event.time * float(p.omega), abs(event.after) / unit
            return None
    return None


def test_launches():
    """Each launch of a box has the image that is enclosed, or stops, as is said."""
    random, verdicts = seeded(9), []
    for k in range(120):
        p = system(random) if k % 2 else random.choice((PAPER, SHIFTED))
        if p.mu:
            continue
        t, u, width = (
            random.uniform(0, 6.2),
            random.uniform(0.05, 2.5),
            10 ** random.uniform(-6, -2),
        )
        found = launches(p, [[t, t + width, u, u + width]])
        verdicts.append(found.verdict[0])
        for a, b in ((0.5, 0.5), (0, 1), (1, 0), (random.random(), random.random())):
            image = launched(p, t + a * width, u + b * width)
            if found.verdict[0] == HITS:
                assert image is not None
                for (low, high), value in zip(found.images[0], image, strict=True):
                    assert low - 1e-8 <= value <= high + 1e-8
            elif found.verdict[0] == STOPS:
                assert image is None
    assert {HITS, STOPS} <= set(verdicts)
    assert verdicts.count(EITHER) < len(verdicts) / 3


def test_launches_backward():
    """The inverse: from an image back to the launch; the derivatives are inverse, areas kept."""
    t, u, h = 3.6, 1.3, 1e-8
    there = launches(PAPER, [[t - h, t + h, u - h, u + h]])
    (t1, T1), (u1, U1) = there.images[0]
    late = 3 * np.pi  # in the mirror image, and a period later
    back = launches(PAPER, [[late - T1, late - t1, u1, U1]], backward=True)
    (s, S), (w, W) = back.images[0]
    assert s <= late - t <= S
    assert w <= u <= W
    low, high = there.derivative[0].reshape(4, 2).T
    (a, b, c, d) = (low + high) / 2
    mean = (u1 + U1) / 2
    assert abs((a * d - b * c) * mean - u) < 1e-4


def test_what_is_no_launch():
    """One line each."""
    for bad in ([[0, 1, 2]], [[0, 1, 2, 1]], [[-1, 1, 1, 2]], [[6, 8, 1, 2]], [[0, 1, -1, 1]]):
        with pytest.raises(BadInput, match="launches"):
            launches(PAPER, bad)
    with pytest.raises(BadInput, match="elastic"):
        launches(replace(PAPER, e=Fraction(1, 2)), [[1, 1, 1, 1]], backward=True)
