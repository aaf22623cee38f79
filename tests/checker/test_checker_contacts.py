"""Two masses in the checker, against the float engine, one mass alone, and orbits that fail."""

from __future__ import annotations

import json
import random
from fractions import Fraction
from itertools import product
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.particles import monodromy as linear
from cap.checker.particles import normal_form, orbit
from cap.checker.particles.existence import defects
from cap.checker.particles.mechanics import Contact, Mechanics, contacts
from cap.checker.system.masses import MassParameters as Parameters
from cap.checker.theorems.particles import from_integers
from cap.floats.masses.particles import Particles, follow
from cap.parameters import PAPER
from cap.parameters import Parameters as Exact

STORED = Path(__file__).parents[2] / "certificates"
BITS = 200
HALF = Fraction(1, 2)
EQUAL = Parameters(*map(Fraction, (1, 1, "2/5", -1, 1)), masses=(Fraction(1), Fraction(1)))


def thin(q):
    """Return the enclosure of a rational."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def middle(x):
    """Return the middle of an interval as a float."""
    return float((x.lower + x.upper) / 2)


def located(name):
    """Return a stored certificate's system and its contacts, and the system for floats."""
    certificate = json.loads((STORED / f"{name}.json").read_text("utf-8"))
    *five, masses = certificate["parameters"].values()
    five, masses = tuple(map(Fraction, five)), tuple(map(Fraction, masses))
    M = Mechanics(Parameters(*five, masses=masses), BITS)
    data = [thin(q) for contact in certificate["hints"]["centre"] for q in contact]
    found = contacts(M, certificate["claims"]["itinerary"], data)
    return SimpleNamespace(
        M=M, orbit=found, claims=certificate["claims"], floats=Particles(Exact(*five), masses)
    )


@pytest.fixture(scope="module", params=["particles", "particles-2", "particles_saddle"])
def at(request):
    """Return a stored orbit."""
    return located(request.param)


@pytest.fixture(scope="module")
def tori():
    """Return the orbit at f = 91/200."""
    return located("particles")


def state(at):
    """Return the state at t = 0 in floats."""
    return [float(pair[0]) for name in ("x", "v") for pair in at.claims[name]]


def flown(at, z):
    """Return the state after a period by the float engine."""
    path = follow(at.floats, z[:2], z[2:], float(at.M.period.lower))
    return np.array([*path.x, *path.v]), path


def test_the_orbit_in_floats(at):
    """The float engine finds the same contacts, velocities, monodromy and least speed."""
    z = state(at)
    end, path = flown(at, z)
    assert np.allclose(end, z, atol=1e-11)
    assert list(path.words) == at.claims["itinerary"]
    for event, contact in zip(path.events, at.orbit, strict=True):
        assert event.time == pytest.approx(middle(contact.at.t), abs=1e-11)
        assert event.before == pytest.approx([middle(v) for v in contact.v], abs=1e-11)
        after = [middle(v) for v in at.M.after(contact.word, contact.v)]
        assert event.after == pytest.approx(after, abs=1e-11)
    D = linear.monodromy(at.M, at.orbit)
    assert np.allclose([[middle(c) for c in row] for row in D], path.monodromy, atol=1e-7)
    least = min(map(middle, orbit.least_speeds(at.M, at.orbit)))
    assert least == pytest.approx(path.least_speed, abs=1e-10)


def test_the_equations(at):
    """All defects of the orbit are nearly zero; a contact moved changes eight of them at most."""
    assert all(abs(g.lower) < 1e-30 for g in defects(at.M, at.orbit))
    moved = list(at.orbit)
    moved[3] = moved[3]._replace(xi=moved[3].xi + thin("1/10"))
    changed = [k for k, g in enumerate(defects(at.M, moved)) if not abs(middle(g)) < 1e-9]
    assert changed == [8, 9, 12, 13]  # the places at the ends of two flights


def test_the_third_order_in_floats(tori):
    """The Taylor polynomial is wrong by 16 times less for half the deviation."""
    jets = normal_form.third_order(tori.M, tori.orbit)
    z, random_ = np.array(state(tori)), random.Random(5)  # noqa: S311
    for _ in range(4):
        direction = np.array([random_.uniform(-1, 1) for _ in range(4)])
        errors = []
        for size in (2e-4, 1e-4):
            d = size * direction
            series = [
                sum(middle(c) * np.prod(d ** np.array(p)) for p, c in jet.coefficients.items())
                for jet in jets
            ]
            end, _ = flown(tori, list(z + d))
            errors.append(np.abs(end - z - series).max())
        assert 10 < errors[0] / errors[1] < 25


