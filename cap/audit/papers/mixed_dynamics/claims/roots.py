"""Section 4.2: the roots of the existence equation, as a statement about an equation."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import enclosure, formula, identity, same, symbols
from cap.audit.means.balls import between, number, precisely
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.paper_equation import Equation, psi
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.checker.kernel.shapes import Enclosure
from cap.sets import interval
from cap.sets.interval import Ball

PAPER_RHO = Fraction(2)
MONOTONE = (
    "Ψ' = Fπ cos θ - f(π - 2θ) > 0 on (0, π/2), as cos θ > 1 - 2θ/π there (cos is concave) and "
    "f < F; and Ψ(π - θ) = Ψ(θ)"
)


def _evenness() -> None:
    """Raise `NotProved` unless Ψ is even about π/2, and increasing on (0, π/2) for f < F."""
    value, theta, (F, f, _, _) = psi()
    identity("Ψ is even about π/2", value.subs(theta, sp.pi - theta), value)
    slope = sp.diff(value, theta)
    identity("Ψ'", slope, F * sp.pi * sp.cos(theta) - f * (sp.pi - 2 * theta))
    chord = 1 - 2 * theta / sp.pi
    at_ends = [sp.simplify((sp.cos(theta) - chord).subs(theta, end)) for end in (0, sp.pi / 2)]
    need(at_ends == [0, 0], "cos θ is not on its chord at the ends")
    identity("cos'' = -cos", sp.diff(sp.cos(theta), theta, 2), -sp.cos(theta))


def _inside(value: Ball, claimed: Enclosure) -> bool:
    low, high = interval.ball(claimed.lower), interval.ball(claimed.upper)
    return bool(low <= value) and bool(value <= high)


@claim("prop:two-solutions", Kind.STEP, stated="θ = π/2 is the only critical point, the maximum")
def one_critical_point() -> Verdict:
    """Ψ(·; f) has one critical point on (0, π), the maximum at π/2."""
    _evenness()
    return confirmed("true for every f < F", f"{MONOTONE}. Shorter than Step 2.")


@claim("prop:two-solutions", Kind.FORMULA, stated="Ψ_θθ(π/2) = 2f - Fπ")
def second_derivative() -> Verdict:
    """Step 1: the second derivative of Ψ at π/2 is 2f - Fπ."""
    value, theta, (F, f, _, _) = psi()
    derived = sp.diff(value, theta, 2).subs(theta, sp.pi / 2)
    return formula(derived, 2 * f - F * sp.pi, "Differentiated by sympy.", "2f - Fπ")


@claim("prop:two-solutions", Kind.WORDS, stated="the third derivative, namely Ψ_θθ")
def third_derivative() -> Verdict:
    """Step 2: the third derivative of Ψ is -Fπ sin θ + 2f."""
    value, theta, (F, f, _, _) = psi()
    second = sp.diff(value, theta, 2)
    identity("the second derivative", second, -F * sp.pi * sp.sin(theta) + 2 * f)
    return formula(
        sp.diff(value, theta, 3),
        -F * sp.pi * sp.sin(theta) + 2 * f,
        "Differentiated by sympy: what is written down, and used, is the second derivative.",
        "-Fπ cos θ; -Fπ sin θ + 2f is the second",
    )


@claim("prop:two-solutions", Kind.INEQUALITY, stated="f < Fπ/2 < F (since π/2 > 1)")
def pi_half() -> Verdict:
    """Step 2: f < Fπ/2 < F, since π/2 > 1, hence Ψ_θ(0) > 0."""
    with precisely():
        half = interval.pi() / 2
        need(half > 1, "π/2 may be at most 1")
        bound = 2 / interval.pi()
        need(bound < 1, "2/π may be at least 1")
    return corrected(
        "Fπ/2 > F, for that very reason; what is needed is f < f_imp = 2F/π < F, which is assumed",
        f"π/2 in {between(half, 6)}, 2/π in {between(bound, 6)}. Ψ_θ(0) = π(F - f).",
    )


@claim("prop:two-solutions", Kind.FORMULA, stated="Ψ_θ(π; f) = -Fπ - fπ")
def slope_at_pi() -> Verdict:
    """Step 2: Ψ_θ(π; f) = -Fπ - fπ."""
    value, theta, (F, f, _, _) = psi()
    return formula(
        sp.diff(value, theta).subs(theta, sp.pi),
        -F * sp.pi - f * sp.pi,
        "By sympy; it is -Ψ_θ(0; f), as the symmetry says, and negative for f < F.",
        "-π(F - f)",
    )


@claim("prop:two-solutions", Kind.STEP, stated="strict concavity allows two critical points")
def critical_points_of_a_concave_function() -> Verdict:
    """Step 2: strict concavity on (θ₀, π - θ₀) allows at most two critical points there."""
    value, theta, (F, f, _, _) = psi()
    second = sp.diff(value, theta, 2)
    identity("Ψ_θθ falls from 0 at θ₀", second.subs(theta, sp.asin(2 * f / (F * sp.pi))))
    identity("Ψ_θθ", second, 2 * f - F * sp.pi * sp.sin(theta))
    return imprecise(
        "it allows at most one: Ψ_θ falls strictly where Ψ_θθ < 0. That one is π/2, so there is no "
        "other θ₁ on that interval",
        "Ψ_θθ = 2f - Fπ sin θ by sympy: 0 where sin θ = 2f/(Fπ), negative where sin θ is larger.",
    )


@claim("sec:periodic", Kind.CONSISTENCY, stated="a saddle-center at the universal f/F = 2/π")
def universal_value() -> Verdict:
    """Section 4 proves a saddle-center at the universal critical value f/F = 2/π."""
    with precisely():
        pi = interval.pi()
        value = 4 * (interval.ball(2 + PAPER_RHO) - pi) / pi**2
        need(bool(value < 2 / pi), "f_sc may be 2F/π")
    return refuted(
        "Section 4 does not: Theorem 4.8 has it at f_sc(F, ω, R) = 4(2F + Rω² - Fπ)/π², and Remark "
        "4.9 calls 2/π, as a universal value, an error of others. (Of orbits that exist the "
        "sentence is nearer to the truth than the theorem: see fold.colliding-orbits)",
        f"f_sc in {between(value, 6)} at the paper's parameters, in balls; 2/π in "
        f"{between(2 / pi, 6)}.",
    )


@claim("prop:two-solutions", Kind.STEP, stated="Ψ_θθ < 0 on (θ₀, π - θ₀), θ₀ = arcsin(2f/(Fπ))")
def inflection_points() -> Verdict:
    """Step 2: Ψ is concave on (θ₀, π - θ₀) with θ₀ = arcsin(2f/(Fπ)), convex outside."""
    value, theta, (F, f, _, _) = psi()
    at_end = sp.diff(value, theta, 2).subs(theta, sp.asin(2 * f / (F * sp.pi)))
    identity("Ψ_θθ(θ₀)", at_end)
    return confirmed("as stated", "Ψ_θθ = 2f - Fπ sin θ vanishes where sin θ = 2f/(Fπ).")


@claim("eq:fsc-formula", Kind.FORMULA, stated="f_sc = 4(2F + Rω² - Fπ)/π²")
def critical_value() -> Verdict:
    """Ψ(π/2; f) = 0 for f = f_sc = 4(2F + Rω² - Fπ)/π²."""
    value, theta, (F, f, R, w) = psi()
    found = sp.solve(value.subs(theta, sp.pi / 2), f)
    need(len(found) == 1, "there is not one such f")
    return formula(
        found[0],
        4 * (2 * F + R * w**2 - F * sp.pi) / sp.pi**2,
        "Solved by sympy. It is where two roots of eq:theta-eq meet; no orbits meet there.",
        "f_sc as stated",
    )


@claim("eq:param-range", Kind.INEQUALITY, stated="f_imp < Fπ/2")
def impulse_bound_below_half_pi() -> Verdict:
    """f_imp = 2F/π < Fπ/2."""
    with precisely():
        pi = interval.pi()
        need(2 / pi < pi / 2, "it is not")
    return confirmed("always: 4 < π²", "In balls.")


@claim("prop:two-solutions", Kind.THEOREM, stated="(i) none, (ii) one, (iii) two roots")
def number_of_roots() -> Verdict:
    """For 0 < f_sc < f_imp: no root for f < f_sc, π/2 alone at f_sc, two for f_sc < f < f_imp."""
    _evenness()
    value, theta, (F, f, R, w) = psi()
    middle = value.subs(theta, sp.pi / 2)
    identity("Ψ(π/2)", sp.diff(middle, f), sp.pi**2 / 4)
    end = value.subs(theta, 0)
    f_sc = 4 * (2 * F + R * w**2 - F * sp.pi) / sp.pi**2
    identity("Ψ(0) at f = 2F/π", end.subs(f, 2 * F / sp.pi), -(sp.pi**2) / 4 * f_sc)
    with precisely():
        counts = [len(Equation(Fraction(a), PAPER_RHO).roots()) for a in ("3/10", "2/5", "3/5")]
    need(counts == [0, 2, 2], "at the paper's R other numbers are found", counts=counts)
    return confirmed(
        "true, as a statement about the roots of an equation, none of which is an orbit "
        "(ansatz.bijection)",
        f"{MONOTONE}; Ψ(π/2) increases with f through 0 at f_sc, and Ψ(0) < -(π²/4) f_sc < 0. At R "
        "= 2 all roots counted in balls for f = 0.3, 0.4, 0.6: 0, 2, 2.",
    )


@claim("prop:two-solutions", Kind.INEQUALITY, stated="Ψ(0; f) < -(π²/4) f_sc < 0")
def value_at_zero() -> Verdict:
    """Item (iii): Ψ(0; f) < Fπ - 2F - Rω² = -(π²/4) f_sc for f < f_imp."""
    value, theta, (F, f, R, w) = psi()
    end = value.subs(theta, 0)
    identity("it increases with f", sp.diff(end, f), sp.pi**2 / 2)
    stated = F * sp.pi - 2 * F - R * w**2
    identity("its value at f_imp", end.subs(f, 2 * F / sp.pi), stated)
    identity("which is -(π²/4) f_sc", stated, -(2 * F + R * w**2 - F * sp.pi))
    return confirmed("as stated", "Ψ(0; f) increases with f; its value at 2F/π by sympy.")


@claim("rem:fsc-vs-fimp", Kind.INEQUALITY, stated="iff Rω² < F(π - 1) - Fπ/2 + Fπ²/4 ≈ 0.94F")
def gap_for_which_it_is_below() -> Verdict:
    """f_sc < f_imp is equivalent to Rω² < F(π - 1) - Fπ/2 + Fπ²/4 ≈ 0.94F."""
    F, gap = symbols("F gap")  # gap = Rω²
    bound = sp.solve(4 * (2 * F + gap - F * sp.pi) / sp.pi**2 - 2 * F / sp.pi, gap)[0]
    stated = sp.pi - 1 - sp.pi / 2 + sp.pi**2 / 4
    with precisely():
        value, claimed = enclosure(bound / F), enclosure(stated)
        need(claimed > 3 * Ball(1), "the stated expression is below 3F")
        need(value > PAPER_RHO.numerator, "the paper's R = 2 is outside")
        own = between(claimed, 4)
    return formula(
        bound / F,
        stated,
        f"Solved by sympy. The stated expression is {own}, not 0.94; and the paper's own R = 2 "
        "would violate 0.94.",
        f"Rω² < F(3π/2 - 2), a factor of F in {between(value, 4)}",
    )


@claim("rem:fsc-vs-fimp", Kind.THEOREM, stated="above f_imp no T-periodic non-sticking orbit")
def impulse_bound() -> Verdict:
    """For f > 2F/π no T-periodic non-sticking orbit exists, whatever its impacts."""
    t = sp.Symbol("t", real=True)
    gain = 4 * sp.integrate(sp.cos(t), (t, 0, sp.pi / 2))  # ∫ |cos| over a period
    identity("∫ |cos ωt| dt over T is 4/ω", gain, 4)
    F, f, w = symbols("F f omega")
    bound = sp.solve(4 * F / w - f * 2 * sp.pi / w, f)[0]
    identity("the bound", bound, 2 * F / sp.pi)
    return confirmed(
        "true, also for orbits that turn, and for periods nT; more: for f > 2F/π every orbit "
        "stops, again and again, and Ω_NS is empty",
        "u = |x'| is continuous through hits and turns, u' = sgn(x') F cos ωt - f: in each period "
        "u changes by at most 4F/ω - 2πf/ω < 0.",
        proof="periodic.md#the-impulse-bound",
    )


@claim("rem:fsc-numerical", Kind.NUMBER, stated="0.34790")
def value_of_f_sc() -> Verdict:
    """At F = ω = 1, R = 2 formula eq:fsc-formula gives f_sc ≈ 0.34790."""
    with precisely():
        value = enclosure((16 - 4 * sp.pi) / sp.pi**2)
        return number("0.34790", value, "(16 - 4π)/π² in balls. The number is right.")


@claim("rem:fsc-numerical", Kind.NUMBER, stated="0.63662")
def value_of_f_imp() -> Verdict:
    """At F = 1 the impulse bound is f_imp = 2/π ≈ 0.63662."""
    with precisely():
        return number("0.63662", 2 / interval.pi(), "2/π in balls.")


@claim("rem:fsc-numerical", Kind.THEOREM, stated="the branch exists for f in (0.34790, 0.63662)")
def branch_exists() -> Verdict:
    """The symmetric branch exists for f in (0.34790, 0.63662), which contains f = 0.4."""
    with precisely():
        equation = Equation(Fraction(2, 5), PAPER_RHO)
        found = [equation.bisected(root) for root in equation.roots()]
        need(len(found) == 2, "there are not two roots")
        need(all(abs(theta.cos()) < Fraction(2, 5).numerator / Ball(5) for theta in found), "turns")
        words = " and ".join(between(theta.cos(), 5) for theta in found)
    return refuted(
        "the two roots exist; no orbit belongs to them. At f = 0.4 even the paper's own condition "
        f"eq:transverse-cond fails, as cos θ is in {words}",
        "All roots at (F, ω, R, f) = (1, 1, 2, 2/5) in balls: |cos θ| < f/F.",
        proof="periodic.md#no-orbit-has-the-pattern",
    )


@claim("rem:transverse-regime", Kind.FORMULA, stated="|θ - π/2| < arccos(f/F) is excluded")
def excluded_neighbourhood() -> Verdict:
    """|cos θ| < f/F excludes the neighbourhood |θ - π/2| < arccos(f/F)."""
    ratio = symbols("ratio")
    identity("cos(π/2 - arcsin ρ) = ρ", sp.cos(sp.pi / 2 - sp.asin(ratio)), ratio)
    return formula(
        sp.asin(ratio),
        sp.acos(ratio),
        "|cos θ| < ρ iff |θ - π/2| < arcsin ρ. The regime (0, arccos(f/F)) ∪ (π - arccos(f/F), π) "
        "of the same remark is right, and contradicts it.",
        "|θ - π/2| < arcsin(f/F)",
    )


@claim("rem:transverse-regime", Kind.THEOREM, stated="the regime of non-sticking symmetric orbits")
def transverse_regime() -> Verdict:
    """The symmetric orbits live in θ in (0, arccos(f/F)) ∪ (π - arccos(f/F), π)."""
    ratio, a = symbols("ratio a")
    identity("cos(π - a) = -cos a", sp.cos(sp.pi - a), -sp.cos(a))
    need(same(sp.cos(sp.acos(ratio)), ratio), "cos arccos ρ is not ρ")
    return imprecise(
        "this is where |F cos θ| > f; turning right needs F cos θ > f, the first of the two "
        "intervals; and there too no root is an orbit",
        "See ansatz.transversality and ansatz.bijection.",
    )


@claim(
    "rem:gkr-saddle-correction", Kind.THEOREM, stated="the saddle-center value depends on R and ω"
)
def universality() -> Verdict:
    """The saddle-center value depends on R and ω through eq:fsc-formula, against the universal
    value f/F = 2/π.
    """
    S, rho = symbols("S rho")
    alpha = 2 / sp.pi * sp.sqrt(1 - S**2)
    value = sp.simplify(alpha.subs(S, 0))
    identity("the two symmetric orbits meet at S = 0", value, 2 / sp.pi)
    need(rho not in value.free_symbols, "the value depends on ρ")
    ratio = 2 / sp.pi  # their least speed at S = 0 is ρ/π less what is lost until its minimum
    lost = sp.sqrt(1 - ratio**2) - 1 + ratio * sp.asin(ratio)
    with precisely():
        gap = between(enclosure(sp.pi * lost), 5)
    claimed = stored("symmetric.json").claims["saddle_center"]
    with precisely():
        need(_inside(2 / interval.pi(), claimed), "the certificate disagrees")
    return refuted(
        "the two symmetric orbits with one hit of each wall meet at f/F = 2/π, for every gap for "
        f"which they do not stop, Rω²/F > c, c in {gap}: the universal value is right. f_sc is "
        "where roots that are no orbits meet",
        "In closed form (cap.one_one.closed_form): sin ωt₁ = πf/(2F), cos ωt₁ = ±S, S = 0 at "
        "f = 2F/π, where the least speed is positive for these gaps; certified at R = 2.",
        certificate="symmetric.json",
        proof="periodic.md#the-saddle-center-of-the-symmetric-orbits",
    )


@claim("rem:fsc-vs-fimp", Kind.CONSISTENCY, stated="impulse 2F/ω over a half-period, πf/ω needed")
def impulse_over_a_half_period() -> Verdict:
    """The largest forcing impulse over a half-period is 2F/ω, the least of friction πf/ω."""
    t, F, f, w = symbols("t F f omega")
    forcing = sp.integrate(F * sp.cos(w * t), (t, -sp.pi / (2 * w), sp.pi / (2 * w)))
    return formula(
        sp.simplify(forcing), 2 * F / w, f"Integrated by sympy; friction gives {f}π/ω.", "2F/ω"
    )
