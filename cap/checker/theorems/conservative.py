"""The theorem about the conservative part: all states but a set of small area stop.

Let e = 1, mu = 0, 0 < f < F.  Omega_NS is the set of the states (x, v) at t = 0 whose velocity
never vanishes afterwards.  *Claimed:* its area is at most ``area``; almost all of it has |v| <=
``speed``.

*Launches.*  Units F = omega = 1.  A launch (t, u), t modulo 2 pi, leaves a wall at the time t with
the speed u > 0; in the mirror image all leave the left one.  If it flies to the other wall without
a stop, and hits it at T with the speed V > 0, then G(t, u) = (T + pi, V).  G is injective (a flight
can be followed backward) and preserves u du dt = dE dt, E = u^2/2 (the flow preserves dx dv, and u
dt is the flux of dx through a wall).  S is the set of launches whose orbit never stops.  `ceiling`:
S has finite measure, G maps S onto S up to a null set, and almost all of S lies below the ceiling W
= c: hence u^2 <= 2 (a + c), v^2 <= u^2 + 2 (1 - f) R.

*Area.*  Let N_t be the set of the states at the time t whose velocity never vanishes afterwards.  A
state of N_t reaches a wall within a bounded time, at a launch of S; the flow preserves dx dv: so
N_t has finite area.  The flow from t to t + s maps N_t into N_{t+s}, injectively, and preserves
area; N_{t + 2 pi} = N_t: so all N_t have one area, and almost all states of N_t come, by n periods
of the flow, from states of N_t, for each n.  Those have hit a wall: almost all states of N_t are on
a flight that began with a launch of S.  These (x, v, t modulo 2 pi), with their mirror images, have
the volume 2 (integral over S of d dE dt), d the time of the flight.  So

    area(Omega_NS) = (1/pi) integral over S of d dE dt.

*Where S is.*  `strips`: almost no launch of S is in a cell of the family ``forward`` (its orbit
would meet W >= c, and that happens on a null set), or of the family ``backward``, which is about
backward orbits, for the friction -f, with -t for t: almost every launch of S has one in S.  So S
lies, up to a null set, in the gaps that both leave; its measure is at most their area A in (t, E)
(`overlap`).

*From measure to area.*  Outside of the columns W > c, so S has its times t in an interval [t_b,
t_e] shorter than 2 pi.  G sends t to t + d + pi - 2 pi k, with an integer k, and k <= 1: else a
flight would hit after t_b + 3 pi, and there is none (`returns_in_time`).  As G preserves the
measure of S, and t is bounded on it, the integral over S of d + pi - 2 pi k vanishes.  So that of d
is at most pi times the measure of S, and area(Omega_NS) <= A.
"""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any

from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.processes import Work
from cap.checker.kernel.reading import MAX_SIZE, number, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.rounding import in_doubles
from cap.checker.kernel.shapes import Field, bound
from cap.checker.strips.ceiling import Flights, closed, descends, returns_in_time
from cap.checker.strips.columns import Column, columns, lines
from cap.checker.strips.overlap import gaps, left
from cap.checker.strips.strips import Ceiling, World
from cap.checker.system.lossy import SYSTEM
from cap.checker.system.walls import BetweenWalls

_CEILING = {"height": number, "phase": number, "level": number}


