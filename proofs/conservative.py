"""Theorem (conservative).  Let e = 1, μ = 0, 0 < f < F.

Ω_NS is the set of the states (x, v) at t = 0 whose velocity never vanishes afterwards.  Its area is
at most ``area``, and almost all of it has |v| <= ``speed``.

Proof (all of it in `cap.checker.theorems.conservative` and the modules that it names).

1. *Section.*  In the mirror image every hit begins a flight from the left wall, a launch (t, E), E
   = u²/2.  The flight map G preserves dt dE.  The area is the integral of the flight time over the
   launches S that never stop, divided by π; on average that time is π: so it is the measure of S.
2. *High speeds.*  Over two flights u² decreases above V_0, and cannot rise above V_1 from below.
   As G² is injective, preserves the measure, and the part of S below V_1 has finite measure and
   is mapped into itself, almost nothing of S comes from above V_1.
3. *Ceiling.*  W = E + a cos(t - b): each flight with u <= V_1 leads below W = c, or W decreases.
   A bijection that preserves a finite measure decreases no bounded function: so W <= c on S.
4. *Strips.*  Launches end alike (they stop, or leave by the ceiling, after the same number of
   flights) in strips along the direction that is contracted.  Columns of times are cut into cells
   between parabolas; each flies into cells of lower levels.  Forward orbits, and backward ones, as
   G is onto S.  Only the boundaries of cells are followed, as arcs, to the second order.
5. *Area.*  What the cells of both families leave is at most ``area``.

The cells are found in doubles, by compiled code, and nothing rests on that; it tries cells as the
checker does, and a little more strictly.  Columns of times in which much is lost are halved, in
rounds whose steps a journal keeps; at last those cells are left out that take away little.  It is
the checker's verdict on all of them that proves the theorem: no other proof of it is made here.
"""

import math
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise

from cap.areas.listing import listed, runs, written
from cap.areas.strips import strips
from cap.areas.strips.cover import Cover
from cap.areas.strips.rounds import Round, Rounds
from cap.areas.strips.strips import GRAIN, World
from cap.checker.kernel.doubles import enclosing
from cap.checker.kernel.rejection import Rejected
from cap.checker.strips.ceiling import Flights, descends
from cap.checker.strips.columns import LINE, Column, columns
from cap.checker.strips.overlap import Gap, gaps, left
from cap.checker.strips.strips import Ceiling
from cap.checker.strips.strips import World as Checked
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.option import Option, count
from cap.parameters import Parameters
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.options import JOBS, JOURNAL
from cap.runner import Runner, within
from cap.sets.compiled import PROBE, require_ieee, rounds_to_nearest

SUMMARY = "an upper bound of the area of the states whose velocity never vanishes"
GROUP = "states"
SEARCH = candidates.every_motion
CHECKING, SEARCHING = 0.5, 0.9  # parts of the time: of all, and of that before the checker's

USUAL = 25  # flights that launches are followed, forward and backward
FLIGHTS = Option(
    "flights",
    count(1, 60),
    f"launches are followed for N flights forward and backward, 1 to 60 (default {USUAL}); more "
    "take longer, and leave less",
    "N",
    default=USUAL,
)
OPTIONS = (FLIGHTS, JOBS, JOURNAL)
WIDE = Fraction(1, 64)  # of columns, at first
FINE = 1 / 2048  # of the narrowest columns
ROUGH = 20  # flights, before columns are cut
LOSSES = 1e-7, 1e-7  # of area for each of its cells: a column that loses more is cut, twice
WORTH = 1.25e-7  # the area that a cell takes away is at least this
LESS, LEAST = (1e-7, 5e-8, 3e-8), 1e-9  # the same for more than `USUAL` flights
COARSE = GRAIN._replace(step=6e-5, thin=1e-5)  # how fine cells are then, before columns are cut
LONGER = GRAIN._replace(step=1.2e-5, thin=3e-6, halvings=7)  # and after that
CEILING = (
    Fraction(4, 5),
    Fraction(1, 10),
    Fraction(16, 25),
)  # of R/2, of 1 and of R/2, near f = 2F/5


