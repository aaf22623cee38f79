"""The theorem ``particles_limits``: certificates that lie are rejected, broken conditions too."""

from __future__ import annotations

import copy
import json
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.particles.existence import defects, dot
from cap.checker.particles.family import Family, moved, with_second
from cap.checker.particles.mechanics import Mechanics, contacts
from cap.checker.particles.orbit import Moment, moments, speeds
from cap.checker.theorems import particles_limits
from cap.checker.theorems.particles_limits import MOST_WORK, ParticlesLimits, work
from cap.checker.verdict import check, words
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.remembered import content
from checker.tampered import accepted

STORED = Path(__file__).parents[2] / "certificates/particles_limits.json"
TINY = Fraction(1, 10**9)


@pytest.fixture(scope="module")
def limits():
    """Return the certificate at the paper's parameters."""
    return json.loads(STORED.read_text("utf-8"))


@pytest.fixture(scope="module", autouse=True)
def krawczyk_computed_once():
    """Compute Krawczyk's operator once for equal systems and arguments: to test faster."""
    known, before = {}, particles_limits.krawczyk

    def once(M, *arguments):
        key = (type(M).__name__, M.p, M.bits, content((M.m, arguments)))
        if key not in known:
            known[key] = before(M, *arguments)
        return known[key]

    particles_limits.krawczyk = once
    yield
    particles_limits.krawczyk = before


@pytest.fixture
def at_the_ends(monkeypatch):
    """Leave out what is between flip and stop."""
    monkeypatch.setattr(ParticlesLimits, "between", lambda _self: None)


@pytest.fixture
def in_between(monkeypatch):
    """Leave out flip and stop themselves."""
    monkeypatch.setattr(ParticlesLimits, "crossing", lambda _self, _name: None)
    for name in ("flip", "stop"):
        monkeypatch.setattr(ParticlesLimits, name, lambda _self, _found: None)


def shifted(pair, by):
    """Return an interval, moved."""
    return [str(Fraction(end) + by) for end in pair]


def test_it_is_verified(limits):
    """Step by step; the schema describes it; the line says what was proved and no more."""
    steps = []
    line = words(check(encode(limits), steps.append))
    assert len(steps) == 9
    fits_the_schema(limits)
    assert "one multiplier is -1" in line
    assert "the least speed of the orbit is 0" in line
    assert "to one family that is analytic in m_2; nothing is claimed of m_2 from the first" in line
    assert line.endswith("nor of the multipliers of the orbits for m_2 below that interval")


@pytest.mark.usefixtures("at_the_ends")
def test_the_masses_claimed(limits):
    """Neither can be moved by its width, nor be wider than its digits, nor the wrong way round."""
    for name in ("flip", "stop"):
        pair = limits["claims"][name]
        width = Fraction(pair[1]) - Fraction(pair[0])
        for by in (-width, width):
            assert not accepted(changed(limits, "claims", name, shifted(pair, by))), (name, by)
        wide = [pair[0], str(Fraction(pair[1]) + 10 * width)]
        rejected(changed(limits, "claims", name, wide), f"{name} is wider than its digits")
    both = changed(limits, "claims", "flip", limits["claims"]["stop"])
    rejected(both, "stop is not below flip")
    above = changed(limits, "claims", "flip", shifted(limits["claims"]["flip"], Fraction(1, 10)))
    rejected(above, "the second mass may not be below the first")


@pytest.mark.usefixtures("at_the_ends")
def test_parameters(limits):
    """The claims hold at no other parameters; the masses to begin with are equal."""
    for name in ("F", "omega", "f", "l", "r"):
        value = str(Fraction(limits["parameters"][name]) + TINY)
        assert not accepted(changed(limits, "parameters", name, value)), name
    rejected(changed(limits, "parameters", "masses", 1, "9/10"), "not equal")
    heavier = changed(limits, "parameters", "masses", [str(1 + TINY)] * 2)
    rejected(heavier, "interior of its box")


