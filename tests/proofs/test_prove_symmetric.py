"""The theorems symmetric and pitchfork: known numbers, orbits in floats, the paper."""

import math
from fractions import Fraction

import pytest
from closed_forms import claims_of, near_paper
from conftest import STARTS
from mpmath import mp, workdps
from support import among, seeded

from cap.floats.search.cycles import near
from cap.one_one.closed_form import asymmetric
from cap.parameters import PAPER
from cap.proofs import pitchfork, symmetric
from cap.proofs.fixed_point import Setting
from cap.sets import interval


def test_the_pitchfork_of_the_paper():
    """To 30 digits, where it is; and its numbers against mpmath."""
    claims = claims_of(pitchfork, digits=30)
    assert near_paper(claims["f"], "0.46590355558750707456911275456", Fraction(1, 10**28))
    with workdps(60):
        S = 4 / (mp.pi**2 - 4)
        alpha = 2 / mp.pi * mp.sqrt(1 - S**2)

        def half(f):
            s = mp.sqrt(1 - (mp.pi * f / 2) ** 2)
            return 2 - 2 * mp.pi**2 * s / (2 + 2 * s)

        def g(f, delta):
            cos_phi = mp.pi * f / 2 / mp.cos(delta)
            s = mp.sqrt(1 - cos_phi**2)
            W = (2 + 2 * s * (mp.cos(delta) + delta * mp.sin(delta))) / mp.pi
            return W * delta - mp.pi / 2 * s * mp.sin(delta)

        values = {
            "f": alpha,
            "half_trace_slope": mp.diff(half, alpha),
            "cubic": mp.diff(lambda d: g(alpha, d), 0, 3) / 6,
            "linear_slope": mp.diff(lambda f: mp.diff(lambda d: g(f, d), 0), alpha),
        }
        values["curvature"] = -values["cubic"] / values["linear_slope"]
        for name, value in values.items():
            assert among(claims[name], value, Fraction(1, 10**29))
        assert abs(half(alpha) + 2) < mp.mpf(10) ** -50


@pytest.mark.parametrize("rho", ["3/4", 1, 2, "5/2", "29/10"])
def test_the_curvatures_at_the_pitchfork(rho):
    """f and the trace of the pair at a small δ are what the curvatures say, up to O(δ⁴)."""
    claims = claims_of(pitchfork, rho)
    with interval.workprec(200):
        delta = Fraction(1, 10**5)
        orbit = asymmetric(interval.ball(delta), interval.ball(Fraction(rho)))
        f, curvature = (float(sum(map(Fraction, claims[k]))) / 2 for k in ("f", "curvature"))
        born = asymmetric(interval.ball(Fraction(0)), interval.ball(Fraction(rho))).alpha
        change = float((orbit.alpha - born) / interval.ball(delta) ** 2)
        assert float(born) == pytest.approx(f)
        assert change == pytest.approx(curvature, rel=1e-5)
        change = float((orbit.trace() - 2) / interval.ball(delta) ** 2)
        told = float(sum(map(Fraction, claims["trace_curvature"]))) / 2
        assert change == pytest.approx(told, rel=1e-4)


def test_the_symmetric_orbits_of_the_paper():
    """At f = 2/5: the two saddles found by others, and the paper's roots."""
    claims = symmetric.prove(Setting(PAPER, STARTS["elliptic"], 25))(Fraction(1))["claims"]
    for name, start in (("plus", "saddle"), ("minus", "second saddle")):
        orbit = claims["branches"][name]
        assert orbit["genuine"] == "yes"
        assert orbit["type"] == "saddle"
        assert among(orbit["x"], Fraction(STARTS[start].x), Fraction(1, 10**7))
        assert among(orbit["v"], Fraction(STARTS[start].v), Fraction(1, 10**7))
        cycle = near(PAPER, STARTS[start].x, STARTS[start].v)
        assert float(Fraction(orbit["trace"][0])) == pytest.approx(cycle.trace, rel=1e-7)
        for pair, (_, time) in zip(orbit["hit_times"], cycle.events, strict=True):
            assert among(pair, Fraction(time), Fraction(1, 10**9))
    assert claims["pitchfork"][0].startswith("0.46590355558750707456911")
    assert claims["minus_identity"][0].startswith("0.6157175183123234")
    for root in claims["paper_roots"]:
        theta = float(Fraction(root["theta"][0]))
        left = math.pi * math.sin(theta)
        assert left == pytest.approx(4 - 0.2 * math.pi**2 + 0.4 * theta * (math.pi - theta))
        assert float(Fraction(root["velocity"][1])) < 0


