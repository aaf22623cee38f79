"""Flights with losses, and events other than elastic hits: against mpmath, and refused if wrong."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, mpf
from support import rational, seeded

from cap.checker.flow.events import WORDS, LossyMap
from cap.checker.flow.losses import Lossy as Mechanics
from cap.checker.kernel.exponential import phi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.series import composed, reciprocal
from cap.checker.system.walls import Parameters
from checker.altered import rejected
from checker.forge_hybrid import PERIODIC, forge_periodic, valid
from checker.hybrid import Flow

BITS = 128
UNIT = {"F": "1", "omega": "1", "f": "2/5", "l": "-9", "r": "9", "e": "9/10", "mu": "1/5"}


def point(q):
    """Return the enclosure of a rational."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def mechanics(parameters, x, v, sets=None, periods=1):
    """Return the mechanics for one orbit."""
    p = Parameters(**{k: Fraction(q) for k, q in parameters.items()})
    state = [point(x), point(v)]
    return Mechanics(p, state, state, 2, periods, sets)


@pytest.mark.parametrize("z", ["0", "-1/1000", "-3", "2/7", "-40", "-190"])
def test_the_exponential_and_its_integrals(z):
    """The derivatives contain their values, by numerical integration, within few ulps."""
    with mp.workdps(60):
        q = mpf(Fraction(z).numerator) / Fraction(z).denominator
        for k in range(4):
            value = phi(0, point(z), k)
            assert value.lower <= rational(mp.exp(q)) <= value.upper
            for n in (1, 2):
                cuts = [0, *(1 - mpf(2) ** -j for j in range(1, 13)), 1]
                cuts = sorted({*cuts, *(1 - c for c in cuts)})
                exact = mp.quad(lambda u, n=n, k=k: u**k * (1 - u) ** (n - 1) * mp.exp(q * u), cuts)
                value = phi(n, point(z), k)
                assert value.lower - Fraction(1, 10**35) <= rational(exact)
                assert rational(exact) <= value.upper + Fraction(1, 10**35)
                assert value.width < 10


def test_the_exponential_over_an_interval():
    """The ends of an interval give the ends of the values; a large exponent is refused."""
    z = Interval.enclosing(Fraction(-2), Fraction(1, 3), BITS)
    for n in range(3):
        assert phi(n, z).lo == phi(n, point("-2")).lo
        assert phi(n, z).hi == phi(n, point("1/3")).hi
    with pytest.raises(Rejected, match="exponent"):
        phi(1, point("-201"))


def test_composition_and_inverse_of_jets():
    """1/(2 + x + 3 v) times its inverse is 1; exp composed with a jet has exp's series."""
    jet = Jet(4, {(0, 0): point(2), (1, 0): point(1), (0, 1): point(3)})
    for power, c in (jet * reciprocal(jet)).coefficients.items():
        assert c.lower <= int(not any(power)) <= c.upper
    x = Jet(3, {(0, 0): point(0), (1, 0): point(2)})
    exp = composed([point(1)] * 4, x)
    assert abs(exp.coefficients[3, 0].lower - Fraction(8, 6)) < Fraction(1, 1 << 100)


@pytest.mark.parametrize("mu", ["0", "1/100000", "1/5", "7"])
@pytest.mark.parametrize("s", [1, -1])
def test_flights_solve_the_differential_equation(mu, s):
    """Position and speed against mpmath, and x' = v, v' = F cos wt - s f - mu v by differences."""
    parameters = UNIT | {"mu": mu, "omega": "3/2", "F": "2"}
    M = mechanics(parameters, "1/3", Fraction(s, 2))
    flight = M.launch()
    with mp.workdps(60):
        flow, start = Flow(parameters), (mpf(0), mpf(1) / 3, mpf(s) / 2)
        for t in ("0", "1/7", "2", "4"):
            moment = M.moment(M.constant(point(t)))
            q = mpf(Fraction(t).numerator) / Fraction(t).denominator
            x, v = flow.state(start, s, q)
            for computed, exact in ((M.place(flight, moment), x), (M.speed(flight, moment), s * v)):
                assert computed.value.lower - Fraction(1, 10**30) <= rational(exact)
                assert rational(exact) <= computed.value.upper + Fraction(1, 10**30)
                assert computed.value.width < 1 << 40
            slopes = [mp.diff(lambda u, n=n: flow.state(start, s, u)[n], q) for n in (0, 1)]
            assert abs(slopes[0] - v) < 1e-15
            assert abs(slopes[1] - (flow.force(q) - s * flow.f - flow.mu * v)) < 1e-15


