"""The theorem ``particles_sink``: against floats, broken conditions, certificates that lie."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.particles import passage, stops, zero
from cap.checker.particles.mechanics import Mechanics
from cap.checker.system.masses import MassParameters as Parameters
from cap.checker.verdict import words
from cap.floats.masses.particles import Particles, follow
from cap.parameters import PAPER
from cap.parameters import Parameters as Exact
from checker import remembered
from checker.altered import changed, encode, fits_the_schema, leaves, rejected, verify
from checker.tampered import accepted, moved

STORED = Path(__file__).parents[2] / "certificates/particles_sink.json"
HIDDEN = "cap.checker.kernel.theorem.Theorem.compare"
BITS = 250


@pytest.fixture(scope="module")
def sink():
    """Return the stored certificate."""
    return json.loads(STORED.read_text("utf-8"))


@pytest.fixture(scope="module", autouse=True)
def once():
    """Compute Krawczyk's operator once for equal certificates."""
    known, before = {}, zero.krawczyk

    def krawczyk(M, equations, region, centre, C):
        words = repr(equations.value.__closure__[1].cell_contents)
        key = M.p, M.bits, str(region), str(centre), id(C), words
        if key not in known:
            known[key] = before(M, equations, region, centre, C)
        return known[key]

    zero.krawczyk = krawczyk
    with remembered.hints_read_once():
        yield
    zero.krawczyk = before


