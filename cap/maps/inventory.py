"""Where the T-periodic orbits with several hits of each wall and no zero velocity may launch.

Units and names are those of `cap.maps.launch_set`: α = f/F, G = Rω²/F, e = 1, μ = 0.

*Bounds.*  Let u = |v| > 0 be the speed of a T-periodic orbit whose velocity never vanishes, s = sgn
v, X the place from the middle, |X| <= G/2.  u is continuous, u' = s cos t - α, s = X'/u.  Over a
period, integrating by parts,

    2πα = ∫ s cos t = ∫ X' cos t/u = ∫ X (sin t/u + u' cos t/u²) <= (G/2)(4/u_0 + 2V/u_0²),

u_0 the least speed and V = 4 (sqrt(1 - α²) - α arccos α), the integral of the positive part of
|cos t| - α, which u' does not exceed: so the rises of u, and its falls, add up to V at most.  Hence
2πα u_0² - 2G u_0 - GV <= 0, which bounds u_0.  By parts once more on each flight, from hit to hit,
with Z = (X² - G²/4)/2, Z' = s u X, which vanishes at hits, |Z| <= G²/8, u'' = -s sin t:

    2πα = -∫ s Z (cos t/u² - (4 s sin t cos t - 3α sin t)/u³ - 3 (s cos t - α)² cos t/u⁴)
       <= (G²/8) (4/u_0² + (8 + 12α)/u_0³ + (8 + 6πα + 12α²)/u_0⁴),

which bounds u_0, too, and better unless G is small.  u is nowhere above U = u_0 + V; and m hits of
each wall in a period need 2mG <= 2πU.

*Search.*  Of the 2m launches of such an orbit take the slowest, (t, u), 0 <= t <= 2π, 0 < u <= U.
Later ones (t_k, u_k), k = 1, ..., 2m, have u_k >= u, and t_k - kπ - t, the time that has passed, is
at most 2π, and 2π, with u_k = u, for k = 2m.  A box of launches is empty if, following it for some
flights, one of this fails for all: for each even k >= 4 on the way it must be certain that the
orbits do not close.  That is proved where the map is smooth by Krawczyk's operator: if

    -C g(0) + (1 - C ∂g) ε,    g = (t_k - kπ - 2π - t, u_k - u),

does not meet the box of ε, or g(0) + ∂g ε does not contain 0, g has no zero there.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, NamedTuple

from cap.maps.launch_set import Constants, LaunchSet, Window, fly, is_smooth
from cap.maps.launch_window import window
from cap.sets import interval
from cap.sets.interval import Ball

EMPTY, SPLIT_T, SPLIT_U, OPEN = ".", "t", "u", "?"
WIDEST = 1.0  # larger boxes are halved at once
PROGRESS = 500  # boxes
SHARP = 2**20  # of the bound of u_0
SPEEDS = 1000


class TooMany(Exception):
    """The boxes of launches are more than they may be."""


class Effort(NamedTuple):
    """Boxes are halved ``depth`` times at most; ``most`` leaves are not too many."""

    depth: int
    most: int


class Bounds(NamedTuple):
    """U, a multiple of 1/SPEEDS, and the largest m: none is faster, or has more hits of a wall."""

    speed: Fraction
    hits: int


class Box(NamedTuple):
    """Launches, in fractions of the whole: [k, k + 1] 2^-depth of its sides."""

    t: int
    u: int
    t_depth: int
    u_depth: int


@dataclass
class Tree:
    """All boxes, halved until they are empty or small; ``text`` has the words in preorder.

    ``flights`` has the windows of each empty box; ``open`` are those that are left.
    """

    text: list[str] = field(default_factory=list)
    flights: list[list[Window]] = field(default_factory=list)
    open: list[Box] = field(default_factory=list)


def bounds(system: Constants) -> Bounds:
    """Return the bounds for α > 0."""
    a, rise = 2 * system.pi * system.alpha, 4 * (system.sine - system.alpha * system.arc)
    G = system.width
    least = (G + (G * G + a * G * rise).sqrt()) / a
    bound = min(interval.ends(least)[1], _least(system)) + interval.ends(rise)[1]
    speed = Fraction(int(bound * SPEEDS) + 1, SPEEDS)
    return Bounds(speed, int(interval.ends(system.pi * interval.ball(speed) / G)[1]))


def _least(system: Constants) -> Fraction:
    """Return a bound of u_0: more than the only positive root of a polynomial of degree 4."""
    alpha, G = system.alpha, system.width
    a, b = 16 * system.pi * alpha, 8 + 12 * alpha
    c = 8 + 6 * system.pi * alpha + 12 * alpha * alpha

    def excess(u: Ball) -> Ball:
        return a * u**4 - G * G * (4 * u * u + b * u + c)

    low, high = Fraction(0), Fraction(1)
    while not excess(interval.ball(high)) > 0:
        low, high = high, 2 * high
    while high - low > high / SHARP:
        middle = (low + high) / 2
        low, high = (low, middle) if excess(interval.ball(middle)) > 0 else (middle, high)
    return high


def tree(
    system: Constants, sides: tuple[Ball, Ball], effort: Effort, tell: Callable[[int, int], None]
) -> Tree:
    """Return a tree of the launches in [0, T] × [0, U], ``sides`` = (T, U), or raise `TooMany`.

    ``tell`` hears of the boxes done and waiting.
    """
    found, waiting, done = Tree(), [Box(0, 0, 0, 0)], 0
    while waiting:
        if len(found.flights) + len(found.open) + len(waiting) > effort.most:
            raise TooMany
        box = waiting.pop()
        done += 1
        if done % PROGRESS == 0:
            tell(done, len(waiting))
        t, u = launches_of(box, sides)
        large = t.rad() > WIDEST / 2 or u.rad() > WIDEST / 2
        first = LaunchSet.of_box(t, u, own=True)
        windows = None if large else proved_empty(system, first)
        if windows is not None:
            found.text.append(EMPTY)
            found.flights.append(windows)
        elif box.t_depth + box.u_depth >= effort.depth:
            found.text.append(OPEN)
            found.open.append(box)
        else:
            word, halves = _halves(box, sides)
            found.text.append(word)
            waiting += reversed(halves)
    return found


def launches_of(box: Box, sides: tuple[Ball, Ball]) -> tuple[Ball, Ball]:
    """Return the launches of a box."""
    t, u = Ball(box.t), Ball(box.u)
    parts = interval.hull(t, t + 1) / 2**box.t_depth, interval.hull(u, u + 1) / 2**box.u_depth
    return parts[0] * sides[0], parts[1] * sides[1]


def _halves(box: Box, sides: tuple[Ball, Ball]) -> tuple[str, list[Box]]:
    """Return the halves of a box, across its longer side, the lower one first."""
    t, u, k, n = box
    if float(sides[0].mid()) / 2**k >= float(sides[1].mid()) / 2**n:
        return SPLIT_T, [Box(2 * t + i, u, k + 1, n) for i in (0, 1)]
    return SPLIT_U, [Box(t, 2 * u + i, k, n + 1) for i in (0, 1)]


def proved_empty(system: Constants, first: LaunchSet) -> list[Window] | None:
    """Return windows with which a box of launches is proved empty, or None."""
    now, windows, k = first, list[Window](), 0
    latest = interval.upper(first.hull[0].x)
    while True:
        found = window(system, now, latest + (k + 2) * system.pi)
        if found is None:
            return None
        if found.a < found.b and not is_smooth(system, now, found):
            found = found._replace(m=None)
        windows.append(found)
        after = None if found.b <= found.a else fly(system, now, found)
        if after is None:
            return windows
        now, k = after, k + 1
        passed, faster = change(system, first, now, k)
        if passed > 2 * system.pi or faster < 0:
            return windows
        if k % 2 == 0 and k > 2 and not open_(system, (passed, faster), first, now, k):
            return None


def change(system: Constants, first: LaunchSet, now: LaunchSet, k: int) -> tuple[Ball, Ball]:
    """Return the time passed since the first launch, and how much faster the k-th one is."""
    (t, u), (x, w) = (first.hull[0].x, first.hull[1]), (now.hull[0].x, now.hull[1])
    passed, faster = x - t - k * system.pi, w - u
    if now.own:
        (a, b), (c, d) = now.matrix
        one = now.centre.x - first.centre.x - k * system.pi + now.spread(a - 1, b)
        other = now.speed - first.speed + now.spread(c, d - 1)
        passed, faster = interval.intersection(passed, one), interval.intersection(faster, other)
    return passed, faster


def open_(
    system: Constants, changes: tuple[Ball, Ball], first: LaunchSet, now: LaunchSet, k: int
) -> bool:
    """Return whether no orbit closes after k flights."""
    late, faster = changes[0] - 2 * system.pi, changes[1]
    if not (late.contains(0) and faster.contains(0)):
        return True
    if not now.own:
        return False
    defect = now.centre.x - first.centre.x - (k + 2) * system.pi, now.speed - first.speed
    return _excluded(now.matrix, defect, now.reach)


def _excluded(matrix: Any, defect: tuple[Ball, Ball], reach: tuple[Ball, Ball]) -> bool:
    """Return whether Krawczyk's operator excludes a zero of g, g(0) = ``defect``."""
    (a, b), (c, d) = matrix
    a, d = a - 1, d - 1
    p, q, r, s = (interval.point(x) for x in (a, b, c, d))
    det = interval.point(p * s - q * r)
    if det == 0 or not det.is_finite():
        return False
    p, q, r, s = (interval.point(x / det) for x in (s, -q, -r, p))
    x, y = interval.symmetric(reach[0]), interval.symmetric(reach[1])
    first = (1 - p * a - q * c) * x - (p * b + q * d) * y - (p * defect[0] + q * defect[1])
    second = (1 - r * b - s * d) * y - (r * a + s * c) * x - (r * defect[0] + s * defect[1])
    return not (first.overlaps(x) and second.overlaps(y))
