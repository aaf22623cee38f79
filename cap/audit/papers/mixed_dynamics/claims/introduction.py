"""Claims of the introduction that are not only summaries of what follows."""

import math
from fractions import Fraction

from cap.audit import labels
from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, enclosure, identity, same, symbols
from cap.audit.means.balls import between, pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.orbits import at
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.checker.kernel.shapes import Enclosure
from cap.proofs.census import census
from cap.sets import interval


@claim("sec:intro", Kind.FORMULA, stated="impulse -f |x'| dt")
def friction_impulse() -> Verdict:
    """The friction term -f sgn(x') delivers the impulse -f |x'| dt when the body is moving."""
    f, v = symbols("f v")
    impulse = -f * sp.sign(v)  # per time
    work = sp.simplify(impulse * v)  # per time
    need(same(work, -f * v), "friction does not work at the rate -f |x'|")
    need(differs(impulse, work), "impulse and work may be the same")
    return corrected(
        "impulse -f sgn(x') dt; -f |x'| dt is the work",
        "Force times dt against force times velocity times dt.",
    )


@claim("sec:intro", Kind.STEP, stated="kinetic energy is conserved at a wall")
def walls_conserve_energy() -> Verdict:
    """The reflection x' -> -x' at a wall conserves kinetic energy."""
    v = sp.Symbol("v", real=True)
    identity("v²/2 is even", (-v) ** 2 / 2, v**2 / 2)
    return confirmed("v²/2 is even in v", "Symbolic identity.")


@claim("eq:Fgreaterf", Kind.THEOREM, stated="F <= f implies permanent rest")
def without_enough_forcing() -> Verdict:
    """Without F > f every trajectory comes to permanent rest."""
    t = sp.Symbol("t", real=True)
    loss = sp.integrate(1 - sp.cos(t), (t, -sp.pi / 2, sp.pi / 2)) + sp.integrate(
        1 + sp.cos(t), (t, sp.pi / 2, 3 * sp.pi / 2)
    )
    need(same(loss, 2 * sp.pi - 4), "the least loss of speed in a period is not 2π - 4")
    with interval.workprec(60):
        need(enclosure(loss) > 0, "the least loss of speed in a period is not positive")
    return confirmed(
        "at F = f the speed falls by at least (F/ω)(2π - 4) in each period, whatever the hits",
        "u' = s F cos ωt - f <= F (|cos ωt| - 1) for u = |x'|, of either sign s; the integral over "
        "a period is enclosed. A mass at rest stays, as |F cos ωt| <= f.",
        proof="setup.md#rest-without-forcing",
    )


@claim("ssec:intro-mixed", Kind.THEOREM, stated="the orbits of Eq. (7) have turning points")
def orbits_of_equation_seven_turn() -> Verdict:
    """The closed-form orbits with sin ωτ = πf/(2F), which the paper ascribes to Eq. (7) of
    GKR2019, have turning points, lie in the dissipative subset, and carry no islands.
    """
    plus = next(m for m in census(Fraction(1, 2), Fraction(2)) if m.name == "plus")
    need(plus.least_speed > 0, "the orbit may stop")
    need(plus.kind == "elliptic", "the orbit is not elliptic")
    return refuted(
        "the T-periodic orbit that hits the right wall at sin ωt₁ = πf/(2F) never stops; at "
        f"(F, ω, R, f) = (1, 1, 2, 1/2) its least speed is in {between(plus.least_speed, 6)}, and "
        f"it is elliptic, with a trace in {between(plus.trace, 6)}",
        "cap.proofs.census, in balls. What GKR2019 prints was not at hand: this is about the "
        "relation as the paper quotes it.",
    )


@claim("ssec:intro-mixed", Kind.CONSISTENCY, stated="Main Theorem thm:lift")
def lift_is_called_a_theorem() -> Verdict:
    """The lift is one of the main theorems."""
    place = labels.stored().place("thm:lift")
    if place.kind == "theorem":
        return confirmed(f"Theorem {place.number}", "The labels of the TeX file.")
    return imprecise(
        f"it is {place.kind.capitalize()} {place.number} of the text", "The labels of the TeX file."
    )


