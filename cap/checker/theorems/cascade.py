"""The theorem about a cascade: where cycles of the release map double their period, as f varies.

Let G be the release map (``attractor``), which depends on f = F cos theta.  For k = 1, 2, .. let P
be p 2^(k-1), p the period claimed.  At f_k

1. *a cycle has the multiplier -1.*  Let Z be a box around a point m of the plane of (x, theta).
All orbits released at the images of Z have the itinerary, one release after the other: G^P is
analytic there.  Its derivatives up to the third by x, and those by theta, follow from those of G by
the chain rule; images of Z are enclosed in mean value form around those of m.  The zeros of

    H(x, theta) = (G^P(x) - x, (G^P)'(x) + 1)

are the cycles wanted.  With a matrix C, K = m - C H(m) + (1 - C H'(Z)) (Z - m) lies in the interior
of Z: so H has one zero in Z [Krawczyk], and it lies in K.  The images of x are disjoint from x
before the P-th: P is the least period.

2. *it passes -1.*  By the theorem on implicit functions, as 1 - (-1) /= 0, the cycle continues to
other theta, with x' = D_theta G^P/2; so its multiplier has the derivative D_theta D_x G^P + D_x^2
G^P x' by theta.  This has a sign in Z, the same for all k.

3. *a cycle of period 2P branches off.*  That sign, and D_x^2 G^P ^2/2 + D_x^3 G^P/3 > 0: by the
theorem on period doubling [Guckenheimer, Holmes] there are cycles of twice the period near it, on
the side of f_k where the multiplier of the first cycle is below -1, and they attract.

It is not claimed that the cycle of f_(k+1) is the one that branches off at f_k.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any, ClassVar, NamedTuple

from cap.checker.flow.events import WORDS
from cap.checker.flow.mechanics import Ends
from cap.checker.kernel.citation import NEUMAIER, cite
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table, Whole, Word, enclosure
from cap.checker.kernel.theorem import BITS
from cap.checker.release.sheared import Passage, Sheared
from cap.checker.system.all_f import ForAllF, without_f
from cap.checker.system.lossy import WITH_LOSSES, WithLosses

_MAX_EVENTS, _MAX_DOUBLINGS, _MAX_PERIOD, _MAX_POINTS = 16, 8, 12, 512
_MAX_BITS, _MAX_WORK = 1024, 3 << 20
_CYCLE = {
    "centre": [number] * 2,
    "reach": [number] * 2,
    "inverse": [[number] * 2] * 2,
    "events": Many(Many(enclosure, 2, _MAX_EVENTS), 1, _MAX_POINTS),
}


class Derivatives(NamedTuple):
    """Of G, or of an iterate, over a set: by x, by theta, and of higher order."""

    x: Interval
    t: Interval
    xx: Interval
    xt: Interval
    xxx: Interval

    def after(self, first: Derivatives) -> Derivatives:
        """Return those of this map after another one: the chain rule."""
        x, t, xx, xt, xxx = first
        return Derivatives(
            self.x * x,
            self.x * t + self.t,
            self.xx * x.square() + self.x * xx,
            (self.xx * t + self.xt) * x + self.x * xt,
            self.xxx * x.square() * x + self.xx * x * xx * 3 + self.x * xxx,
        )


class Doubling(NamedTuple):
    """The zero of H in Z, and the derivatives of G^P over Z."""

    x: Interval
    theta: Interval
    derivatives: Derivatives


class Cascade(ForAllF, WithLosses):
    """The values of f where cycles double their period, and the ratios of their differences."""

    PARAMETERS = without_f(WITH_LOSSES)
    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS._replace(shape=Whole(64, _MAX_BITS)),
        Field("cycles", Many(_CYCLE, 2, _MAX_DOUBLINGS), "", "",
              "for each k: m, the half-widths of Z, C, and for each of the P points of the cycle "
              "the time windows of the events from its release to the next one"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("itinerary", Many(Word(WORDS), 2, _MAX_EVENTS), "", "",
              "the events from each of these releases to the next one, the last word"),
        Field("half_periods", Whole(1, 32), "", "", "n: the time that G takes, in T/2"),
        Field("period", Whole(1, _MAX_PERIOD), "", "", "p: of the cycle at f_1"),
        Field("direction", Word(("up", "down")), "", "",
              "up if the multipliers fall below -1 as f increases, down if as f decreases"),
        Field("parameters", Many(Quantity("F"), 2, _MAX_DOUBLINGS), "period doubling", "f_k",
              "the f at which a cycle of the period p 2^(k-1) has the multiplier -1"),
        Field("places", Many(Quantity("R"), 2, _MAX_DOUBLINGS), "a point of the cycle", "x_k",
              "where it is released"),
        Field("ratios", Many(Quantity(), 0, _MAX_DOUBLINGS), "ratio of differences", r"\delta_k",
              "(f_(k+1) - f_k)/(f_(k+2) - f_(k+1))"),
    )
    CITES = (
        cite(
            "Krawczyk", NEUMAIER,
            ("differentiable", "H is continuously differentiable on Z: all events are transverse",
             "itinerary"),
            ("inclusion", "K lies in the interior of Z", "parameters, places"),
        ),
        cite(
            "period doubling",
            "Guckenheimer and Holmes, Nonlinear Oscillations, Dynamical Systems, and Bifurcations "
            "of Vector Fields, 1983, Theorem 3.5.1",
            ("smooth", "G^P is analytic in x and theta near the cycle, of the multiplier -1",
             "itinerary, parameters"),
            ("transversal", "the multiplier of the cycle, continued, has a derivative by f that is "
             "not zero", "direction"),
            ("cubic", "D_x^2 G^P ^2/2 + D_x^3 G^P/3 is positive", "places"),
        ),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time: events of all points, with jets of the third order."""
        cycles, events = hints["cycles"], len(claims["itinerary"])
        number = len(cycles)
        for name, wanted in (("parameters", number), ("places", number), ("ratios", number - 2)):
            need(len(claims[name]) == wanted, f"{name} is not a list of {wanted}")
        for k, cycle in enumerate(cycles):
            points = claims["period"] << k
            need(len(cycle["events"]) == points, f"the windows of cycle {k + 1} are not {points}")
            same = all(len(each) == events for each in cycle["events"])
            need(same, f"windows are not lists of {events}")
        work = 6 * events * hints["bits"] * sum(len(each["events"]) for each in cycles)
        need(work <= _MAX_WORK, f"bits and points are too much: {work} > {_MAX_WORK}")

    def prove(self) -> None:
        """Prove the theorem."""
        found = list[Doubling]()
        for k, hint in enumerate(self.hints["cycles"]):
            found.append(self.doubling(hint))
            self.bifurcates(found[-1])
            period = self.claims["period"] << k
            self.step(f"a cycle of period {period} has the multiplier -1, and doubles")
        f = [cos_sin(each.theta)[0] * self.number(self.p.F) for each in found]
        differences = [b - a for a, b in pairwise(f)]
        ratios = [a / b for a, b in pairwise(differences)]
        self.confirm(parameters=f, places=[each.x for each in found], ratios=ratios)
        self.step("the parameters and their ratios are as claimed")

    def doubling(self, hint: dict[str, Any]) -> Doubling:
        """Prove that there is one cycle with the multiplier -1 in Z; return it."""
        m = [self.number(q) for q in hint["centre"]]
        reach = [Interval.enclosing(-q, q, self.hints["bits"]) for q in hint["reach"]]
        need(all(q > 0 for q in hint["reach"]), "Z has no interior")
        windows = [[w[:2] for w in each] for each in hint["events"]]
        centres, slope = self.centre(m, windows)
        images, D = self.over(m, reach, centres, windows)
        first = images[0]
        apart = all(y.is_before(first) or first.is_before(y) for y in images[1:])
        need(apart, "the period of a cycle may be smaller")
        C = [[self.number(q) for q in row] for row in hint["inverse"]]
        H = centres[-1] - m[0], slope + 1
        K = [
            z - (row[0] * H[0] + row[1] * H[1]) + self.rest(n, row, D, reach)
            for n, (z, row) in enumerate(zip(m, C, strict=True))
        ]
        for z, centre, half in zip(K, hint["centre"], hint["reach"], strict=True):
            need(z.lies_inside(centre - half, centre + half), "Krawczyk: K(Z) is not inside Z")
        return Doubling(K[0], K[1], D)

    def rest(self, n: int, row: list[Interval], D: Derivatives, reach: list[Interval]) -> Interval:
        """Return the n-th component of (1 - C H'(Z)) (Z - m)."""
        one = reach[0].integer(1)
        columns = ((D.x - 1, D.xx), (D.t, D.xt))
        unit = [one if n == k else one.integer(0) for k in range(2)]
        total = one.integer(0)
        for k, (a, b) in enumerate(columns):
            total = total + (unit[k] - (row[0] * a + row[1] * b)) * reach[k]
        return total

    def map(self, theta: Interval, order: int) -> Sheared:
        """Return G for these theta."""
        n = self.claims["half_periods"]
        return Sheared(self.p, theta, Fraction(0), theta.midpoint(), n, order)

    def centre(
        self, m: list[Interval], windows: list[list[Ends]]
    ) -> tuple[list[Interval], Interval]:
        """Return the images of m, from x on to that under G^P, and (G^P)' at m."""
        G, (x, theta) = self.map(m[1], 2), m
        places, slope = [x], theta.integer(1)
        for each in windows:
            image = G.over(places[-1], Passage(self.claims["itinerary"], each))
            places.append(image.value)
            slope = slope * image[(1, 0)]
        return places, slope

    def over(
        self,
        m: list[Interval],
        reach: list[Interval],
        centres: list[Interval],
        windows: list[list[Ends]],
    ) -> tuple[list[Interval], Derivatives]:
        """Return the images of Z, that under G^P left out, and the derivatives of G^P."""
        G, zero, one = self.map(m[1] + reach[1], 3), m[0].integer(0), m[0].integer(1)
        D, images = Derivatives(one, zero, zero, zero, zero), list[Interval]()
        for y, each in zip(centres, windows, strict=False):
            box = y + D.x * reach[0] + D.t * reach[1]
            images.append(box)
            jet = G.over(box, Passage(self.claims["itinerary"], each))
            parts = [jet[power] for power in ((1, 0), (0, 1), (2, 0), (1, 1), (3, 0))]
            factors = (1, 1, 2, 1, 6)
            here = Derivatives(*(q * n for q, n in zip(parts, factors, strict=True)))
            D = here.after(D)
        return images, D

    def bifurcates(self, found: Doubling) -> None:
        """Prove that the multiplier passes -1, in the direction claimed, and that cycles attract
        that branch off."""
        D = found.derivatives
        speed = D.xt + D.xx * D.t / 2  # of the multiplier, by theta; f decreases with theta
        falls = speed if self.claims["direction"] == "up" else -speed
        need(falls.is_positive(), "the multiplier may not pass -1 in the direction claimed")
        cubic = D.xx.square() / 2 + D.xxx / 3
        need(cubic.is_positive(), "a cycle that branches off may not attract")

    def words(self) -> str:
        """Return the theorem in one line."""
        claims = self.claims
        listed = "; ".join(
            f"f_{k + 1} in {f}, period {claims['period'] << k}"
            for k, f in enumerate(claims["parameters"])
        )
        side = "larger" if claims["direction"] == "up" else "smaller"
        events = ", ".join(claims["itinerary"])
        quotients = ", ".join(map(str, claims["ratios"]))
        parts = (_TEXT, _RATIOS, _NOT_CLAIMED, _NOR) if quotients else (_TEXT, _NOT_CLAIMED)
        text = "".join(parts)
        return self.told(text, listed=listed, quotients=quotients, side=side, events=events)


_TEXT = (
    "x'' = F cos(omega t) - f sgn x' - mu x' with F = {F}, omega = {omega}, mu = {mu} and walls at "
    "l = {l} and r = {r}, where v becomes -e v with e = {e}: with T = 2 pi/omega, let G take the "
    "place x at which a mass that has stuck is released to the right to the place of its next "
    "release, a release to the left mirrored by x -> l + r - x with half a period; at each of the "
    "following f, G has a cycle of the least period named, with exactly these events from each "
    "release to the next, {half_periods} half-periods later: {events}; its multiplier is -1, and "
    "falls below -1 with a derivative that is not zero for {side} f; so (period doubling) near it, "
    "on that side of f, there is a cycle of twice the period, and it attracts: {listed}"
)
_RATIOS = "; the ratios (f_(k+1) - f_k)/(f_(k+2) - f_(k+1)) are in {quotients}"
_NOT_CLAIMED = "; it is not claimed that the cycle of f_(k+1) is the one that branches off at f_k"
_NOR = ", nor that the ratios converge, be it to 4.6692.. (Feigenbaum)"

THEOREM = Cascade
