"""Certified orbits contain the true ones, are tight, and obey the symmetries of the system."""

from dataclasses import replace
from fractions import Fraction
from types import SimpleNamespace

import mpmath
import pytest
import reference
from attempts import box, hits
from support import between, holds, inside, number, only, rational, rounds, seeded, value_at, width

from cap.errors import NotProved
from cap.flow.event import BALLS, TAYLOR_MODELS, flies
from cap.flow.jet_transport import strobe_jet
from cap.flow.strobe import oscillator, strobe
from cap.flow.windows import find_windows
from cap.parameters import PAPER, Parameters
from cap.sets import interval, matrix
from cap.sets.interval import Ball

BITS, ERROR = 110, Fraction(1, 10**30)
SHIFTED = Parameters(Fraction(2), Fraction(3), Fraction(4, 5), Fraction(-7, 3), Fraction(-1))
FAR = replace(PAPER, l=Fraction(-7, 3))
NARROW = replace(PAPER, l=Fraction(1), r=Fraction(3, 2))


def friction(text):
    """Return the paper's parameters with another friction."""
    return replace(PAPER, f=Fraction(text))


P_STAR = PAPER, "0.1002798898441954", "0.5419433067664584"
CASES = {  # parameters, x, v; radii up to which balls, Taylor models must succeed
    "P*": (*P_STAR, "1e-3", "1e-3"),
    "saddle": (PAPER, "0.34352606", "0.7753195", "1e-3", "1e-3"),
    "mirror": (PAPER, "0.55916325", "1.06697003", "1e-3", "1e-3"),
    "second saddle": (PAPER, "-0.7914", "0.4979", "1e-9", "1e-9"),
    "to the left": (PAPER, "1/5", "-3", "1e-9", "1e-9"),
    "f = 0": (friction("0"), "3/10", "2", "1e-9", "1e-4"),
    "f = 3/10": (friction("3/10"), "1/10", "-57/20", "1e-9", "1e-9"),
    "f = 9/20": (friction("9/20"), "0.2", "0.6", "1e-3", "1e-3"),
    "f = 1/2": (friction("1/2"), "2/5", "9/20", "1e-9", "1e-3"),
    "f = 3/5": (friction("3/5"), "-3/10", "13/20", "1e-4", "1e-3"),
    "F = 2, omega = 3": (SHIFTED, "-11/5", "-5/2", "1e-9", "1e-3"),
    "F = 2, one hit": (SHIFTED, "-17/15", "-3/2", "1e-9", "1e-4"),
    "l = -7/3": (FAR, "-1/2", "4/5", "1e-4", "1e-3"),
    "sixteen hits": (NARROW, "13/10", "-5/2", "0", "1e-9"),
}


def truth(p, x, v):
    """Return the orbit of a state over a period, from the reference in mpmath."""
    return reference.flow(reference.System.of(p), number(x), number(v))


def certified(p, x, v, radius, kind, order=3):
    """Return the certified orbit of the box around (x, v), in windows that it finds itself."""
    osc, state = oscillator(p), box((x, v), kind, radius, order)
    times = hits(v, [rational(t) for t in truth(p, x, v).hits], 0)
    expected, orbit = find_windows(osc, state, times, kind)
    assert orbit.hits == orbit.events
    for hit, (word, window) in zip(orbit.hits, expected, strict=True):
        assert hit.word == word
        assert interval.subset(kind.bound(hit.time), window)
    return orbit


def at_point(quantity, kind, offset):
    """Return the enclosures of a quantity at one point: of its range, of its value there."""
    if kind is BALLS:
        return [quantity]
    return [quantity.bound(), value_at(quantity, offset)]


