"""Theorem (mixed).  Let f > 0, e = 1, μ = 0.  Consider the states of

    x'' = F cos ωt - f sgn x',   l < x < r,   v -> -v at the walls,   T = 2π/ω,

with l < x < r, |v| < V at t = 0.  There are explicit numbers such that of the area of this box

 (i)   at least `shares.attractor` tends to the orbits released in A (theorem `attractor`), to
       periodic orbits that stick, of `cycles`, or to periodic orbits that turn, of `sinks`,
 (ii)  at least `shares.segment` converges to T-periodic orbits that touch no wall (`segment`),
 (iii) at least `shares.either` does one of both,
 (iv)  at least `shares.stops` stops at least once, all these included,
 (v)   at most `never_stopping_area` never stops.

Proof.  After a stick the state is one number, the place of the release, and what becomes of places
is found in rounds (`cap.proofs.places`).  Almost each state that stops is what becomes of its first
stop backwards in time, after so many half periods, before the stop before.  So stops, by place and
time, are cut into regions, which are followed backwards with the density of their area, and
different stops give different states: the areas are added.  A first stop that is a stick has the
fate of its place; from turns parts of the regions are followed forwards to the stick, or into a
strip in which all go to the segment, or an ellipse that the flow contracts.  Subtracted is what may
lie over places without the fate.

What attracts is looked for: where neither an interval as in `attractor`, nor a cycle, nor a sink,
nor orbits as in `segment` are found and proved, nothing is said of them.

The theorems `attractor` and `segment` are proved here in balls; places, and the regions of stops,
are followed in outward-rounded doubles (`cap.areas.folded`).  There is one proof alone, the
checker's, of cycles, of sinks, and of how much of the places has a fate
(`cap.checker.attracting.cycles`, `sinks`, and `cap.checker.folded.masses`): its functions are
called here.
"""

from dataclasses import replace
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

from cap.areas.folded import stops
from cap.areas.folded.cuts import cheapest, dearest
from cap.areas.folded.missing import FATES, Known, means
from cap.areas.folded.missing import known as masses_of
from cap.areas.folded.stops import SPANS, Releases, Sticks, Trees
from cap.areas.folded.trees import Floats, Plan
from cap.areas.listing import written
from cap.certificate.writer import dumps
from cap.checker.folded.masses import Places
from cap.checker.folded.tree import NOTHING
from cap.checker.kernel.certificate import read
from cap.checker.system.walls import WITHOUT_LOSSES
from cap.checker.theorems.mixed import Mixed
from cap.errors import BadInput, NotProved, TooFewDigits
from cap.floats import candidates
from cap.maps.fixed_point import Start
from cap.option import Option, exact_part, exact_positive
from cap.proofs import attractor, cycles, places, segment, sinks
from cap.proofs.fixed_point import Proof, Setting, assembled
from cap.proofs.options import JOBS
from cap.release.trap import critical_points
from cap.runner import Tell, within
from cap.sets import interval
from cap.sets.compiled import PROBE, require_ieee, rounds_to_nearest

SUMMARY = "lower bounds of the shares of the states that are attracted, or stop"
GROUP = "states"
SEARCH = candidates.fates
CHECKING, PLACES = 0.5, 0.5  # parts of the time: of all, and of that before the checker's
SPEED = Option(
    "speed",
    exact_positive,
    "for states |v| < Q (default 3/2 R omega)",
    "Q",
)
UNDECIDED = Option(
    "undecided",
    exact_part,
    "go on until of at most the part Q of the states neither fate is shown (default: as far as "
    "75000 regions go)",
    "Q",
)
OPTIONS = (JOBS, SPEED, UNDECIDED)
SLACK = Fraction(1, 2000)  # of a share, at first: the checker cannot follow all that the prover can
STROBES = 40  # that may count for an orbit from a stop
POINTS = 6  # of a region, in each direction, from which orbits tell what to hope for


class Effort(NamedTuple):
    """What is missing of areas before regions are cut, backwards and forwards, and how many are.

    At most ``back`` regions are followed backwards, and ``ahead`` parts of them forwards.
    """

    worth: float
    onwards: float
    back: int
    ahead: int