def prove(setting: Setting) -> Proof:
    """Find cells; there is no box whose size is left to choose."""
    p = setting.parameters
    if not (p.f > 0 and p.e == 1 and p.mu == 0):
        raise BadInput("the theorem conservative needs f > 0, e = 1 and mu = 0")
    require_ieee(rounds_to_nearest(PROBE))
    R = p.R * p.omega**2 / p.F
    ceiling = CEILING[0] * R / 2, CEILING[1], CEILING[2] * R / 2
    lemma_3_ceiling(p, ceiling)
    a, b, c = map(float, ceiling)
    lines = strips.lines(strips.window(a, b, c), WIDE)
    world = World(float(p.f / p.F), float(R), a, b, c, lines)
    flights: int = setting.of(FLIGHTS)
    begin = partial(_begun, p, ceiling)
    tell = setting.runner.tell
    search = replace(setting.runner, tell=within(tell, 0, SEARCHING))
    world, family = _rounds(flights).found(world, begin, search)
    family = strips.worthy(family, LEAST if flights > USUAL else WORTH)
    half = (1 + SEARCHING) / 2
    work = replace(search, journal=None, whole=True, tell=within(tell, SEARCHING, half))
    texts, found = zip(*work.map(_read, family, "families are listed", processes=True), strict=True)
    work = replace(work, tell=within(tell, half, 1))
    hints = {
        "ceiling": dict(zip(("height", "phase", "level"), map(str, ceiling), strict=True)),
        "lines": _lines(world.lines),
        **dict(zip(("forward", "backward"), texts, strict=True)),
    }
    claims = {
        "area": _above(_area(world, work, *found) * float(p.F**2 / p.omega**3)),
        "speed": _speed(p.F / p.omega, (ceiling[0] + ceiling[2]), (p.F - p.f) * p.R),
    }
    parameters = p.elastic_strings()
    return settled("conservative", setting, parameters, (claims, hints))


def lemma_3_ceiling(p: Parameters, ceiling: tuple[Fraction, Fraction, Fraction]) -> None:
    """*Statement.* Almost all launches that never stop are below the ceiling.

    *Computed.* By the checker: it takes two seconds, and is asked before the search for strips.
    """
    top = Ceiling(*map(enclosing, ceiling))
    try:
        descends(Flights(enclosing(p.f / p.F), enclosing(p.R * p.omega**2 / p.F)), top)
    except Rejected as reason:
        words = "the function of the ceiling may not decrease: these parameters need another one"
        raise NotProved("Lemma 3", f"{words} ({reason})") from None


def checked(p: Parameters, world: World, ceiling: tuple[Fraction, Fraction, Fraction]) -> Checked:
    """Return the same world for the checker, without columns."""
    sign = 1 if world.f > 0 else -1
    f, R = enclosing(sign * p.f / p.F), enclosing(p.R * p.omega**2 / p.F)
    top = Ceiling(enclosing(ceiling[0]), enclosing(sign * ceiling[1]), enclosing(ceiling[2]))
    return Checked(f, R, top, list(world.lines), [])


def _rounds(flights: int) -> Rounds:
    """Return in which rounds cells are found."""
    deep, rough = flights > USUAL, min(flights, ROUGH)
    losses, grain, last = (LESS, COARSE, LONGER) if deep else (LOSSES, GRAIN, GRAIN)
    cuts = [Round(rough, grain, loss) for loss in losses]
    return Rounds((*cuts, Round(flights, last, 0)), FINE)


def _begun(
    p: Parameters, ceiling: tuple[Fraction, Fraction, Fraction], world: World
) -> strips.Family:
    """Return columns without cells, with those bottoms that the checker accepts."""
    covers = world.cover(), world.mirrored.cover()
    for each, cover in zip((world, world.mirrored), covers, strict=True):
        referee = checked(p, each, ceiling)
        referee.columns = _columns(_text(cover))
        for j in range(len(cover.top)):
            cover.has_bottom[j] = cover.has_bottom[j] and _accepts(referee, j)
    return covers


def _read(cover: Cover) -> tuple[str, list[list[Gap]]]:
    """Return the text of a family, and the gaps of its columns as the checker reads them."""
    text = _text(cover)
    return text, [*map(gaps, _columns(text))]


def _text(cover: Cover) -> str:
    return listed([runs(cover, j) for j in range(len(cover.top))])


def _columns(text: str) -> list[Column]:
    """Return the columns that the checker reads; it refuses those that are too long."""
    try:
        return columns(text)
    except Rejected as reason:
        raise NotProved("Lemma 4", f"the cells are too many for the checker ({reason})") from None


def _accepts(referee: Checked, j: int) -> bool:
    """Return whether the checker accepts the ends of a column."""
    try:
        referee.ends(j)
    except Rejected:
        return False
    return True


def _lines(lines: tuple[float, ...]) -> str:
    """Return the lines as text."""
    units = [round(t / LINE) for t in lines]
    return written([units[0], *(b - a for a, b in pairwise(units))])


def _area(world: World, runner: Runner, *found: list[list[Gap]]) -> float:
    """Return the area that is left, in units F = ω = 1."""
    words = "the area that is left is bounded"
    areas = left(lambda f, tasks: runner.map(f, [*tasks], words, processes=True), *found)
    widths = [b - a for a, b in pairwise(world.lines)]
    return math.fsum(w * area for w, area in zip(widths, areas, strict=True))


def _above(x: float) -> str:
    """Return a decimal of four places above a number."""
    if not x < 10**6:
        raise NotProved("area", "the area that is left is too large", {"area": x})
    return f"{math.floor(x * 10**4) / 10**4 + 1e-4:.4f}"


def _speed(speed: Fraction, energy: Fraction, work: Fraction) -> str:
    """Return a decimal above sqrt(2 energy speed² + 2 work)."""
    square = 2 * energy * speed**2 + 2 * work
    return str(Fraction(math.isqrt(math.ceil(square * 10**8)) + 1, 10**4))