def branches(rho, f):
    """Return the two branches."""
    return claims_of(symmetric, rho, f=f)["branches"]


CASES = {  # ρ, f: (genuine, type) of plus and of minus, None: no such orbit
    ("2", "1/2"): (("yes", "elliptic"), ("yes", "saddle")),
    ("2", "0.63"): (("yes", "elliptic"), ("yes", "saddle")),
    ("2", "0.64"): (None, None),
    ("2", "0.1"): (("yes", "saddle"), ("yes", "saddle")),
    ("1", "0.1"): (("no", None), None),
    ("1", "0.5"): (("yes", "saddle"), None),
    ("1/2", "0.6"): (("no", None), None),
    ("6", "0.1"): (("yes", "elliptic"), ("yes", "saddle")),
    ("100", "0.9"): (None, None),
    ("1/1000", "0.1"): (("no", None), None),
}


@pytest.mark.parametrize(("rho", "f"), CASES)
def test_symmetric_orbits_at_other_parameters(rho, f):
    """Which exist and of what type, against a grid of speeds in floats."""
    for (name, orbit), expected in zip(branches(rho, f).items(), CASES[rho, f], strict=True):
        found = orbit and (orbit["genuine"], orbit.get("type"))
        least = least_on_a_grid(
            float(Fraction(rho)), float(Fraction(f)), 1 if name == "plus" else -1
        )
        if least is None or orbit is None:
            assert orbit is None
            assert least is None or least < 0
        else:
            assert float(Fraction(orbit["least_speed"][0])) == pytest.approx(least, abs=1e-5)
        assert found == expected


def least_on_a_grid(rho, alpha, sign):
    """Return the least speed of a symmetric orbit's formula on a grid of times, or None."""
    square = 1 - (math.pi * alpha / 2) ** 2
    if square < 0:
        return None
    S = sign * math.sqrt(square)
    t1, W = math.atan2(math.pi * alpha / 2, S), (rho + 2 * S) / math.pi
    times = [t1 + math.pi * k / 2000 for k in range(2001)]
    return min(W - (math.sin(t) - math.sin(t1)) - alpha * (t - t1) for t in times)


def test_the_least_speed_of_the_minus_branch():
    """At random parameters: at the hits, or between them where arcsin α > arcsin |S|."""
    random, inner = seeded(4), 0
    with interval.workprec(120):
        for _ in range(200):
            rho, alpha = random.randint(20, 500) / 100, random.randint(1, 636) / 1000
            orbit = symmetric.symmetric(
                interval.ball(Fraction(alpha)), interval.ball(Fraction(rho)), -1
            )
            least = float(orbit.least_speed())
            assert least == pytest.approx(least_on_a_grid(rho, alpha, -1), abs=1e-5)
            inner += least < float(orbit.mean_speed) - 1e-9
    assert 0 < inner < 200


@pytest.mark.parametrize("theta", [0, 1])
@pytest.mark.parametrize("f", ["0.35", "0.4", "0.6"])
def test_roots_of_the_papers_equation_are_no_orbits(theta, f):
    """Its formula, in mpmath: it moves left on all of (τ, T/2), with the friction for the right."""
    root = claims_of(symmetric, "2", f=f)["paper_roots"][theta]
    angle = float(sum(map(Fraction, root["theta"])) / 2)
    alpha = float(f)

    def velocity(t):
        return math.sin(t) - alpha * t - math.sin(angle) + alpha * angle

    last = velocity(math.pi)
    assert last < 0
    assert last == pytest.approx(float(Fraction(root["velocity"][0])))
    assert -math.sin(angle) - alpha * angle != pytest.approx(last)


def test_where_the_papers_equation_has_no_root():
    """Below its f_sc = (16 - 4π)/π² = 0.3479, and where Ψ(0) > 0."""
    assert claims_of(symmetric, "2", f="0.34")["paper_roots"] == []
    assert len(claims_of(symmetric, "2", f="0.348")["paper_roots"]) == 2
    assert claims_of(symmetric, "1", f="0.9")["paper_roots"] == []


def test_critical_values_that_do_not_exist():
    """The pitchfork needs ρ < (π² - 4)/2, Φ' = -1 needs ρ < π² - 2."""
    for rho, pitch, minus in (("2.93", True, True), ("2.94", False, True), ("8", False, False)):
        claims = claims_of(symmetric, rho)
        assert (claims["pitchfork"] is not None) == pitch
        assert (claims["minus_identity"] is not None) == minus
        assert among(claims["saddle_center"], Fraction(2 / math.pi), Fraction(1, 10**15))