@pytest.mark.usefixtures("at_the_ends")
def test_hints_of_the_ends(limits):
    """Centres of other zeros, boxes that are too small, matrices that are too bad."""
    for name in ("flip", "stop"):
        for end in ("lower", "upper"):
            point = copy.deepcopy(limits["hints"][name][end])
            point[3][2] = str(Fraction(point[3][2]) + Fraction(1, 10**12))
            assert not accepted(changed(limits, "hints", name, end, point)), (name, end)
        rows = limits["hints"][name]["preconditioner"]
        rejected(changed(limits, "hints", name, "preconditioner", rows[::-1]), "interior")
        rejected(changed(limits, "hints", name, "preconditioner", rows[:-1]), "32 rows")
        rejected(changed(limits, "hints", "middle", rows[:-1]), "32 rows")
        fewer = limits["hints"][name]["upper"][:-1]
        rejected(changed(limits, "hints", name, "upper", fewer), "not a list of 8")
    rejected(changed(limits, "hints", "reach", limits["hints"]["radius"]), "not in the large one")
    rejected(changed(limits, "hints", "radius", "0"), "radius is not positive")
    itinerary = limits["claims"]["itinerary"]
    rejected(changed(limits, "claims", "itinerary", itinerary[:-1]), "not a list of 7")
    assert not accepted(changed(limits, "claims", "itinerary", [*itinerary[1:], itinerary[0]]))


@pytest.mark.usefixtures("at_the_ends")
@pytest.mark.parametrize(
    ("z", "why"),
    [
        (((3, -3), (3, -1)), "other pair"),
        (((-3, -4), (0, -1)), "other pair"),
        (((0, -1), (0, -1)), "at the lower end"),
        (((0, -3), (0, -3)), "at the upper end"),
        (((0, -2), (0, -1)), "at the lower end"),
    ],
)
def test_the_reduced_traces(limits, monkeypatch, z, why):
    """One pair stays on the unit circle, the other one comes to -1, from the right side."""
    values = iter(z)
    monkeypatch.setattr(
        particles_limits,
        "reduced_traces",
        lambda _D: [Interval.enclosing(q, q, 100) for q in next(values)],
    )
    rejected(limits, why)


@pytest.mark.usefixtures("at_the_ends")
def test_a_speed_that_keeps_its_sign(limits, monkeypatch):
    """At the lower end of stop some velocity inside a flight must be certainly reversed."""
    for v in (Interval.enclosing(1, 1, 100), Interval.enclosing(-1, 1, 100)):
        monkeypatch.setattr(particles_limits, "speeds", lambda *_, v=v: [v])
        rejected(limits, "no velocity has certainly changed sign")


@pytest.mark.usefixtures("at_the_ends")
def test_other_contacts_near_the_stop(limits, monkeypatch):
    """For all masses of stop it is proved that there are none."""

    def refuse(M, _orbit):
        need(not isinstance(M, Family), "there may be other contacts")

    monkeypatch.setattr(particles_limits, "no_other_contacts", refuse)
    rejected(limits, "there may be other contacts")


@pytest.mark.usefixtures("in_between")
def test_nodes(limits):
    """One is left out, moved, exchanged; cells that are too small or too large."""
    nodes = limits["hints"]["nodes"]
    without = nodes[:4] + nodes[5:]
    rejected(changed(limits, "hints", "nodes", without), r"may not be in the box|interior")
    rejected(changed(limits, "hints", "nodes", []), r"may not be in the box|interior|not certain")
    exchanged = [nodes[0], nodes[2], nodes[1], *nodes[3:]]
    rejected(changed(limits, "hints", "nodes", exchanged), "interior")
    rejected(changed(limits, "hints", "nodes", [nodes[0], *nodes]), "do not fall")
    mass = str(Fraction(nodes[4]["mass"]) + Fraction(1, 10**6))
    rejected(changed(limits, "hints", "nodes", 4, "mass", mass), "interior of its box")
    point = copy.deepcopy(nodes[4]["centre"])
    point[2][0] = str(Fraction(point[2][0]) + Fraction(1, 10**6))
    rejected(changed(limits, "hints", "nodes", 4, "centre", point), "interior of its box")
    rejected(changed(limits, "hints", "cell_reach", "1/2"), "may not be in the box")
    rejected(changed(limits, "hints", "cell_reach", "50"), r"interior|not certain|may stop")
    rejected(changed(limits, "hints", "node_radius", "1/100"), r"interior|may not be in the box")
    rejected(changed(limits, "hints", "node_radius", "-1"), "not positive")
    loose = limits["hints"] | {"node_radius": "1/1000", "cell_reach": "1"}
    rejected(limits | {"hints": loose}, "may not be in the box of a cell")
    rejected(changed(limits, "hints", "middle", limits["hints"]["middle"][::-1]), "interior")