def product_of_single_orbits():
    """Return two equal masses on the orbits of `elliptic` and its mirror image, as contacts."""
    one = json.loads((STORED / "elliptic.json").read_text("utf-8"))["claims"]
    x, v = (float(one[k][0]) for k in "xv")
    system = Particles(PAPER, (Fraction(1),) * 2)
    alone = follow(Particles(PAPER, (Fraction(1),)), [x], [v], np.pi)
    path = follow(system, [x, -alone.x[0]], [v, -alone.v[0]], 2 * np.pi)
    data = []
    for event in path.events:
        here = follow(system, [x, -alone.x[0]], [v, -alone.v[0]], event.time - 1e-12)
        data += [event.time, here.x[event.word == "hit l"], *event.before]
    M = Mechanics(EQUAL, BITS)
    return M, contacts(M, path.words, [thin(Fraction(q)) for q in data]), one


def test_equal_masses_move_as_one_alone():
    """Jets do not couple them; each has the Taylor coefficients and the twist of `elliptic`.

    The contacts are floats, so this holds to about 1e-9.
    """
    M, found, one = product_of_single_orbits()
    assert [c.word for c in found].count("meet 1 2") == 4
    jets = normal_form.third_order(M, found)
    for i in (0, 1):  # x and v of the first mass: the orbit of `elliptic`
        taylor = one["taylor"]["xv"[i]]
        for power, c in jets[2 * i].coefficients.items():
            x1, x2, v1, v2 = power
            if x2 or v2:
                assert abs(middle(c)) < 1e-6, power
            elif f"{x1},{v1}" in taylor:
                assert middle(c) == pytest.approx(float(taylor[f"{x1},{v1}"][0]), abs=1e-6)
    D = linear.monodromy(M, found)
    trace, (zero, unit) = D[0][0] + D[2][2], (thin(0), thin(1))
    starts = [[unit, zero, zero, zero], [zero, unit, zero, zero]]
    planes = [linear.plane(M, D, trace, start) for start in starts]
    rotation = float(one["rotation_number"][0])
    for plane in planes:
        assert middle(plane.theta) == pytest.approx(1 - rotation, abs=1e-9)
    f = normal_form.in_complex_coordinates(M, jets, planes)
    expected = -2 * float(one["twist"][0])
    B = twists_of_a_product(f)
    assert np.allclose(B, [[expected, 0], [0, expected]], atol=1e-5)


def twists_of_a_product(f):
    """Return the twist matrix of thin jets that are wrong by 1e-9, without its checks."""
    own = [f[j].coefficients[normal_form.UNITS[j]] for j in (0, 1)]
    wide = [{p: widened(c) for p, c in g.coefficients.items()} for g in f]
    loose = [normal_form.Jet(normal_form.ORDER, coefficients) for coefficients in wide]
    for j in (0, 1):
        loose[j].coefficients[normal_form.UNITS[j]] = own[j]
    return [[middle(b) for b in row] for row in normal_form.twist_matrix(loose)]


def widened(c):
    """Return a number with 1e-7 to each side."""
    slack = Interval.enclosing(Fraction(-1, 10**7), Fraction(1, 10**7), BITS)
    return type(c)(c.re + slack, c.im + slack)


def refused(of, why, k=0, **changes):
    """Check that an orbit with one contact changed is refused."""
    bad = list(of.orbit)
    bad[k] = bad[k]._replace(**changes)
    with pytest.raises(Rejected, match=why):
        orbit.least_speeds(of.M, bad)


def test_what_is_no_such_orbit(tori):
    """Each condition on contacts and flights, broken."""
    M, found = tori.M, tori.orbit
    assert len(orbit.least_speeds(M, found)) == 2
    one, two = thin(1), thin(2)
    refused(tori, "not in order", 2, at=found[1].at)
    refused(tori, "not in order", 0, at=M.instant(thin(0)))
    refused(tori, "not in order", 7, at=M.instant(thin(7)))
    for xi in (one, -one, two):
        refused(tori, "may be at a wall", 3, xi=xi)
    v1, v2 = found[1].v
    refused(tori, "a mass may stop", 1, v=(thin(0), v2))
    refused(tori, "may not be approached", 0, v=(found[0].v[0], -found[0].v[1]))
    apart = found[1]._replace(v=(v2, v1))
    with pytest.raises(Rejected, match="may not be approached"):
        orbit.admissible(M, apart, M.flight(apart))
    stops = Contact("meet 1 2", found[1].at, thin(0), (thin(18), thin(-1)))
    with pytest.raises(Rejected, match="sign of a velocity"):
        M.flight(stops)  # (m_1 - m_2) 18 = 2 m_2: the first one has v_1 = 0
    assert len(list(M.critical(1, thin(0), M.period))) == 2
    with pytest.raises(Rejected, match="critical at a contact"):
        list(M.critical(1, M.theta[1], M.period))


