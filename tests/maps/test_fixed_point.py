"""From a guess to a proved fixed point: it is the true one, alone, and in every box claimed."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
import reference
from attempts import box as around
from attempts import hits
from conftest import ORBITS, STARTS
from mpmath import mpf
from support import holds, number, rational, rounds, seeded, width

from cap.errors import NotProved
from cap.floats.search.cycles import near
from cap.flow.event import BALLS
from cap.flow.strobe import oscillator, strobe
from cap.flow.windows import find_windows
from cap.maps import fixed_point
from cap.maps.fixed_point import Start, existence, neighbourhood, prove
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

ERROR = Fraction(1, 10**55)
NAMES = pytest.mark.parametrize("name", STARTS)


def truth(name):
    """Return x, v and the hit times of one of the paper's orbits, to 60 digits."""
    return reference.periodic_orbit(reference.System.of(PAPER), ORBITS[name][2])


@NAMES
@pytest.mark.parametrize("places", [10, 11, 13, 16, 21, 25])
def test_the_box_contains_the_fixed_point(name, places):
    """Also with many more bits than places: K(box) encloses what lies between m and P* only.

    An earlier version evaluated Φ' on the box alone, to which m need not belong.
    """
    with mpmath.workdps(70):
        x, v, hits = truth(name)
    for bits in (places * 10 // 3 + 80, 500):
        with interval.workprec(bits):
            point = prove(oscillator(PAPER), STARTS[name], places)
            assert holds(point.box[0], x, ERROR)
            assert holds(point.box[1], v, ERROR)
            for hit, time in zip(point.orbit.hits, hits, strict=True):
                assert holds(hit.time, time, ERROR)
            assert max(map(width, point.box)) < 10.0 ** (4 - places)
            assert point.reach == (Fraction(100, 10**places),) * 2
            for inner, outer in zip(point.box, point.hint.box(point.reach), strict=True):
                assert interval.subset_interior(inner, outer)


@NAMES
def test_more_places_give_narrower_boxes(name):
    """About as narrow as asked for, at any number of places."""
    for places in (20, 60, 200):
        with interval.workprec(places * 10 // 3 + 80):
            point = prove(oscillator(PAPER), STARTS[name], places)
            assert max(map(width, point.box)) < 10.0 ** (3 - places)


@NAMES
def test_rough_guesses_are_good_enough(name):
    """Three decimals of the orbit, or two."""
    start = STARTS[name]
    with interval.workprec(200):
        osc = oscillator(PAPER)
        best = prove(osc, start, 30)
        digits = 5 if name == "second saddle" else 3
        times = tuple(round(t, 2) for t in ORBITS[name][2])
        rough = Start.non_sticking(round(start.x, digits), round(start.v, digits), times)
        again = prove(osc, rough, 30)
        assert all(a.overlaps(b) for a, b in zip(best.box, again.box, strict=True))


def test_guesses_that_are_no_orbit_are_refused():
    """No orbit there, hits elsewhere, too few or too many, states that are none; no other error."""
    star, saddle, (x, v, times) = STARTS["elliptic"], STARTS["saddle"], ORBITS["elliptic"]
    for start in [
        Start.non_sticking(0.9, 0.1, times),
        Start.non_sticking(-0.5, -0.5, times),
        Start.non_sticking(0.0, 5.0, times),
        Start.non_sticking(x, v, (3.0, 5.0)),
        Start.non_sticking(x, v, times[::-1]),
        Start.non_sticking(x, v, times[:1]),
        Start.non_sticking(x, v, (*times, 6.0)),
        Start.non_sticking(x, v, (*times, times[0] + 6.2831853)),
        Start.non_sticking(x, v, ()),
        Start.non_sticking(x, -v, times),
        replace(star, v=-v),
        replace(star, events=star.events[::-1]),
        replace(star, events=tuple((word.replace("r", "l"), t) for word, t in star.events)),
        replace(star, periods=2),
        replace(star, x=1.0),
        replace(star, x=5.0),
        replace(star, v=0.0),
        replace(saddle, events=saddle.events[1:]),
        replace(saddle, events=(("hit r", -saddle.events[0][1]), saddle.events[1])),
    ]:
        with interval.workprec(150), pytest.raises(NotProved):
            prove(oscillator(PAPER), start, 20)


def test_orbits_without_a_hit_are_refused():
    """A shear: Φ' - 1 is singular, exactly, and Newton's step is not finite."""
    far = replace(PAPER, f=Fraction(1, 10), l=Fraction(-100), r=Fraction(100))
    for p in (far, replace(far, f=Fraction(0))):
        with interval.workprec(150), pytest.raises(NotProved):
            prove(oscillator(p), Start.non_sticking(0.0, 5.0, ()), 20)


def test_existence_refuses_squares_without_the_fixed_point():
    """Beside it, or with it on the boundary, or so large that the itinerary changes."""
    with mpmath.workdps(70), interval.workprec(200):
        osc, (x, v, times) = oscillator(PAPER), truth("elliptic")
        hint = prove(osc, STARTS["elliptic"], 30).hint
        near = hits(1, map(rational, times), 0)
        radius = Fraction(1, 10**6)

        def attempt(dx, dv, radius):
            centre = rational(x) + dx, rational(v) + dv
            moved = replace(hint, centre=centre)
            expected, _ = find_windows(osc, moved.box((radius, radius)), near, BALLS)
            return existence(osc, moved, (radius, radius), expected)

        box, _, _ = attempt(0, 0, radius)
        assert holds(box[0], x)
        attempt(radius / 2, -radius / 2, radius)
        for factor in (Fraction(1), Fraction(101, 100), Fraction(2), Fraction(10)):
            for shift in (radius * factor, -radius * factor):
                for dx, dv in ((shift, 0), (0, shift), (shift, shift)):
                    with pytest.raises(NotProved):
                        attempt(dx, dv, radius)
        for large in (Fraction(1, 100), Fraction(1, 2)):
            with pytest.raises(NotProved):
                attempt(0, 0, large)


@NAMES
def test_all_orbits_of_the_neighbourhood(name, paper):
    """Random orbits of the rectangle, and those of its corners, have the hits in the windows."""
    random = seeded(name)
    point = prove(paper, STARTS[name], 30)
    around = fixed_point.largest_neighbourhood(paper, point, (Fraction(2), Fraction(2)))
    corners = [(a, b) for a in (-1, 1) for b in (-1, 1)]
    others = [[Fraction(random.randint(-99, 99), 99) for _ in "xv"] for _ in range(rounds(5))]
    with mpmath.workdps(reference.DIGITS):
        system = reference.System.of(PAPER)
        for offset in [*corners, *others]:
            state = [
                number(m + k * r)
                for m, k, r in zip(point.hint.centre, offset, around.reach, strict=True)
            ]
            orbit = reference.flow(system, *state)
            for (_, window), time in zip(around.expected, orbit.hits, strict=True):
                assert holds(window, time)
            moved = max(abs(a - b) for a, b in zip(state, orbit.end, strict=True))
            assert moved > mpf(10) ** -12


def test_the_largest_neighbourhood_is_large(paper):
    """Not much smaller than what one would find by hand."""
    for name, least in (("elliptic", 0.008), ("mirror", 0.002), ("saddle", 0.003)):
        point = prove(paper, STARTS[name], 30)
        around = fixed_point.largest_neighbourhood(paper, point, (Fraction(2), Fraction(2)))
        assert around.reach[0] > least
        smaller = neighbourhood(paper, point, (around.reach[0] / 2, around.reach[1] / 3))
        assert smaller.reach == (around.reach[0] / 2, around.reach[1] / 3)


def test_some_neighbourhood(paper):
    """A tiny one: P* is the only fixed point in it, by the same lemma."""
    for name in ("elliptic", "saddle"):
        point = prove(paper, STARTS[name], 30)
        around = fixed_point.some_neighbourhood(paper, point, (Fraction(2), Fraction(2)))
        assert 0 < around.reach[0] <= Fraction(2, 2**30)
        assert neighbourhood(paper, point, around.reach).reach == around.reach


def test_too_large_neighbourhoods_are_refused(paper):
    """A rectangle with two fixed points, one across a wall, one with v = 0."""
    point = prove(paper, STARTS["elliptic"], 30)
    other = STARTS["saddle"]
    gap = Fraction(other.x) - point.hint.centre[0], Fraction(other.v) - point.hint.centre[1]
    for reach in [
        (gap[0] * 2, gap[1] * 2),
        (Fraction(95, 100), Fraction(1, 10**6)),
        (Fraction(1, 10**6), Fraction(6, 10)),
        (Fraction(1, 10), Fraction(1, 10)),
    ]:
        with pytest.raises(NotProved):
            neighbourhood(paper, point, reach)


def test_a_neighbourhood_away_from_the_fixed_point_is_refused(paper):
    """The centre of the hint moved away: K leaves the box."""
    point = prove(paper, STARTS["elliptic"], 30)
    r = Fraction(1, 1000)
    neighbourhood(paper, point, (r, r))
    for dx, dv in ((2 * r, 0), (0, 2 * r), (-2 * r, -2 * r)):
        centre = point.hint.centre[0] + dx, point.hint.centre[1] + dv
        moved = replace(point, hint=replace(point.hint, centre=centre))
        with pytest.raises(NotProved) as caught:
            neighbourhood(paper, moved, (r, r))
        assert caught.value.step == "Krawczyk"


def test_the_derivative_is_enclosed_on_the_whole_box(paper, monkeypatch):
    """The box lies in the domain of the Taylor models; the slope encloses Φ' at its corners."""
    seen = {}

    class Recorded(fixed_point.Domain):
        def __init__(self, reach, order):
            super().__init__(reach, order)
            seen["reach"] = self.reach

    def contract(hint, image, slope, box, bound=lambda q: q):
        seen["box"], seen["slope"] = box, [[bound(q) for q in row] for row in slope]
        return original(hint, image, slope, box, bound)

    original = fixed_point.contract
    monkeypatch.setattr(fixed_point, "Domain", Recorded)
    monkeypatch.setattr(fixed_point, "contract", contract)
    point = prove(paper, STARTS["elliptic"], 30)
    for reach in (Fraction(1, 700), Fraction(3, 1999)):
        neighbourhood(paper, point, (reach, reach))
        for box, m, size in zip(seen["box"], point.hint.centre, seen["reach"], strict=True):
            lower, upper = interval.ends(box)
            _, largest = interval.ends(size)
            assert m - largest <= lower <= m - reach
            assert m + reach <= upper <= m + largest
        with mpmath.workdps(reference.DIGITS):
            system = reference.System.of(PAPER)
            for dx, dv in ((reach, reach), (-reach, reach), (reach, -reach), (-reach, -reach)):
                x, v = point.hint.centre
                derivative = reference.jacobian(system, number(x + dx), number(v + dv))
                for row, values in zip(seen["slope"], derivative, strict=True):
                    assert all(
                        holds(q, value, Fraction(1, 10**30))
                        for q, value in zip(row, values, strict=True)
                    )


def test_windows_after_a_capture_have_room():
    """There the times are the same for all orbits; a little more precision must still fit in."""
    p = replace(PAPER, F=Fraction(2), e=Fraction(1, 10))
    cycle = near(p, -0.2915, 1.4118)
    with interval.workprec(200):
        osc, start = oscillator(p), Start(cycle.x, cycle.v, cycle.events)
        state = interval.ball(Fraction(cycle.x)), interval.ball(Fraction(cycle.v))
        windows, orbit = find_windows(osc, state, start.expected(), BALLS)
        tight = fixed_point.tightened(orbit, windows)
        strobe(osc, state, tight, BALLS)
        for event, old, new in zip(orbit.events, windows, tight, strict=True):
            assert interval.subset_interior(event.time, new.window)
            if event.word.startswith("capture"):
                assert new == old
        assert fixed_point.prove(osc, start, 40).orbit.events[-1].word == "release right"


def test_find_windows():
    """Windows from rough times hold the hits, strictly, and stay certified for the same box."""
    with mpmath.workdps(70), interval.workprec(200):
        osc, (x, v, times) = oscillator(PAPER), truth("elliptic")
        state = around(map(rational, (x, v)), BALLS, Fraction(1, 10**8))
        for shift in (Fraction(0), Fraction(1, 100), Fraction(-1, 100)):
            near = hits(1, [rational(t) + shift for t in times], 0)
            expected, found = find_windows(osc, state, near, BALLS)
            orbit = strobe(osc, state, expected, BALLS)
            assert str(found) == str(orbit)
            for (word, window), hit in zip(expected, orbit.hits, strict=True):
                assert word == hit.word
                assert interval.subset_interior(hit.time, window)
                assert width(window) < 1e-6
        for bad in ([Ball("nan")] * 2, [Ball(0, "inf")] * 2, [Ball(5), Ball(6)]):
            with pytest.raises(NotProved):
                find_windows(osc, state, hits(1, bad), BALLS)


def test_preconditioners_are_decimals_or_refused():
    """Ten digits of each entry; beyond floats there are none."""
    for value in ("0.1", "-123456789.123", "1e-300", "7e300", "0"):
        short = fixed_point._short(Ball(value))
        assert abs(short - Fraction(value)) <= abs(Fraction(value)) / 10**9
    for value in ("1e400", "-1e400", "nan", "inf", "1e10000000000000000000000"):
        with pytest.raises(NotProved, match="beyond floats"):
            fixed_point._short(Ball(value))