@pytest.mark.slow
@pytest.mark.usefixtures("in_between")
@pytest.mark.parametrize(
    ("speed", "rate", "why"),
    [
        (0, 1, "at a node"),
        (-1, 1, "at a node"),
        (1, -1000, "in a cell"),
        (Fraction(1, 10**9), 0, None),
        (1, -100, None),
    ],
)
def test_speeds_between(limits, monkeypatch, speed, rate, why):
    """The speed at a node is positive; it grows, or falls too little in a cell of 0.0016."""

    def one(value):
        return lambda *_: [Interval.enclosing(value, value, int(limits["hints"]["bits"]))]

    monkeypatch.setattr(particles_limits, "speeds", one(speed))
    monkeypatch.setattr(particles_limits.Family, "speed_rates", one(rate))
    if why:
        rejected(limits, why)
    else:
        verify(limits)


@pytest.fixture(scope="module")
def node(limits):
    """Return the system of the last node, the contacts of its hint, and the rows of stop."""
    certificate = read(encode(limits))
    hints, itinerary = certificate.hints, certificate.claims["itinerary"]
    last = hints["nodes"][-1]
    family = Family(certificate.parameters, (last["mass"], last["mass"]), 200)
    centre = [family.number(c) for contact in last["centre"] for c in contact]
    return family, contacts(family, itinerary, centre), hints["stop"]["preconditioner"]


def test_a_critical_time_that_a_contact_passes(node):
    """It is in the flight of mass 2 before a hit of mass 1, or after it: if uncertain, in both."""
    M, orbit, _ = node
    critical = M.two_pi - M.theta[1]

    def found(low, high, times):
        at = M.instant(critical + Interval.enclosing(low * TINY, high * TINY, M.bits))
        passed = [*orbit[:6], orbit[6]._replace(at=at), orbit[7]]
        return [k for k, i, _ in moments(M, passed, times) if i == 1 and k in (5, 6)]

    assert orbit[6].word == "hit l"
    assert found(-2, -1, M.critical) == found(-2, -1, M.may_be_critical) == [6]
    assert found(1, 2, M.critical) == found(1, 2, M.may_be_critical) == [5]
    assert found(-1, 1, M.may_be_critical) == [5, 6]
    with pytest.raises(Rejected, match="critical at a contact"):
        found(-1, 1, M.critical)


def test_a_speed_on_a_flight_continued(node):
    """Past its end a flight is followed as if nothing happened there."""
    M, orbit, _ = node
    late = M.instant(orbit[7].at.t + M.number(TINY))
    flight = M.flight(orbit[6])
    [found] = speeds(M, orbit, [Moment(6, 0, late)])
    here = M.velocity(0, flight, orbit[7].at) * flight.signs[0]
    assert 0 < abs(middle(found - here)) < 2 * TINY


def test_rates(limits):
    """dz/dm_2 and the rates of speeds, for one mass, against differences of zeros."""
    certificate = read(encode(limits))
    p, itinerary = certificate.parameters, certificate.claims["itinerary"]
    hints, bits, mass = certificate.hints, 200, Fraction(9, 10)
    rows, found = hints["stop"]["preconditioner"], []
    centre = [c for contact in hints["nodes"][-1]["centre"] for c in contact]
    h = Fraction(1, 10**6)
    for second in (hints["nodes"][-1]["mass"] + k * h for k in (-1, 0, 1)):
        M = Mechanics(with_second(p, second), bits)
        z = [M.number(c) for c in centre]
        for _ in range(30):  # Newton's method, on midpoints
            G = defects(M, contacts(M, itinerary, z))
            steps = [dot([M.number(c) for c in row], G) for row in rows]
            z = [(a - b).midpoint() for a, b in zip(z, steps, strict=True)]
        found.append((M, z))
    mass = hints["nodes"][-1]["mass"]
    family = Family(p, (mass, mass), bits)
    orbit = contacts(family, itinerary, found[1][1])
    moving = family.rates(orbit, rows)
    for below, above, rate in zip(found[0][1], found[2][1], moving, strict=True):
        assert near(middle(above - below) / (2 * h), rate)
    slow = moments(family, orbit, family.critical)
    assert len(slow) == 6
    values = [speeds(M, contacts(M, itinerary, z), slow) for M, z in (found[0], found[2])]
    for low, high, rate in zip(*values, family.speed_rates(orbit, moving, slow), strict=True):
        assert near(middle(high - low) / (2 * h), rate)