class Conservative(BetweenWalls):
    """An upper bound of the area of the states whose velocity never vanishes."""

    # fmt: off
    HINTS = (
        Field("ceiling", _CEILING, "", "", "a, b, c: launches that never stop have "
              "E + a cos(t - b) <= c, in units F = omega = 1"),
        Field("lines", text, "", "", "the lines between columns of launches, as integers"),
        Field("forward", text, "", "", "cells of launches whose orbits stop or rise above, column "
              "by column"),
        Field("backward", text, "", "", "the same for backward orbits"),
    )
    CLAIMS = (
        Field("area", bound, "", "", "an upper bound of the area of the states (x, v) whose "
              "velocity never vanishes, at whatever speed"),
        Field("speed", bound, "", "", "almost all of them have at most this |v|"),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:  # noqa: ARG003
        """Bound what becomes a double."""
        small = max(map(abs, hints["ceiling"].values())) <= MAX_SIZE
        need(small, "a number of the ceiling is larger than 10^30")

    @in_doubles()
    def prove(self) -> None:
        """Prove the theorem."""
        F, omega = self.p.F, self.p.omega
        f, R = enclosing(self.p.f / F), enclosing(self.R * omega**2 / F)
        at = self.hints["ceiling"]
        a, b, c = (enclosing(at[name]) for name in _CEILING)
        lines_at = lines(self.hints["lines"])
        self.work = Work(self.jobs, self.tell, self.phases())
        flights, ceiling = Flights(f, R), Ceiling(a, b, c)
        boxes = descends(flights, ceiling)
        self.step(f"almost all launches that never stop are below the ceiling ({boxes} boxes)")
        closed(ceiling, lines_at[0], lines_at[-1])
        returns_in_time(flights, lines_at[0], lines_at[-1])
        self.step("they begin in the columns, and the next ones do half a period later on average")
        below = Ceiling(a, -b, c)
        mirror = [-line for line in reversed(lines_at)]
        forward = self.family("forward", World(f, R, ceiling, lines_at, []))
        backward = self.family("backward", World(-f, R, below, mirror, []))
        self.compare_area(lines_at, forward, backward)
        self.compare_speed(at["height"] + at["level"])

    def phases(self) -> dict[str, float]:
        """Return what takes long, in words, and how long it may take: most, by length of text."""
        texts = {name: len(self.hints[name]) for name in ("forward", "backward")}
        followed = {_FOLLOWED.format(name): float(size) for name, size in texts.items()}
        return followed | {_LEFT: _SHORT * sum(followed.values())}

    def family(self, name: str, world: World) -> list[Column]:
        """Prove that almost no launch of S is in a cell of a family."""
        world.columns = columns(self.hints[name])
        C = len(world.columns)
        need(len(world.lines) == C + 1, f"{name} has not one entry for each column")
        sizes = [sum(len(run.levels) for run in runs) for runs in world.columns]
        cells, size = sum(sizes), len(self.hints[name])
        weight = lambda j: size * sizes[j] / (cells or 1)  # noqa: E731
        self.work(world.prove, range(C), _FOLLOWED.format(name), weight)
        self.step(f"{name}: from {cells} cells orbits stop, or leave by the ceiling")
        return world.columns

    def compare_area(self, at: list[float], forward: list[Column], backward: list[Column]) -> None:
        """Compare the area that is left with the one claimed."""
        total = Double(0.0)
        work, column = partial(self.work, words=_LEFT), self.phases()[_LEFT] / len(forward)
        work = partial(work, weight=lambda _columns: column)
        areas = left(work, map(gaps, forward), [*map(gaps, backward)])
        for (low, high), area in zip(pairwise(at), areas, strict=True):
            total = total + Double(area) * (high - low)
        whole = Fraction(total.upper) * self.p.F**2 / self.p.omega**3
        need(whole <= self.claims["area"], "more area is left than is claimed")
        self.step("the launches that are left have at most the area claimed")

    def compare_speed(self, energy: Fraction) -> None:
        """Compare the largest speed."""
        square = 2 * energy * (self.p.F / self.p.omega) ** 2 + 2 * (self.p.F - self.p.f) * self.R
        fast = self.claims["speed"] >= 0 and square <= self.claims["speed"] ** 2
        need(fast, "the speed may be larger than claimed")

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.told(SYSTEM + _AREA)


# what is done
_FOLLOWED = "{} cells are followed"
_LEFT = "the area that is left is bounded"
_SHORT = 0.05  # of the time before

_AREA = (
    "the states (x, v) at t = 0 whose velocity never vanishes afterwards, of whatever speed, are a "
    "set of area at most {area}, and almost all of them have |v| <= {speed}; from all other states "
    "the velocity vanishes at least once"
)

THEOREM = Conservative