def check(orbit, kind, offset, exact, derivative):
    """Compare a certified orbit with the true one from one state of the box."""
    assert len(orbit.hits) == len(exact.hits)
    pairs = [
        *((hit.time, time) for hit, time in zip(orbit.hits, exact.hits, strict=True)),
        *((hit.velocity, v) for hit, v in zip(orbit.hits, exact.velocities, strict=True)),
        *zip(orbit.end, exact.end, strict=True),
    ]
    if derivative:
        pairs += [(orbit.monodromy[i][j], derivative[i][j]) for i in (0, 1) for j in (0, 1)]
    for quantity, value in pairs:
        for ball in at_point(quantity, kind, offset):
            assert holds(ball, value, ERROR)
    assert holds(orbit.least_speed, exact.least, ERROR)
    assert orbit.least_speed > 0


@pytest.mark.parametrize("radius", only(("0", "1e-9", "1e-4", "1e-3"), "1e-9", "1e-3"))
@pytest.mark.parametrize("name", CASES)
def test_containment(name, radius):
    """Hits, speeds, end, least speed, Φ' of random states of a box, over both kinds of sets."""
    p, x, v, *limits = CASES[name]
    x, v, r = Fraction(x), Fraction(v), Fraction(radius)
    random, orbits = seeded(name + radius), []
    with mpmath.workdps(reference.DIGITS), interval.workprec(BITS):
        for kind, limit in zip((BALLS, TAYLOR_MODELS), limits, strict=True):
            try:
                orbits.append((kind, certified(p, x, v, r, kind)))
            except NotProved:
                assert r > Fraction(limit)
        corner = r * random.choice([-1, 1]), r * random.choice([-1, 1])
        others = [[inside(random, 0, r) for _ in "xv"] for _ in range(rounds(2))]
        for n, offset in enumerate([corner, *others] if orbits else []):
            state = x + offset[0], v + offset[1]
            exact, derivative = truth(p, *state), None
            if n == 0:
                derivative = reference.jacobian(reference.System.of(p), *map(number, state))
            for kind, orbit in orbits:
                assert orbit.s == (1 if v > 0 else -1)
                check(orbit, kind, offset, exact, derivative)


@pytest.mark.parametrize("kind", [BALLS, TAYLOR_MODELS], ids=["balls", "Taylor models"])
@pytest.mark.parametrize("name", ["P*", "f = 3/5"])
def test_wide_windows(name, kind):
    """From wide, lopsided windows, in which v varies much, the hits are found and enclosed."""
    p, x, v, *_ = CASES[name]
    x, v = Fraction(x), Fraction(v)
    with mpmath.workdps(reference.DIGITS), interval.workprec(BITS):
        exact, osc = truth(p, x, v), oscillator(p)
        state = box((x, v), kind)
        for left, right in ((10, 10), (8, 20), (20, 8), (15, 50), (100, 20)):
            windows = [
                between(t - Fraction(1, left), t + Fraction(1, right))
                for t in map(rational, exact.hits)
            ]
            orbit = strobe(osc, state, hits(v, windows), kind)
            check(orbit, kind, (Fraction(0), Fraction(0)), exact, None)
            assert max(width(kind.bound(hit.time)) for hit in orbit.hits) < 1e-9


@pytest.mark.parametrize("sign", [1, -1])
def test_a_flight_that_begins_or_ends_near_its_least_speed(sign):
    """Whether the minimum lies inside is not decided: the least speed is enclosed all the same."""
    with interval.workprec(BITS):
        osc = oscillator(PAPER)
        slow = interval.midpoint(osc.slow_right if sign > 0 else osc.slow_left)
        flight = osc.launch(sign, osc.moment(Ball(0)), Ball(0), Ball(4 * sign))

        def speed(t):
            return sign * osc.velocity(flight, osc.moment(t))

        early, late = slow - Fraction(1, 2), slow + Fraction(1, 2)
        for left, right, width_left, width_right in [
            (early, slow, 0, Fraction(1, 5)),
            (slow, late, Fraction(1, 5), 0),
            (early, late, Fraction(1, 5), Fraction(1, 5)),
            (slow + Fraction(1, 9), late, Fraction(1, 10), Fraction(1, 10)),
            (early, slow - Fraction(1, 9), Fraction(1, 10), Fraction(1, 10)),
        ]:
            times = interval.around(left, width_left), interval.around(right, width_right)
            least = interval.least(*map(speed, times))
            if slowest := flies(osc, flight, times, BALLS.bound):
                least = interval.least(least, slowest)
            for k in (-1, 0, 1):
                for m in (-1, 0, 1):
                    start, end = left + k * width_left, right + m * width_right
                    lowest = speed(interval.ball(min(max(start, slow), end)))
                    assert holds(least, interval.midpoint(lowest), ERROR)


