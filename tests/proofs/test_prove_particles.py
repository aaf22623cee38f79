"""The theorems on two masses: scalings, mirror images, digits, words, and what is refused."""

import json
from dataclasses import replace
from fractions import Fraction
from functools import cache

import particle_orbits
import pytest
from support import proving

from cap.checker.verdict import check
from cap.errors import BadInput, NotProved
from cap.floats.candidates import Request, particles
from cap.maps import zero
from cap.parameters import Parameters
from cap.proofs import particle_orbit, particles_saddle
from cap.proofs import particles as theorem
from cap.proofs.fixed_point import Setting
from cap.sets import interval
from cap.sets.interval import Ball

A = particle_orbits.A
PART = Fraction(9, 10)


@cache
def claims_at(p, masses, digits=12, kind=theorem):
    """Return the claims at some parameters."""
    name = kind.__name__.rpartition(".")[2]
    found = particles(Request(name, p, options={"masses": masses})).candidates[0]
    return kind.prove(Setting(p, found.guess, digits))(PART)["claims"]


def numbers(pairs, unit=1):
    """Return the middles of enclosures, over a unit."""
    if isinstance(pairs[0], str):
        return sum(map(Fraction, pairs)) / 2 / unit
    return [numbers(pair, unit) for pair in pairs]


def near(one, other):
    """Return whether nested numbers agree to ten digits."""
    if isinstance(one, list):
        return len(one) == len(other) and all(map(near, one, other))
    return abs(one - other) <= 1e-10 * max(1, abs(one))


def test_scaling():
    """Masses, forces, lengths and times in other units: the numbers change with their units."""
    mass, length, speed = Fraction(2), Fraction(3), Fraction(6)  # so ω is 2, F is 2·3·4
    scaled = Parameters(24 * A.F, 2 * A.omega, 24 * A.f, 3 * A.l, 3 * A.r)
    one = claims_at(A, particle_orbits.MASSES)
    two = claims_at(scaled, tuple(mass * m for m in particle_orbits.MASSES))
    action = mass * length * speed
    for name, unit in (
        ("x", length),
        ("v", speed),
        ("hit_times", Fraction(1, 2)),
        ("least_speeds", speed),
        ("theta", 1),
        ("twist_matrix", 1 / action),
        ("twist_determinant", 1 / action**2),
    ):
        assert near(numbers(one[name]), numbers(two[name], unit)), name
    assert near(numbers(one["monodromy"][0][2]), numbers(two["monodromy"][0][2], Fraction(1, 2)))


def test_mirror_image():
    """With the masses exchanged the orbit is the mirror image, half a period later."""
    one = claims_at(A, particle_orbits.MASSES)
    two = claims_at(A, particle_orbits.MASSES[::-1])
    for name in ("theta", "reduced_traces"):
        assert near(numbers(one[name]), numbers(two[name]))
    # the unit of B is that of the first mass, its value is not
    assert near(numbers(one["twist_matrix"]), numbers(two["twist_matrix"]))
    assert near(numbers(one["least_speeds"]), numbers(two["least_speeds"])[::-1])
    swap = {"hit l": "hit r", "hit r": "hit l", "meet 1 2": "meet 1 2"}
    words = [swap[word] for word in two["itinerary"]]
    assert sorted(words) == sorted(one["itinerary"])


@cache
def claims_of_thirty_digits():
    """Return the claims that the tests compare with."""
    return theorem.prove(particle_orbits.setting())(PART)["claims"]


@pytest.mark.parametrize("digits", [6, 100])
def test_digits(digits):
    """Claims of few digits contain those of thirty, and those claims of a hundred."""
    certificate = theorem.prove(particle_orbits.setting(digits=digits))(PART)
    check(json.dumps({**certificate, "provenance": {}}).encode(), lambda _step: None)
    thirty = claims_of_thirty_digits()
    wide, narrow = sorted((certificate["claims"], thirty), key=lambda c: len(c["theta"][0][0]))
    for name in ("x", "v", "theta", "twist_matrix", "monodromy", "least_speeds"):
        assert nested(narrow[name], wide[name]), name


def nested(inner, outer):
    """Return whether each enclosure lies in the other."""
    if isinstance(inner[0], str):
        (a, b), (c, d) = (tuple(map(Fraction, pair)) for pair in (inner, outer))
        return c <= a <= b <= d
    return all(map(nested, inner, outer))


def test_resonances():
    """All k with |k_1| + |k_2| <= 4 up to sign; one that may hold is refused."""
    assert len(theorem.RESONANCES) == 20
    half = {(k, n) for k, n in theorem.RESONANCES} | {(-k, -n) for k, n in theorem.RESONANCES}
    every = {(k, n) for k in range(-4, 5) for n in range(-4, 5) if 0 < abs(k) + abs(n) <= 4}
    assert half == every
    theta = [Ball(0.125), Ball(0.125)]
    assert theorem._distance(1, 0, theta).overlaps(Ball(0.125))
    assert theorem._distance(3, 1, theta).overlaps(Ball(0.5))
    assert theorem._distance(2, 1, theta).overlaps(Ball(0.375))
    with pytest.raises(NotProved, match="resonance of order 2"):
        theorem._distance(1, -1, theta)
    with pytest.raises(NotProved, match="resonance of order 4"):
        theorem._distance(4, 0, [Ball(0.25, 1e-9), theta[1]])


