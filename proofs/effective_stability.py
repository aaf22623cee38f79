"""Theorem (effective stability).  Let the stroboscopic map Φ of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω,

be given at rational parameters, and let an elliptic non-sticking T-periodic orbit be guessed.  If
the lemmas below succeed, then

 (i)   Φ has exactly one fixed point P* in an explicit box; all orbits from the box are
       non-sticking, with the same sequence of transverse wall hits;
 (ii)  with exact c, A, κ < 1 and N, let E = {c + A u : |u| <= 1}, in the box, and E' = {c + A u :
       |u| <= κ}: each motion that starts in E' at t = 0 is in E at t = nT for all integers |n| <=
       N.  So its velocity does not vanish for |t| <= NT.

No invariant curve is needed, and none is proved.

Proof.  Lemmas 1 and 2 (`cap.proofs.fixed_point`) give (i).  Lemma 3: a polynomial H, numbers h' and
h, and D with H <= h' on E', H >= h on the boundary of E, |H∘Φ - H| <= D on E; h' + N D < h; P* is
in E'.  Let W_n be the component of P* in {z in the interior of E : H(z) <= h' + nD}; W_0 contains
E'.  Let n < N.

 - *Forwards.*  Φ(W_n) is connected and contains P*.  There H <= h' + (n+1)D < h, so it does not
   meet the boundary of E: it lies in the interior of E, and in W_(n+1).
 - *Backwards.*  Φ is continuous and injective on E: from its end a motion can be followed back,
   flight by flight.  So Φ(int E) is open (invariance of domain), with its boundary in Φ(∂E).  There
   H >= h - D > h' + nD, so W_n does not meet it; W_n is connected and contains P* = Φ(P*), so it
   lies in Φ(int E).  Its preimage in int E is connected, contains P*, and has H <= h' + (n+1)D: it
   lies in W_(n+1).

Hence Φⁿ(E') lies in W_|n|, in E, for |n| <= N.  Between nT and (n+1)T the motion is that of a state
in the box.
"""

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.floats import candidates
from cap.flow.jet_transport import strobe_jet
from cap.flow.windows import Itinerary
from cap.maps import approximate_integral, normal_form
from cap.maps.approximate_integral import Ellipse, Plan
from cap.maps.normal_form import Ellipticity
from cap.option import Option, count
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Around, Located, Proof, Setting, proof_of
from cap.proofs.options import PERIODS
from cap.proofs.orbit import HITS, need_hits
from cap.sets import interval
from cap.sets.jet import Jet

SUMMARY = "an ellipse around an elliptic orbit whose motions do not stop for N periods"
GROUP = "orbit"
SEARCH = candidates.elliptic

DEGREE = Option(
    "degree",
    count(5, 15),
    "of the polynomial, 5 to 15 (default 10): the higher, the larger the ellipse",
    "N",
    default=10,
)
OPTIONS = (PERIODS, DEGREE)
MANY = Fraction(10**9)  # periods, if not asked for
CENTRE = 12  # digits of the centre
EXPANDED = Fraction(8, 5)  # times this degree is the order of Φ, to bound what H leaves
SPARED = 2  # times as many periods are planned; more, if the checker cannot follow, where
HALF = Fraction(1, 2)  # of the box is not left
GUARD = 20  # digits of H, beyond those that N needs