@pytest.mark.parametrize("mu", ["0", "1/5"])
def test_flights_with_the_viscosity_in_an_interval(mu):
    """With mu in [0, 1/50], position and speed contain those of five values of mu.

    The mu of the parameters, which may be 0, does not matter.
    """
    sets = {"e": (Fraction(9, 10), Fraction(1)), "mu": (Fraction(0), Fraction(1, 50))}
    M = mechanics(UNIT | {"mu": mu}, "0", "1", sets)
    flight, moment = M.launch(), M.moment(M.constant(point(2)))
    x, v = M.place(flight, moment), M.speed(flight, moment)
    with mp.workdps(40):
        for n in range(5):
            flow = Flow(UNIT | {"mu": f"{n}/200"})
            for computed, exact in zip((x, v), flow.state((0, 0, 1), 1, mpf(2)), strict=True):
                assert computed.value.lower <= rational(exact) <= computed.value.upper
                assert computed.value.width < point("1/10").lo


@pytest.mark.parametrize("name", ["focus", "viscous", "stick", "double"])
def test_the_saltation_matrices_of_the_test_tool(name):
    """The derivative by saltation agrees with difference quotients of the flow."""
    with mp.workdps(40):
        flow, given = Flow(PERIODIC[name]["parameters"]), PERIODIC[name]
        z, n, step = [mpf(q) for q in given["orbit"]], given.get("periods", 1), mpf(10) ** -12
        J = flow.run(*z, n)[2]
        for j in (0, 1):
            ends = []
            for sign in (1, -1):
                moved = [q + sign * step * (i == j) for i, q in enumerate(z)]
                ends.append(flow.run(*moved, n)[1])
            for i in (0, 1):
                assert abs((ends[0][i] - ends[1][i]) / (2 * step) - J[i, j]) < 1e-8


def test_the_minima_of_the_speed():
    """F cos wt = s f and s sin wt < 0 at all of them, two in two periods for each sign."""
    M = mechanics(UNIT | {"omega": "2"}, "0", "1", periods=2)
    for s in (1, -1):
        assert len(M.minima[s]) == 2
        for moment in M.minima[s]:
            exact = M.moment(moment.t)
            for given, found in ((moment.cos, exact.cos), (moment.sin, exact.sin)):
                assert given.value.lo <= found.value.hi
                assert found.value.lo <= given.value.hi
            assert (moment.sin.value * -s).is_positive()
            assert moment.t.value.is_before(M.horizon)
            assert moment.t.value.is_positive()


def passage(parameters, x, v, words, windows, periods=1):
    """Follow one orbit."""
    p = Parameters(**{k: Fraction(q) for k, q in parameters.items()})
    windows = [(Fraction(a), Fraction(b)) for a, b in windows]
    return LossyMap(p, windows, words, periods).over([point(x), point(v)], [point(x), point(v)], 2)


FREE = {"F": "1", "omega": "1", "f": "1/2", "l": "-9", "r": "9", "e": "1", "mu": "0"}
# v = 1/2 + sin t - t/2 vanishes at 2.38, where cos t = -0.72: a turn to the left


@pytest.mark.parametrize(
    ("word", "window", "why"),
    [
        ("turn right", ("2.3", "2.5"), "to which the mass moves"),
        ("stick", ("2.3", "2.5"), "too strong"),
        ("hit r", ("2.3", "2.5"), "vanish before a hit"),
        ("hit l", ("2.3", "2.5"), "moves away"),
        ("turn left", ("2.4", "2.5"), "vanish before a stop"),
        ("turn left", ("2.2", "2.3"), "not vanish in a window"),
        ("turn left", ("0.5", "2.5"), "more than once"),
        ("turn left", ("0", "2.5"), "begins before"),
        ("turn left", ("2.3", "6.4"), "after T"),
        ("release left", ("2.3", "2.5"), "does not rest"),
        ("capture r", ("0", "0.1"), "not accumulate"),
    ],
)
def test_a_turn_is_nothing_else(word, window, why):
    """A turn under another name, or in a window that does not hold it alone, is refused."""
    with pytest.raises(Rejected, match=why):
        passage(FREE, "0", "0.5", [word], [window])


def test_a_turn_at_a_wall_and_beyond():
    """The turn is accepted with walls far off, and refused where the wall is met before."""
    good = passage(FREE, "0", "0.5", ["turn left", "turn right"], [("2.3", "2.5"), ("5.2", "5.5")])
    M = good.mechanics
    x = M.place(M.launch(), good.events[0].moment).value
    assert good.events[0].moment.t.value.lower > Fraction(238, 100)
    nearer = FREE | {"r": str(x.lower)}
    with pytest.raises(Rejected, match="beyond a wall"):
        passage(nearer, "0", "0.5", ["turn left"], [("2.3", "2.5")])