@claim("ssec:intro-mixed", Kind.FORMULA, stated="remainder O((f - f_sc)^(3/2))")
def remainder_of_the_normal_form() -> Verdict:
    """The local normal form of the roots holds up to O((f - f_sc)^(3/2)); Theorem 4.8 has O(μ²)."""
    F, f, y, theta = symbols("F f y theta")
    # Ψ is even in θ - π/2, hence analytic in y = (θ - π/2)² and f, with ∂Ψ/∂y != 0.
    shift = sp.Symbol("s", real=True)
    psi = F * sp.pi * sp.sin(theta) + f * sp.pi**2 / 2 - f * theta * (sp.pi - theta)
    at_shift = psi.subs(theta, sp.pi / 2 + shift)
    identity("Ψ is even about π/2", at_shift, at_shift.subs(shift, -shift))
    slope = sp.limit(sp.diff(at_shift, shift) / (2 * shift), shift, 0)
    need(same(slope, f - F * sp.pi / 2), "the derivative by y is not f - Fπ/2")
    return corrected(
        "O((f - f_sc)²): (θ - π/2)² is an analytic function of f near f_sc",
        "Ψ depends analytically on y = (θ - π/2)² and f, and ∂Ψ/∂y = f - Fπ/2 < 0 at y = 0 for "
        f"f < 2F/π; implicit function theorem for {y}. The theorem is right, the summary weaker.",
    )


@claim("ssec:intro-mixed", Kind.THEOREM, stated="verified at (1, 1, 2, 0.4)")
def an_elliptic_orbit_exists() -> Verdict:
    """At (F, ω, R, f) = (1, 1, 2, 0.4) there is an elliptic T-periodic orbit in Ω_NS."""
    found = stored("elliptic.json")
    claims, p = found.claims, found.parameters
    right = (p["F"], p["omega"], p["f"], p["r"] - p["l"]) == (1, 1, Fraction(2, 5), 2)
    need(right, "the certificate is about other parameters")
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    return confirmed(
        f"x* in {pair(claims['x'], 12)}, v* in {pair(claims['v'], 12)}, least speed in "
        f"{pair(claims['least_speed'], 6)}",
        "The stored certificate, checked now.",
        certificate="elliptic.json",
    )


@claim("ssec:intro-mixed", Kind.THEOREM, stated="islands and dissipative attractors coexist")
def coexistence() -> Verdict:
    """Stability islands of Hamiltonian type and dissipative attractors coexist in the same phase
    space at the same parameter values.
    """
    island, shares, never = (stored(f"{name}.json") for name in ("island", "mixed", "conservative"))
    need(
        all(at_the_paper(each) for each in (island, shares, never)), "they are at other parameters"
    )
    part, V = shares.claims["shares"], shares.claims["box"]["v"].upper
    need(island.claims["disks"] == 2, "the disk and its image may be one")
    inside = math.floor(2 * island.claims["area"].lower * 10**5) / 10**5
    need(part["attractor"].lower > 0 and part["segment"].lower > 0, "a share may be zero")
    area = math.ceil(never.claims["area"] * 1000) / 1000
    names = "attractor", "segment", "either", "stops"
    attracted, settled, both, stopping = (least(part[name]) for name in names)
    return confirmed(
        f"true at the paper's parameters, with shares: of the states |v| < {float(V):g} at t = 0 "
        f"at least {attracted} of the area tend to one chaotic set (or its mirror image), at least "
        f"{settled} to T-periodic orbits that touch no wall, at least {both} to one or the other; "
        f"at least {stopping} stop at least once, these included. From two invariant "
        f"disks, around P* and its mirror image, of the area {inside:g} together, the velocity "
        f"never vanishes; all such states have, in the whole plane, at most the area {area:g}",
        "The stored certificates; the disks: island.json. Never stopping: "
        "conservative.json. To check this one and mixed.json takes minutes: they were accepted "
        "when the verdicts were recorded, and cap.verify checks them. What is left of the area is "
        "undecided.",
        certificate="mixed.json",
    )


