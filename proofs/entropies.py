"""Theorem (entropies).  Let f range over [f', f''], and let G be the release map of
`cap.proofs.attractor` for each f.  If the lemmas succeed, then, but for an explicit share of the
range,

 (i)   G maps an interval I into its interior, and is unimodal there; I is given for each strip of
       values of f, for the middle of it, and moves with f at a given speed by θ;
 (ii)  on each piece of a strip the first symbols of the kneading sequence are those claimed; where
       one may depend on f it is ?;
 (iii) the topological entropy of G on I lies between the bounds claimed for the piece;
 (iv)  on some pieces a cycle of G attracts the critical point.

The shares of the range with positive entropy, and with such a cycle, are claimed.  Not claimed:
that the entropy is monotone in f, or that there is no cycle elsewhere.

Proof.  All with θ = arccos(f/F) as a variable of Taylor models, in a coordinate that moves with f
(`cap.release.family`).  Where the events on a cell differ by a turn from those next to it, G is
still continuously differentiable (`cap.release.halt`).
"""

import json
from dataclasses import asdict, replace
from fractions import Fraction
from functools import partial
from math import ceil, floor, log
from typing import Any

from cap.certificate import NONE
from cap.certificate.writer import exact, window
from cap.checker.release.strip import MOST_ENTROPY
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.flow.windows import Itinerary
from cap.parameters import Parameters
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.options import JOBS, JOURNAL, RANGE_OF_F, whole_range_of_f
from cap.proofs.strip_hints import CHECKED, Referee
from cap.release import kneading, piece
from cap.release.cell import slack
from cap.release.family import Family
from cap.release.passage import words
from cap.release.strip import Core, core, cover, proved
from cap.release.trap import critical_points
from cap.sets import interval
from cap.subdivision import UNDECIDED, Cell, cells_between, subdivide

SUMMARY = "the entropy for all f of a range (attractor --from --to), in pieces; attracting cycles"
GROUP = "releases"
SEARCH = candidates.range_of_f
OPTIONS = (*RANGE_OF_F, JOBS, JOURNAL)
CHECK = whole_range_of_f

BITS = 80
STEP = Fraction(1, 500)  # of F: the strips, at first
FINEST = Fraction(1, 16)  # of a strip, at least
WEAK = STEP / 4  # of F: wider strips are halved if the entropy of a piece may be 0
PARTS = 8  # of a strip, at most: the pieces
WIDE = Fraction(1, 20)  # bounds of the entropy that are close enough
PLACES, SHARP = 6, 40  # decimals of the entropy, bits of slopes


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    low, high = whole_range_of_f(setting.options, setting.parameters)
    number = ceil((high - low) / (STEP * setting.parameters.F))
    cuts = [low + (high - low) * Fraction(k, number) for k in range(number + 1)]
    step = partial(examine, setting.parameters)
    smallest = (high - low) / number * FINEST
    key = f"entropies at {setting.parameters}, {STEP}, {PARTS}, {WIDE}, {WEAK}, {BITS} bits"
    found = subdivide(step, cells_between(cuts), smallest, setting.runner, key)
    strips = [_read(verdict) for _, verdict in found if verdict != UNDECIDED]
    if not strips:
        raise NotProved("Lemma 1", "for no f of the range an interval is found")
    kinds = {(strip["half_periods"], strip["turn"]) for strip in strips}
    if len(kinds) > 1:
        raise NotProved("Lemma 1", "the release maps differ too much over the range: take parts")
    ((halves, turn),) = kinds
    claims = {
        "range": [exact(low), exact(high)],
        "half_periods": halves,
        "turn": turn,
        "strips": [strip["claim"] for strip in strips],
        **shares(strips, high - low),
    }
    hints = {"bits": str(CHECKED), "strips": [strip["hint"] for strip in strips]}
    strings = setting.parameters.strings()
    del strings["f"]
    return settled("entropies", setting, strings, (claims, hints))


def _read(verdict: str) -> Any:
    """Return what is proved of a strip, from a verdict of `examine`."""
    try:
        return json.loads(verdict)
    except ValueError:
        raise BadInput(f"the journal is damaged: {verdict[:40]!r}; remove it") from None


def shares(strips: list[Any], length: Fraction) -> dict[str, str]:
    """Return the shares of the range."""
    pieces = [q for strip in strips for q in strip["claim"]["pieces"]]

    def share(chosen: list[Any]) -> Fraction:
        ends = [[Fraction(end) for end in q["f"]] for q in chosen]
        return sum((b - a for a, b in ends), Fraction(0)) / length

    return {
        "positive": str(share([q for q in pieces if Fraction(q["entropy"][0]) > 0])),
        "periodic": str(share([q for q in pieces if q["cycle"] != NONE])),
        "undecided": str(1 - share(pieces)),
    }