USUAL = Effort(6e-6, 3e-6, 13_000, 75_000)  # if nothing is asked for
# until it is what is asked for
EFFORTS = (
    Effort(2e-5, 2e-5, 6000, 30_000),
    USUAL,
    Effort(4e-6, 1.2e-6, 16_000, 300_000),
    Effort(2e-6, 4e-7, 40_000, 800_000),
)


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    if setting.parameters.e != 1 or setting.parameters.mu:
        raise BadInput("the theorem mixed is about e = 1, mu = 0")
    require_ieee(rounds_to_nearest(PROBE))
    hints = {
        "bits": str(setting.checker_bits),
        "places": {"level": str(places.LEVEL), "tree": NOTHING},
        "stops": dict.fromkeys(Trees._fields, written([0])),
    }
    nested = dict[str, Any]()
    if attracts := chaotic(setting):
        nested["attractor"], hints["attractor"] = attracts["claims"], attracts["hints"]
    if attracted := touching_nothing(setting):
        nested["segment"] = attracted["claims"]
    if turning := sinks.contracted(setting.parameters, draft(setting, nested, hints)):
        nested["sinks"] = turning
        setting.progress(f"{len(turning)} ellipses around states of attracting cycles")
    if found := cycles.contracted(setting.parameters, draft(setting, nested, hints)):
        nested["cycles"] = found
        setting.progress(f"{len(found)} attracting cycles of releases")
    parts = lemma_shares(setting, draft(setting, nested, hints), hints)

    def proof(part: Fraction) -> dict[str, Any]:
        slack = SLACK * 4 ** round(5 * (Fraction(9, 10) - part))
        enough_left(setting, 1 - parts[2] + slack)
        return certificate_of(setting, claims_of(setting, parts, slack) | nested, hints)

    return proof


def draft(setting: Setting, nested: dict[str, Any], hints: dict[str, Any]) -> Mixed:
    """Return the checker's theorem, with what is known to attract, and no shares."""
    nothing = (Fraction(0),) * 4
    content = certificate_of(setting, claims_of(setting, nothing, SLACK) | nested, hints)
    return Mixed(read(dumps({**content, "provenance": {}}).encode()), silent)


def chaotic(setting: Setting) -> dict[str, Any] | None:
    """Return a certificate of the theorem `attractor`, if it is proved around a critical point."""
    for x in critical_points(setting.parameters):
        try:
            return attractor.prove(replace(setting, guess=Start(x, 0.0, ())))(Fraction(1))
        except TooFewDigits:
            raise
        except (BadInput, NotProved) as problem:
            setting.progress(f"no attractor around x = {x:.6g}: {problem}")
    return None


def touching_nothing(setting: Setting) -> dict[str, Any] | None:
    """Return a certificate of the theorem `segment`, if it is proved."""
    try:
        return segment.prove(setting)(Fraction(1))
    except TooFewDigits:
        raise
    except (BadInput, NotProved) as problem:
        setting.progress(f"no segment: {problem}")
        return None


def silent(_step: str) -> None:
    """Hear nothing."""


def lemma_shares(setting: Setting, theorem: Mixed, hints: dict[str, Any]) -> tuple[Fraction, ...]:
    """*Statement.* Such parts of the box are attracted, go to the segment, do either, and stop.

    *Computed.* Stops are followed backwards and forwards, in ever smaller regions until no more is
    undecided than asked for.  The trees are added to the hints.
    """
    tell = setting.runner.tell
    known, hints["places"]["tree"] = by_places(setting, theorem, within(tell, 0, PLACES))
    releases = releases_of(theorem, known)
    whole = 2 * theorem.region()[0] * theorem.region()[1]
    wanted: Fraction | None = setting.of(UNDECIDED)
    enough = None if wanted is None else (1 - wanted + SLACK) * whole
    efforts = (USUAL,) if wanted is None else EFFORTS
    for k, effort in enumerate(efforts, 1):
        tries = f"try {k} of at most {len(efforts)}: " if len(efforts) > 1 else ""
        runner = replace(setting.runner, tell=within(tell, PLACES, 1, tries))
        plan = Plan(effort.worth, STROBES, points=POINTS, onwards=effort.onwards)
        p, V = setting.parameters, speed_of(setting)
        trees = stops.search(p, V, releases, plan, runner)
        runner.tell("regions are chosen", 1.0)
        areas, hints["stops"] = counted(trees, releases, effort, enough)
        shares = tuple(area / whole for area in areas)
        if wanted is None or 1 - shares[2] + SLACK <= wanted:
            break
    enough_left(setting, 1 - shares[2] + SLACK)
    return shares


