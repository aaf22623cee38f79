"""Section 10.5: the fixed point of Theorem 10.1, Krawczyk's operator, and what follows."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity
from cap.audit.means.balls import pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, refuted
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix

BITS = 120
CENTRE = Fraction("0.1002798898"), Fraction("0.5419433068")
RADIUS = Fraction(1, 10**9)


def orbits(centre: tuple[Fraction, Fraction], radius: Fraction) -> tuple[Box, Matrix[Ball]]:
    """Return Φ and Φ' on a box."""
    x, v = (interval.around(q, radius) for q in centre)
    image = after_periods(PAPER, x, v, 1)
    return image.state, image.monodromy


@claim("sec:numerics", Kind.THEOREM, stated="(H1) to (H5) of Theorem 5.6 are verified")
def hypotheses_at_the_point() -> Verdict:
    """At (F, ω, R, f) = (1, 1, 2, 0.4) the hypotheses (H1) to (H5) of Theorem 5.6 hold."""
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    hits = claims["hit_forcing"]
    need(all(each.lower > 0 for each in hits), "(H1) fails at a hit")  # |F cos ωt*| - f
    need(-2 < claims["trace"].lower <= claims["trace"].upper < 2, "it is not elliptic")
    near = claims["resonance_distances"]
    need(all(each.lower > 0 for each in near.values()), "a resonance")
    return confirmed(
        f"they hold, and (H6) too: τ₁ in {pair(claims['twist'], 6)}",
        "The stored certificate: never-stopping, |F cos ωt*| > f at both hits, |tr Φ'| < 2, "
        "distances of the rotation number from 0, 1/4, 1/3, 1/2.",
        certificate="elliptic.json",
    )


@claim("eq:Krawczyk", Kind.FORMULA, stated="z̄ - C G(z̄) + (1 - C G'([z]))([z] - z̄)")
def krawczyk_operator() -> Verdict:
    """For z in [z], the point z - C G(z) is in K([z])."""
    names = "c11 c12 c21 c22 m11 m12 m21 m22 g1 g2 d1 d2"
    q = sp.symbols(names, real=True)
    C, M = sp.Matrix(2, 2, q[:4]), sp.Matrix(2, 2, q[4:8])
    G, d = sp.Matrix(q[8:10]), sp.Matrix(q[10:])
    difference = (d - C * (G + M * d)) - (-C * G + (sp.eye(2) - C * M) * d)
    identity("z - C G(z) = z̄ - C G(z̄) + (1 - C M)(z - z̄)", difference, sp.zeros(2, 1))
    return confirmed(
        "as stated: G(z) = G(z̄) + M (z - z̄) with M in an enclosure of G' on [z]",
        "Mean value theorem, row by row; the identity by sympy.",
    )


@claim("eq:Krawczyk", Kind.THEOREM, stated="Newton iteration from any point of [z] converges")
def newton_from_any_point() -> Verdict:
    """If K([z]) is in the interior of [z], G has one zero in [z], and Newton iteration from any
    point of [z] converges to it.
    """
    # G(z) = z - (9/10) z¹¹/11 on [-1, 1], z̄ = 0, C = 1: G' = 1 - (9/10) z¹⁰ is in [1/10, 1].
    slope = Fraction(1, 10), Fraction(1)
    reach = max(abs(1 - each) for each in slope)
    need(reach < 1, "K([z]) is not in the interior of [z]")
    after = 1 - (1 - Fraction(9, 110)) / slope[0]  # one step from z = 1
    need(after < -8, "the step stays near", after=after)
    for _ in range(60):  # G > 0, and it is convex, below its zero near -1.28: a monotone sequence
        value = after - Fraction(9, 110) * after**11
        need(value > 0 and after < Fraction(-12, 10), "the iterates come back", at=float(after))
        after = Fraction(round((after - value / (1 - Fraction(9, 10) * after**10)) * 2**60), 2**60)
    return corrected(
        "existence and uniqueness: yes. What converges from every point of [z] is z -> z - C G(z), "
        "which maps [z] into K([z]); Newton's own iteration need not: for G = z - 9z¹¹/110 on "
        "[-1, 1] with C = 1, K([z]) = [-9/10, 9/10], and Newton's method leads from z = 1 to "
        f"-{Fraction(90, 11)} and on to another zero near {float(after):.3f}",
        "A counterexample with rational numbers; below its outer zero G is positive and convex, so "
        "Newton's method is monotone there.",
    )


@claim("thm:CAP-elliptic", Kind.THEOREM, stated="a unique elliptic fixed point in the box")
def elliptic_fixed_point() -> Verdict:
    """Φ has a unique fixed point in the box of radius 10⁻⁹ around (0.1002798898, 0.5419433068); it
    is elliptic and never stops.
    """
    claims = stored("elliptic.json").claims
    for name, centre in zip("xv", CENTRE, strict=True):
        at, box = claims[name], claims["box"][name]
        need(centre - RADIUS < at.lower <= at.upper < centre + RADIUS, "it is not in the box")
        need(box.lower < centre - RADIUS and centre + RADIUS < box.upper, "the box is larger")
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    need(-2 < claims["trace"].lower <= claims["trace"].upper < 2, "it is not elliptic")
    return confirmed(
        f"x* in {pair(claims['x'], 15)}, v* in {pair(claims['v'], 15)}; and unique in a box about "
        f"{int((claims['box']['x'].upper - claims['box']['x'].lower) / (2 * RADIUS)):,} times as "
        "wide",
        "The stored certificate, which the checker accepts.",
        certificate="elliptic.json",
    )