def least(share: Enclosure) -> str:
    """Return a lower bound in per cent, rounded down."""
    return f"{math.floor(share.lower * 1000) / 10:g} %"


@claim("ssec:intro-mixed", Kind.WORDS, stated="one transformation removes both discontinuities")
def lift_removes_both_discontinuities() -> Verdict:
    """A single coordinate transformation removes both discontinuities at once, and lifts the
    system to a smooth Hamiltonian system.
    """
    F, R, f, c = symbols("F R f c")
    jump = (-F * c / R - f / R) - (F * c / R - f / R)
    need(same(jump, -2 * F * c / R), "the jump is not -2F cos ωt/R")
    need(differs(jump, sp.Integer(0)), "there may be no jump")
    return corrected(
        "velocities become continuous and friction constant; the field still jumps, by "
        "2F |cos ωt|/R, at every integer q: piecewise smooth, with transverse crossings",
        "One-sided limits of F/R cos ωt W'(q) - f/R at an integer. The paper itself reads the "
        "lifted equations in the sense of Filippov there.",
    )


@claim("ssec:intro-mixed", Kind.WORDS, stated="R is the universal cover of [l, r]")
def universal_cover() -> Verdict:
    """π: R -> [l, r] is the universal covering of [l, r] = R/(dihedral group)."""
    h = symbols("h")  # 0 < h < 1
    left, right = 1 - h, 2 - (1 + h)  # W on both sides of 1
    identity("W is even about 1", left, right)
    return imprecise(
        "[l, r] is the orbifold R/D_∞, and π folds at every integer: no covering map there, "
        "and an interval is its own universal cover",
        "W(1 - h) = W(1 + h): π is not injective near an integer. The quotient by the group "
        "generated by q -> -q and q -> 2 - q is as the paper says.",
    )


@claim("ssec:intro-mixed", Kind.STEP, stated="the propagator is a C^∞ map of the data")
def propagator_is_smooth() -> Verdict:
    """On each branch the propagator is a C^∞ map of the initial data."""
    x0, v0, t, t0 = sp.symbols("x0 v0 t t0", real=True)
    F, f, w = symbols("F f omega")
    v = v0 + F / w * (sp.sin(w * t) - sp.sin(w * t0)) - f * (t - t0)
    x = x0 + sp.integrate(v, (t, t0, t))
    second = [sp.diff(g, a, b) for g in (x, v) for a in (x0, v0) for b in (x0, v0)]
    need(all(each == 0 for each in second), "the propagator is not affine")
    return confirmed(
        "it is affine in (x₀, v₀), with the linear part ((1, t - t₀), (0, 1))",
        "The flight integrated by sympy; all second derivatives vanish.",
    )


@claim("ssec:intro-mixed", Kind.STEP, stated="unaffected to leading order")
def off_diagonal_saltation_entries() -> Verdict:
    """Restitution and viscosity leave the off-diagonal saltation entries unaffected to leading
    order.
    """
    F, f, v, c, eps = symbols("F f v c epsilon")
    entry = ((2 - eps) * F * c + eps * f) / v
    slope = sp.simplify(sp.diff(entry, eps))
    need(same(slope, (f - F * c) / v), "the derivative by ε is not (f - F cos ωt)/v")
    need(differs(slope, sp.Integer(0)), "the derivative by ε may vanish")
    return imprecise(
        "the entry at the right wall is ((2 - ε) F cos ωt + ε f)/v: it changes by "
        "ε (f - F cos ωt)/v, to first order; only the determinant needs it not",
        "Differentiated by ε at fixed t and v. For its sign see persistence.",
    )


