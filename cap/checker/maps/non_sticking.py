"""A fixed point whose orbit hits the walls alternately and never turns: mu = 0, e = 1, one period.

On the orbit of P* the velocity never vanishes; flights and hits preserve dx^dv, so det Phi' = 1.
"""

from __future__ import annotations

from typing import Any, ClassVar

from cap.checker.flow.itinerary import MAX_EVENTS, Passage, PeriodMap, limit_work, work
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Quantity, Table
from cap.checker.maps.fixed_point import WINDOWS, FixedPoint, Point, krawczyk_theorem

KRAWCZYK = krawczyk_theorem(
    "Phi is continuously differentiable on the box: "
    "all hits are transverse and no velocity vanishes",
    "K(box) lies in the interior of the box",
)


class NonSticking(FixedPoint):
    """The fixed point of an orbit that hits the walls alternately, without losses."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        *FixedPoint.HINTS,
        Field("hit_times", WINDOWS, "", "", "each orbit from the box has its k-th hit in the k-th"),
    )
    CLAIMS: ClassVar[Table] = (
        *FixedPoint.CLAIMS,
        Field("hit_times", Many(Quantity("omega^-1"), 1, MAX_EVENTS), "hit time", "t_k",
              "increasing, in (0, T)"),
        Field("hit_forcing", Many(Quantity("F"), 1, MAX_EVENTS),
              "|F cos wt| - f at hit", r"|F\cos\omega t_k| - f",
              "its sign says whether this clause of (H1) holds, which nothing else needs"),
        Field("least_speed", Quantity("R omega"), "least speed", r"\min |v|",
              "the minimum of |v| on the orbit of P*, positive"),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:  # noqa: ARG003
        """Bound the time."""
        limit_work(work(len(hints["hit_times"]), hints["bits"], int(hints.get("order", 0))))

    @property
    def phi(self) -> PeriodMap:
        """The map over one period."""
        return PeriodMap(self.p, [window[:2] for window in self.hints["hit_times"]])

    def orbit(self, fixed_point: Point, orbit: Passage) -> None:
        """Compare the claims about P* and its orbit with what is computed."""
        super().orbit(fixed_point, orbit)
        (a, b), (c, d) = orbit.jacobian
        self.confirm(
            hit_times=[h.moment.t.value for h in orbit.events],
            hit_forcing=[h.forcing.magnitude() - self.number(self.p.f) for h in orbit.events],
            least_speed=orbit.least_speed,
            determinant=a * d - b * c,
        )
        self.step("the claims about the orbit of P* contain what is computed")
        need(self.claims["least_speed"].lower > 0, "the least speed is not positive")

    def statement(self, conclusion: str, **more: object) -> str:
        """Return the sentence that says what the orbit is, and what is concluded."""
        return self.told(f"{_ORBIT}; {conclusion}", hits=len(self.claims["hit_times"]), **more)


_ORBIT = (
    "x'' = F cos(omega t) - f sgn x' with F = {F}, omega = {omega}, f = {f} and elastic walls at "
    "{l} and {r}: the time-T map Phi of (x, v), T = 2 pi/omega, has one and only one fixed point "
    "in {box[x]} x {box[v]}, with x in {x}, v in {v}; its orbit hits the walls {hits} times per "
    "period, transversely, and never turns or sticks, with a least speed in {least_speed}"
)