def examine(p: Parameters, cell: Cell) -> str:
    """Return what is proved of a strip of f, as JSON, or `UNDECIDED`."""
    middle = replace(p, f=(cell.lower + cell.upper) / 2)
    with interval.workprec(BITS):
        for near in critical_points(middle):
            try:
                strip = lemma_1_strip(middle, near, cell)
            except NotProved:
                continue
            wide = cell.upper - cell.lower > WEAK * p.F
            return UNDECIDED if wide and weak(strip) else json.dumps(strip)
    return UNDECIDED


def weak(strip: dict[str, Any]) -> bool:
    """Return whether the entropy of a piece may be 0 and may be positive: finer strips may tell."""
    bounds = [tuple(map(Fraction, q["entropy"])) for q in strip["claim"]["pieces"]]
    return any(low <= 0 < high for low, high in bounds)


def lemma_1_strip(p: Parameters, near: float, cell: Cell) -> dict[str, Any]:
    """*Statement.* For all f of a strip G is unimodal on I, which it maps into its interior.

    *Computed.* H, H' and, near the critical point, H'' over cells of y times the strip.
    """
    found = core(p, near, *cell)
    checker = Referee(found)
    cells = cover(found, checker.follows)
    turn = proved(found, cells)
    checker.begin(cells, turn)
    pieces = lemma_2_pieces(found, checker, turn, found.family.part(*cell))
    exact = interval.exact_decimal
    return {
        "half_periods": str(cells[0].half_periods),
        "turn": "minimum" if turn > 0 else "maximum",
        "claim": {
            "interval": [exact(found.lower), exact(found.upper)],
            "shear": str(found.family.shear),
            "pieces": [claim for claim, _ in pieces],
        },
        "hint": {
            "cells": [_hint(c.upper, slack(c.times)) for c in cells],
            "pieces": [hint for _, hint in pieces],
        },
    }


def _hint(to: Fraction, events: Itinerary) -> dict[str, Any]:
    return {
        "to": str(to),
        "words": list(words(events)),
        "events": [window(event.window) for event in events],
    }


def lemma_2_pieces(
    found: Core, checker: Referee, turn: int, part: Family, depth: int = 1
) -> list[tuple[Any, Any]]:
    """*Statement.* The symbols, the bounds of the entropy, and cycles, piece by piece.

    *Computed.* The images of the critical point as Taylor models in θ.
    """
    try:
        claim, hint = lemma_2_piece(found, checker, turn, part)
        low, high = map(Fraction, claim["entropy"])
        close = low > 0 and high - low <= WIDE
        unproved = claim["cycle"] == NONE and piece.foreseen_cycle(part.p, found, part.p.f)[0]
        if (close and not unproved) or depth >= PARTS:
            return [(claim, hint)]
    except NotProved:
        if depth >= PARTS:
            raise
    middle = (part.low + part.high) / 2
    halves = part.part(part.low, middle), part.part(middle, part.high)
    return [q for half in halves for q in lemma_2_pieces(found, checker, turn, half, 2 * depth)]


def lemma_2_piece(
    found: Core, checker: Referee, turn: int, part: Family
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Prove what is claimed of one piece; the checker agrees."""
    near = piece.line(found, part)
    c, value = piece.critical_point(found, part, near, turn)
    images = list(piece.images(found, part, value))
    sequence = piece.symbols([y.places(part) for y in images], c, turn)
    hint = {name: interval.exact_decimal(q) for name, q in asdict(near).items()}
    known = checker.images(part, sequence, near)
    cycle = piece.attracting(found, part, images, partial(checker.contracts, part, known))
    return claim_of(part, sequence[: len(known)], cycle), hint


def claim_of(part: Family, sequence: str, cycle: piece.Attracting | None) -> dict[str, Any]:
    """Return what is claimed of a piece."""
    return {
        "f": [exact(part.low), exact(part.high)],
        "kneading": sequence,
        "entropy": entropy(sequence),
        "cycle": NONE
        if cycle is None
        else {name: exact(Fraction(q)) for name, q in asdict(cycle).items()},
    }


def entropy(sequence: str) -> list[str]:
    """Return decimal bounds of the entropy, from symbols some of which may be ?."""
    least, most = (kneading.extreme(sequence, least=which) for which in (True, False))
    low, high = kneading.slopes(least, SHARP)[0], kneading.slopes(most, SHARP)[1]
    lower = Fraction(floor(log(low) * 10**PLACES - 1 / 8), 10**PLACES) if low > 1 else Fraction(0)
    upper = Fraction(ceil(log(high) * 10**PLACES + 1 / 8), 10**PLACES) if high > 1 else Fraction(0)
    upper = min(upper, MOST_ENTROPY)
    for h, symbols, sign in ((lower, least, 1), (upper % MOST_ENTROPY, most, -1)):
        s = interval.ball(h).exp()
        if h > 0 and kneading.compared(symbols, kneading.tent(s)) != sign:
            raise NotProved("Lemma 2", "the bounds of the entropy are not certain", {"h": h})
    return [interval.decimal(lower, PLACES), interval.decimal(upper, PLACES)]