@claim("ssec:intro-related", Kind.THEOREM, stated="reversible only at f = 0")
def reversible_only_without_friction() -> Verdict:
    """The system is reversible only at f = 0."""
    t, v, F, f, w = sp.symbols("t v F f omega", real=True)
    field = F * sp.cos(w * t) - f * sp.sign(v)
    reversed_field = field.subs({t: -t, v: -v}, simultaneous=True)  # (x, v, t) -> (x, -v, -t)
    identity("without friction the field is reversible", (reversed_field - field).subs(f, 0))
    capture = stored("capture.json").claims
    box = capture["box"]
    need(box["x"].lower < box["x"].upper, "the box has no interior")
    need(box["v"].lower < box["v"].upper, "the box has no interior")
    return confirmed(
        "at f = 0 (x, v, t) -> (x, -v, -t) reverses it; at f = 2/5 all states of an open box come "
        "to rest at the right wall, and move on together: Φ is not injective there, so no "
        "involution conjugates it to an inverse",
        "Symbolic identity for f = 0; the certified capture at f = 2/5, and the lemma of capture "
        "for every other f < F.",
        certificate="capture.json",
        proof="setup.md#captures-for-every-friction",
    )


@claim("abstract", Kind.THEOREM, stated="any positive restitution defect or viscous damping")
def any_damping() -> Verdict:
    """With any positive restitution defect or viscous damping elliptic periodic orbits persist."""
    p = at()
    with interval.workprec(80):
        F, w, f, R = (interval.ball(q) for q in (p.F, p.omega, p.f, p.R))
        period = 2 * interval.pi() / w
        largest = (4 * F / w - f * period) / (2 * R)
        need(largest < 1, "there may be an orbit at μ = 1", largest=largest)
    return refuted(
        "for small ones only: for μ > (4F/ω - fT)/(2R), which is "
        f"in {between(largest, 5)} at the paper's parameters, no T-periodic orbit exists whose "
        "velocity never vanishes",
        "Over a period a never-stopping orbit gains at most 4F/ω from the forcing, and loses fT to "
        "friction and μ times its path, at least 2R.",
        proof="persistence.md#no-orbit-at-large-viscosity",
    )


@claim("abstract", Kind.THEOREM, stated="a single attracting basin")
def single_basin() -> Verdict:
    """The Hamiltonian islands are replaced by a single attracting basin."""
    first, second = (stored(name).claims["box"] for name in ("elliptic.json", "elliptic-2.json"))
    apart = first["v"].upper < second["v"].lower or second["v"].upper < first["v"].lower
    need(apart, "the two elliptic orbits may be the same")
    plain, lossy = (stored(name) for name in ("segment.json", "segment-2.json"))
    need(plain.claims["basin_area"].lower > 0 < lossy.claims["basin_area"].lower, "no open set")
    e, mu = (lossy.parameters[name] for name in ("e", "mu"))
    need(e < 1 and mu > 0, "it has no losses")
    return refuted(
        "at the paper's parameters there are two islands, around two elliptic orbits, and both "
        "centres become sinks for small ε and μ (Theorem 8.2): at least two basins. And an open "
        "set of states tends to T-periodic orbits that touch no wall: at the paper's parameters, "
        f"whatever ε, of the area {pair(plain.claims['basin_area'], 5)}; at f = "
        f"{lossy.parameters['f']}, ε = {1 - e}, μ = {mu} of the area "
        f"{pair(lossy.claims['basin_area'], 5)}",
        "Two different elliptic orbits that never stop, by certificates. An explicit range for the "
        "one is certified (persistence.asymptotic-stability), for the other it is the same by the "
        "symmetry (x, v, t) -> (-x, -v, t + T/2), which inelastic walls and viscosity keep. The "
        "open sets: segment.json and segment-2.json; without a hit ε does not matter.",
        certificate="segment-2.json",
    )
