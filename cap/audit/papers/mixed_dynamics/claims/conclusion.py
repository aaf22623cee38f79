"""Section 11: what the conclusion says beyond the sections that it sums up."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity, same, symbols
from cap.audit.means.balls import below, pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, refuted
from cap.parameters import PAPER


@claim("ssec:conclusion-summary", Kind.CONSISTENCY, stated="τ_(n+1) - τ_n >= 2(F - f)/(F + f)")
def bound_of_the_conclusion() -> Verdict:
    """The proof of Theorem 2.5 gives the lower bound 2(F - f)/(F + f) on times between events."""
    F, f, w, a, c = symbols("F f omega a c")
    stated, proof = 2 * (F - f) / (F + f), 2 * a / (F * w + f)
    faster = {F: F * c**2, f: f * c**2}  # time in units of 1/c: forces per mass grow by c²
    need(same(stated.subs(faster, simultaneous=True), stated), "it depends on the unit of time")
    need(not same(stated, proof), "the two bounds agree")
    return refuted(
        "a time cannot be bounded below by a number without a unit: the bound stays the same when "
        "time is measured in another unit. The proof has another one, 2a*/(Fω + f), and neither "
        "holds: hits of one wall may follow each other at once",
        "Change of the unit of time, by sympy; see wellposed.uniform-inter-event-time, and the row "
        "on the time between events.",
    )


@claim("ssec:conclusion-novelty", Kind.WORDS, stated="a smooth Hamiltonian system on a cover")
def smooth_lift() -> Verdict:
    """The lift is a smooth Hamiltonian system, to which the smooth KAM theorem applies directly."""
    margins = stored("elliptic.json").claims["hit_forcing"]  # |F cos ωt*| - f
    need(all(each.lower > 0 for each in margins), "the forcing may vanish")
    jumps = " and ".join(f"f + {below(each)}" for each in margins)
    return corrected(
        "the lifted field is discontinuous at every wall, by 2F cos ωt/R, and along P* it does "
        f"jump: |F cos ωt| at its hits is more than {jumps}. What is smooth, even analytic, is the "
        "return map Φ near P*, as a composition of flights and crossings; to this KAM applies",
        "The forcing at both hits, from the stored certificate; the jump is cover.jump-of-the-"
        "field; smoothness of Φ is smoothness.smooth-near-the-orbit.",
        certificate="elliptic.json",
    )


@claim("ssec:conclusion-novelty", Kind.FORMULA, stated="universal sqrt μ scaling")
def universal_scaling() -> Verdict:
    """Multipliers and rotation rate scale like the square root of the distance from the fold."""
    S, rho, nu = symbols("S rho nu")
    k = 2 * sp.pi**2 * S / (rho + 2 * S)
    depth = ((2 - k) ** 2 - 2).subs(S, sp.sqrt(1 - (1 - sp.pi * nu / 2) ** 2)) - 2
    leading = sp.limit(depth / sp.sqrt(nu), nu, 0, "+")
    identity("2 - trace", leading, -8 * sp.pi**2 * sp.sqrt(sp.pi) / rho)
    return corrected(
        "the fourth root: at the saddle-center of the symmetric orbits the trace differs from 2 by "
        "a multiple of the square root of the distance in f, so θ* and log λ go with its fourth "
        "root, as at every generic fold of an area-preserving map",
        "The trace in closed form, expanded by sympy; θ*² is 2 - trace to leading order.",
        proof="periodic.md#the-saddle-center-of-the-symmetric-orbits",
    )


@claim("ssec:open-asymmetric", Kind.WORDS, stated="r != -l breaks the symmetry Σ")
def asymmetric_walls() -> Verdict:
    """If r != -l the symmetry is broken, and the closed forms do not apply."""
    x, v, b, left, right = sp.symbols("x v b l r", real=True)
    mirror = left + right - x
    identity("the mirror exchanges the walls", mirror.subs(x, left), right)
    identity("and keeps the law of motion", -(b - v), -b + v)
    found = stored("symmetric-2.json")
    p = found.parameters
    need(p["r"] != -p["l"], "the walls are symmetric about 0")
    branches = found.claims["branches"]
    need(len(branches) > 0, "it has no orbits")
    return refuted(
        "a translation makes r = -l: nothing in the system depends on where the walls are, only on "
        "R = r - l. The symmetry is x -> l + r - x, t -> t + π/ω, for all walls; symmetric orbits "
        f"are certified for l = {p['l']}, r = {p['r']}",
        "Change of coordinates; the stored certificate. So the open problem is none.",
        certificate="symmetric-2.json",
    )


@claim("ssec:open-PWS-KAM", Kind.THEOREM, stated="a pitchfork at F_pf(μ_s, μ_k, e, L)")
def constant_force() -> Verdict:
    """With constant force and inelastic walls the primary bifurcation is a supercritical pitchfork
    at F_pf, with no saddle-center.
    """
    F, f, x, v, e, sign = symbols("F f x v e s")
    energy = v**2 / 2 - F * x
    rate = sp.diff(energy, x) * v + sp.diff(energy, v) * (F - f * sign)
    identity("the rate of v²/2 - Fx on a flight, s = sgn v", rate, -f * sign * v)
    lost = energy - energy.subs(v, -e * v)
    identity("what a hit takes of it", lost, (1 - e**2) * v**2 / 2)
    return refuted(
        "x'' = F - f sgn(x') with walls of restitution e < 1 has no periodic orbit but rest, so no "
        "pitchfork of any: v²/2 - Fx falls at the rate f|v| on flights, and at hits. (μ_s, μ_k and "
        "L, which F_pf is to depend on, are not defined; friction has one coefficient here)",
        "The rate and the loss by sympy; along a periodic orbit that moves it would fall for ever.",
    )


@claim("ssec:open-engineering", Kind.WORDS, stated="attraction of all initial conditions")
def attraction_of_all() -> Verdict:
    """A restitution defect that is large enough by eq:persist-eigenvalues makes all initial
    conditions tend to one attractor.
    """
    area = stored("segment.json").claims["basin_area"]
    need(area.lower > 0, "the set may have no area")
    return refuted(
        "the formula is about multipliers at one orbit. An open set of states, of an area in "
        f"{pair(area, 6)} at t = 0, tends to orbits that touch no wall, whatever the walls' "
        "restitution is",
        "The stored certificate: none of these orbits comes to a wall.",
        certificate="segment.json",
    )


@claim("ssec:open-engineering", Kind.WORDS, stated="no energy dissipation in the islands")
def energy_in_the_islands() -> Verdict:
    """Initial conditions in the Hamiltonian region produce no energy dissipation."""
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    hits = len(claims["hit_times"])
    work = PAPER.f * PAPER.R * hits
    need(work > 0, "friction does no work")
    return refuted(
        f"along P* friction takes the energy f · {hits}R = {work} in each period, exactly, which "
        "the forcing returns: the mass crosses the gap once after each hit, and never stops. "
        "Preserved is area in the plane of states, not energy",
        "The path between hits, from the stored certificate.",
        certificate="elliptic.json",
    )


@claim("ssec:open-engineering", Kind.WORDS, stated="saddles and A, B give a rigorous horseshoe")
def program_for_the_horseshoe() -> Verdict:
    """Enclosures of the saddle branch and of the coefficients A, B would give a horseshoe."""
    found = stored("homoclinic.json")
    need(found.parameters["f"] == Fraction(2, 5), "other parameters")
    need(found.claims["least_speed"].lower > 0, "the saddle may stop")
    need(len(found.claims["points"]) > 0, "there is no homoclinic point")
    return corrected(
        "A and B are no quantities of this system (melnikov.amplitudes, "
        "slow.equilibria-do-not-collide). A horseshoe needs a transverse intersection of the "
        "invariant curves of a saddle, enclosed: that is done; it gives no value of the entropy",
        "Stored certificate of a saddle with transverse homoclinic points.",
        certificate="homoclinic.json",
    )


@claim("ssec:outlook", Kind.WORDS, stated="only the twist is left for a rigorous enclosure")
def what_is_left() -> Verdict:
    """The KAM hypotheses are certified at one point but for the twist."""
    claims = stored("elliptic.json").claims
    need(claims["twist"].lower > 0, "the twist may vanish")
    return confirmed(
        f"and the twist is certified now, τ₁ in {pair(claims['twist'], 10)}; along the branch of "
        "this orbit it has certified zeros at isolated f (branch.json)",
        "The stored certificate.",
        certificate="elliptic.json",
    )