def test_a_second_event_must_be_named():
    """The orbit turns twice in the period: with one turn, its velocity vanishes before T."""
    with pytest.raises(Rejected, match="vanish between the last event"):
        passage(FREE, "0", "0.5", ["turn left"], [("2.3", "2.5")])


STICKY = FREE | {"f": "9/10"}
# v = 1/2 + sin t - 9 t/10 vanishes at 1.66, where cos t = -0.09; then cos t = -9/10 at 2.69


@pytest.mark.parametrize(
    ("words", "windows", "why"),
    [
        (["stick"], [], "no release follows"),
        (["stick", "release right"], [("5.5", "5.9")], "no release to this side"),
        (["stick", "release left"], [("2.7", "2.8")], "not in its window"),
        (["stick", "turn left"], [("2.6", "2.8")], "no release follows"),
        (["stick", "stick"], [("2.6", "2.8")], "no release follows"),
        (["turn left"], [], "too weak"),
        (["turn right"], [], "to which the mass moves"),
        (["stick", "capture r"], [("1.6", "1.7")], "too weak to hold"),
    ],
)
def test_a_stick_is_followed_by_its_own_release(words, windows, why):
    """Another release, a release at another time, or none, is refused."""
    with pytest.raises(Rejected, match=why):
        passage(STICKY, "0", "0.5", words, [("1.6", "1.75"), *windows])


def test_a_stick_and_its_release():
    """The release is at arccos(-9/10), to the left; what follows forgets the velocity."""
    M = mechanics(STICKY, "0", "0.5")
    windows = [(Fraction(16, 10), Fraction(175, 100)), (Fraction(2), Fraction(3))]
    phi = LossyMap(None, windows, ["stick", "release left"])
    events, flight = phi.follow(M, M.launch())
    with mp.workdps(40):
        assert abs(rational(mp.acos(mpf(-9) / 10)) - events[1].moment.t.value.lower) < 1e-30
    assert events[1].forcing.lower <= Fraction(-9, 10) <= events[1].forcing.upper
    assert flight.at_rest
    assert len(flight.minima) == 0  # the release is not among them
    x = M.place(flight, M.at(M.horizon))
    assert x[1, 0].lower <= 1 <= x[1, 0].upper
    assert x[0, 1].lower > 0


def test_a_release_from_a_wall_is_away_from_it():
    """After a capture at the right wall, motion does not begin to the right."""
    certificate = valid("captured")
    words = [*certificate["claims"]["itinerary"][:4], "release right"]
    windows = [*certificate["hints"]["events"][:4], ["5", "5.3"]]
    with pytest.raises(Rejected, match="into the wall"):
        passage(certificate["parameters"], *certificate["hints"]["centre"], words, windows)


def test_an_event_after_the_end():
    """Two periods hold twice the events; with one period, those of the second are refused."""
    certificate = forge_periodic("double")
    rejected(certificate | {"claims": certificate["claims"] | {"period": "1"}}, "after T")


@pytest.mark.parametrize("name", ["focus", "stick"])
def test_every_word_of_an_itinerary_counts(name):
    """Each word in turn replaced by each other word, left out, or doubled, is refused."""
    certificate = forge_periodic(name, digits=6)
    hints, claims = certificate["hints"], certificate["claims"]
    p = Parameters(**{k: Fraction(q) for k, q in certificate["parameters"].items()})
    windows = [tuple(map(Fraction, w)) for w in hints["events"]]
    state, words = [point(q) for q in hints["centre"]], claims["itinerary"]
    LossyMap(p, windows, words).over(state, state, 2)
    rng = seeded(5)
    for n, right in enumerate(words):
        changes = [(w, windows[n : n + 1]) for w in WORDS if w != right]
        altered = [([*words[:n], w, *words[n + 1 :]], windows) for w, _ in changes]
        altered.append((words[:n] + words[n + 1 :], windows[:n] + windows[n + 1 :]))
        altered.append((words[: n + 1] + words[n:], windows[: n + 1] + windows[n:]))
        for other, times in rng.sample(altered, len(altered)):
            with pytest.raises(Rejected):
                LossyMap(p, times, other).over(state, state, 2)


@pytest.mark.parametrize(
    ("name", "why"), [("f", "the friction is a parameter"), ("F", "the force is not F cos wt")]
)
def test_only_losses_may_be_sets(name, why):
    """The times of the least speeds depend on f and F: these are numbers, or f that of theta."""
    with pytest.raises(Rejected, match=why):
        mechanics(UNIT, "0", "1", {name: (Fraction(1, 3), Fraction(1, 2))})