def test_rates_without_an_inverse(node):
    """A matrix that is no inverse of G' bounds no rates."""
    family, orbit, rows = node
    assert all(width(rate) < Fraction(1, 10) for rate in family.rates(orbit, rows))
    for factor in (-1, 0):
        bad = [[factor * c for c in row] for row in rows]
        with pytest.raises(Rejected, match="may not move smoothly"):
            family.rates(orbit, bad)


def test_a_velocity_that_turns_in_its_flight(node):
    """Of each contact both velocities have, just before it, the signs of the flight before."""
    M, orbit, _ = node
    particles_limits.no_other_contacts(M, orbit)
    for k, contact in enumerate(orbit):
        for i in (0, 1):
            v = [-u if i == j else u for j, u in enumerate(contact.v)]
            turned = contact._replace(v=(v[0], v[1]))
            with pytest.raises(Rejected, match=r"another sign at the end of a flight|approached"):
                particles_limits.no_other_contacts(M, [*orbit[:k], turned, *orbit[k + 1 :]])


def near(difference, rate):
    """Return whether a difference lies in a rate that is enclosed, and not too wide."""
    error = Fraction(1, 10**8)
    return rate.lower - error <= difference <= rate.upper + error and width(rate) < Fraction(1, 2)


def middle(interval):
    """Return the middle of an interval."""
    return Fraction(interval.lo + interval.hi, 2 << interval.bits)


def test_the_family_is_the_systems_of_its_masses(limits):
    """Rules, velocities and the values of G of single masses lie in those of a family."""
    certificate = read(encode(limits))
    p, itinerary = certificate.parameters, certificate.claims["itinerary"]
    bits, second = 120, (Fraction(89, 100), Fraction(9, 10))
    family = Family(p, second, bits)
    point = [c for contact in certificate.hints["nodes"][4]["centre"] for c in contact]
    value = moved(p, second, itinerary, [family.number(c) for c in point], bits)
    for mass in (second[0], Fraction(179, 200), Fraction(8937, 10**4), second[1]):
        M = Mechanics(with_second(p, mass), bits)
        c = [M.number(q) for q in point]
        exact = contacts(M, itinerary, c)
        for wide, narrow in zip(family.rule("meet 1 2"), M.rule("meet 1 2"), strict=True):
            assert all(overlap(a, b) for a, b in zip(wide, narrow, strict=True))
        by = M.number(mass - (second[0] + second[1]) / 2)
        single = defects(M, exact)
        for g, slope, found in zip(value.G, value.slope, single, strict=True):
            assert overlap(g + slope * by, found)
            assert width(g + slope * value.by) < Fraction(1, 10)


def overlap(one, other):
    """Return whether two intervals meet."""
    return one.lo <= other.hi and other.lo <= one.hi


def width(interval):
    """Return the width of an interval."""
    return Fraction(interval.hi - interval.lo, 1 << interval.bits)


def test_too_much_work(limits):
    """Bits, contacts and nodes are bounded before anything is computed."""
    one = work(282, 8, 1) - work(282, 8, 0)
    most = (MOST_WORK - work(282, 8, 0)) // one
    assert 64 < most < 512
    for more, why in ((0, "do not fall"), (1, "too much")):
        hints = limits["hints"] | {"nodes": limits["hints"]["nodes"][:1] * (most + more)}
        rejected(limits | {"hints": hints}, why)
    hints = limits["hints"] | {"bits": "4096"}
    rejected(limits | {"hints": hints}, "too much")