def test_tightness():
    """Taylor models see the true range of the trace over a box; balls, ten times more."""
    with mpmath.workdps(reference.DIGITS), interval.workprec(BITS):
        p, x, v = P_STAR
        x, v, r = Fraction(x), Fraction(v), Fraction(1, 10**9)
        model = matrix.trace(certified(p, x, v, r, TAYLOR_MODELS).monodromy)
        ball = matrix.trace(certified(p, x, v, r, BALLS).monodromy)
        assert 5.5e-8 < width(model.bound()) < 1.5e-7
        assert width(ball) < 1.6e-6
        system, traces = reference.System.of(p), []
        for dx, dv in ((r, r), (r, -r), (-r, r), (-r, -r)):
            derivative = reference.jacobian(system, number(x + dx), number(v + dv))
            traces.append(derivative[0][0] + derivative[1][1])
        assert width(model.bound()) < 1.05 * float(max(traces) - min(traces))
        point = certified(p, x, v, Fraction(0), BALLS)
        quantities = [*point.end, *sum(point.monodromy, ()), point.hits[1].time]
        assert max(map(width, quantities)) < 1e-28
        end = certified(p, x, v, Fraction(1, 10**4), TAYLOR_MODELS).end
        assert max(width(model.remainder) for model in end) < 1e-10


def test_determinant_is_one():
    """The flow preserves area: an enclosure of det Φ' contains 1, a tight one is near it."""
    with mpmath.workdps(reference.DIGITS), interval.workprec(BITS):
        for name in ("P*", "to the left", "F = 2, omega = 3", "l = -7/3"):
            p, x, v, *_ = CASES[name]
            for kind, r in ((BALLS, Fraction(0)), (TAYLOR_MODELS, Fraction(1, 10**9))):
                m = certified(p, Fraction(x), Fraction(v), r, kind).monodromy
                det = kind.bound(matrix.determinant(m))
                assert holds(det, 1)
                assert width(det) < 1e-4


@pytest.mark.parametrize("name", ["P*", "to the left", "F = 2, one hit", "f = 3/5"])
@pytest.mark.parametrize("radius", ["0", "1e-7"])
def test_strobe_jet(name, radius):
    """Taylor coefficients to order 3 at a state of the box, against divided differences."""
    p, x, v, *_ = CASES[name]
    x, v, r, order = Fraction(x), Fraction(v), Fraction(radius), 3
    random = seeded(name + radius)
    with mpmath.workdps(reference.DIGITS), interval.workprec(BITS):
        box = interval.around(x, r), interval.around(v, r)
        orbit = certified(p, x, v, r, BALLS)
        jets = strobe_jet(oscillator(p), box, orbit, order)
        state = number(inside(random, x, r)), number(inside(random, v, r))
        table = reference.derivatives(reference.System.of(p), *state, order)
        for exponent, values in table.items():
            for jet, value in zip(jets, values, strict=True):
                error = Fraction(1, 10**17) * int(1 + abs(value))
                assert holds(jet[exponent] + Ball(0), value, error)
                if not r:
                    assert width(jet[exponent] + Ball(0)) < 1e-17
        (a, b), (c, d) = orbit.monodromy
        linear = (jets[0][1, 0], a), (jets[0][0, 1], b), (jets[1][1, 0], c), (jets[1][0, 1], d)
        assert all(left.overlaps(right) for left, right in linear)
        for jet, end in zip(jets, orbit.end, strict=True):
            assert jet[0, 0].overlaps(end)


