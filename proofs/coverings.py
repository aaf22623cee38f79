"""Coverings between parallelograms, proved; what the theorems on horseshoes share.

A family comes from floats.  Its sets are made exact; each covering is proved, or given up;
coverings that make a diamond are given up, the least important first; what is left grows by an
integer vector.  The lemmas: `cap.checker.coverings.covering` and `cap.checker.coverings.graph`.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import Any, Literal, NamedTuple, get_args

import numpy as np

from cap.areas.parallelograms.covering import Engine, numbers
from cap.areas.parallelograms.planar import Planar as Compiled
from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.graph import overlaps
from cap.checker.coverings.planar import Planar
from cap.checker.kernel.rejection import Rejected
from cap.errors import NotProved
from cap.floats.candidates import Family
from cap.maps.graphs import Part, Places, fastest
from cap.proofs.closed_paths import Orbit, periodic_orbits
from cap.proofs.cones import Cones, cones, with_cones
from cap.runner import Runner
from cap.sets import interval

SIGNIFICANT, SCALE, PLACES = 12, 10**16, 8  # digits of the sets, of the vector, of the claims
Edge = tuple[int, int]
Sets = list[list[Fraction]]
Which = Literal["any", "disjoint", "hyperbolic"]
WHICH: tuple[Which, ...] = get_args(Which)
ABOUT = (
    "any: sets may overlap, for more entropy (default); disjoint: they do not, for a "
    "semiconjugacy; hyperbolic: coverings without cones are left out, too, for hyperbolicity and "
    "a conjugacy"
)


class Asked(NamedTuple):
    """A map: for the functions of the checker, and, if there is such code, compiled."""

    exact: Planar
    compiled: Compiled | None = None


class Proved(NamedTuple):
    """Sets with proved coverings, without diamonds, and the growth of their graph."""

    sets: Sets
    edges: list[list[int]]
    vector: list[int]
    growth: Fraction
    together: int
    orbits: list[Orbit] = []  # noqa: RUF012 (never changed)
    cones: Cones | None = None

    def hints(self) -> dict[str, Any]:
        """Return what the certificate says of them."""
        return {
            "sets": [[interval.exact_decimal(n) for n in numbers] for numbers in self.sets],
            "coverings": [[str(j) for j in targets] for targets in self.edges],
            "vector": [str(v) for v in self.vector],
            **({"cones": self.cones.hints()} if self.cones else {}),
        }

    def claims(self, iterates: int) -> dict[str, Any]:
        """Return the claims; the map that they are about is an iterate."""
        return {
            "growth": interval.decimal(self.growth, PLACES),
            "entropy": interval.decimal(entropy(self.growth, iterates), PLACES),
            "together": str(self.together),
            **({"orbits": self.orbits} if self.orbits else {}),
            **({"cones": self.cones.claims()} if self.cones else {}),
        }


def first_that_grows(g: Asked, found: Iterable[Family], runner: Runner, which: Which) -> Proved:
    """Return what is proved of the first family whose graph grows; `NotProved` if none does."""
    reason = "no saddle of the map is found in floats"
    for each in found:
        if each.growth <= 1:
            reason = "no sets that cover each other in two loops are found: more --effort may help"
            continue
        try:
            return proved(g, each, runner, which)
        except NotProved as failure:
            reason = str(failure)
    raise NotProved("search", reason)


def proved(g: Asked, found: Family, runner: Runner, which: Which) -> Proved:
    """Return what is proved of a family; `NotProved` if its graph does not grow."""
    sets = [[_short(float(n)) for n in row] for row in found.sets]
    edges = lemma_1_coverings(g, sets, found, runner)
    part, edges = lemma_2_no_diamond(sets, edges, disjoint=which != "any")
    if part.growth <= 1:
        raise NotProved("Lemma 2", "the coverings that are proved make no two loops")
    if which == "hyperbolic":
        edges = with_cones(g.exact, sets, edges, runner)
        part = _fastest(edges, len(sets))
        if part.growth <= 1:
            raise NotProved("Lemma 3", "the coverings with cones make no two loops")
    best = _certified(sets, part, edges)
    found_cones = cones(g.exact, best.sets, best.edges, runner) if best.together == 1 else None
    if which == "hyperbolic" and found_cones is None:
        raise NotProved("Lemma 3", "not all cones are mapped into cones")
    orbits = periodic_orbits(g.exact, best.sets, best.edges)
    return best._replace(orbits=orbits, cones=found_cones)


def lemma_1_coverings(g: Asked, sets: Sets, found: Family, runner: Runner) -> list[Edge]:
    """*Statement.* Sets cover sets.

    *Computed.* Each covering, by subdivision and the mean value form, in intervals of doubles;
    those that are not proved are left out.  Where the map is compiled, so is that.
    """
    targets: list[list[int]] = [[] for _ in sets]
    for i, j in zip(found.source.tolist(), found.target.tolist(), strict=True):
        targets[i].append(j)
    if g.compiled is not None:
        runner.tell("coverings are proved", None)
        return _compiled(Engine(g.compiled), sets, targets)
    tasks = [Task(i, sets[i], {j: sets[j] for j in of_i}) for i, of_i in enumerate(targets)]
    work = partial(_covered, g.exact)
    proved = runner.map(work, tasks, "coverings are proved", processes=True)
    return [(task.number, j) for task, held in zip(tasks, proved, strict=True) for j in held]


def _compiled(engine: Engine, sets: Sets, targets: list[list[int]]) -> list[Edge]:
    """Return the coverings that compiled code proves."""
    known = np.array([numbers(one) for one in sets])
    held = [engine.covered(known[i], known[of_i]) for i, of_i in enumerate(targets)]
    return [
        (i, j)
        for i, (of_i, which) in enumerate(zip(targets, held, strict=True))
        for j, is_held in zip(of_i, which.tolist(), strict=True)
        if is_held
    ]


class Task(NamedTuple):
    """A set with its number, and those that it seems to cover, by theirs."""

    number: int
    source: list[Fraction]
    targets: dict[int, list[Fraction]]


def _covered(g: Planar, task: Task) -> list[int]:
    """Return the sets that a set covers, proved."""
    source = Parallelogram(task.source)

    def held(which: list[int]) -> bool:
        try:
            covers(g.on(task.number), source, [Parallelogram(task.targets[j]) for j in which])
        except Rejected:
            return False
        return True

    every = list(task.targets)
    return every if held(every) else [j for j in every if held([j])]


def lemma_2_no_diamond(sets: Sets, edges: list[Edge], *, disjoint: bool) -> tuple[Part, list[Edge]]:
    """*Statement.* There is no diamond; or no two sets overlap.

    *Computed.* Exactly; the covering with the least flow is left out of each diamond found, and of
    two sets that overlap the one with the less flow.
    """
    overlapping = overlaps(sets)
    while True:
        part = _fastest(edges, len(sets))
        edges = [(i, j) for i, j in edges if part.right[i] > 0 and part.right[j] > 0]
        if not edges:
            return part, edges
        if disjoint:
            out = _one_of_two(part, edges, overlapping)
            kept = [(i, j) for i, j in edges if i not in out and j not in out]
        else:
            cut = set[Edge]()
            for diamond in diamonds(edges, overlapping):
                if not cut.intersection(diamond):
                    cut.add(min(diamond, key=partial(_flow, part)))
            kept = [edge for edge in edges if edge not in cut]
        if len(kept) == len(edges):
            return part, edges
        edges = kept


def _flow(part: Part, edge: Edge) -> float:
    return float(part.left[edge[0]] * part.right[edge[1]])


def _one_of_two(part: Part, edges: list[Edge], overlapping: Sequence[set[int]]) -> set[int]:
    """Return sets without which no two overlap: those with the less flow, one after the other."""
    weight, out = part.left * part.right, set[int]()
    used = {i for edge in edges for i in edge}
    for i in sorted(used, key=lambda i: (weight[i], i)):
        if overlapping[i] & (used - out):
            out.add(i)
    return out


def diamonds(edges: Sequence[Edge], overlapping: Sequence[set[int]]) -> Iterator[list[Edge]]:
    """Give diamonds, as their edges: at least one if there is any."""
    out: dict[int, list[int]] = {}
    for i, j in edges:
        out.setdefault(i, []).append(j)
    before: dict[Edge, Edge] = {}
    waiting = [(i, i) for i in out]
    for here in waiting:
        i, j = here
        for b in out.get(i, ()):
            for c in out.get(j, ()):
                if b == c and i < j:
                    yield list(_back(before, here, b))
                elif c in overlapping[b] and (b, c) not in before:
                    before[b, c] = here
                    waiting.append((b, c))


def _back(before: dict[Edge, Edge], here: Edge, end: int) -> Iterator[Edge]:
    """Give the edges of the two paths that lead to a vertex by a pair."""
    then = end, end
    while True:
        yield here[0], then[0]
        yield here[1], then[1]
        if here not in before:
            return
        here, then = before[here], here


def _fastest(edges: list[Edge], count: int) -> Part:
    source, target = _arrays(edges)
    return fastest(source, target, count)


def _arrays(edges: list[Edge]) -> tuple[Places, Places]:
    pairs = np.array(edges, dtype=np.int64).reshape(-1, 2)
    return pairs[:, 0].copy(), pairs[:, 1].copy()


def _certified(sets: Sets, part: Part, edges: list[Edge]) -> Proved:
    """Return the sets in use, renumbered, with an integer vector and what it proves."""
    used = sorted({i for edge in edges for i in edge})
    number = {i: k for k, i in enumerate(used)}
    lists: list[list[int]] = [[] for _ in used]
    for i, j in edges:
        lists[number[i]].append(number[j])
    largest = float(part.right.max())
    vector = [int(Fraction(float(part.right[i]) / largest) * SCALE) for i in used]
    ratios = [
        Fraction(sum(vector[j] for j in targets), v)
        for targets, v in zip(lists, vector, strict=True)
        if v > 0
    ]
    chosen = [sets[i] for i in used]
    together = 1 + max(map(len, overlaps(chosen)))
    return Proved(chosen, lists, vector, _rounded_down(min(ratios)), together)


def entropy(growth: Fraction, iterates: int) -> Fraction:
    """Return a lower bound of iterates log(growth)."""
    with interval.workprec(64):
        value = iterates * interval.ball(growth).log()
        return _rounded_down(interval.ends(value)[0])


def _rounded_down(q: Fraction) -> Fraction:
    return Fraction(math.floor(q * 10**PLACES), 10**PLACES)


def _short(x: float) -> Fraction:
    """Return a decimal of a few significant digits near a double."""
    places = SIGNIFICANT - 1 - (math.floor(math.log10(abs(x))) if x else 0)
    return Fraction(round(Fraction(x) * 10**places), 10**places)
