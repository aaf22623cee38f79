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

The strips are found in doubles, and nothing rests on that.  Each cell is tried with the checker as
soon as it is found: those that do not hold are left out, and it is the checker's verdict on all of
them that proves the theorem.
"""

import math
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any

from cap.cells.listing import Edge, Run, listed, written
from cap.cells.strips import World, all_strips, cut, even
from cap.checker.flow.ceiling import Flights, descends
from cap.checker.flow.columns import LINE, column
from cap.checker.flow.overlap import gaps, mirrored, shared
from cap.checker.flow.strips import Ceiling, fails
from cap.checker.flow.strips import World as Checked
from cap.checker.kernel.doubles import enclosing
from cap.checker.kernel.rejection import Rejected
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.parameters import Parameters
from cap.proofs.fixed_point import Proof, Setting, assembled
from cap.runner import Plan, Runner

SUMMARY = "an upper bound of the area of the states whose velocity never vanishes"
SEARCH = candidates.every_motion
OPTIONS = ("jobs", "journal")

FLIGHTS = 12  # that launches are followed, forward and backward
WIDTH = Fraction(1, 64)  # of columns
CEILING = (
    Fraction(4, 5),
    Fraction(1, 10),
    Fraction(16, 25),
)  # of R/2, of 1 and of R/2, near f = 2F/5

Found = list[tuple[int, Edge, Edge]]


def prove(setting: Setting) -> Proof:
    """Find cells; there is no box whose size is left to choose."""
    p = setting.parameters
    if not (p.f > 0 and p.e == 1 and p.mu == 0):
        raise BadInput("the theorem conservative needs f > 0, e = 1 and mu = 0")
    R = p.R * p.omega**2 / p.F
    a, b, c = CEILING[0] * R / 2, CEILING[1], CEILING[2] * R / 2
    lemma_3_ceiling(p, (a, b, c))
    scaled = float(p.f / p.F), float(R), float(a), float(b), float(c)
    world = World(*scaled, even(a, b, c, WIDTH), FLIGHTS)
    found = {}
    for name, each in (("forward", world), ("backward", world.mirrored)):
        columns = all_strips(each, _keeping(setting.runner, name))
        found[name] = cut(each, columns, partial(failing, setting, checked(p, each, (a, b, c))))
    hints = {
        "ceiling": {"height": str(a), "phase": str(b), "level": str(c)},
        "lines": _lines(world.lines),
        **{name: [listed(runs) for runs in each] for name, each in found.items()},
    }
    claims = {
        "area": _above(_area(world, hints) * float(p.F**2 / p.omega**3)),
        "speed": _speed(p.F / p.omega, (a + c), (p.F - p.f) * p.R),
    }
    parameters = p.elastic_strings()
    proved = assembled("conservative", setting, parameters, (claims, hints))
    return lambda _part: proved


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


def _keeping(runner: Runner, name: str) -> Runner:
    """Return a runner with a journal of its own for each family."""
    path = runner.journal
    return replace(runner, journal=path and path.with_name(f"{path.name}.{name}"))


def checked(p: Parameters, world: World, ceiling: tuple[Fraction, Fraction, Fraction]) -> Checked:
    """Return the same world for the checker, without columns."""
    sign = 1 if world.f > 0 else -1
    f, R = enclosing(sign * p.f / p.F), enclosing(p.R * p.omega**2 / p.F)
    top = Ceiling(enclosing(ceiling[0]), enclosing(sign * ceiling[1]), enclosing(ceiling[2]))
    return Checked(f, R, top, list(world.lines), [])


def failing(
    setting: Setting, world: Checked, columns: list[list[Run]], wanted: list[int], level: int
) -> Found:
    """Return the cells of a level with which the checker does not succeed."""
    own = setting.runner
    runner = Runner(own.jobs, own.tell, own.executor, whole=True)
    parts = [tuple(wanted[k : k + 8]) for k in range(0, len(wanted), 8)]
    plan = Plan[tuple[int, ...], Found](total=len(wanted), weight=len, words=f"level {level}")
    task = partial(_tried, world, [listed(runs) for runs in columns], level)
    return [each for _, found in runner.run(task, parts, plan) for each in found]


def _tried(world: Checked, texts: list[str], level: int, wanted: tuple[int, ...]) -> Found:
    """Return the cells of some columns with which the checker does not succeed."""
    world.columns = [column(text) for text in texts]
    return [(j, *cell) for j in wanted for cell in fails(world, j, level)]


def _lines(lines: tuple[float, ...]) -> str:
    """Return the lines as text."""
    units = [round(t / LINE) for t in lines]
    return written([units[0], *(b - a for a, b in pairwise(units))])


def _area(world: World, hints: dict[str, Any]) -> float:
    """Return the area that is left, in units F = ω = 1."""
    pairs = zip(hints["forward"], reversed(hints["backward"]), strict=True)
    left = [shared(gaps(column(one)), mirrored(gaps(column(two)))) for one, two in pairs]
    widths = [b - a for a, b in pairwise(world.lines)]
    return math.fsum(w * area for w, area in zip(widths, left, strict=True))


def _above(x: float) -> str:
    """Return a decimal of four places above a number."""
    if not x < 10**6:
        raise NotProved("area", "the area that is left is too large", {"area": x})
    return f"{math.floor(x * 10**4) / 10**4 + 1e-4:.4f}"


def _speed(speed: Fraction, energy: Fraction, work: Fraction) -> str:
    """Return a decimal above sqrt(2 energy speed² + 2 work)."""
    square = 2 * energy * speed**2 + 2 * work
    return str(Fraction(math.isqrt(math.ceil(square * 10**8)) + 1, 10**4))
