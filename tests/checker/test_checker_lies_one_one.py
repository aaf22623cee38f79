"""Lies about (1,1) orbits, each rejected for the reason named: what is claimed is nearly true."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, mpf

from cap.checker.kernel.certificate import read
from cap.checker.one_one import pairs as of_pairs
from cap.checker.verdict import words
from checker.altered import changed, encode, rejected, verify
from checker.forge_impact import (
    PAPER,
    WALLS,
    System,
    forge_branch,
    forge_pitchfork,
    forge_symmetric,
)
from checker.parts import Interval, Theorem, home, over_intervals, regularised_twist

pytestmark = pytest.mark.usefixtures("pairs_computed_once")

F = Fraction
SHORT = {"first": "0.2", "width": "0.05", "last": "0.3"}


def decimals(value, places=40):
    """Return a number of mpmath with so many places."""
    return mp.nstr(value, places, strip_zeros=False, min_fixed=-mp.inf, max_fixed=mp.inf)


@pytest.fixture
def uncompared(monkeypatch):
    """No claim is compared with what is computed: only what follows from the claims can fail."""
    monkeypatch.setattr(Theorem, "compare", lambda *_: None)


# symmetric orbits


@pytest.mark.parametrize("side", ["-1e-25", "1e-25"])
def test_friction_at_the_saddle_centre(side):
    """At f = 2F/pi +- 1e-25, 64 bits do not tell whether there are orbits; more do."""
    with mp.workdps(50):
        f = decimals(2 / mp.pi + mpf(side))
    certificate = forge_symmetric(PAPER | {"f": f}, 20)
    verify(certificate)
    rejected(changed(certificate, "hints", "bits", "64"), "f may be 2F/pi")


def test_a_trace_of_two():
    """There the trace is 2 - 1e-11, which 6 digits do not tell from 2."""
    with mp.workdps(50):
        f = decimals(2 / mp.pi - mpf("1e-25"))
    certificate = forge_symmetric(PAPER | {"f": f}, 6)
    saddle = changed(certificate, "claims", "branches", "plus", "type", "saddle")
    for either in (certificate, saddle):
        rejected(either, "branches.plus.trace is not that of the type claimed")


def slow(sign, speed, low, high):
    """Return parameters with the orbit of this sign of c at a least speed, by the position of r."""
    with mp.workdps(50):

        def excess(r):
            system = System(PAPER | {"f": "3/5", "l": "0", "r": decimals(r)})
            return system.symmetric(mpf(3) / 5, sign).least_speed - mpf(speed)

        r = mp.findroot(excess, (mpf(low), mpf(high)), solver="anderson", tol=mpf(10) ** -40)
        return PAPER | {"f": "3/5", "l": "0", "r": decimals(r)}


def test_an_orbit_that_comes_to_rest():
    """At a least speed of +-1e-9, 6 digits do not tell whether the orbit is genuine."""
    for speed, genuine, why in (
        ("1e-9", True, "least_speed is not positive"),
        ("-1e-9", False, "least_speed is not negative"),
    ):
        parameters = slow(-1, speed, "0.7", "1")
        verify(forge_symmetric(parameters, 12))
        certificate = forge_symmetric(parameters, 6)
        orbit = certificate["claims"]["branches"]["minus"]
        assert (orbit["genuine"] == "yes") == genuine
        rejected(certificate, f"branches.minus.{why}")
        end = ["0", orbit["least_speed"][1]] if genuine else [orbit["least_speed"][0], "0"]
        rejected(changed(certificate, "claims", "branches", "minus", "least_speed", end), why)


def test_an_orbit_that_is_not_genuine():
    """Everything claimed of the formula is true, but its least speed is negative."""
    parameters = PAPER | {"f": "3/5", "l": "-3/8", "r": "3/8"}
    lie = forge_symmetric(parameters, genuine=True)
    rejected(lie, "branches.minus.least_speed is not positive")


@pytest.mark.parametrize(("f", "where", "excess"), [(4, 1, -1), (4, 1, 1), (9, 0, -1)], ids=str)
def test_the_number_of_roots(f, where, excess):
    """With Psi(0) or Psi(pi/2) within 1e-25 of 0, 64 bits do not tell whether there are roots."""
    with mp.workdps(50):
        rho = (mp.pi - 2 + mp.pi**2 * f / 40) if where else mp.pi**2 * f / 20 - 2
        r = decimals(rho + excess * mpf("1e-25"))
    certificate = forge_symmetric(PAPER | {"f": f"{f}/10", "l": "0", "r": r}, 15)
    verify(certificate)
    why = "the number of roots of the paper's equation is not decided"
    rejected(changed(certificate, "hints", "bits", "64"), why)


@pytest.mark.parametrize("side", ["-1e-25", "1e-25"])
def test_a_formula_with_a_hit_speed_near_zero(side):
    """With R = 2|c| +- 1e-25, 64 bits do not tell whether 'minus' hits the walls."""
    with mp.workdps(50):
        r = decimals(2 * mp.sqrt(1 - (mp.pi / 20) ** 2) + mpf(side))
    certificate = forge_symmetric(PAPER | {"f": "1/10", "l": "0", "r": r}, 15)
    if side == "-1e-25":  # with the other sign the trace has 50 digits
        verify(certificate)
    why = "branches.minus. the sign of the hit speed is not decided"
    rejected(changed(certificate, "hints", "bits", "64"), why)


@pytest.mark.parametrize("side", ["-1e-25", "1e-25"])
def test_a_speed_that_may_decrease_after_a_hit(side):
    """'minus' hits r when the forces balance if f = 1/sqrt(1 + pi^2/4)."""
    with mp.workdps(50):
        f = decimals(1 / mp.sqrt(1 + mp.pi**2 / 4) + mpf(side))
    certificate = forge_symmetric(PAPER | {"f": f}, 15)
    verify(certificate)
    why = "whether the speed decreases after a hit is not decided"
    rejected(changed(certificate, "hints", "bits", "64"), why)


@pytest.mark.parametrize("name", ["pitchfork", "minus_identity"])
@pytest.mark.parametrize("side", ["-1e-25", "1e-25"])
def test_a_gap_at_which_a_value_of_f_appears(name, side):
    """At R = (pi^2 - 4)/2 or pi^2 - 2 to 25 digits, 64 bits do not tell whether c < 1."""
    with mp.workdps(50):
        R = (mp.pi**2 - 4) / 2 if name == "pitchfork" else mp.pi**2 - 2
        r = decimals(R + mpf(side))
    certificate = forge_symmetric(PAPER | {"l": "0", "r": r}, 11)
    verify(certificate)
    assert (certificate["claims"][name] == "none") == (side == "1e-25")
    rejected(changed(certificate, "hints", "bits", "64"), "whether c is below 1 is not decided")


def test_a_root_at_the_end_of_its_claim():
    """Psi must change its sign in the claim: with the root 1e-14 beyond an end it does not."""
    certificate = forge_symmetric(digits=6)
    with mp.workdps(30):
        root = mpf(forge_symmetric(digits=30)["claims"]["paper_roots"][0]["theta"][0])
        for lower, upper, fine in (
            ("-1e-14", "6e-7", True),
            ("-6e-7", "1e-14", True),
            ("1e-14", "6e-7", False),
            ("-6e-7", "-1e-14", False),
        ):
            ends = [decimals(root + mpf(q), 30) for q in (lower, upper)]
            claimed = changed(certificate, "claims", "paper_roots", 0, "theta", ends)
            if fine:
                verify(claimed)
            else:
                rejected(claimed, r"paper_roots\[0\].theta may not contain the root")


def test_a_root_near_an_end():
    """A claim that reaches over 0 is not in its half of (0, pi), with its root in it."""
    with mp.workdps(50):
        r = decimals(mp.pi**2 * 9 / 20 - 2 + mpf("1e-8"))
    certificate = forge_symmetric(PAPER | {"f": "9/10", "l": "0", "r": r}, 10)
    verify(certificate)
    certificate["digits"] = "6"
    path = "claims", "paper_roots", 0, "theta", 0
    rejected(changed(certificate, *path, "-0.0000001"), "theta is not in its half")


# the pitchfork


@pytest.fixture(scope="module")
def pitchfork():
    """Return a valid certificate."""
    return forge_pitchfork(digits=8)


@pytest.mark.parametrize(
    "name", ["half_trace_slope", "cubic", "linear_slope", "curvature", "trace_curvature"]
)
def test_derivatives_that_may_vanish(pitchfork, uncompared, name):
    """An enclosure that contains 0, at either end, is not enough; of either sign it is."""
    for ends, fine in (
        (["-1", "2"], False),
        (["0", "1"], False),
        (["-1", "0"], False),
        (["1", "2"], True),
        (["-2", "-1"], True),
    ):
        certificate = changed(pitchfork, "claims", name, ends)
        if fine:
            verify(certificate)
        else:
            rejected(certificate, f"{name} does not exclude 0")


@pytest.mark.parametrize(
    ("curvature", "side"), [(["-2", "-1"], "f < f_0"), (["1", "2"], "f > f_0")]
)
def test_the_side_of_a_pitchfork(pitchfork, curvature, side):
    """The pair is there where f - f_0 has the sign of the curvature."""
    assert side in words(read(encode(changed(pitchfork, "claims", "curvature", curvature))))


def test_a_pitchfork_at_little_friction():
    """With c within 1e-18 of 1, slopes of 1e-9 are not told from 0 by 6 digits."""
    with mp.workdps(50):
        r = decimals((mp.pi**2 - 4) / 2 * (1 - mpf("1e-18")))
    certificate = forge_pitchfork(WALLS | {"l": "0", "r": r}, 6)
    rejected(certificate, "half_trace_slope does not exclude 0")
    apart = changed(certificate, "claims", "half_trace_slope", ["0", "0.0000001"])
    rejected(apart, "half_trace_slope does not exclude 0")


# the branch


@pytest.fixture(scope="module")
def early():
    """Return a valid certificate of a part of the branch, in three cells."""
    return forge_branch(**SHORT)


def test_a_cell_on_which_the_trace_may_rise(early):
    """On [0, 2/5] the Taylor models do not prove that the trace decreases; all claims are true."""
    verify(early)
    wide = forge_branch(first="0.4", width="0.01", last="0.41")
    rejected(wide, r"cells\[0\]: the trace may not decrease")


@pytest.mark.parametrize("n", range(3))
def test_a_cell_on_which_the_least_speed_may_rise(early, monkeypatch, n):
    """If L' may vanish on one cell, whichever it is, the certificate is refused."""
    computed, count = home("steepness").steepness, iter(range(9))

    def steepness(pair):
        slope = computed(pair)
        return slope if next(count) != n else slope - Interval(slope.lo, slope.lo, slope.bits)

    monkeypatch.setattr(home("steepness"), "steepness", steepness)
    rejected(early, rf"cells\[{n}\]: the least speed may not decrease")