def test_a_collision_that_turns_one_mass_only():
    """A fast heavy mass that overruns a light one keeps its sign, the other one turns."""
    p = EQUAL._replace(masses=(Fraction(1), Fraction(1, 10)))
    M = Mechanics(p, BITS)
    contact = Contact("meet 1 2", M.instant(thin(1)), thin(0), (thin(1), thin("-1/10")))
    after = M.flight(contact)
    assert after.signs == (1, 1)
    with pytest.raises(Rejected, match="does not keep"):
        orbit.admissible(M, contact, after)
    D = linear.saltation(M, contact)
    with pytest.raises(Rejected, match="symplectic form"):
        linear.symplectic(M, D)
    head_on = contact._replace(v=(thin(1), thin(-6)))
    orbit.admissible(M, head_on, M.flight(head_on))
    linear.symplectic(M, linear.saltation(M, head_on))
    both = Contact("meet 1 2", M.instant(thin(1)), thin(0), (thin(3), thin(2)))
    orbit.admissible(M, both, M.flight(both))
    linear.symplectic(M, linear.saltation(M, both))


def leftwards(masses, gap, speeds, t):
    """Return a system, a hit of r at t, and a hit of l half a unit of time later."""
    M = Mechanics(EQUAL._replace(masses=masses), BITS)
    v = thin(-speeds[0]), thin(speeds[1])
    start = Contact("hit r", M.instant(thin(t)), thin(1 - gap), v)
    end = Contact("hit l", M.instant(thin(t + HALF)), thin(0), (thin(-1), thin(-1)))
    return M, start, end


def test_masses_that_meet_inside_a_flight():
    """The gap is proved positive on flights to the left, unless it closes."""
    outcomes = []
    heavy_left = (Fraction(1), Fraction(1, 5))
    for masses, t, gap, second in product(
        (heavy_left, heavy_left[::-1], (Fraction(1),) * 2),
        (Fraction(1, 10), Fraction(2), Fraction(7, 2), Fraction(5)),
        (Fraction(1, 5), Fraction(1, 10), Fraction(1, 50)),
        (Fraction(3), Fraction(16, 5), Fraction(7, 2), Fraction(5)),
    ):
        M, start, end = leftwards(masses, gap, (Fraction(3), second), t)
        flight = M.flight(start)
        assert flight.signs == (-1, -1)
        least = min(gap_at(M, flight, t + HALF * n / 200) for n in range(201))
        try:
            orbit.apart(M, start, end)
        except Rejected:
            outcomes.append(least > 0)
            assert least <= 0
        else:
            outcomes.append(least > 0)
            assert least > 0
    assert 20 < sum(outcomes) < 120


def test_a_gap_that_nearly_closes():
    """A gap that is least inside a flight, and convex, needs tangents, and halves; 0 is refused."""
    masses, t = (Fraction(1), Fraction(1, 5)), Fraction(1, 10)
    M, start, end = leftwards(masses, Fraction(1, 2), (Fraction(3), Fraction(4)), t)
    flight = M.flight(start)
    least = min(gap_at(M, flight, t + HALF * n / 5000) for n in range(5001))
    assert 0 < least < gap_at(M, flight, t + HALF)
    for slack, proved in (("0.1", True), ("0.001", True), ("0.00001", True), ("-0.00001", False)):
        gap = Fraction(1, 2) - Fraction(least) + Fraction(slack)
        M, start, end = leftwards(masses, gap, (Fraction(3), Fraction(4)), t)
        if proved:
            orbit.apart(M, start, end)
        else:
            with pytest.raises(Rejected, match="may meet"):
                orbit.apart(M, start, end)


def test_equal_masses_that_stay_together():
    """Between two meetings in one direction their gap is linear, and so 0 all the time."""
    M = Mechanics(EQUAL, BITS)
    v = thin(-3), thin(-4)
    start = Contact("meet 1 2", M.instant(thin(3)), thin(HALF), v)
    end = Contact("meet 1 2", M.instant(thin(Fraction(31, 10))), thin(0), (thin(-3), thin(-3)))
    with pytest.raises(Rejected, match="may meet"):
        orbit.apart(M, start, end)
    orbit.apart(M, start, end._replace(word="hit l"))


