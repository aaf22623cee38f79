"""The theorem about all T-periodic orbits whose velocity never vanishes.

Such an orbit goes from wall to wall, m hits of each in a period.

*Bounds.*  Units 1/omega, F/omega^2.  Let u = |v| > 0, s = sgn v, X the place from the middle
between the walls, |X| <= rho/2, dX/dt = s u.  The speed u is continuous, as hits are elastic, u' =
s cos t - alpha.  Over a period u' has the integral 0, so integration by parts gives

    2 pi alpha = int s cos t = int X' cos t/u = int X (sin t/u + u' cos t/u^2)
              <= (rho/2)(4/u_0 + int |u'|/u_0^2),    u_0 = min u > 0.

The positive part of u' is at most that of |cos t| - alpha, with the integral V = 4 (sqrt(1 -
alpha^2) - alpha arccos alpha); so int |u'| <= 2V, and 2 pi alpha u_0^2 - 2 rho u_0 - rho V <= 0.
Once more: let g = sin t/u + u' cos t/u^2, and Z = (X^2 - rho^2/4)/2, which is 0 at hits, Z' = s u
X, -rho^2/8 <= Z <= 0.  By parts on each flight, where u'' = -s sin t,

    int X g = int s Z' g/u = - int s Z (g/u)',
    (g/u)' = cos t/u^2 - (4 s sin t cos t - 3 alpha sin t)/u^3 - 3 (s cos t - alpha)^2 cos t/u^4.

The integrals over a period of |cos t|, |sin t|, |sin t cos t|, |cos t|^3, cos^2 t are 4, 4, 2, 8/3,
pi; so

    16 pi alpha u_0^4 <= rho^2 (4 u_0^2 + (8 + 12 alpha) u_0 + 8 + 6 pi alpha + 12 alpha^2).

Each of the two inequalities has one change of sign among its coefficients: where it fails for some
number, it fails for all larger ones, so u_0 is below it.  From the time of u_0 on u rises by V at
most, in a period: u <= u_0 + V.  If U is a bound of that, 2 m rho = int u <= 2 pi U.

*m = 1*: the closed form (``closed_form``, ``pairs``) has all of them: plus, minus, and at most one
pair, delta and -delta.  alpha(delta) decreases strictly, so delta is between two numbers if alpha
is between its values there.  At the hit of the right wall t_1 = arccos S - delta, u_1 = W + alpha
delta.  With |delta| < pi/2 and 0 < arccos S < pi, the hits of the left wall before and after that,
at t_1 - pi + 2 delta and t_1 + pi + 2 delta, are before and after t = 0; for S > 0 because t_1 + 2
delta = arccos S + delta < pi, and > -pi/2, and for S < 0 because delta = 0.  So the state at t = 0
is one of the flight (``flight``) that comes to r with v = u_1 at t_1 > 0, or leaves r with v = -u_1
at t_1 < 0.

*m > 1*: cap.checker.flow.launches.  The slowest launch of the orbit lies in [0, L] x [0, U], L > 2
pi; a tree of halves of this box is given.  Each leaf is proved empty, or left open and counted; the
size of a box is its integral of u dt du, the area of the states that are launched from it.

*Orbits that touch no wall* turn.  They form a family, the theorem ``segment``, if and only if alpha
< 2/sqrt(4 + pi^2) and the stroke 2 sqrt(1 - (pi alpha/2)^2) is less than rho.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.flow.launches import Gap, Phase, Window, empty, phase
from cap.checker.kernel.arctangent import arccos
from cap.checker.kernel.choices import OrNone
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.letters import Letters
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import Rejected, need
from cap.checker.kernel.shapes import Field, Many, Quantity, Whole, Word, bound
from cap.checker.kernel.theorem import BITS
from cap.checker.one_one.closed_form import Symmetric, birth, friction
from cap.checker.one_one.pairs import over_intervals, slowest
from cap.checker.one_one.scaled import Scaled
from cap.checker.system.flight import place, velocity

LONGEST = Fraction(62832, 10000)  # L, more than 2 pi
UNIT = 2**13  # the ends of windows are multiples of 1/UNIT
MAX_BOXES = 20_000
MAX_DEPTH = 60
MAX_WORK = 1 << 25
MAX_LETTERS = 400  # of the windows of a box: 40 flights
EMPTY, OPEN, HALVES_T, HALVES_U = ".?tu"
PART = re.compile("([0-9]{1,7})(?: ([0-9]{1,6}))?(?: ([0-9]{1,6}))?")


class Orbit(NamedTuple):
    """A (1,1) orbit: t_1 and u_1, trace and least speed."""

    t: Interval
    u: Interval
    trace: Interval
    slowest: Interval


class Inventory(Scaled):
    """All fixed points of Phi whose velocity never vanishes."""

    # fmt: off
    HINTS = (
        BITS,
        Field("asymmetry", OrNone([number] * 2), "", "",
              'delta of the asymmetric pair is between; "none" if there is none'),
        Field("tree", OrNone(Letters(EMPTY + OPEN + HALVES_T + HALVES_U, 2 * MAX_BOXES)), "", "",
              "[0, 62832/10000] x [0, highest_speed] in preorder: t, u: halved across t or u, the "
              'lower half first; . empty, ? open; "none" if most_hits is 1'),
        Field("flights", Many(Letters("0123456789 ,", MAX_LETTERS), 0, MAX_BOXES), "", "",
              "for each empty box, its flights, between commas: a, b - a, m - a, in units 2^-13; "
              "without m - a where not all may hit, without b - a where none does"),
    )
    CLAIMS = (
        Field("fixed_points", Many({"x": Quantity("R"), "v": Quantity("R omega"),
              "trace": Quantity(), "hits": Whole(2, 2)}, 0, 4), "fixed point", "P",
              "all fixed points of Phi with l < x < r whose velocity never vanishes, but for those "
              "that undecided leaves: plus, minus, then the pair; the trace of Phi'; hits in a "
              "period"),
        Field("families", Many(Word(("segment",)), 0, 1), "", "",
              "segment: a family of T-periodic orbits that touch no wall, and turn; not counted"),
        Field("undecided", {"boxes": Whole(0, MAX_BOXES), "size": bound}, "", "",
              "boxes of launches left open, from which orbits with more than one hit of each wall "
              "may begin; their size, the integral of u dt du, in F^2/omega^3"),
        Field("highest_speed", bound, "", "U", "no such orbit is faster, in units of F/omega"),
        Field("most_hits", Whole(0, 999), "", "",
              "no such orbit has more hits of each wall in a period"),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:  # noqa: ARG003
        """Bound the time: bits times flights."""
        work = hints["bits"] * sum(told.count(",") + 1 for told in hints["flights"])
        need(work <= MAX_WORK, f"bits and flights are too much: {work} > {MAX_WORK}")

    def prove(self) -> None:
        """Prove the theorem."""
        need(self.p.f > 0, "0 < f does not hold")
        self.limits()
        self.points()
        self.families()
        self.launches()

    @property
    def alpha(self) -> Interval:
        """f/F."""
        return self.number(self.p.f / self.p.F)

    def limits(self) -> None:
        """Compare the bounds of speed and number of hits."""
        rho = self.rho
        U = self.number(self.claims["highest_speed"])
        too_fast = U - self.rise
        fails = any(each.is_positive() for each in self.excesses(too_fast))
        need(too_fast.is_positive() and fails, "highest_speed is too low")
        most = self.pi() * U / rho
        need(most.upper < self.claims["most_hits"] + 1, "there may be more than most_hits hits")
        need(self.claims["most_hits"] <= most.upper, "most_hits is more than the bound")
        self.step("all of these orbits are slower than claimed, with no more hits than claimed")

    def excesses(self, u: Interval) -> Iterator[Interval]:
        """Give what is not positive for the least speed u of such an orbit."""
        alpha, rho, pi_alpha = self.alpha, self.rho, self.pi() * self.alpha
        yield u.square() * pi_alpha * 2 - u * rho * 2 - rho * self.rise
        cubic = u.square() * 4 + u * (alpha * 12 + 8) + 8 + pi_alpha * 6 + alpha.square() * 12
        yield u.square().square() * pi_alpha * 16 - rho.square() * cubic

    @property
    def rise(self) -> Interval:
        """V."""
        alpha = self.alpha
        return ((-alpha.square() + 1).sqrt() - alpha * arccos(alpha)) * 4

    def points(self) -> None:
        """Compare the fixed points with one hit of each wall."""
        orbits = [orbit for orbit in self.orbits() if self.exists(orbit)]
        claims = self.claims["fixed_points"]
        need(len(claims) == len(orbits), f"fixed_points is not a list of {len(orbits)}")
        for n, (claim, orbit) in enumerate(zip(claims, orbits, strict=True)):
            x, v = self.start(orbit)
            computed = {"x": x, "v": v, "trace": orbit.trace}
            where = f"fixed_points[{n}]"
            self.compare(where, {key: claim[key] for key in computed}, computed)
            inside = self.p.l < claim["x"].lower and claim["x"].upper < self.p.r
            need(inside, f"{where} may be at a wall")
        self.step(f"with one hit of each wall, these {len(orbits)} orbits exist and no other")

    def exists(self, orbit: Orbit) -> bool:
        """Return whether the least speed is positive."""
        need(not orbit.slowest.contains_zero(), "the sign of a least speed is not decided")
        return orbit.slowest.is_positive()

    def orbits(self) -> Iterator[Orbit]:
        """Yield what the closed form has, whether it exists or not."""
        limit = self.number(2) / self.pi()
        below = self.alpha.is_before(limit)
        need(below or limit.is_before(self.alpha), "f may be 2F/pi")
        need(below or self.hints["asymmetry"] is None, "there is no pair, and asymmetry is given")
        for sign in (1, -1) if below else ():
            orbit = Symmetric.of(self.alpha, self.rho, sign)
            need(not orbit.hit_speed.contains_zero(), "the sign of a hit speed is not decided")
            if orbit.hit_speed.is_positive():
                trace = (-orbit.k + 2).square() - 2
                yield Orbit(orbit.t_1, orbit.hit_speed, trace, orbit.slowest)
        yield from self.pair() if below else ()

    def pair(self) -> Iterator[Orbit]:
        """Yield the asymmetric orbits."""
        c, hint = birth(self.rho), self.hints["asymmetry"]
        exists = c is not None and self.alpha.is_before(friction(c))
        decided = exists or c is None or friction(c).is_before(self.alpha)
        need(decided, "whether there is a pair is not decided")
        need((hint is not None) == exists, "asymmetry is given, or not, against the formulas")
        if hint is None:
            return
        low, high = hint
        need(0 < low < high < Fraction(3, 2), "asymmetry is not in (0, 3/2)")
        pairs, ends = over_intervals(self.rho), (self.number(low), self.number(high))
        early, late = (pairs.at(end).alpha.constant for end in ends)
        need(late.is_before(self.alpha) and self.alpha.is_before(early), "asymmetry is elsewhere")
        delta = self.between((low, high))
        found = pairs.at(delta)
        u_1, u_2 = (u.constant for u in found.speeds)
        least, angle = slowest(found), arccos(found.S.constant)
        least = Interval(min(least.lo, u_2.lo), min(least.hi, u_2.hi), least.bits)
        trace = found.trace.constant
        yield Orbit(angle - delta, u_1, trace, least)
        yield Orbit(angle + delta, u_2, trace, least)

    def start(self, orbit: Orbit) -> tuple[Interval, Interval]:
        """Return x and v at t = 0."""
        t, u, alpha = orbit.t, orbit.u, self.alpha
        cos, sin = cos_sin(t)
        need(not t.contains_zero(), "a mass may be at the right wall at t = 0")
        s = 1 if t.is_positive() else -1
        V = u * s - sin
        v = velocity(V, -t, alpha * s, 0)
        gap = -place(cos, V, -t, alpha * s / 2, 1)
        length, scale = (self.number(self.p.F / self.omega**k) for k in (2, 1))
        return self.number(self.p.r) - gap * length, v * scale

    def families(self) -> None:
        """Decide whether there are orbits that touch no wall."""
        limit = self.number(2) / (self.pi().square() + 4).sqrt()
        exist = self.alpha.is_before(limit)
        need(exist or limit.is_before(self.alpha), "whether orbits may turn is not decided")
        if exist:
            stroke = (-(self.pi() * self.alpha / 2).square() + 1).sqrt() * 2
            fits, hits = stroke.is_before(self.rho), self.rho.is_before(stroke)
            need(fits or hits, "whether orbits that touch no wall fit is not decided")
            exist = fits
        need(self.claims["families"] == ["segment"] * exist, "families are not those that exist")
        self.step("the family of orbits that touch no wall is named, if it exists")

    def launches(self) -> None:
        """Follow the launches of orbits with more hits."""
        tree, flights = self.hints["tree"], iter(self.hints["flights"])
        count, size = 0, Fraction(0)
        need((tree is None) == (self.claims["most_hits"] < 2), "the tree is missing, or needless")
        need(self.pi().upper * 2 < LONGEST, "a period is too long")
        gap = Gap(self.alpha, self.rho)
        for word, t, u in leaves(tree, self.claims["highest_speed"]) if tree else ():
            if word == OPEN:
                count, size = count + 1, size + (t[1] - t[0]) * (u[1] ** 2 - u[0] ** 2) / 2
            else:
                told = next(flights, None)
                need(told is not None, "flights has fewer boxes than the tree")
                empty(gap, self.between(t), self.between(u), self.windows(str(told)))
        need(next(flights, None) is None, "flights has more boxes than the tree")
        claim = self.claims["undecided"]
        need(count == claim["boxes"] and size <= claim["size"], "undecided is more than claimed")
        self.step("no orbit with more hits of a wall begins in a box that is not left open")

    def between(self, ends: tuple[Fraction, Fraction]) -> Interval:
        """Return an enclosure of an interval."""
        return Interval.enclosing(ends[0], ends[1], self.hints["bits"])

    def windows(self, told: str) -> Iterator[Window]:
        """Yield the windows of a box."""
        for part in told.split(","):
            match = PART.fullmatch(part)
            if match is None:
                raise Rejected("flights are not up to three numbers each")
            a, *others = match.groups()
            ends = [None if k is None else self.at(int(a) + int(k)) for k in others]
            begin = self.at(int(a))
            yield Window(begin, ends[0] or begin, ends[1])

    def at(self, k: int) -> Phase:
        """Return the phase k/UNIT."""
        return phase(self.number(Fraction(k, UNIT)))

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.told("".join(self.sentences()))

    def sentences(self) -> Iterator[str]:
        """Yield the sentences."""
        points, open_ = self.claims["fixed_points"], self.claims["undecided"]
        count = f"exactly {len(points)}" if points else "no"
        if open_["boxes"]:
            count = f"at least {len(points)}"
        yield f"{_SYSTEM}{count} fixed point{'' if len(points) == 1 else 's'}{_VELOCITY}"
        for k, point in enumerate(points):
            yield ("; " if k else ": ") + _POINT.format_map(point)
        yield _BOUNDS
        if open_["boxes"]:
            yield _UNDECIDED.format_map(open_)
        yield _FAMILY if self.claims["families"] else ""


def leaves(tree: str, U: Fraction) -> Iterator[tuple[str, Any, Any]]:
    """Yield the leaves of a tree: the word, and the box as pairs of ends."""
    waiting = [((Fraction(0), LONGEST), (Fraction(0), U), 0)]
    for word in tree:
        need(bool(waiting), "the tree goes on after its end")
        t, u, depth = waiting.pop()
        if word in (EMPTY, OPEN):
            yield word, t, u
            continue
        need(depth < MAX_DEPTH, "the tree is too deep")
        side = t if word == HALVES_T else u
        middle = (side[0] + side[1]) / 2
        halves = (middle, side[1]), (side[0], middle)
        waiting += [(h, u, depth + 1) if side is t else (t, h, depth + 1) for h in halves]
    need(not waiting, "the tree ends before its end")


_SYSTEM = (
    "x'' = F cos(omega t) - f sgn x' with F = {F}, omega = {omega}, f = {f} and elastic walls at "
    "{l} and {r}, T = 2 pi/omega: the time-T map has "
)
_VELOCITY = " with l < x < r whose velocity never vanishes"
_POINT = "x in {x}, v in {v}, with a trace in {trace} and {hits} hits in a period"
_BOUNDS = (
    "; no T-periodic orbit whose velocity never vanishes is faster than {highest_speed} F/omega, "
    "or hits a wall more than {most_hits} times in a period"
)
_UNDECIDED = (
    "; others, if there are any, hit each wall more than once in a period, and leave a wall in one "
    "of {boxes} boxes of launches of the size {size} F^2/omega^3"
)
_FAMILY = (
    "; besides, the T-periodic orbits that touch no wall are a family, turn twice in a period, and "
    "are not counted"
)

THEOREM = Inventory