def enough_left(setting: Setting, left: Fraction) -> None:
    """Raise `NotProved` if neither fate is shown for more than was asked for."""
    wanted: Fraction | None = setting.of(UNDECIDED)
    if wanted is not None and left > wanted:
        reason = f"of the part {float(left):.4f} neither fate is shown"
        most = f"with {EFFORTS[-1].ahead} regions; {wanted} was asked for"
        raise NotProved("share", f"{reason}, {most}")


def releases_of(theorem: Mixed, known: Places) -> Releases:
    """Return what is known of releases, for what is compiled."""
    return Releases(theorem.basins(), masses_of(known))


def counted(
    trees: Trees, releases: Releases, effort: Effort, enough: Fraction | None
) -> tuple[tuple[Fraction, ...], dict[str, str]]:
    """Return the areas for the fates and of all that stops, and the regions chosen, as text.

    There are at most as many as the effort allows, and not many more than for an area with either
    fate that is ``enough``.
    """
    *sticks, turns = trees
    fated = [areas_of(tree, releases.known) for tree in sticks]
    worths = [*(each[2] for each in fated), turns.areas]
    price = dearest(trees, worths, effort.back)
    *stuck, back = (tree.best(worth, price) for tree, worth in zip(trees, worths, strict=True))
    ended = [[below_sum(z[rows]) for z in each] for each, rows in zip(fated, stuck, strict=True)]
    total = [sum(each, Fraction(0)) for each in zip(*ended, strict=True)]
    onwards = turns.onwards(back)
    price = dearest([turns], [onwards], effort.ahead)
    if enough is not None:
        wanted = float(enough - total[2]) + turns.lost(back)
        price = max(price, cheapest([turns], [onwards], wanted * (1 + 1e-9)))
    ahead = turns.best(onwards, price)
    found = [*turns.areas_of(back, ahead).T, turns.areas[back]]
    areas = tuple(known + below_sum(w) for known, w in zip(total, found, strict=True))
    late, early = (tree.text(rows) for tree, rows in zip(sticks, stuck, strict=True))
    return areas, {"late": late, "early": early, "turns": turns.text(back, ahead)}


def below_sum(areas: Floats) -> Fraction:
    """Return the sum of areas, exactly."""
    return sum(map(Fraction, areas.tolist()), Fraction(0))


def areas_of(tree: Sticks, known: Known) -> tuple[Floats, ...]:
    """Return the areas for the fates, and of all that stops, from each region (N,), from below."""
    spans, lost = tree.spans(SPANS), np.empty((len(FATES), len(tree.areas)))
    for fate, found in enumerate(lost):
        means(known, fate, spans, found)
    fated = (np.maximum(0.0, tree.areas - tree.weights * more) * (1 - 1e-12) for more in lost)
    return (*fated, tree.areas)


def by_places(setting: Setting, theorem: Mixed, tell: Tell) -> tuple[Places, str]:
    """Return what is known of places of release, and the tree of those that are followed."""
    parts = theorem.basins(), theorem.kept(), theorem.scale.width()
    search = places.Search(setting.parameters, *parts, tell)
    tree = search.run(places.WORTHS)
    return search.places(places.LEVEL), tree


def speed_of(setting: Setting) -> Fraction:
    """Return V."""
    p = setting.parameters
    V: Fraction = setting.of(SPEED) or Fraction(3, 2) * p.R * p.omega
    return V


def claims_of(setting: Setting, found: tuple[Fraction, ...], slack: Fraction) -> dict[str, Any]:
    """Return the claims about the shares found, less some slack."""
    p = setting.parameters
    V = speed_of(setting)
    a, s, either, known = (max(Fraction(0), share - slack) for share in found)
    area = 2 * p.R * V
    claimed = {
        "attractor": (a, 1 - s),
        "segment": (s, 1 - a),
        "either": (max(a + s, either), Fraction(1)),
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