def test_jets_of_all_orders_agree():
    """The jet of order n is that of order 6, truncated."""
    with mpmath.workdps(reference.DIGITS), interval.workprec(BITS):
        p, x, v = P_STAR
        x, v = Fraction(x), Fraction(v)
        orbit, box = certified(p, x, v, Fraction(0), BALLS), (interval.ball(x), interval.ball(v))
        best = strobe_jet(oscillator(p), box, orbit, 6)
        for order in range(6):
            for jet, fine in zip(strobe_jet(oscillator(p), box, orbit, order), best, strict=True):
                pairs = zip(jet.coefficients, fine.truncated(order).coefficients, strict=True)
                assert all((a - b).contains(0) and width(a + Ball(0)) < 1e-14 for a, b in pairs)


@pytest.mark.parametrize("name", ["P*", "saddle", "to the left", "F = 2, omega = 3", "f = 1/2"])
def test_time_reversal(name):
    """With friction -f, the end with its velocity reversed comes back; the hits at T - t."""
    p, x, v, *_ = CASES[name]
    with mpmath.workdps(reference.DIGITS), interval.workprec(BITS):
        x, v = Fraction(x), Fraction(v)
        there = certified(p, x, v, Fraction(0), BALLS)
        opposite = SimpleNamespace(F=p.F, omega=p.omega, f=-p.f, l=p.l, r=p.r, e=1, mu=0)
        osc = oscillator(opposite)
        times = [osc.T - hit.time for hit in reversed(there.hits)]
        state = there.end[0], -there.end[1]
        _, back = find_windows(osc, state, hits(state[1], times), BALLS)
        assert holds(back.end[0], x)
        assert holds(-back.end[1], v)
        assert max(map(width, back.end)) < 1e-20
        assert back.least_speed.overlaps(there.least_speed)
        assert all(a.time.overlaps(b) for a, b in zip(back.hits, times, strict=True))


def test_mirror_symmetry():
    """σ, half a period and a reflection, commutes with Φ; the mirror orbit has the same trace."""
    with mpmath.workdps(reference.DIGITS), interval.workprec(BITS):
        system = reference.System.of(PAPER)
        for name in ("P*", "saddle", "to the left"):
            _, x, v, *_ = CASES[name]
            z = Fraction(x), Fraction(v)
            half = reference.flow(system, *map(number, z), end=system.T / 2)
            mirrored = [rational(-c) for c in half.end]
            end = certified(PAPER, *z, Fraction(0), BALLS).end
            again = reference.flow(
                system, *(number(interval.midpoint(c)) for c in end), end=system.T / 2
            )
            image = certified(PAPER, *mirrored, Fraction(0), BALLS).end
            for ball, value in zip(image, again.end, strict=True):
                assert holds(ball, -value, Fraction(1, 10**20))
        star, mirror = (
            certified(PAPER, Fraction(x), Fraction(v), Fraction(1, 10**6), TAYLOR_MODELS)
            for _, x, v, *_ in (CASES["P*"], CASES["mirror"])
        )
        traces = [matrix.trace(orbit.monodromy).bound() for orbit in (star, mirror)]
        assert traces[0].overlaps(traces[1])
        assert star.least_speed.overlaps(mirror.least_speed)


def test_more_bits_give_narrower_enclosures():
    """The orbit at 300 bits lies in that at 60 bits."""
    p, x, v = P_STAR
    orbits = []
    for bits in (60, 300):
        with mpmath.workdps(99), interval.workprec(bits):
            orbits.append(certified(p, Fraction(x), Fraction(v), Fraction(0), BALLS))
    coarse, fine = ([*o.end, *sum(o.monodromy, ()), *(h.time for h in o.hits)] for o in orbits)
    assert all(interval.subset(b, a) for a, b in zip(coarse, fine, strict=True))
