"""Theorem (mixed).  Let f > 0, e = 1, μ = 0.  Consider the states of

    x'' = F cos ωt - f sgn x',   l < x < r,   v -> -v at the walls,   T = 2π/ω,

with l < x < r, |v| < V at t = 0.  There are explicit numbers such that of the area of this box

 (i)   at least `shares.attractor` tends to the orbits released in A (theorem `attractor`),
 (ii)  at least `shares.segment` converges to T-periodic orbits that touch no wall (`segment`),
 (iii) at least `shares.stops` stops at least once, the first two included,
 (iv)  at most `never_stopping_area` never stops.

Proof.  After a stick the state is one number, the place of the release, and a table of places,
made in rounds, gives their fates.  Almost each state that sticks is what becomes of its first stick
backwards in time, after so many half periods.  So all sticks, by place and time, are cut into
regions, which are followed backwards with the density of their area; there nothing sticks, and
different sticks give different states: the areas are added, less what lies over places without the
fate.  States in which the mass never sticks go to the segment, or are not counted: they are found
backwards from a strip in which all go there.

The theorems `attractor` and `segment` are proved here in balls, the regions of sticks are followed
in outward-rounded doubles (`cap.cells.sticks`).  The places and the strip are followed by the
arithmetic of the checker (`cap.checker.folded`), which is asked for what it can count: there is no
second one for them.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from typing import Any

from cap.cells import sticks
from cap.cells.listing import written
from cap.cells.sticks import Leaf, Tree
from cap.cells.trees import Plan
from cap.certificate.writer import dumps
from cap.checker.folded.backward import System
from cap.checker.folded.regions import UNIT, Region
from cap.checker.folded.regions import Leaf as Followed
from cap.checker.folded.sticks import entered, half_strip, strip_area
from cap.checker.folded.table import ATTRACTOR, SEGMENT, Table
from cap.checker.kernel.certificate import read
from cap.checker.kernel.theorem import WITHOUT_LOSSES
from cap.checker.theorems.mixed import Mixed, below
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.proofs import attractor, segment
from cap.proofs.fixed_point import Proof, Setting, assembled
from cap.sets import interval

SUMMARY = "shares of the states: attracted, to the segment, stopping, undecided"
SEARCH = candidates.releasing
OPTIONS = ("jobs", "speed", "undecided")
SPEED = Fraction(3, 2)  # in units of R omega: 3 at the paper's parameters
SLACK = Fraction(1, 10**3)  # of a share: where the checker cannot follow as far as the prover
PLACES = {"parts": "512", "cuts": "6", "depth": "10"}
WORTH, LEAST = 1e-4, 1e-7  # areas that are missing of a region before it is cut: at first, at last
STRIP, FLIGHTS = 2e-4, 24  # a part of the strip that is not cut: its size; flights followed
SMALL = 0.02  # times the worth: leaves that give less are not listed

Measures = tuple[Fraction, Fraction, Fraction]


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    if setting.parameters.e != 1 or setting.parameters.mu:
        raise BadInput("the theorem mixed is about e = 1, mu = 0")
    attracts, attracted = (each.prove(setting)(Fraction(1)) for each in (attractor, segment))
    nested = {"attractor": attracts["claims"], "segment": attracted["claims"]}
    hints = {
        "bits": str(setting.checker_bits),
        "attractor": attracts["hints"],
        "places": PLACES,
        "sticks": {"early": "A", "late": "A"},
        "strip": {"slow": "A", "fast": "A"},
    }
    draft = certificate_of(setting, claims_of(setting, (0, 0, 0)) | nested, hints)
    theorem = Mixed(read(dumps({**draft, "provenance": {}}).encode()), silent)
    parts = lemma_shares(setting, theorem, hints)
    proved = certificate_of(setting, claims_of(setting, parts) | nested, hints)
    return lambda _part: proved


def silent(_step: str) -> None:
    """Hear nothing."""


def lemma_shares(setting: Setting, theorem: Mixed, hints: dict[str, Any]) -> tuple[Fraction, ...]:
    """*Statement.* Such parts of the box are attracted, go to the segment, and stop.

    *Computed.* Sticks are followed backwards, in ever smaller regions until no more is undecided
    than asked for.  The trees are added to the hints.
    """
    runner = setting.runner

    def work(f: Callable[[Any], Any], tasks: Any) -> list[Any]:
        return runner.map(f, list(tasks), "releases", processes=True)

    table = theorem.table(work)
    strip, hints["strip"] = by_strip(theorem)
    W, V = theorem.region()
    worth = WORTH
    while True:
        trees = sticks.search(setting.parameters, speed_of(setting), Plan(worth), runner)
        (a, s, stops), texts = counted(trees, table, worth * SMALL)
        shares = tuple(area / (2 * W * V) for area in (a, s + strip, stops + strip))
        hints["sticks"] = dict(zip(("early", "late"), texts, strict=True))
        if setting.undecided is None or 1 - shares[0] - shares[1] <= setting.undecided - 2 * SLACK:
            return shares
        worth /= 4
        if worth < LEAST:
            raise NotProved(
                f"of the part {float(1 - shares[0] - shares[1]):.4f} neither fate is shown, with "
                f"regions down to an area of {4 * worth:.0e}; {float(setting.undecided)} was asked"
            )


def counted(
    trees: tuple[Tree, Tree], table: Table, least: float
) -> tuple[Measures, tuple[str, ...]]:
    """Return the areas for the fates and of all that sticks, and the trees without small leaves."""
    total, texts = [Fraction(0)] * 3, list[str]()
    for tree in trees:
        leaves = [areas_of(leaf, table) for leaf in tree.leaves()]
        kept = [found[2] > least for found in leaves]
        for found, keep in zip(leaves, kept, strict=True):
            if keep:
                total = [a + Fraction(b) for a, b in zip(total, found, strict=True)]
        texts.append(tree.text(kept))
    return (total[0], total[1], total[2]), tuple(texts)


def areas_of(leaf: Leaf, table: Table) -> tuple[float, float, float]:
    """Return the areas for the fates, and of all that sticks, from a region."""
    lost = [leaf.weight * table.missing(leaf.place, fate) for fate in (ATTRACTOR, SEGMENT)]
    a, s = (max(0.0, (leaf.area - more) * (1 - 1e-12)) for more in lost)
    return a, s, leaf.area


def by_strip(theorem: Mixed) -> tuple[Fraction, dict[str, str]]:
    """Return the area of states that go to the segment without a stick, and the trees for it."""
    y, strip = System(theorem.p), theorem.strip()
    V = below(theorem.region()[1])
    total, texts = Fraction(strip_area(y, strip)), dict[str, str]()
    for name, fast in (("slow", False), ("fast", True)):
        root, (low, high) = half_strip(y, strip, fast=fast)
        search = partial(entering, lambda leaf, f=fast: entered(y, strip, V, (leaf, f)))
        numbers, area = search(root, (high - low) * strip.k)
        total += Fraction(area)
        texts[name] = written(numbers)
    return total, texts


def entering(area: Callable[[Followed], float], region: Region, long: float) -> Any:
    """Return the tree of a region, and the area that it gives; ``long``: its size along z."""
    found = area(Followed(region, FLIGHTS))
    wide = (region.high[0] - region.low[0]) * UNIT
    here = long * 0.5**region.n
    if found or wide * here < STRIP:
        return ([FLIGHTS + 2], found) if found else ([0], 0.0)
    parts = region.parts((0, 0, 0)) if wide > here else region.halves()
    (first, a), (second, b) = (entering(area, part, long) for part in parts)
    if not a + b:
        return [0], 0.0
    return [*([2, 0, 0, 0] if wide > here else [1]), *first, *second], a + b


def speed_of(setting: Setting) -> Fraction:
    """Return V."""
    p = setting.parameters
    return setting.speed or SPEED * p.R * p.omega


def claims_of(setting: Setting, found: tuple[Fraction | int, ...]) -> dict[str, Any]:
    """Return the claims about the shares found, with some slack."""
    p = setting.parameters
    V = speed_of(setting)
    a, s, known = (max(Fraction(0), share - SLACK) for share in found)
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
