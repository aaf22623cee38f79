"""Corollary 3.4: the factors of Φ', its determinant, and where |det Φ'| < 1."""

from typing import Any

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, formula, identity, reals, same, symbols
from cap.audit.means.balls import between
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.linear import Event, derivative
from cap.audit.means.need import need
from cap.audit.means.orbits import Followed, States, at, hits_only
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, refuted
from cap.sets import interval
from cap.sets.interval import Ball

LATER = States("-0.39", "0.53", "0.001")  # hits only in the first period, a stop in the second


def hit(side: int, restitution: Any = 1) -> tuple[Any, Any, Any, Any]:
    """Return the derivative of a hit of r (1) or l (-1), with the symbols u = |v|, c, f."""
    u, f = symbols("u f")
    c = sp.Symbol("c", real=True)
    v = side * u
    event = Event(v, c - f * side, -restitution * v, c + f * side)
    return derivative(event, True, restitution), u, c, f


@claim("cor:det-Phi", Kind.FORMULA, stated="((1, Δt), (0, 1)), determinant 1")
def free_flight() -> Verdict:
    """The fundamental matrix of a free flight of duration Δt is ((1, Δt), (0, 1))."""
    x0, v0, d = reals("x0 v0 d")
    gain = sp.Function("gain")(d)  # of velocity, by forcing and friction: no state in it
    v = v0 + sp.diff(gain, d)
    x = x0 + v0 * d + gain
    identity("x' = v", sp.diff(x, d), v)
    M = sp.Matrix([[sp.diff(z, y) for y in (x0, v0)] for z in (x, v)])
    need(same(M, sp.Matrix([[1, d], [0, 1]])), "the fundamental matrix is another")
    return confirmed(
        "as stated", "The force does not depend on the state; differentiated by sympy."
    )


@claim("cor:det-Phi", Kind.FORMULA, stated="α = -2F cos ωt*/v₋")
def wall_entry() -> Verdict:
    """The saltation matrix of a hit of the right wall is ((-1, 0), (α, -1)), α = -2F cos ωt*/v₋."""
    M, u, c, f = hit(1)
    before, after, n = sp.Matrix([u, c - f]), sp.Matrix([-u, c + f]), sp.Matrix([[1, 0]])
    H = sp.diag(1, -1)
    need(same(H + (after - H * before) * n / u, M), "the saltation formula gives another matrix")
    need(same(M[0, :], sp.Matrix([[-1, 0]])) and same(M[1, 1], sp.Integer(-1)), "another matrix")
    return formula(
        M[1, 0],
        -2 * c / u,
        "Two neighbouring orbits at a hit, from first principles (cap.audit.means.linear); the "
        "paper's own formula H + (g₊ - H g₋)nᵀ/(nᵀg₋) gives the same. Section 10 of the paper has "
        "this sign.",
        "α = +2F cos ωt*/v₋",
    )


@claim("cor:det-Phi", Kind.FORMULA, stated="α with |v₋| in the denominator at the left wall")
def left_wall_entry() -> Verdict:
    """At the left wall the same holds with |v₋| in the denominator."""
    M, u, c, _ = hit(-1)
    return formula(
        M[1, 0],
        -2 * c / u,
        "From first principles, v₋ = -u. With |v₋| the sign would have to be the other one: by "
        "chance the stated -2F cos ωt*/|v₋| is right at the left wall.",
        "2F cos ωt*/v₋ with the signed velocity v₋ < 0, that is -2F cos ωt*/|v₋|",
    )


@claim("cor:det-Phi", Kind.FORMULA, stated="det M_wall = 1")
def wall_determinant() -> Verdict:
    """The saltation matrix of an elastic hit has determinant 1."""
    for side in (1, -1):
        need(same(hit(side)[0].det(), sp.Integer(1)), "the determinant is another")
    return confirmed("1, at both walls", "From first principles.")


@claim("eq:saltation-turn", Kind.FORMULA, stated="diag(1, (F cos ωt̃ - f)/(F cos ωt̃ + f))")
def turning_matrix() -> Verdict:
    """The saltation matrix of a turning point with F cos ωt̃ > f is
    diag(1, (F cos ωt̃ - f)/(F cos ωt̃ + f)).
    """
    f, a = symbols("f a")
    c = f + a
    M = derivative(Event(sp.Integer(0), c + f, sp.Integer(0), c - f), False)
    need(same(M, sp.diag(1, (c - f) / (c + f))), "the matrix is another")
    return confirmed("as stated", "Two neighbouring orbits, from first principles.")


@claim("cor:det-Phi", Kind.FORMULA, stated="(-F cos ωt̃ - f)/(-F cos ωt̃ + f)")
def turning_to_the_left() -> Verdict:
    """For F cos ωt̃ < -f the factor is (-F cos ωt̃ - f)/(-F cos ωt̃ + f), in (0, 1)."""
    f, a = symbols("f a")
    c = -(f + a)
    M = derivative(Event(sp.Integer(0), c - f, sp.Integer(0), c + f), False)
    factor = a / (a + 2 * f)
    need(same(M, sp.diag(1, (-c - f) / (-c + f))), "the matrix is another")
    identity("the factor", (-c - f) / (-c + f), factor)
    need(
        factor.is_positive is True and sp.simplify(1 - factor).is_positive is True, "not in (0, 1)"
    )
    return confirmed(
        "as stated", "From first principles; with a = |F cos ωt̃| - f it is a/(a + 2f)."
    )