class Proved(NamedTuple):
    """The ellipse E, the polynomial H in its coordinates, and κ."""

    ellipse: Ellipse
    integral: Jet
    part: Fraction


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its box; return the rest of the proof.

    Raises `NotProved` with the step that failed and the sets at which it did.
    """
    need_hits("effective_stability", setting)
    return proof_of("effective_stability", setting, HITS, conclusion)


def conclusion(orbit: Located) -> Callable[[Around], Content]:
    """Expand Φ at P*, and H; return what proves the rest when the box is known."""
    setting, point, periods = orbit.setting, orbit.point, _asked(orbit.setting)
    degree = setting.of(DEGREE)
    jets = strobe_jet(orbit.osc, point.box, point.orbit, degree + 2)
    linear = normal_form.ellipticity(*jets)
    f = normal_form.complex_map(*jets, linear)
    H = approximate_integral.integral(f.truncated(degree), linear)
    growths = approximate_integral.growths(f, H)
    proved = dict[Plan, Proved]()

    def conclude(around: Around) -> Content:
        spared = SPARED * max(Fraction(1), HALF / around.part) ** 3
        plan = approximate_integral.plan(growths, periods * spared, largest(linear, around))
        if plan not in proved:
            E = approximate_integral.ellipse(linear, centre(orbit), plan.radius)
            cut, places = H.truncated(plan.degree), len(str(periods)) + GUARD
            exact = approximate_integral.polynomial(cut, linear, point.box, E, places)
            proved[plan] = Proved(E, exact, interval.short(Fraction(plan.part)))
            lemma_3_drift(orbit, around.proved.expected, proved[plan])
        lemma_4_inside(orbit, around, proved[plan])
        return claims(setting, proved[plan]), hints(setting, proved[plan])

    return conclude


def _asked(setting: Setting) -> Fraction:
    """Return N."""
    return setting.of(PERIODS) or MANY


def order_of(setting: Setting) -> int:
    """Return the order to which Φ is expanded around the ellipse."""
    return int(EXPANDED * setting.of(DEGREE))


def centre(orbit: Located) -> tuple[Fraction, Fraction]:
    """Return a point of a few digits near P*."""
    x, v = (
        round(m, CENTRE - interval.decade(unit))
        for m, unit in zip(orbit.point.hint.centre, orbit.setting.scale, strict=True)
    )
    return x, v


def largest(linear: Ellipticity, around: Around) -> float:
    """Return a radius r, in floats, such that |z| <= r is well in the box."""
    p, q = float(linear.p.mid()), linear.q
    widths = float(abs(q).mid()), p  # of |z| <= 1: |q| in x, p in v
    sides = (around.box[name] for name in "xv")
    halves = (float(Fraction(side[1]) - Fraction(side[0])) / 2 for side in sides)
    return 0.95 * min(half / width for half, width in zip(halves, widths, strict=True))


def lemma_3_drift(orbit: Located, expected: Itinerary, proved: Proved) -> None:
    """*Statement.* h' + N D < h.

    *Computed.* The bounds of H and of its change.
    """
    setting, (E, H, part) = orbit.setting, proved
    bounds = approximate_integral.held(orbit.osc, expected, E, H, part, order_of(setting))
    if not bounds.inner + interval.ball(_asked(setting)) * bounds.drift < bounds.outer:
        raise NotProved("Lemma 3", "orbits may leave the ellipse before", bounds._asdict())


def lemma_4_inside(orbit: Located, around: Around, proved: Proved) -> None:
    """*Statement.* E lies in the box, and P* in E'.

    *Computed.* The least rectangle around E, and u at P*.
    """
    E, _, part = proved
    for name, m, half in zip("xv", E.centre, E.half_widths(), strict=True):
        low, high = (interval.ball(Fraction(end) - m) for end in around.box[name])
        if not (-half > low and half < high):
            raise NotProved("Lemma 4", "the ellipse may leave the box", {name: half})
    a, b = E.coordinates(orbit.point.box)
    if not a * a + b * b < interval.ball(part * part):
        raise NotProved("Lemma 4", "P* may be outside the inner ellipse", {"u_1": a, "u_2": b})


def claims(setting: Setting, proved: Proved) -> dict[str, Any]:
    """Return the claims: the ellipses, N, and the area of the inner one."""
    exact, (E, _, part) = interval.exact_decimal, proved
    area = interval.pi() * interval.ball(part**2 * abs(E.determinant()))
    return {
        "centre": [exact(c) for c in E.centre],
        "axes": [[exact(entry) for entry in row] for row in E.axes],
        "part": exact(part),
        "periods": str(_asked(setting)),
        "area": setting.rounding.pair(area, setting.units.area),
    }


def hints(setting: Setting, proved: Proved) -> dict[str, Any]:
    """Return the hints: H, row by row of one degree, and the order of the expansion."""
    exact, H, order = interval.exact_decimal, proved.integral, order_of(setting)
    rows = [[exact(H[n - j, j]) for j in range(n + 1)] for n in range(1, H.space.order + 1)]
    return {"bits": str(setting.checker_bits_to(order)), "order": str(order), "integral": rows}
