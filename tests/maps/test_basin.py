"""Ellipses that the map contracts: against float orbits from them; what no ellipse has."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from cap.errors import NotProved
from cap.floats.search.cycles import near
from cap.flow.itinerary import itinerary
from cap.flow.strobe import oscillator
from cap.maps import basin, fixed_point
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.sets import interval

STRONG = replace(PAPER, F=Fraction(3))
SINKS = {  # parameters and a state near
    "focus": (STRONG, (0.4064, -0.6708)),
    "superstable": (replace(PAPER, F=Fraction(2), e=Fraction(3, 5)), (0.1447, 1.4118)),
    "inelastic": (replace(PAPER, e=Fraction(3, 5)), (-0.063, 0.745)),
}
ROOM = Fraction(1, 2), Fraction(1, 2)


def prepared(p, state):
    """Return the oscillator, the fixed point near a state, the events of its orbit."""
    cycle = near(p, *state)
    osc, units = oscillator(p), (Fraction(1), p.omega)
    point = fixed_point.prove(osc, Start(cycle.x, cycle.v, cycle.events), 30, units)
    return osc, point, fixed_point.tightened(point.orbit, Start(0, 0, cycle.events).expected())


@pytest.fixture(scope="module", params=SINKS)
def found(request):
    """Return the parameters, what is `prepared`, W with its size, and the basin."""
    p, state = SINKS[request.param]
    with interval.workprec(160):
        set_up = prepared(p, state)
        largest = basin.largest(*set_up, ROOM)
        return p, set_up, largest, basin.scaled(*set_up, largest, Fraction(9, 10))


def rows(W):
    """Return the matrix in floats."""
    return np.array([[float(q) for q in row] for row in W])


def test_it_contracts_by_the_bound(found):
    """Float orbits from the ellipse, its border too: images nearer by κ, which is not far off."""
    p, (_, point, _), _, told = found
    W, kappa = rows(told.matrix), float(told.contraction)
    centre = np.array([float(q.mid()) for q in point.box])
    random, worst = np.random.default_rng(1), 0.0
    assert kappa < 1
    for k in range(150):
        angle = random.uniform(0, 2 * math.pi)
        radius = 1.0 if k % 3 == 0 else random.uniform(0.01, 1)
        start = np.array([math.cos(angle), math.sin(angle)]) * radius
        z = centre + np.linalg.solve(W, start)
        image = np.array(itinerary(p, *z, 2 * math.pi / float(p.omega)).end)
        ratio = np.linalg.norm(W @ (image - centre)) / radius
        worst = max(worst, ratio)
        assert ratio <= kappa + 1e-7
    J = np.array([[float(q.mid()) for q in row] for row in point.orbit.monodromy])
    assert np.linalg.norm(W @ J @ np.linalg.inv(W), 2) <= kappa
    assert max(abs(np.linalg.eigvals(J))) <= kappa


def test_its_numbers_are_decimals_and_it_fits(found):
    """W and κ are finite decimals of few digits; the ellipse fits into the room."""
    _, (osc, point, events), (W, size), told = found
    for q in (*told.matrix[0], *told.matrix[1], told.contraction):
        assert Fraction(interval.exact_decimal(q)) == q
        assert len(interval.exact_decimal(q)) < 25
    reach = np.linalg.norm(np.linalg.inv(rows(told.matrix)), axis=1)
    assert all(side < float(room) for side, room in zip(reach, ROOM, strict=True))
    with interval.workprec(160):
        again = basin.contraction(osc, point, events, told.matrix, Fraction(1))
        assert again <= told.contraction < 1
        inner = basin.contraction(osc, point, events, W, size / 10)
        assert inner <= basin.contraction(osc, point, events, W, size) < 1


def test_the_largest_that_is_found_is_large(found):
    """Twice the size fails, or does not fit."""
    _, (osc, point, events), (W, size), _ = found
    reach = np.linalg.norm(np.linalg.inv(rows(W)), axis=1) * float(2 * size)
    fits = all(side < float(room) for side, room in zip(reach, ROOM, strict=True))
    if fits:
        with interval.workprec(160), pytest.raises(NotProved):
            basin.contraction(osc, point, events, W, 2 * size)


def test_a_small_room():
    """The ellipse lies in the rectangle that is given, however narrow in either direction."""
    with interval.workprec(160):
        set_up = prepared(STRONG, (0.4064, -0.6708))
        for room in ((Fraction(1, 10**6), Fraction(1)), (Fraction(1), Fraction(1, 10**6))):
            W, size = basin.largest(*set_up, room)
            told = basin.scaled(*set_up, (W, size), Fraction(1, 10))
            reach = np.linalg.norm(np.linalg.inv(rows(told.matrix)), axis=1)
            assert all(0 < side < float(r) for side, r in zip(reach, room, strict=True))
            assert told.contraction < 1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("p", "state"),
    [(STRONG, (0.1992, -1.4002)), (PAPER, (0.3435, 0.7753)), (PAPER, (0.1003, 0.5419))],
    ids=["saddle with turns", "saddle", "elliptic"],
)
def test_what_is_no_sink(p, state, monkeypatch):
    """No ellipse around it is contracted, of whatever shape and size."""
    identity = (Fraction(1), Fraction(0)), (Fraction(0), Fraction(1))
    with interval.workprec(160):
        osc, point, events = prepared(p, state)
        for size in (Fraction(1, 100), Fraction(1, 10**9)):
            with pytest.raises(NotProved) as caught:
                basin.contraction(osc, point, events, identity, size)
        assert caught.value.step == "basin"
        monkeypatch.setattr(basin, "shape", lambda _: identity)
        with pytest.raises(NotProved, match="no ellipse"):
            basin.largest(osc, point, events, ROOM)


def test_sizes_that_are_too_large():
    """Over other itineraries, or the walls; a W that is singular; one of the wrong shape."""
    with interval.workprec(160):
        osc, point, events = prepared(STRONG, (0.4064, -0.6708))
        W = basin.shape(point)
        for size in (Fraction(1), Fraction(1000)):
            with pytest.raises(NotProved):
                basin.contraction(osc, point, events, W, size)
        singular = (Fraction(1), Fraction(1)), (Fraction(1), Fraction(1))
        with pytest.raises(NotProved):
            basin.contraction(osc, point, events, singular, Fraction(1, 10**6))
        skew = (Fraction(1000), Fraction(0)), (Fraction(0), Fraction(1))
        with pytest.raises(NotProved, match="contracted"):
            basin.contraction(osc, point, events, skew, Fraction(1, 10**9))


def test_the_norm_bounds_all_matrices_of_the_balls():
    """Of random ball matrices: numpy's spectral norm of members is at most the bound."""
    random = np.random.default_rng(2)
    for radius in (0, 1e-3, 1):
        for _ in range(50):
            M = random.uniform(-2, 2, (2, 2))
            balls = [[interval.Ball(q, radius) for q in row] for row in M.tolist()]
            bound = float(basin._norm(balls).upper())
            for signs in (random.choice([-1, 1], (2, 2)), random.uniform(-1, 1, (2, 2)), -1, 1):
                assert np.linalg.norm(M + radius * signs, 2) <= bound * (1 + 1e-12)
            assert bound <= np.linalg.norm(M, 2) + 2 * radius + 1e-7


