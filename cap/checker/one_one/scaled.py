"""What the theorems on (1,1) orbits share: the units of ``closed_form``, and words."""

from __future__ import annotations

from typing import Any

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.shapes import Field, Quantity
from cap.checker.one_one.closed_form import Symmetric
from cap.checker.system.walls import BetweenWalls

ONE_ONE = "T-periodic, with a velocity that never vanishes and one hit of each wall per period"
SYSTEM = (
    "x'' = F cos(omega t) - f sgn x' with F = {F}, omega = {omega}, f = {f} and elastic walls at "
    "{l} and {r}, T = 2 pi/omega; a (1,1) orbit is " + ONE_ONE + ": "
)

# fmt: off
STATE = (
    Field("x", Quantity("R"), "x at t = 0", "x(0)", "the state at t = 0"),
    Field("v", Quantity("R omega"), "v at t = 0", "v(0)", "positive"),
    Field("hit_times", [Quantity("omega^-1")] * 2, "hit time", "t_k", "t_1, t_2 in (0, T)"),
    Field("hit_speed", Quantity("R omega"), "hit speed", "|v_1|", "|v| at both hits"),
    Field("least_speed", Quantity("R omega"), "least speed", r"\min |v|", "the minimum of |v|"),
)
# fmt: on


class Scaled(BetweenWalls):
    """A theorem on (1,1) orbits: units and constants."""

    @property
    def rho(self) -> Interval:
        """R omega^2/F."""
        return self.number(self.R * self.omega**2 / self.p.F)

    @property
    def alpha(self) -> Interval:
        """f/F."""
        return self.number(self.p.f / self.p.F)

    def state(self, orbit: Symmetric) -> dict[str, Any]:
        """Return the state of a symmetric orbit at t = 0, the times of its hits, and its speeds."""
        (gap, u), t_1, F, omega = orbit.start, orbit.t_1, self.p.F, self.omega
        times = [t * self.number(1 / omega) for t in (t_1, t_1 + self.pi())]
        x = self.number(self.p.r) - gap * self.number(F / omega**2)
        start = {"x": x, "v": u * self.number(F / omega), "hit_times": times}
        return start | self.speeds(orbit)

    def speeds(self, orbit: Symmetric) -> dict[str, Any]:
        """Return the speeds of a symmetric orbit."""
        speed = self.number(self.p.F / self.omega)
        return {"hit_speed": orbit.hit_speed * speed, "least_speed": orbit.slowest * speed}