def test_a_cell_on_which_a_hit_may_be_slowest(early, monkeypatch):
    """If L were larger by 1, it would not be below the speeds at the hits."""
    computed = of_pairs.slowest

    def slowest(pair):
        L = computed(pair)
        return L + 1

    monkeypatch.setattr(of_pairs, "slowest", slowest)
    rejected(early, "the least speed may be that at a hit")


def test_a_rotation_number_at_the_end():
    """Where the trace at the end is that of 1/4, to 25 digits, 64 bits decide nothing."""
    with mp.workdps(50):
        system = System(WALLS)
        last = decimals(mp.findroot(lambda d: system.pair(d).trace, (mpf("0.3"), mpf("0.4"))))
    for end in (-1, 1):
        q = str(F(last) + F(end, 10**25))
        certificate = forge_branch(first="0.3", width="0.04", last=q)
        rejected(changed(certificate, "hints", "bits", "64"), "1/4 is met is not decided")


def zero_of_the_twist():
    """Return the zero of the twist at the paper's walls, to 30 digits."""
    bits, rho = 200, Interval.enclosing(F(2), F(2), 200)
    pairs = over_intervals(rho)
    low, high = F("0.36226226705"), F("0.36226226706")
    while high - low > F(1, 10**30):
        middle = (low + high) / 2
        N = regularised_twist(pairs, pairs.at(Interval.enclosing(middle, middle, bits)))
        low, high = (low, middle) if N.is_positive() else (middle, high)
    return F(round(low * 10**30), 10**30)


def test_a_bracket_that_ends_with_the_zero():
    """At an end of a bracket the twist must have a sign."""
    certificate = forge_branch(first="0.34", width="0.03", last="0.37")
    verify(certificate)
    zero = zero_of_the_twist()
    why = "the twist may vanish at the end of a bracket"
    for ends in ([zero - F(1, 10**12), zero], [zero, zero + F(1, 10**12)]):
        bad = changed(certificate, "hints", "twist_zeros", [[str(q) for q in ends]])
        rejected(changed(bad, "hints", "bits", "64"), why)
