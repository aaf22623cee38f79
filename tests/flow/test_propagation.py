"""The flow of boxes over long times: tight, true, and with no event left undecided."""

import math
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, product

import pytest
from flows import HEAVY, MIXED, OILY, SOFT, starting
from mpmath import workdps
from oracle_flow import orbit
from support import decimal_fraction, holds, inside, only, rational, seeded, width

from cap.flow.itinerary import itinerary
from cap.flow.propagation import after_periods, at_time_zero, propagate
from cap.flow.strobe import State, oscillator
from cap.parameters import PAPER, Parameters
from cap.sets import interval, matrix

P_STAR = Fraction("0.1002798898"), Fraction("0.5419433068")
HAIR = Fraction(1, 10**9)
NEAR = P_STAR[0] + Fraction(1, 10**4), P_STAR[1]  # rotates around P*


def far(p, state, end, radius=0, **options):
    """Return `propagate` from a box around an exact state to an exact time."""
    state = tuple(map(Fraction, state))
    begin = starting(oscillator(p), state, radius=radius, **options)
    return propagate(p, begin, interval.ball(Fraction(end)))


def words(image):
    """Return its itinerary."""
    return tuple(event.word for event in image.events)


def holds_orbit(image, events, end, error=Fraction(1, 10**15)):
    """Check an image against an orbit in mpmath, which has all hits before a capture."""
    left = iter(events)
    for told in image.events:
        event = next(left)
        while told.word.startswith("capture") and event.word != told.word:
            event = next(left)
        assert event.word == told.word
        assert holds(told.time, event.time, error)
    assert next(left, None) is None
    assert all(holds(ball, value, error) for ball, value in zip(image.state, end, strict=True))


@pytest.fixture(scope="module")
def rotating():
    """Fifty periods of a box that rotates around the elliptic fixed point."""
    x, v = (interval.around(q, HAIR) for q in NEAR)
    return after_periods(PAPER, x, v, 50)


def test_fifty_periods_are_tight(rotating):
    """The widths are those of the image of the box under the derivative, to 1 percent."""
    for side, row in zip(rotating.state, rotating.monodromy, strict=True):
        image = float(sum(abs(entry.mid()) for entry in row)) * 2e-9
        assert 0.99 * image < width(side) < 1.01 * image
    assert all(width(entry) < 1e-2 for row in rotating.monodromy for entry in row)


def test_fifty_periods_are_true(rotating):
    """Two hits a period, in turns, in their order; area is preserved; orbits lie in their sets."""
    assert words(rotating) == ("hit r", "hit l") * 50
    assert rotating.wall == 0
    for one, other in pairwise(rotating.events):
        assert one.time < other.time
    det = matrix.determinant(rotating.monodromy)
    assert holds(det, 1, 0)
    assert width(det) < 1e-2
    random, end = seeded(1), 50 * oscillator(PAPER).T
    for _ in range(2):
        state = [inside(random, q, HAIR) for q in NEAR]
        with workdps(25):
            events, last = orbit(PAPER, 0, *state, interval.midpoint(end))
        holds_orbit(rotating, events, last)


def test_its_derivative_is_that_of_orbits(rotating):
    """Divided differences over the box lie in the enclosed monodromy."""
    end = interval.midpoint(50 * oscillator(PAPER).T)
    with workdps(30):
        middle, *corners = (
            orbit(PAPER, 0, NEAR[0] + a * HAIR, NEAR[1] + b * HAIR, end)[1]
            for a, b in ((0, 0), (1, 0), (0, 1))
        )
        for k, corner in enumerate(corners):
            for row, one, other in zip(rotating.monodromy, corner, middle, strict=True):
                assert holds(row[k], rational(one - other) / HAIR)


@pytest.mark.parametrize(
    ("state", "radius", "periods"),
    [(NEAR, "1/100000", 12), (("0.34352606", "0.7753195"), "1/10000", 2), (NEAR, "1/1000", 3)],
    ids=["far", "saddle", "large"],
)
def test_the_corners_of_large_boxes(state, radius, periods):
    """Where the second derivative takes them out of the linear image; the derivative there."""
    centre, radius = tuple(map(Fraction, state)), Fraction(radius)
    box = (interval.around(q, radius) for q in centre)
    image = after_periods(PAPER, *box, periods)
    end, step = interval.midpoint(periods * oscillator(PAPER).T), Fraction(1, 10**15)
    with workdps(40):
        for a, b in product((1, -1), repeat=2):
            x, v = centre[0] + a * radius, centre[1] + b * radius
            events, here = orbit(PAPER, 0, x, v, end)
            holds_orbit(image, events, here, Fraction(1, 10**14))
            for k, (dx, dv) in enumerate(((step, 0), (0, step))):
                ahead = orbit(PAPER, 0, x + dx, v + dv, end)[1]
                for row, one, other in zip(image.monodromy, ahead, here, strict=True):
                    assert holds(row[k], rational(one - other) / step, Fraction(1, 10**9))


