"""Theorem (mixed).  Let f > 0, e = 1, μ = 0.  Consider the states of

    x'' = F cos ωt - f sgn x',   l < x < r,   v -> -v at the walls,   T = 2π/ω,

with l < x < r, |v| < V at t = 0.  There are explicit numbers such that of the area of this box

 (i)   at least `shares.attractor` tends to the orbits released in A (theorem `attractor`),
 (ii)  at least `shares.segment` converges to T-periodic orbits that touch no wall (`segment`),
 (iii) at least `shares.stops` stops at least once, the first two included,
 (iv)  at most `never_stopping_area` never stops.

Proof.  After a stick the state is one number, the place of the release, and a table of places,
made in rounds, gives their fates (`cap.proofs.places`).  The box is divided into leaves; each is
followed, in quadratic models, until its orbits are released, and cut where this fails; the parts of
a leaf are counted whose releases all lie in an interval of one fate.

The theorems `attractor` and `segment` are proved here in balls.  The leaves are followed by the
arithmetic of the checker (`cap.checker.folded`), which is asked for what it can count: there is no
second one.  The tests compare its fates with orbits in floats, and with `cap.cells`.
"""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any

from cap.certificate.writer import dumps
from cap.checker.folded.fates import Judge
from cap.checker.folded.places import shares
from cap.checker.folded.tree import NOTHING
from cap.checker.kernel.certificate import read
from cap.checker.kernel.theorem import WITHOUT_LOSSES
from cap.checker.theorems.mixed import Mixed
from cap.errors import BadInput
from cap.floats import candidates
from cap.proofs import attractor, places, segment
from cap.proofs.fixed_point import Proof, Setting, assembled
from cap.proofs.places import Work
from cap.sets import interval

SUMMARY = "shares of the states: attracted, to the segment, stopping, undecided"
SEARCH = candidates.releasing
OPTIONS = ("jobs", "speed", "cuts")
SPEED = Fraction(3, 2)  # in units of R omega: 3 at the paper's parameters
SLACK = Fraction(1, 10**5)  # of a share: libraries may steer otherwise by rounding
COLUMNS, ROWS, CUTS, DEPTH = 64, 192, 4, 6
HALVED = 9  # most halvings of a leaf in all, on average: the checker does no more work
HOPE = 0.1  # part of what is undecided that one cut more may decide, if none was before
FIRST, MOST, ROUNDS = 1, 9, 8  # cuts of a leaf; rounds in which they are chosen


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    if setting.parameters.e != 1 or setting.parameters.mu:
        raise BadInput("the theorem mixed is about e = 1, mu = 0")
    attracts, attracted = (each.prove(setting)(Fraction(1)) for each in (attractor, segment))
    nested = {"attractor": attracts["claims"], "segment": attracted["claims"]}
    hints = {
        "bits": str(setting.checker_bits),
        "attractor": attracts["hints"],
        "places": {"level": str(places.LEVEL), "tree": NOTHING},
        "columns": str(COLUMNS),
        "rows": str(ROWS),
        "depth": str(halvings(setting)),
        "leaves": str(FIRST) * (COLUMNS * ROWS),
    }
    draft = certificate_of(setting, claims_of(setting, (0, 0, 0)) | nested, hints)
    theorem = Mixed(read(dumps({**draft, "provenance": {}}).encode()), silent)
    tree, judge = lemma_places(setting, theorem)
    hints["places"]["tree"] = tree
    hints["leaves"], parts = lemma_shares(setting, theorem, judge)
    proved = certificate_of(setting, claims_of(setting, parts) | nested, hints)
    return lambda _part: proved


def silent(_step: str) -> None:
    """Hear nothing."""


def halvings(setting: Setting) -> int:
    """Return how many times more than it is cut a leaf is halved: the checker limits the sum."""
    return min(DEPTH, HALVED - cuts_of(setting))


def cuts_of(setting: Setting) -> int:
    """Return how often leaves are cut, on average."""
    return CUTS if setting.cuts is None else setting.cuts