@pytest.mark.slow
@pytest.mark.parametrize("omega", [Fraction(10**6), Fraction(1, 10**6), Fraction(7)])
def test_other_units_of_time(omega):
    """The same ellipse, v in the new units, with the same bound of its contraction."""
    told = []
    for w in (Fraction(1), omega):
        p = replace(PAPER, F=3 * w**2, f=Fraction(2, 5) * w**2, omega=w)
        with interval.workprec(160):
            set_up = prepared(p, (0.4064, -0.6708 * float(w)))
            room = ROOM[0], ROOM[1] * w
            found = basin.largest(*set_up, room)
            told.append(basin.scaled(*set_up, found, Fraction(9, 10)))
    plain, other = told
    assert plain.contraction == other.contraction
    assert rows(other.matrix) @ np.diag([1, float(omega)]) == pytest.approx(
        rows(plain.matrix), rel=1e-5, abs=1e-3
    )
    assert all(Fraction(interval.exact_decimal(q)) == q for row in other.matrix for q in row)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("entry", [None, "1e200", "nan"])
def test_a_shape_of_nothing(entry):
    """Saddles have none, nor derivatives that are huge or no numbers; numpy says nothing."""
    with interval.workprec(160):
        _, point, _ = prepared(STRONG, (0.4064, -0.6708) if entry else (0.1992, -1.4002))
        (a, b), row = point.orbit.monodromy
        orbit = point.orbit._replace(monodromy=((interval.Ball(entry) if entry else a, b), row))
        with pytest.raises(NotProved, match="no sink"):
            basin.shape(replace(point, orbit=orbit))


@pytest.mark.parametrize("loss", [Fraction(1, 10**6), Fraction(1, 10**12)])
def test_a_sink_that_hardly_attracts(loss):
    """The multipliers are 1 - 2 ε in size: in the normal form that is what W contracts by."""
    with interval.workprec(250):
        p = replace(PAPER, e=1 - loss)
        set_up = prepared(p, (0.1003, 0.5419))
        told = basin.scaled(*set_up, basin.largest(*set_up, ROOM), Fraction(1, 2))
        assert 1 - 2 * loss <= told.contraction < 1 - loss / 4