@claim("cor:det-Phi", Kind.STEP, stated="rank one, determinant 0")
def sticking_matrix() -> Verdict:
    """The onset of sticking collapses the velocity: rank one, determinant 0; the exit time does not
    depend on the velocity.
    """
    a, f = symbols("a f")
    M = derivative(Event(sp.Integer(0), -a - f, sp.Integer(0), sp.Integer(0)), False)
    need(same(M, sp.diag(1, 0)), "the matrix is another")
    return confirmed(
        "diag(1, 0): position is kept, velocity lost; the rest ends at a phase fixed by f/F",
        "From first principles with the acceleration 0 after the event.",
    )


@claim("cor:det-Phi", Kind.FORMULA, stated="product over turns, or 0 with a stick")
def determinant_of_a_period() -> Verdict:
    """|det Φ'| is the product of (|F cos ωt̃| - f)/(|F cos ωt̃| + f) over the turns of [0, T], and
    0 if there is a rest.
    """
    p = at(F="3")
    orbits = States("0.4064", "-0.6708", "1e-12").follow(1, p)
    with interval.workprec(100):
        (a, b), (c, d) = orbits.monodromy
        product = _turning_product(orbits, 3)
        need((a * d - b * c - product).contains(0), "the product differs")
        need(abs(product) < 1, "the product is not below 1")
        words = between(product, 8)
    captured = stored("capture.json").claims["itinerary"]
    need("capture r" in captured, "there is no capture")
    return corrected(
        "true, and 0 too if a wall captures the mass, after infinitely many turns and perhaps no "
        "rest in the interior",
        f"Product of the factors above. At F = 3 the focus (0.4064, -0.6708) has {words}, and its "
        "Φ', followed in balls, a determinant that overlaps it.",
        certificate="capture.json",
    )


def _turning_product(orbits: Followed, F: int) -> Ball:
    """Return the product over the turns, for ω = 1 and f = 2/5."""
    f, product = interval.ball(at().f), Ball(1)
    for word, time in zip(orbits.words, orbits.times, strict=True):
        if word.startswith("turn"):
            force = abs(F * time.cos())
            product = product * (force - f) / (force + f)
    return product


def _stops_later() -> tuple[Followed, Followed]:
    """Return what states do that do not stop in their first period, but in their second."""
    first, second = hits_only(LATER, 1), LATER.follow(2)
    need(second.has("turn") or second.has("stick"), "it does not stop in the second period either")
    return first, second


@claim("cor:det-Phi", Kind.STEP, stated="the orbit stops in [0, T], by definition of Ω_dissip")
def dissipative_states_stop_at_once() -> Verdict:
    """For a datum in Ω_dissip the orbit has, by definition, a turning point or a rest in [0, T]."""
    _, second = _stops_later()
    return refuted(
        f"not all: the orbits from {LATER} are in Ω_dissip = X \\ Ω_NS, but stop only after T: "
        f"{second.shown()}",
        "A box of states followed in balls. Ω_NS asks that no stop ever comes; a stop in [0, T] is "
        "asked for by X \\ Ω_NS^[0,T].",
    )


@claim("cor:det-Phi", Kind.THEOREM, stated="|det Φ'| < 1 almost everywhere on Ω_dissip")
def contraction_almost_everywhere() -> Verdict:
    """0 <= |det Φ'| < 1 at almost every point of Ω_dissip at which Φ is differentiable."""
    first, second = _stops_later()
    with interval.workprec(100):
        (a, b), (c, d) = first.monodromy
        need((a * d - b * c).contains(1), "the determinant is not 1")
    stop = next(word for word in second.words if not word.startswith("hit"))
    return refuted(
        f"det Φ' = 1 on an open subset of Ω_dissip: all orbits from {LATER} only hit walls in "
        f"[0, T] ({first.shown()}), and have a {stop} later. It is true of X \\ Ω_NS^[0,T], the "
        "states that stop in the first period",
        "A box of states followed in balls: Φ' is a product of flights and elastic hits there.",
    )


@claim("cor:det-Phi", Kind.STEP, stated="|F cos ωt̃| < |F cos ωt̃| + 2f")
def factor_below_one() -> Verdict:
    """A turning factor is less than 1 since |F cos ωt̃| < |F cos ωt̃| + 2f."""
    f, a = symbols("f a")
    need(same((a + f) - (a - f), 2 * f), "numerator and denominator do not differ by 2f")
    return confirmed("(a - f)/(a + f) < 1: the denominator is larger by 2f", "Symbolic identity.")


@claim("rem:noted-elementary", Kind.CONSISTENCY, stated="symplecticity is area preservation")
def area_and_form() -> Verdict:
    """In two real dimensions symplecticity is equivalent to area preservation."""
    mirror = sp.diag(1, -1)
    need(same(mirror.det(), sp.Integer(-1)), "diag(1, -1) keeps the orientation")
    need(differs(mirror.det(), sp.Integer(1)), "it is symplectic")
    return corrected(
        "to the preservation of area and orientation",
        "diag(1, -1) preserves area, reverses dv ∧ dx.",
    )


@claim("ssec:intro-mixed", Kind.WORDS, stated="saltation factors each of unit determinant")
def unit_determinants() -> Verdict:
    """On a never-stopping orbit Φ' is a product of matrices of determinant 1."""
    orbits = hits_only(States("0.1003", "0.5419", "1e-6"))
    with interval.workprec(100):
        (a, b), (c, d) = orbits.monodromy
        det = a * d - b * c
        need(det.contains(1), "the determinant is not 1")
        words = between(det, 6)
    return confirmed(
        "flights and elastic hits have determinant 1, exactly",
        f"From first principles (saltation.wall-determinant); near P* in balls: {words}.",
    )