@pytest.mark.parametrize("name", only(MIXED, "turns", "stick", "capture r"))
def test_random_points_of_boxes(name):
    """The events, the end and the derivative of exact orbits from the box, in all their kinds."""
    p, x, v, start, end = MIXED[name]
    centre, random = (Fraction(x), Fraction(v)), seeded(2)
    radius = Fraction(1, 10**7)
    image = far(p, centre, end, radius, start=start)
    ends = []
    with workdps(30):
        offsets = [
            (1, 0),
            (0, 1),
            (0, 0),
            *([decimal_fraction(random) for _ in "xv"] for _ in "ab"),
        ]
        for offset in offsets:
            state = [c + d * radius for c, d in zip(centre, offset, strict=True)]
            events, last = orbit(p, Fraction(start), *state, Fraction(end))
            ends.append(last)
            holds_orbit(image, events, last)
        for k in (0, 1):
            for row, one, other in zip(image.monodromy, ends[k], ends[2], strict=True):
                assert holds(row[k], rational(one - other) / radius, Fraction(1, 10**8))


@pytest.mark.parametrize("name", [name for name in MIXED if name.startswith(("stick", "heavy"))])
def test_a_stick_on_the_way(name):
    """One direction is lost for ever: the determinant contains 0, tightly; the box is no point."""
    p, x, v, start, end = MIXED[name]
    image = far(p, (x, v), Fraction(end) + 20, HAIR, start=start)
    assert "stick" in words(image)
    det = matrix.determinant(image.monodromy)
    assert holds(det, 0, 0)
    assert width(det) < 1e-4
    assert width(image.state[0]) > 1e-10


@pytest.mark.parametrize("name", [name for name in MIXED if name.startswith("capture")])
def test_a_capture_on_the_way(name):
    """From the release on all orbits are one: the derivative is exactly zero."""
    p, x, v, start, end = MIXED[name]
    for more in (0, 10):
        image = far(p, (x, v), Fraction(end) + more, HAIR, start=start)
        assert all(entry.is_zero() for row in image.monodromy for entry in row)
        assert all(width(side) < 1e-10 for side in image.state)


def test_ending_at_rest():
    """In the interior and at either wall; the rest goes on, or is said to have ended."""
    for name, wall in (("stick", 0), ("capture r", 1), ("capture l", -1)):
        p, x, v, start, end = MIXED[name]
        long = far(p, (x, v), end, HAIR, start=start)
        rests = [k for k, w in enumerate(words(long)) if w.startswith(("stick", "capture"))]
        k = rests[0]
        since, until = (long.events[n].time for n in (k, k + 1))
        middle = interval.midpoint((3 * since + until) / 4)
        image = far(p, (x, v), middle, HAIR, start=start)
        assert words(image) == words(long)[: k + 1]
        assert image.wall == wall
        assert image.state[1].is_zero()
        assert all(entry.is_zero() for entry in image.monodromy[1])
        if wall:
            assert image.state[0] == oscillator(p).wall(wall)
            assert all(entry.is_zero() for entry in image.monodromy[0])


LEFT_OF_A_THIRD = replace(PAPER, r=Fraction(1, 3))
BEGINNINGS = {  # parameters, state, start, wall
    "leaving r": (PAPER, (1, "-1/2"), "1/10", 1),
    "leaving l": (PAPER, (-1, "7/10"), "-2", -1),
    "held by r": (PAPER, (1, 0), 0, 1),
    "at l, pushed away": (PAPER, (-1, 0), 0, -1),
    "resting at r": (PAPER, (1, 0), "3/2", 1),
    "resting": (PAPER, ("1/3", 0), "3/2", 0),
    "pushed to the right": (PAPER, ("1/3", 0), "1/10", 0),
    "resting long": (HEAVY, ("-1/2", 0), "1", 0),
    "at l, inelastic": (OILY, (-1, 0), "7/2", -1),
    "late": (SOFT, ("1/5", "6/5"), "123", 0),
    "resting at 1/3": (LEFT_OF_A_THIRD, ("1/3", 0), 0, 1),
    "leaving 1/3": (LEFT_OF_A_THIRD, ("1/3", "-1/7"), 0, 1),
    "no friction": (replace(OILY, f=Fraction(0)), ("1/10", "1/3"), 0, 0),
}