@claim("ssec:num-orbit", Kind.THEOREM, stated="a unique non-sticking fixed point")
def number_of_fixed_points() -> Verdict:
    """At f = 0.4 the map Φ has a unique non-sticking fixed point."""
    claims = stored("inventory.json").claims
    points, segment = claims["fixed_points"], stored("segment.json").claims
    need(claims["undecided"]["boxes"] == 0, "the inventory is not complete")
    need(claims["families"] == ["segment"], "no family of orbits that turn is named")
    elliptic = [each for each in points if -2 < each["trace"].lower <= each["trace"].upper < 2]
    places = ", ".join(f"({pair(each['x'], 5)}, {pair(each['v'], 5)})" for each in points)
    return refuted(
        f"exactly {len(points)} have a velocity that never vanishes, {len(elliptic)} of them "
        f"elliptic: {places}; and those that touch no wall, and turn without sticking, are a whole "
        f"segment, with v in {pair(segment['v'], 5)} and one for each x between "
        f"{pair(segment['left'], 5)} and {pair(segment['right'], 5)}",
        "The stored inventory, which the checker accepts: orbits with one hit of each wall in "
        "closed form, all launches of orbits with more hits in boxes.",
        certificate="inventory.json",
    )


@claim("ssec:num-cap", Kind.NUMBER, stated="K([z]) in int([z]) with margin ≈ 10⁻¹³")
def margin_of_the_inclusion() -> Verdict:
    """The inclusion of K([z]) in the interior of [z] holds with a margin of about 10⁻¹³ in each
    component.
    """
    with interval.workprec(BITS):
        image, ((a, b), (c, d)) = orbits(CENTRE, Fraction(0))
        defect = [q - interval.ball(each) for q, each in zip(image, CENTRE, strict=True)]
        (p, q), (r, s) = matrix.inverse(((a - 1, b), (c, d - 1)))
        point = interval.point
        C = (point(p), point(q)), (point(r), point(s))
        (a, b), (c, d) = orbits(CENTRE, RADIUS)[1]
        product = matrix.product(C, ((a - 1, b), (c, d - 1)))
        rest = [[abs((i == j) - product[i][j]) for j in (0, 1)] for i in (0, 1)]
        shift = matrix.apply(C, (defect[0], defect[1]))
        radius = interval.ball(RADIUS)
        reach = [abs(shift[i]) + radius * (rest[i][0] + rest[i][1]) for i in (0, 1)]
        need(all(each < radius for each in reach), "K([z]) may leave [z]")
        margins = [radius - interval.upper(each) for each in reach]
        need(all(each > radius * 9 / 10 for each in margins), "the margin is smaller")
    return corrected(
        "the inclusion holds, and its margin is more than 9·10⁻¹⁰, nine tenths of the radius of "
        "[z]; 10⁻¹³ is the size of the residual",
        "K([z]) for the box of Theorem 10.1, in balls.",
    )


@claim("thm:CAP-KAM", Kind.THEOREM, stated="if τ₁ != 0, the conclusion of Theorem 5.6 holds")
def kam_at_the_point() -> Verdict:
    """If the twist is not zero, invariant curves surround P* at the paper's parameters."""
    claims = stored("elliptic.json").claims
    twist = claims["twist"]
    need(twist.lower > 0, "the twist may vanish")
    return corrected(
        f"the condition can be dropped: τ₁ in {pair(twist, 8)}. Invariant curves of density one "
        "surround P*, one of them explicit (strobe.never-stopping-orbits-exist); the rate "
        "O(δ^(5/2)) for the complement is open (kam.measure-estimate)",
        "The stored certificate, and Moser's twist theorem, which it cites with its hypotheses.",
        certificate="elliptic.json",
    )


@claim("rem:CAP-twist-feasibility", Kind.WORDS, stated="a rigorous twist is feasible")
def twist_is_feasible() -> Verdict:
    """A rigorous enclosure of τ₁ by automatic differentiation is feasible."""
    claims = stored("elliptic.json").claims
    order = max(sum(map(int, key.split(","))) for key in claims["taylor"]["x"])
    need(order >= 3, "the Taylor coefficients are of lower order")
    need(claims["twist"].lower > 0, "the twist may vanish")
    return confirmed(
        f"it is done: τ₁ in {pair(claims['twist'], 12)}, from Taylor coefficients of order three "
        f"(the certificate has those up to order {order})",
        "The stored certificate.",
        certificate="elliptic.json",
    )
