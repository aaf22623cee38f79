"""The theorem about a window: a cycle of the release map attracts its critical point.

The release map G, its interval I, its cells, the critical point c and the basin are as in
``attractor``.  The kneading sequence of G begins with the symbols K of ``kneading``, n in number,
and goes on with those of ``repeated``, p in number, again and again:

*The cycle.*  Let J = J_0 be the interval ``around``, J_i an enclosure of G(J_(i-1)) in mean value
form, and J_p inside J_0.  Let the product of enclosures of G' over J_0, ..., J_(p-1) lie in (-1,
1).  So G^p contracts J into itself: it has one fixed point there, which attracts J.  The image
G^(n+1)(c) lies in J.  Each J_i lies on one side of c: that is the symbol of all G^(n+1+i+kp)(c).

*Its points.*  If G^p takes ``point`` into itself it contains the fixed point: it is the only one in
J.  The images of ``point`` contain the others, the product of G' over them the multiplier.  The
p enclosures are disjoint, so p is the least period.

*Entropy.*  As in ``attractor``; the sequence is known without an end.
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from itertools import chain, combinations, cycle
from typing import Any, ClassVar, NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.letters import Letters
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table, enclosure, region
from cap.checker.theorems.attractor import Attractor

_MAX_PERIOD, _MAX_FIRST = 64, 1024
# fmt: off
_FIRST = Field("kneading", Letters("RL", _MAX_FIRST), "", "",
               "the branches of G(c), .., G^n(c): R where G decreases, L where it increases")
# fmt: on


class Round(NamedTuple):
    """The images of an interval under G up to G^p, and an enclosure of (G^p)' over it."""

    images: list[Interval]
    slope: Interval


class Window(Attractor):
    """The interval, its unimodal map, and the cycle that attracts its critical point."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        *Attractor.HINTS,
        Field("point", enclosure, "", "", "in `around`; G^p takes it into its interior"),
    )
    CLAIMS: ClassVar[Table] = (
        *(_FIRST if field.name == "kneading" else field for field in Attractor.CLAIMS),
        Field("repeated", Letters("RL", _MAX_PERIOD), "", "",
              "the branches of G^(n+1)(c), .., G^(n+p)(c), and again of all that follow, p by p"),
        Field("cycle", Many(Quantity("R"), 1, _MAX_PERIOD), "attracting cycle", "x_k",
              "its points, each the image of the one before"),
        Field("multiplier", Quantity(), "its multiplier", "(G^p)'", "of the cycle"),
        Field("around", region, "J", "J", "around the first point of the cycle, which attracts "
              "all of it; G^(n+1)(c) lies in it"),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time: the cycle is followed twice."""
        p = len(claims["repeated"])
        need(len(claims["cycle"]) == p, f"cycle is not a list of {p}")
        super().limit(hints, claims | {"kneading": claims["kneading"] + 2 * claims["repeated"]})

    def kneading(self, c: Interval, x: Interval) -> Interval:
        """Prove that the critical point has the kneading sequence claimed; and the cycle."""
        last = super().kneading(c, x)
        J = self.attracts(c)
        arrived = self.image(last, self.windows(last), 1).value
        need(arrived.lies_in(*J), "the image of the critical point may not lie in J")
        self.cycle(J)
        return arrived

    def attracts(self, c: Interval) -> tuple[Fraction, Fraction]:
        """Prove that a cycle attracts J, and the symbols of the images of J; return J."""
        J: tuple[Fraction, Fraction] = self.claims["around"][:2]
        low, high = J
        a, b = self.claims["interval"][:2]
        need(a < low < high < b, "J has no interior in I")
        found = self.round(Interval.enclosing(low, high, self.hints["bits"]))
        need(found.images[-1].lies_inside(low, high), "G^p may not take J into its interior")
        one = c.integer(1)
        need(found.slope.magnitude().is_before(one), "G^p may not contract J")
        for n, (symbol, x) in enumerate(zip(self.claims["repeated"], found.images, strict=False)):
            holds = self.lies_on(symbol, x, c)
            need(holds, f"symbol {n + 1} of those repeated may be another one")
        return J

    def round(self, x: Interval) -> Round:
        """Return the images of an interval under G, ..., G^p, after itself."""
        images, slope = [x], x.integer(1)
        for _ in self.claims["repeated"]:
            G = self.image(x, self.windows(x), 2)
            x, slope = G.value, slope * G[(1,)]
            images.append(x)
        return Round(images, slope)

    def cycle(self, J: tuple[Fraction, Fraction]) -> None:
        """Compare the claims on the cycle."""
        low, high = self.hints["point"][:2]
        need(J[0] <= low < high <= J[1], "the point is not in J")
        found = self.round(Interval.enclosing(low, high, self.hints["bits"]))
        need(found.images[-1].lies_inside(low, high), "the cycle may not begin at the point")
        apart = all(x.is_before(y) or y.is_before(x) for x, y in combinations(found.images[:-1], 2))
        need(apart, "the period of the cycle may be smaller")
        self.confirm(cycle=found.images[:-1], multiplier=found.slope)

    def symbols(self) -> Iterable[str]:
        """Return the kneading sequence, without an end."""
        return chain(self.claims["kneading"], cycle(self.claims["repeated"]))

    def known(self) -> str:
        """Return the kneading sequence for people."""
        return f"{self.claims['kneading']}, and then {self.claims['repeated']} again and again"

    def about(self, chaos: str) -> str:
        """Return what is said, and not said, of the orbits in I."""
        points = ", ".join(map(str, self.claims["cycle"]))
        return chaos + _CYCLE.format(points=points, p=len(self.claims["repeated"]))


_CYCLE = (
    "; G has a cycle of the least period {p}, with its points in {points} and the multiplier "
    "(G^{p})' in {{multiplier}}; it attracts the critical point, and all of {{around}}, but it is "
    "not claimed that it attracts almost all of I"
)

THEOREM = Window
