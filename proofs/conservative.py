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

The cells are found in doubles, by compiled code, and nothing rests on that; those that take away
little are left out.  Each is tried with the checker: those that do not hold are left out, too, and
it is the checker's verdict on all of them that proves the theorem.
"""

import json
import math
from dataclasses import replace
from fractions import Fraction
from functools import partial
from hashlib import sha256
from itertools import pairwise
from typing import Any

import numpy as np

from cap.cells import strips
from cap.cells.cover import Cover
from cap.cells.listing import Edge, edges_of, listed, runs, written
from cap.cells.strips import Family, World
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
OPTIONS = ("flights", "jobs", "journal")

FLIGHTS = 20  # that launches are followed, forward and backward, if nothing else is asked for
WIDE, FINE = Fraction(1, 64), Fraction(1, 256)  # widths of columns
WITHIN = 0.48, 0.84  # of the times: there columns are fine, as most of what is left is there
WORTH = 2e-7  # the area that a cell takes away is at least this
ROUNDS = 4  # of trying with the checker
PART = 16  # columns that are tried together
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
    R = p.R * p.omega**2 / p.F
    ceiling = CEILING[0] * R / 2, CEILING[1], CEILING[2] * R / 2
    lemma_3_ceiling(p, ceiling)
    a, b, c = map(float, ceiling)
    begin, end = strips.window(a, b, c)
    near = tuple(begin + part * (end - begin) for part in WITHIN)
    lines = strips.lines((begin, end), WIDE, FINE, (near[0], near[1]))
    world = World(float(p.f / p.F), float(R), a, b, c, lines)
    family = strips.found(world, setting.flights or FLIGHTS, setting.runner)
    family = tried(setting, world, ceiling, strips.worthy(family, WORTH))
    texts = [[listed(runs(each, j)) for j in range(len(lines) - 1)] for each in family]
    hints = {
        "ceiling": dict(zip(("height", "phase", "level"), map(str, ceiling), strict=True)),
        "lines": _lines(lines),
        **dict(zip(("forward", "backward"), texts, strict=True)),
    }
    claims = {
        "area": _above(_area(world, hints) * float(p.F**2 / p.omega**3)),
        "speed": _speed(p.F / p.omega, (ceiling[0] + ceiling[2]), (p.F - p.f) * p.R),
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


def tried(
    setting: Setting, world: World, ceiling: tuple[Fraction, Fraction, Fraction], family: Family
) -> Family:
    """Return the cells with which the checker succeeds."""
    worlds = zip(("forward", "backward"), (world, world.mirrored), family, strict=True)
    found = [
        _tried_all(
            _keeping(setting.runner, name), checked(setting.parameters, each, ceiling), cover
        )
        for name, each, cover in worlds
    ]
    return found[0], found[1]


def _tried_all(runner: Runner, world: Checked, cover: Cover) -> Cover:
    """Return the cells of a family with which the checker succeeds."""
    for _ in range(ROUNDS):
        bad = failing(runner, world, cover)
        if not bad:
            return cover
        cover, runner = _without(cover, bad), replace(runner, journal=None)
    raise NotProved("Lemma 4", "cells do not hold", {"cells": len(bad)})


def failing(runner: Runner, world: Checked, cover: Cover) -> list[tuple[int, Edge, Edge]]:
    """Return the cells with which the checker does not succeed, and their columns."""
    C = len(cover.top)
    texts = [_readable(listed(runs(cover, j))) for j in range(C)]
    parts = [(k, min(k + PART, C)) for k in range(0, C, PART)]
    key = f"cells {world.f} {world.R} {sha256(repr(texts).encode()).hexdigest()}"
    plan = Plan[tuple[int, int], Any](
        key,
        encode=json.dumps,
        decode=json.loads,
        total=C,
        weight=lambda part: part[1] - part[0],
        words="columns checked",
    )
    results = runner.run(partial(_tried, world, texts), parts, plan)
    return [(j, (a, b, c), (d, e, f)) for _, bad in results for j, (a, b, c), (d, e, f) in bad]


def _readable(text: str) -> str:
    """Return the text of a column; the checker refuses those that are too long."""
    try:
        column(text)
    except Rejected as reason:
        raise NotProved("Lemma 4", f"the cells are too many for the checker ({reason})") from None
    return text


def _tried(world: Checked, texts: list[str], part: tuple[int, int]) -> list[tuple[int, Edge, Edge]]:
    """Return the cells of some columns with which the checker does not succeed."""
    world.columns = [column(text) for text in texts]
    found = []
    for j in range(*part):
        levels = {0, *(level for run in world.columns[j] for level in run.levels)}
        found += [(j, *cell) for level in sorted(levels) for cell in fails(world, j, level)]
    return found


def _without(cover: Cover, bad: list[tuple[int, Edge, Edge]]) -> Cover:
    """Return the cells that hold without some others, and without some bottoms."""
    without = set(bad)
    for j, low, high in bad:
        if low == high:
            cover.has_bottom[j] = False
    own = strips.columns_of(cover).tolist()
    pairs = ((j, *edges_of(cover, i)) for i, j in enumerate(own))
    return strips.holding(strips.kept(cover, np.array([each not in without for each in pairs])))


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