@pytest.mark.parametrize("end", ["1/2", "2", "30"])
@pytest.mark.parametrize("name", BEGINNINGS)
def test_other_beginnings(name, end):
    """At a wall, at rest, at other times: like floats, and like the exact orbit.

    The derivative is along the box: by x at a wall, or v = 0, it is 0.
    """
    p, state, start, wall = BEGINNINGS[name]
    x, v = map(Fraction, state)
    start, end = Fraction(start), Fraction(start) + Fraction(end)
    image = far(p, (x, v), end, start=start, wall=wall)
    path = itinerary(p, float(x), float(v), float(end), start=float(start), wall=wall)
    assert (words(image), image.wall) == (path.words, path.wall)
    with workdps(30):
        holds_orbit(image, *orbit(p, start, x, v, end))
    for ball, value in zip(image.state, path.end, strict=True):
        assert holds(ball, value, 1e-8)
    for row, values in zip(image.monodromy, path.monodromy, strict=True):
        for entry, value, varies in zip(row, values, (not wall, v != 0), strict=True):
            assert holds(entry, value, 1e-5 * (1 + abs(value))) if varies else entry.is_zero()


@pytest.mark.parametrize("end", ["3/5", "2", "5"])
def test_the_derivative_of_a_launch(end):
    """From v = 0 it is told by x only: by v it is another from either side, by a turning."""
    start, end, step = Fraction(1, 10), Fraction(end), Fraction(1, 10**12)
    image = far(PAPER, ("1/3", 0), end, start=start)
    with workdps(40):
        starts = ((0, 0), (step, 0), (0, step), (0, -step))
        here, *others = (orbit(PAPER, start, Fraction(1, 3) + x, v, end)[1] for x, v in starts)
        by_x, by_v, by_less_v = (
            [rational(one - other) / step for one, other in zip(there, here, strict=True)]
            for there in others
        )
    force = math.cos(start)
    for row, x, v, w in zip(image.monodromy, by_x, by_v, by_less_v, strict=True):
        assert holds(row[0], x, Fraction(1, 10**9))
        assert row[1].is_zero()
        assert float(w) == pytest.approx(-float(v) * (force - 0.4) / (force + 0.4), rel=1e-6)


@pytest.mark.parametrize("name", ["turns", "stick", "soft", "viscous", "brisk"])
def test_pieces_make_the_whole(name):
    """To the end at once, or with a stop on a flight: the same events, sets that overlap."""
    p, x, v, start, end = MIXED[name]
    whole = far(p, (x, v), end, HAIR, start=start)
    for part in (Fraction(1, 5), Fraction(1, 2), Fraction(9, 10)):
        time = start + (Fraction(end) - start) * part
        first = far(p, (x, v), time, HAIR, start=start)
        osc = oscillator(p)
        begin = State(osc.moment(interval.ball(time)), *first.state, first.wall)
        second = propagate(p, begin, interval.ball(Fraction(end)))
        assert words(first) + words(second) == words(whole)
        both = matrix.product(second.monodromy, first.monodromy)
        pairs = zip((*both[0], *both[1]), (*whole.monodromy[0], *whole.monodromy[1]), strict=True)
        for one, other in (*zip(second.state, whole.state, strict=True), *pairs):
            assert one.overlaps(other)


@pytest.mark.parametrize("name", MIXED)
def test_every_precision(name):
    """At 200 bits the sets of a point lie in those at 53."""
    p, x, v, start, end = MIXED[name]
    rough = far(p, (x, v), end, start=start)
    with interval.workprec(200):
        sharp = far(p, (x, v), end, start=start)
    for one, other in zip(sharp.state, rough.state, strict=True):
        assert one.overlaps(other)
        assert width(one) < 1e-9


def test_parameters_in_other_units():
    """Large and small units of length and time change nothing else."""
    for length, omega in ((Fraction(10**6), Fraction(1, 1000)), (Fraction(1, 10**6), Fraction(99))):
        force = length * omega**2
        p = Parameters(force, omega, force * 2 / 5, -length, length)
        x, v = NEAR[0] * length, NEAR[1] * length * omega
        image = propagate(p, at_time_zero(interval.ball(x), interval.ball(v)), 9 * oscillator(p).T)
        plain = after_periods(PAPER, *map(interval.ball, NEAR), 9)
        assert words(image) == words(plain)
        units = interval.ball(length), interval.ball(length * omega)
        for side, unit, other in zip(image.state, units, plain.state, strict=True):
            assert (side / unit).overlaps(other)