class Sorted:
    """The leaves, with the cuts of each, and the counts with the last two numbers of cuts."""

    def __init__(self, setting: Setting, theorem: Mixed, judge: Judge) -> None:
        self.work, self.judge = work_of(setting, "leaves"), judge
        self.leaves, self.p = list(theorem.leaves()), theorem.p
        self.depth = halvings(setting)
        self.cuts = [FIRST - 1] * len(self.leaves)
        self.counts = [(0, 0, 0)] * len(self.leaves)
        self.gains = [1.0] * len(self.leaves)
        self.refine(range(len(self.leaves)))
        self.refine(range(len(self.leaves)))

    def refine(self, chosen: Sequence[int]) -> None:
        """Cut some leaves once more."""
        for n in chosen:
            self.cuts[n] += 1
        tasks = [self.leaves[n].cut(self.cuts[n], self.depth) for n in chosen]
        counted = self.work(partial(shares, self.p, self.judge), tasks)
        for n, counts in zip(chosen, counted, strict=True):
            before = self.part(n, self.counts[n], -1)
            self.counts[n] = counts
            self.gains[n] = self.part(n, counts) - before

    def part(self, n: int, counts: tuple[int, int, int], less: int = 0) -> float:
        """Return which part of a leaf has a fate."""
        return (counts[0] + counts[1]) / float(1 << self.cuts[n] + self.depth + less)

    def hope(self, n: int) -> float:
        """Return what one cut more of a leaf may gain, for each piece: it steers."""
        left = 1 - self.part(n, self.counts[n])
        return (self.gains[n] + HOPE * left) / (1 << self.cuts[n]) if left else 0.0

    def spend(self, room: int) -> None:
        """Cut leaves once more, those that gain most, until the number of pieces is this."""
        chosen = list[int]()
        for n in sorted(range(len(self.cuts)), key=lambda n: -self.hope(n)):
            if self.cuts[n] == MOST:
                continue
            room -= 1 << self.cuts[n]
            if room < 0:
                break
            chosen.append(n)
        self.refine(chosen)

    @property
    def pieces(self) -> int:
        """The number of pieces into which all leaves are cut."""
        return sum(1 << cuts for cuts in self.cuts)


def work_of(setting: Setting, words: str) -> Work:
    """Return a map over tasks that tells of its progress."""
    runner = replace(setting.runner, journal=None)
    return lambda f, tasks: runner.map(f, list(tasks), words, processes=True)


def lemma_places(setting: Setting, theorem: Mixed) -> tuple[str, Judge]:
    """*Statement.* Such releases are attracted, or go to the segment, by intervals of places.

    *Computed.* Nodes of a tree are followed, as by the checker.  Returns the tree, and what tells
    fates.
    """
    width, strip = theorem.width(), theorem.strip()
    work = work_of(setting, "releases")
    found = places.Search(theorem.p, strip, theorem.kept(), width, work, places.LEVEL)
    tree = found.run(places.WORTHS)
    return tree, Judge(strip, found.places().table)


def lemma_shares(
    setting: Setting, theorem: Mixed, judge: Judge
) -> tuple[str, tuple[Fraction, ...]]:
    """*Statement.* Such parts of the box are attracted, go to the segment, and otherwise stop.

    *Computed.* All leaves are followed, as by the checker; those are cut more that gain by it.
    Returns how often each is cut, and the parts.
    """
    found = Sorted(setting, theorem, judge)
    wanted = len(found.leaves) << cuts_of(setting)
    for n in range(ROUNDS):
        found.spend((wanted - found.pieces) // (ROUNDS - n))
    letters = "".join(map(str, found.cuts))
    return letters, theorem.parts(found.counts, letters)


def claims_of(setting: Setting, found: tuple[Fraction | int, ...]) -> dict[str, Any]:
    """Return the claims about the shares found, with some slack."""
    p = setting.parameters
    V = setting.speed or SPEED * p.R * p.omega
    a, s, stops = (max(Fraction(0), share - SLACK) for share in found)
    known = a + s + stops
    area = 2 * p.R * V
    claimed = {
        "attractor": (a, 1 - s),
        "segment": (s, 1 - a),
        "stops": (known, Fraction(1)),
        "undecided": (Fraction(0), 1 - known),
    }
    return {
        "box": {"x": [str(p.l), str(p.r)], "v": [str(-V), str(V)]},
        "shares": {name: outward(*ends, 6) for name, ends in claimed.items()},
        "never_stopping_area": outward(Fraction(0), (1 - known) * area, 6),
    }


def outward(lower: Fraction, upper: Fraction, places: int) -> list[str]:
    """Return decimals with so many places around an interval."""
    scale = 10**places
    ends = Fraction(lower * scale // 1, scale), Fraction(-(-upper * scale // 1), scale)
    return [interval.decimal(end, places) for end in ends]


def certificate_of(
    setting: Setting, claims: dict[str, Any], hints: dict[str, Any]
) -> dict[str, Any]:
    """Return a certificate with these claims and hints."""
    strings = setting.parameters.strings()
    kept = {name: strings[name] for name in WITHOUT_LOSSES}
    return assembled("mixed", setting, kept, (claims, hints))
