"""The theorem branch: known numbers, other proofs, other parameters, ranges."""

import math
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from functools import cache

import pytest
import reference
from closed_forms import check_cells, claims_of, near_paper, plain, proved, setting, within
from mpmath import mp, workdps
from reference import System
from support import number, only, rational, seeded

from cap.errors import BadInput
from cap.floats.search.cycles import near
from cap.maps.fixed_point import Start
from cap.one_one.closed_form import asymmetric
from cap.parameters import Parameters
from cap.proofs import branch, elliptic, pitchfork
from cap.proofs.fixed_point import Setting
from cap.runner import Runner
from cap.sets import bisection, interval, matrix


@pytest.fixture(scope="module", autouse=True)
def _cells_once():
    """Examine no cell twice: a verdict depends on ρ and the cell alone."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("examine_monotone", "examine_twist"):
            patch.setattr(branch, name, cache(getattr(branch, name)))
        yield


@pytest.mark.slow
def test_the_branch_of_the_paper():
    """Where it begins and ends, where the twist vanishes."""
    claims = claims_of(branch)
    assert near_paper(claims["f_start"], "0.465903555587507074569", Fraction(1, 10**11))
    assert near_paper(claims["f_end"], "0.347829754922769", Fraction(1, 10**11))
    assert near_paper(claims["trace_end"], "-1.637833771382508", Fraction(1, 10**11))
    (zero,) = claims["twist_zeros"]
    assert near_paper(zero, "0.400028562945859", Fraction(1, 10**8))
    ratios = [each["ratio"] for each in claims["resonances"]]
    assert ratios == ["1/8", "1/7", "1/6", "1/5", "1/4", "2/7", "1/3", "3/8", "2/5"]


def orbit_at(f, delta):
    """Return Newton's float orbit at f, from the closed form's state for this δ, at ρ = 2."""
    p = Parameters(Fraction(1), Fraction(1), f, Fraction(0), Fraction(2))
    with interval.workprec(100):
        orbit = asymmetric(interval.ball(delta), interval.ball(Fraction(2)))
        (sin, cos), _ = orbit.phases
        t1 = math.atan2(float(sin), float(cos)) % (2 * math.pi)
        u1 = float(orbit.speeds[0])
    system = System.of(p)
    x, v = reference.flow(system, system.r, -u1, start=t1, end=2 * math.pi).end
    return p, near(p, float(x), float(v))


@pytest.mark.slow
def test_resonances_by_secants_in_floats():
    """At the f claimed Newton's orbit has the rotation number; and no other f near has it."""
    certificate = proved(branch)
    hints = certificate["hints"]["resonances"]
    for each, ends in zip(certificate["claims"]["resonances"], hints, strict=True):
        f, delta = (sum(map(Fraction, pair)) / 2 for pair in (each["f"], ends))
        level = 2 * math.cos(2 * math.pi * Fraction(each["ratio"]))
        points = []
        for step in (Fraction(-1, 10**6), Fraction(1, 10**6)):
            _, cycle = orbit_at(f + step, delta)
            points.append((float(step), cycle.trace - level))
        (a, low), (b, high) = points
        assert low < 0 < high
        assert abs(a - low * (b - a) / (high - low)) < 1e-9


RHOS = {"3/4": True, "2": True, "5/2": False}  # whether there is an end


@pytest.mark.parametrize(
    "rho", ["3/4", *(pytest.param(q, marks=pytest.mark.slow) for q in ("2", "5/2"))]
)
def test_branches(monkeypatch, rho):
    """All claims on cells at random points; with an end and without."""
    if rho != "2":
        monkeypatch.setattr(branch, "SMALLEST", Fraction(1, 10**6))
    certificate = proved(branch, rho)
    check_cells(certificate)
    assert (certificate["hints"]["end"] is not None) == RHOS[rho]