def test_a_twist_matrix_that_may_be_singular(monkeypatch):
    """det B may vanish: not proved."""
    asked = particle_orbits.setting()
    flat = ((Ball(1), Ball(1)), (Ball(1), Ball(1, 1e-9)))
    monkeypatch.setattr(theorem.twist_matrix, "twist_matrix", lambda _jets, _frame: flat)
    with pytest.raises(NotProved, match="twist matrix may be singular"):
        theorem.prove(asked)


def test_the_other_kind_of_orbit():
    """Each theorem refuses the orbit of the other, whatever the search says."""
    with pytest.raises(NotProved, match="leave the unit circle"):
        theorem.prove(particle_orbits.setting(particle_orbits.NEGATIVE, "particles_saddle"))
    with pytest.raises(NotProved, match="not one pair"):
        particles_saddle.prove(particle_orbits.setting())


def test_a_derivative_that_is_not_symplectic(monkeypatch):
    """The check of the computation: Dᵀ J D - J without 0 is no proof."""
    monkeypatch.setattr(particle_orbit.contacts, "symplectic_defect", lambda _m, _d: [Ball(1)])
    with pytest.raises(NotProved, match="does not preserve the form"):
        theorem.prove(particle_orbits.setting())


def test_no_orbit_near_the_guess():
    """A guess far from any orbit, or double, or with an event that is no contact."""
    asked = particle_orbits.setting()
    events = [list(event) for event in asked.particles.events]
    events[0][1], events[1][3] = 0.7, (0.3, -0.2)
    for changed, reason in (
        (events, "Newton"),
        ([("turn 1 left", *event[1:]) for event in events], "no contact"),
    ):
        guess = replace(asked.particles, events=tuple(tuple(event) for event in changed))
        with pytest.raises(NotProved, match=reason):
            theorem.prove(replace(asked, guess=guess))
    with pytest.raises(NotProved, match="beyond floats"):
        zero.inverse_of([[interval.ball(1), interval.ball(1)]] * 2)
    with pytest.raises(BadInput, match="about two masses"):
        theorem.prove(replace(asked, guess=replace(asked.particles, masses=(Fraction(1),))))


def test_the_command(capsys, tmp_path):
    """It finds the orbit itself, writes a certificate with the masses in its name, and says all."""
    words = ("particles", "--masses", "1,9/10", "--f", "91/200", "--digits", "8")
    status, out, err = proving(capsys, *words, "--out", str(tmp_path))
    assert (status, err) == (0, "")
    assert [path.name for path in tmp_path.iterdir()] == ["particles-f=91_200-masses=1,9_10.json"]
    assert "elliptic x elliptic" in out
    assert "does not say that P* is stable" in out
    assert proving(capsys, *words, "--out", str(tmp_path))[0] == 0  # the same file again


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("particles",), "give --masses M1,M2, as 1,9/10"),
        (("particles", "--masses", "1"), "about two masses"),
        (("particles", "--masses", "1,2,3"), "about two masses"),
        (("particles", "--masses", "1,0"), "positive"),
        (("particles", "--masses", "1,-2"), "positive"),
        (("particles", "--masses", "1,x"), "not a number: 'x'"),
        (("particles", "--masses", "1,9/10", "--mu", "1/10"), "no viscosity"),
        (("particles", "--masses", "1,9/10", "--orbit", "1", "2"), "finds its orbit itself"),
        (("particles", "--masses", "1,9/10", "--f", "9/10"), "never stop, to continue from"),
        pytest.param(
            ("particles", "--masses", "1,9/10"), "inverse hyperbolic", marks=pytest.mark.slow
        ),
        (("particles", "--masses", "1,3"), "before m = 1, 1.0"),
        (("elliptic", "--masses", "1,9/10"), "an option of: particles, particles_limits, "),
        (("elliptic", "--proportional"), "an option of: particles, particles_limits, "),
        (("particles", "--masses", "1,9/10", "--proportional"), "keeps the signs of both"),
    ],
)
def test_requests_that_make_no_sense(capsys, words, reason):
    """One line, status 2."""
    status, out, err = proving(capsys, *words)
    assert (status, out) == (2, "")
    assert reason in err
    assert err.count("\n") == 1


def test_the_negative_case(capsys, tmp_path):
    """Where the paper expects an elliptic orbit it is elliptic times inverse hyperbolic."""
    words = ("particles_saddle", "--masses", "1,9/10", "--digits", "8", "--out", str(tmp_path))
    status, out, _ = proving(capsys, *words)
    assert status == 0
    assert "unstable" in out
    (path,) = tmp_path.iterdir()
    traces = json.loads(path.read_text("utf-8"))["claims"]["reduced_traces"]
    assert Fraction(traces[1][1]) < -2 < Fraction(traces[0][0]) <= Fraction(traces[0][1]) < 2