def thin(q):
    """Return the enclosure of a rational."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def near(text):
    """Return an interval around a number, as K(S) is."""
    slack = Fraction(1, 10**35)
    return Interval.enclosing(Fraction(text) - slack, Fraction(text) + slack, BITS)


def middle(x):
    """Return the middle of an interval as a float."""
    return float((x.lower + x.upper) / 2)


@pytest.fixture(scope="module")
def orbit(sink):
    """Return the system, the words and the events of the stored orbit."""
    *five, masses = sink["parameters"].values()
    five, masses = tuple(map(Fraction, five)), tuple(map(Fraction, masses))
    M = Mechanics(Parameters(*five, masses=masses), BITS)
    itinerary = sink["claims"]["itinerary"]
    texts = [q for event in sink["hints"]["centre"] for q in event]
    events = stops.events(M, itinerary, [near(q) for q in texts])
    data = [thin(q) for q in texts]
    floats = Particles(Exact(*five), masses)
    return SimpleNamespace(M=M, words=itinerary, data=data, events=events, floats=floats)


def test_it_is_verified(sink):
    """In five steps; the schema describes it; the line says what was proved."""
    assert len(verify(sink)) == 5
    few = [["0"] * 8] * 8  # the schema does not count the events, and large matrices take long
    fits_the_schema({**sink, "hints": sink["hints"] | {"preconditioner": few}})
    line = words(read(encode(sink)))
    assert "one and only one orbit of period 3 T" in line
    assert "stick 1, meet 1 2, stick 2" in line
    assert "near enough to this state" in line


def test_the_orbit_in_floats(sink, orbit):
    """The float engine finds the events, comes back after three periods, and has the derivative."""
    z = [float(pair[0]) for name in "xv" for pair in sink["claims"][name]]
    path = follow(orbit.floats, z[:2], z[2:], 3 * 2 * np.pi)
    assert list(path.words) == orbit.words
    assert [*path.x, *path.v] == pytest.approx(z, abs=1e-9)
    for event, found in zip(path.events, orbit.events, strict=True):
        assert event.time == pytest.approx(middle(found.at.t), abs=1e-9)
        assert event.before == pytest.approx([middle(v) for v in found.v], abs=1e-8)
        assert event.positions == pytest.approx([middle(x) for x in found.x], abs=1e-9)
    D = passage.derivative(orbit.M, orbit.events, 3)
    assert np.allclose([[middle(c) for c in row] for row in D], path.monodromy, atol=1e-6)
    assert max(abs(np.linalg.eigvals(path.monodromy))) == pytest.approx(0.423, abs=1e-3)
    scaled = np.linalg.matrix_power(path.monodromy, 4)
    assert middle(passage.row_sums(orbit.M, D, 4)) == pytest.approx(
        np.abs(scaled).sum(axis=1).max(), abs=1e-6
    )


def test_the_derivative_of_the_equations(orbit):
    """Each column agrees with a difference."""
    equations = stops.of_events(orbit.M, orbit.words, 3)
    size, h = len(orbit.data), Fraction(1, 10**20)
    parts, count = equations.slopes(orbit.data), len(orbit.words)
    start = equations.value(orbit.data)
    assert max(abs(middle(g)) for g in start) < 1e-30
    for j in range(size):
        step = list(orbit.data)
        step[j] = step[j] + thin(h)
        column = [(g - g0).lower / h for g, g0 in zip(equations.value(step), start, strict=True)]
        expected = [0.0] * size
        for k, (own, following) in enumerate(parts):
            for block, event in ((own, k), ((following), (k + 1) % count)):
                if event == j // 4:
                    for i in range(4):
                        expected[4 * k + i] += middle(block[i][j % 4])
        assert np.allclose([float(c) for c in column], expected, atol=1e-9), j


def test_every_number(sink):
    """No enclosure can be moved or widened, no bound lowered, no part of the box moved."""
    for path, pair in leaves(sink["claims"]):
        if path[0] == "itinerary":
            continue
        low, high = map(Fraction, pair)
        far = 10 * (high - low)
        tries = [[low - far, high - far], [low + far, high + far]]
        for ends in moved(pair) if path[0] in ("x", "v") else tries[path[-1] % 2 :][:1]:
            value = [str(end) for end in ends]
            assert not accepted(changed(sink, "claims", *path, value)), path
    kappa = Fraction(sink["claims"]["contraction"])
    small = str(kappa - Fraction(1, 100))
    rejected(changed(sink, "claims", "contraction", small), "larger than claimed")
    rejected(changed(sink, "claims", "contraction", "1"), "not below 1")
    rejected(changed(sink, "claims", "power", "1"), "larger than claimed")
    verify(changed(sink, "claims", "contraction", "9/10"))


def test_words_and_parameters(sink):
    """No word can be another one; the period and the parameters neither."""
    itinerary = sink["claims"]["itinerary"]
    for n, word in enumerate(itinerary):
        for other in {("hit l", "turn 1 left", "stick 2", "release 1 right")[n % 4]} - {word}:
            assert not accepted(changed(sink, "claims", "itinerary", n, other)), (n, other)
    for period in ("1", "2", "4"):
        assert not accepted(changed(sink, "claims", "period", period))
    for name in ("F", "omega", "f", "l", "r"):
        other = str(Fraction(sink["parameters"][name]) + Fraction(1, 10**9))
        assert not accepted(changed(sink, "parameters", name, other)), name
    assert not accepted(changed(sink, "parameters", "masses", ["9/10", "1"]))


def test_hints_and_lengths(sink):
    """A bad hint proves nothing; lists are as long as the itinerary."""
    for k in (0, 5, 7, 23):
        for n in range(4):
            off = str(Fraction(sink["hints"]["centre"][k][n]) + Fraction(1, 1000))
            assert not accepted(changed(sink, "hints", "centre", k, n, off))
    rejected(changed(sink, "hints", "radius", "0"), "radius is not positive")
    rejected(changed(sink, "hints", "radius", "1"), "S is not in the box")
    for name in ("box", "event_times"):
        short = sink["claims"][name][:-1]
        rejected(changed(sink, "claims", name, short), f"claims.{name} is not a list of 24")
    rejected(changed(sink, "hints", "centre", sink["hints"]["centre"][:-1]), "hints.centre")
    rows = sink["hints"]["preconditioner"]
    rejected(changed(sink, "hints", "preconditioner", rows[:-1]), "96 rows and columns")


def test_times_claimed(sink, monkeypatch):
    """They are in order in (0, nT), also if nothing is compared."""
    monkeypatch.setattr(HIDDEN, lambda *_: None)
    times = sink["claims"]["event_times"]
    rejected(changed(sink, "claims", "event_times", 0, ["0", "1"]), "before 0")
    rejected(changed(sink, "claims", "event_times", 3, times[2]), "not increasing")
    rejected(changed(sink, "claims", "event_times", 23, ["18.8", "18.85"]), "not before nT")


def refused(of, why, k, **changes):
    """Check that an orbit with one event changed is refused."""
    bad = list(of.events)
    bad[k] = bad[k]._replace(**changes)
    with pytest.raises(Rejected, match=why):
        passage.follows(of.M, bad, 3)


def numbered(of, word):
    """Return the place of the first such event."""
    return of.words.index(word)


def test_what_is_no_such_orbit(orbit):
    """Each condition on events, flights and rests, broken."""
    M, found = orbit.M, orbit.events
    passage.follows(M, found, 3)
    turn, stick = numbered(orbit, "turn 2 left"), numbered(orbit, "stick 1")
    release, hit = numbered(orbit, "release 2 right"), numbered(orbit, "hit r")
    refused(orbit, "not in order", 4, at=found[3].at)
    one = thin(1)
    refused(orbit, "without a contact", turn, x=(found[turn].x[0], one))
    refused(orbit, "without a contact", turn, x=found[turn].x[::-1])
    v = found[hit].v
    refused(orbit, "may not be approached", hit, v=(v[0], -v[1]))
    refused(orbit, "does not rest", release, before=(-1, 1))
    refused(orbit, "that rests", turn, before=(found[turn].before[0], 0))
    refused(orbit, "from which it does not come", turn, after=(found[turn].after[0], 1))
    free = found[stick].at._replace(cos=thin("-9/20"))
    refused(orbit, "transversal|let a mass stick", stick, at=free._replace(cos=thin("-1/2")))
    weak = found[turn].at._replace(cos=thin("-1/5"))
    refused(orbit, "may not turn a mass", turn, at=weak)
    strong = found[turn].at._replace(cos=thin("1"))
    refused(orbit, "may not be transversal", turn, at=strong)


def test_a_mass_that_moves_before_its_release(orbit):
    """A rest past a time at which the force reaches friction is refused."""
    M, found = orbit.M, orbit.events
    k = numbered(orbit, "stick 2")
    start, end = found[k], found[k + 1]
    assert end.word == "release 2 right"
    passage.moves(M, start, end)
    later = end._replace(at=M.instant(end.at.t + thin("1/10")), word="hit l")
    with pytest.raises(Rejected, match="before its release"):
        passage.moves(M, start, later)
    strong = start._replace(at=M.instant(end.at.t + thin("1/10")))
    after = end._replace(at=M.instant(end.at.t + thin("1/5")), word="hit l")
    with pytest.raises(Rejected, match="before its release"):
        passage.moves(M, strong, after)
    with pytest.raises(Rejected, match="critical at an event"):
        passage.moves(M, start, end._replace(word="hit l"))


def test_a_velocity_that_vanishes(orbit):
    """A flight with a velocity of the other sign, or that is never positive, is refused."""
    M, found = orbit.M, orbit.events
    end = found[1]._replace(v=(-found[1].v[0], found[1].v[1]))
    with pytest.raises(Rejected, match="may stop"):
        passage.moves(M, found[0], end)
    turn = numbered(orbit, "turn 2 right")
    soon = found[turn + 1]._replace(at=M.instant(found[turn].at.t + thin("1/1000")))
    with pytest.raises(Rejected, match="begins and ends"):
        passage.keeps(M, 1, found[turn], soon)


def test_which_release(orbit):
    """A release whose time may be one or another is refused."""
    k = numbered(orbit, "release 2 right")
    M, t = orbit.M, orbit.events[k].at.t
    assert abs(middle(stops.release_time(M, orbit.events[k]) - t)) < 1e-30
    wide = Interval(t.lo - (4 << BITS), t.hi + (1 << BITS), BITS)
    with pytest.raises(Rejected, match="which release"):
        stops.release_time(M, orbit.events[k]._replace(at=M.instant(wide)))


@pytest.mark.parametrize("omega", ["1", "2"])
def test_the_release_is_the_nearest(omega):
    """Of those a period apart; f = F cos(omega t) there, and the force grows."""
    M = Mechanics(Parameters(1, Fraction(omega), Fraction(2, 5), -1, 1, masses=(1, 1)), BITS)
    near = SimpleNamespace(word="release 1 right", at=M.instant(thin(20)))
    t = float(middle(stops.release_time(M, near)))
    assert abs(t - 20) < np.pi / float(omega)
    assert np.cos(float(omega) * t) == pytest.approx(0.4)
    assert np.sin(float(omega) * t) < 0


def test_a_critical_time_beside_a_release(orbit):
    """Just below f = F two critical times lie close together; a release is at one of them only."""
    close = Parameters(*orbit.M.p[:2], Fraction(9999, 10000), *orbit.M.p[3:5], masses=(1, 1))
    M, n = Mechanics(close, BITS), numbered(orbit, "release 2 right")
    release = orbit.events[n]._replace(at=M.instant(M.two_pi - M.theta[1]))
    assert abs(middle(stops.release_time(M, release) - release.at.t)) < 1e-30
    end = orbit.events[n + 1]._replace(at=M.instant(M.two_pi + thin("1/2")))
    assert len(passage.critical(M, 1, release, end)) == 1
    wide = M.instant(release.at.t + Interval.enclosing(*[Fraction(q, 20) for q in (-1, 1)], BITS))
    with pytest.raises(Rejected, match="critical at an event"):
        passage.critical(M, 1, release._replace(at=wide), end)


def test_who_rests():
    """From a stick to a release or a hit, around the period."""
    itinerary = ["meet 1 2", "stick 1", "turn 2 left", "release 1 left", "stick 2"]
    rests = stops.resting(itinerary)
    assert rests == [(False, False), (True, False), (True, False), (False, False), (False, True)]
    assert PAPER.f == Fraction(2, 5)