@pytest.mark.slow
@pytest.mark.parametrize("rho", ["1", "3/2"])
def test_branches_that_pass_the_period_doubling(monkeypatch, rho):
    """There the trace falls below -2 before the end: all resonances up to 1/2 are passed."""
    monkeypatch.setattr(branch, "SMALLEST", Fraction(1, 10**6))
    certificate = plain(branch.prove(setting(rho))(Fraction(1)))
    check_cells(certificate)
    claims = certificate["claims"]
    assert claims["resonances"][-1]["ratio"] == "1/2"
    assert Fraction(claims["trace_end"][1]) < -2
    assert len(claims["resonances"]) == 11
    parabolic = Fraction(claims["resonances"][-1]["f"][1])
    for cell in claims["cells"]:
        if Fraction(cell["f"][1]) < parabolic:
            assert cell["twist"] is None


@pytest.mark.parametrize("rho", only(["3/4", "2", "5/2"], "3/4"))
def test_least_speeds_of_whole_orbits(rho):
    """In mpmath, from hit to hit: the least speed of the formula is that of the orbit."""
    random = seeded(3)
    cells = proved(branch, rho)["claims"]["cells"]
    for cell in random.sample(cells, 4):
        low, high = map(Fraction, cell["delta"])
        delta = low + (high - low) * Fraction(random.randint(1, 98), 100)
        with interval.workprec(200), workdps(50):
            orbit = asymmetric(interval.ball(delta), interval.ball(Fraction(rho)))
            alpha, u1 = (number(interval.midpoint(q)) for q in (orbit.alpha, orbit.speeds[0]))
            (sin, cos), _ = orbit.phases
            t1 = mp.atan2(*(number(interval.midpoint(q)) for q in (sin, cos)))
            R = number(Fraction(rho))
            s = System(mp.mpf(1), mp.mpf(1), alpha, mp.mpf(0), R)
            least = reference.flow(s, R, -u1, start=t1, end=t1 + 2 * mp.pi).least
            assert within(cell["least_speed"], rational(least))


@pytest.mark.parametrize("f", ["7/20", "2/5", "23/50"])
def test_against_the_theorem_elliptic(f):
    """Krawczyk's proof at one f: the trace and the sign of the twist are those of the cell."""
    f = Fraction(f)
    cells = [c for c in claims_of(branch)["cells"] if within(c["f"], f)]
    with interval.workprec(120):

        def above(delta):
            return asymmetric(
                interval.ball(delta), interval.ball(Fraction(2))
            ).alpha - interval.ball(f)

        delta, _ = bisection.crossing(above, Fraction(0), Fraction(48, 100), 20)
    p, cycle = orbit_at(f, delta)
    proof = elliptic.prove(Setting(p, Start(cycle.x, cycle.v, cycle.events), 12))
    claims = proof(Fraction(1, 2))["claims"]
    trace, least, twist = (
        sum(map(Fraction, claims[name])) / 2 for name in ("trace", "least_speed", "twist")
    )
    assert cells
    for cell in cells:
        assert within(cell["trace"], trace, Fraction(1, 10**11))
        assert within(cell["least_speed"], least, Fraction(1, 10**11))
        assert cell["twist"] == ("+" if (1 + trace) * twist > 0 else "-")


@pytest.mark.parametrize(
    "rho", ["0.72", *(pytest.param(rho, marks=pytest.mark.slow) for rho in ("0.70407", "0.705"))]
)
def test_pairs_that_end_soon_after_their_birth(rho):
    """The least speed at birth vanishes at ρ = 0.70406060652...; just above the end is near."""
    certificate = proved(branch, rho)
    check_cells(certificate)
    claims = certificate["claims"]
    assert Fraction(claims["f_end"][0]) < Fraction(claims["f_start"][0])
    assert claims["resonances"] == [] or rho == "0.72"