def test_a_bend_that_is_not_certain():
    """At a critical time the second derivative of a gap has no sign; beside it, both."""
    M = Mechanics(EQUAL._replace(masses=(Fraction(1), Fraction(1, 2))), BITS)
    with pytest.raises(Rejected, match="bend of a gap is not certain"):
        orbit.bent(M, 1, M.instant(M.theta[1]))
    before, after = (orbit.bent(M, 1, M.instant(M.theta[1] + thin(d))) for d in ("-1/10", "1/10"))
    assert (before, after) == (1, -1)


def test_a_gap_is_halved_so_often():
    """What tangents do not show without halving is refused when no halving is left."""
    masses, t = (Fraction(1), Fraction(1, 5)), Fraction(1, 10)
    M, start, end = leftwards(masses, Fraction(1, 2), (Fraction(3), Fraction(4)), t)
    flight = M.flight(start)
    least = min(gap_at(M, flight, t + HALF * n / 5000) for n in range(5001))
    nearly = Fraction(1, 2) - Fraction(least) + Fraction(1, 10**5)
    M, start, end = leftwards(masses, nearly, (Fraction(3), Fraction(4)), t)
    flight = M.flight(start)
    piece = orbit.knot(M, flight, start.at), orbit.knot(M, flight, end.at)
    orbit.convex(M, flight, piece, 16)
    with pytest.raises(Rejected, match="may meet"):
        orbit.convex(M, flight, piece, 0)


def gap_at(M, flight, t):
    """Return the gap at a time."""
    at = M.instant(thin(t))
    return middle(M.place(1, flight, at) - M.place(0, flight, at))


def test_distances_from_integers():
    """The distance of each point lies in the enclosure, also where it is not monotone."""
    random_ = random.Random(3)  # noqa: S311
    for _ in range(300):
        low = Fraction(random_.randrange(-5000, 5000), 1000)
        width = Fraction(random_.choice([0, 1, 50, 400, 1200]), 1000)
        found = from_integers(Interval.enclosing(low, low + width, BITS))
        for n in range(11):
            q = low + width * n / 10
            assert found.lower <= abs(q - round(q)) <= found.upper <= HALF
    assert from_integers(thin("9/4")).lower == from_integers(thin("9/4")).upper == Fraction(1, 4)


def test_one_multiplier_only():
    """Two pairs that coincide are refused, and a rotation without a sign."""
    M, found, _ = product_of_single_orbits()
    D = linear.monodromy(M, found)
    slack = Interval.enclosing(Fraction(-1, 10**8), Fraction(1, 10**8), BITS)
    with pytest.raises(Rejected, match="may coincide"):
        linear.reduced_traces([[c + slack for c in row] for row in D])
    zero = thin(0)
    with pytest.raises(Rejected, match="sign of a rotation"):
        linear.plane(M, D, D[0][0] + D[2][2], [zero] * 4)


def test_what_must_be_real(tori):
    """Jets that are not symplectic are noticed in the normal form."""
    M, found = tori.M, tori.orbit
    D = linear.monodromy(M, found)
    z, other = linear.reduced_traces(D)
    planes = [linear.rotation(M, D, z, other), linear.rotation(M, D, other, z)]
    jets = normal_form.third_order(M, found)
    assert len(normal_form.twist_matrix(normal_form.in_complex_coordinates(M, jets, planes))) == 2
    for power in ((1, 1, 0, 0), (3, 0, 0, 0), (0, 1, 1, 1)):
        bad = [*jets[:3], jets[3] + normal_form.Jet(3, {power: thin("1/1000")})]
        with pytest.raises(Rejected, match=r"not real|disjoint"):
            normal_form.twist_matrix(normal_form.in_complex_coordinates(M, bad, planes))


def test_an_entry_that_is_not_real(tori):
    """Of the diagonal, too, where no other entry says so."""
    M, found = tori.M, tori.orbit
    D = linear.monodromy(M, found)
    z, other = linear.reduced_traces(D)
    planes = [linear.rotation(M, D, z, other), linear.rotation(M, D, other, z)]
    f = normal_form.in_complex_coordinates(M, normal_form.third_order(M, found), planes)
    normal_form.twist_matrix(f)
    off = planes[0].multiplier * normal_form.Complex(thin("1/1000"), thin(0))
    bad = f[0] + normal_form.Jet(3, {(2, 0, 1, 0): off})
    with pytest.raises(Rejected, match="entry of the twist matrix is not real"):
        normal_form.twist_matrix([bad, f[1]])