def test_pairs_that_are_born_at_little_friction():
    """Near ρ = (π² - 4)/2 the pair exists below a small f only."""
    with pytest.raises(BadInput, match="lower --from"):
        branch.prove(setting("2.9348"))
    check_cells(proved(branch, "2.93"))
    check_cells(proved(branch, "2.93", low="1/100"))


UNITS = [
    ("1e10", "1e5", "0", "2"),
    ("1e-20", "1e-10", "1", "3"),
    ("1", "1e-12", "0", "2e24"),
    ("1e-9", "1e9", "-1e-27", "1e-27"),
]


@pytest.mark.parametrize("words", UNITS, ids=range(len(UNITS)))
def test_units_of_any_size(words):
    """F, ω and R from 2e-27 to 2e24, of the same ρ: the digits are those of F = ω = 1."""
    F, omega, l, r = map(Fraction, words)
    p = Parameters(F, omega, F / 2, l, r)
    rho = p.R * omega**2 / F
    assert rho == 2
    ask = Setting(p, Start(0.0, 0.0, ()), 12)
    certificate, scaled = plain(branch.prove(ask)(Fraction(1))), proved(branch)
    claims, others = certificate["claims"], scaled["claims"]
    for name, unit in (("f_start", F), ("f_end", F), ("trace_end", 1)):
        for one, other in zip(claims[name], others[name], strict=True):
            assert abs(Fraction(one) / unit - Fraction(other)) < Fraction(1, 10**11)
    assert [c["twist"] for c in claims["cells"]] == [c["twist"] for c in others["cells"]]
    check_cells(certificate)
    for cell, other in zip(claims["cells"], others["cells"], strict=True):
        for name, unit in (("f", F), ("least_speed", F / omega)):
            a, b = (Fraction(q) / unit for q in cell[name])
            c, d = map(Fraction, other[name])
            assert abs(a - c) < Fraction(1, 10**10)
            assert abs(b - d) < Fraction(1, 10**10)
    pitch, same = pitchfork.prove(ask)(Fraction(1))["claims"], claims_of(pitchfork)
    for name, unit in (("f", F), ("half_trace_slope", 1 / F), ("curvature", F)):
        assert abs(Fraction(pitch[name][0]) / unit - Fraction(same[name][0])) < Fraction(1, 10**9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("low", "high", "end"),
    [("0.45", None, False), ("0.42", "0.44", False), (None, "2/5", True), ("1/3", "0.41", True)],
)
def test_ranges_of_friction(low, high, end):
    """Inside what is asked for; cells go no further down than needed."""
    certificate = proved(branch, low=low, high=high)
    check_cells(certificate)
    claims = certificate["claims"]
    a, b = map(Fraction, claims["f_range"])
    assert (claims["f_end"] is not None) == end
    if low and not end:
        assert a == Fraction(low)
        assert Fraction(claims["cells"][-1]["f"][0]) > Fraction(low) * Fraction(99, 100)
    if high:
        assert b == Fraction(high)
    if low == "1/3":
        assert a > Fraction("0.3478")


def test_threads_and_a_journal(tmp_path):
    """They give the same certificate; a second run examines no cell."""
    journal = tmp_path / "journal"
    with ThreadPoolExecutor(2) as executor:
        ask = setting("3/4", runner=Runner(executor=executor, journal=journal))
        assert plain(branch.prove(ask)(Fraction(1))) == proved(branch, "3/4")
    size = journal.stat().st_size
    ask = setting("3/4", runner=Runner(journal=journal))
    assert plain(branch.prove(ask)(Fraction(1))) == proved(branch, "3/4")
    assert journal.stat().st_size == size
    with pytest.raises(BadInput, match="something else"):
        branch.prove(setting("29/10", runner=Runner(journal=journal)))


def test_monodromies_agree():
    """The float orbits from which the comparisons start have determinant 1."""
    _, cycle = orbit_at(Fraction(2, 5), Fraction("0.36241"))
    assert matrix.determinant(cycle.path.monodromy) == pytest.approx(1, abs=1e-6)
