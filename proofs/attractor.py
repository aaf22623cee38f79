"""Theorem (attractor).  Let f > 0.  Consider

    x'' = F cos ωt - f sgn x' - μ x',   l < x < r,   v -> -e v at the walls,   T = 2π/ω,

and its release map G (`cap.release.passage`): a mass that has stuck at x and is released to the
right sticks next where it is released at G(x), a release to the left being mirrored by (x, v, t) ->
(l + r - x, -v, t + T/2).  If the lemmas below succeed, then

 (i)   G maps an explicit interval I into its interior.  All releases from I have the same events up
       to the next release, which is n half-periods later.
 (ii)  G is unimodal on I: it has one critical point c, inside; G' has one sign to the left of c,
       the other one to the right.
 (iii) The first symbols of the kneading sequence, the branches of G(c), G²(c), ..., are as claimed.
 (iv)  The topological entropy h of G on I lies in `entropy`; that of the time-T map from one time
       of releases to the right to the next, on the states at these times of the orbits released in
       A = ∩ Gᵏ(I) and of their mirror images, which is 2h/n, in `entropy_per_period`.  Here (wall,
       v) before a hit and (wall, -e v) after it are one state.
 (v)   All orbits from an explicit box of states at t = 0 come to be released in I, or to the left
       in its mirror image.  So an open set of states of positive area tends to the orbits released
       in A and their images.

If h > 0: some iterate of G has a horseshoe (Misiurewicz), G has periodic points of infinitely many
periods, and an uncountable scrambled set (Li and Yorke).  Not claimed: that no periodic orbit of G
attracts, an invariant density, or a Lyapunov exponent.

Proof of (iv).  Entropy is a monotone function of the kneading sequence (Milnor and Thurston; proved
in `cap.checker.release.kneading`), and log s for the tent map of slope s: `cap.release.kneading`
compares.  G on I takes n half-periods, so it is the n-th power of the map S over half a period with
the mirror image, which is continuous on these states (proved in `cap.checker.release.releases`).
"""

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice
from math import ceil, log2
from typing import Any, NamedTuple

from cap.certificate.writer import Pair, window
from cap.errors import NotProved, TooFewDigits
from cap.floats import candidates
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.flow.windows import Itinerary
from cap.parameters import Parameters
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Proof, Setting, bits, settled
from cap.proofs.options import RANGE_OF_F
from cap.proofs.release_hints import cell_bits, checker_of, followable, lemma_5_basin
from cap.release import kneading
from cap.release.cell import Cell
from cap.release.passage import image, words
from cap.release.trap import Trap, trap
from cap.release.unimodal import Critical, cover, critical, kneading_sequence, nearby, turning
from cap.sets import interval
from cap.sets.interval import Ball

SUMMARY = "an interval that the map of releases takes into itself: its entropy from both sides"
GROUP = "releases"
SEARCH = candidates.releasing
OPTIONS = RANGE_OF_F
OVER_F = "entropies"
COARSE = 80  # bits, for the cells and the basin
MOST_SYMBOLS = 2000  # at the precision for 30 digits the checker accepts few more
FIRST, STEP = 24, 8  # numbers of symbols after which the slopes are computed
ROUNDS = 8  # of precision, each half as much more


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    proved = Unimodal(setting)
    content = proved.certified(*lemma_3_entropy(setting, proved.trap, proved.turn, proved.halves))
    return settled("attractor", setting, setting.parameters.strings(), content)


class Unimodal:
    """The lemmas on the interval and its basin, proved, with hints that the checker can follow."""

    def __init__(self, setting: Setting) -> None:
        self.setting, p = setting, setting.parameters
        self.trap = trap(p, setting.start.x)
        with interval.workprec(COARSE):
            osc = oscillator(p)
            self.cells = cover(osc, p, self.trap.lower, self.trap.upper)
            self.turn = lemma_1_unimodal(self.cells)
            self.halves = self.cells[0].half_periods
            checker = checker_of(setting, self.trap, self.halves)
            self.pieces = followable(checker, osc, self.cells)
            self.basin = lemma_5_basin(setting, osc, self.trap, checker)

    def certified(self, numbers: dict[str, Any], found: "Kneading") -> Content:
        """Return claims, with numbers about the critical point and the entropy, and hints."""
        lower, upper = self.trap.lower, self.trap.upper
        claims = {
            "interval": [interval.exact_decimal(end) for end in (lower, upper)],
            "itinerary": [event.word for event in self.trap.events],
            "half_periods": str(self.halves),
            "turn": "minimum" if self.turn > 0 else "maximum",
            **numbers,
            "basin": {name: list(sides) for name, sides in self.basin.sides.items()},
        }
        hints = {
            "bits": str(found.bits),
            "cell_bits": str(cell_bits(self.setting)),
            "critical": [str(end) for end in (found.critical.lower, found.critical.upper)],
            "cells": [
                {"to": str(piece.upper), "events": windows_of(piece.windows())}
                for piece in self.pieces
            ],
            "basin_events": windows_of(self.basin.windows),
        }
        return claims, hints


def windows_of(events: Itinerary) -> list[Pair]:
    """Return time windows for the certificate."""
    return [window(event.window) for event in events]


class Kneading(NamedTuple):
    """The critical point, the symbols known, and the precision at which they are."""

    critical: Critical
    symbols: str
    bits: int


def lemma_1_unimodal(cells: list[Cell]) -> int:
    """*Statement.* G has one itinerary and is unimodal on I.

    *Computed.* G', and near the critical point G'', over the cells, as Taylor models.  Returns 1
    for a minimum, -1 for a maximum.
    """
    if len({(each.half_periods, words(each.times)) for each in cells}) > 1:
        raise NotProved("Lemma 1", "the releases have several itineraries")
    return turning(cells)


def lemma_3_entropy(
    setting: Setting, trap: Trap, turn: int, halves: int
) -> tuple[dict[str, Any], Kneading]:
    """*Statement.* The critical point, its value, its kneading sequence, the entropy.

    *Computed.* G' has opposite signs at the ends of a short interval; G(c), G²(c), ... in mean
    value form, with more bits until there are symbols enough to compare with tent maps.
    """
    precision = setting.checker_bits
    for _ in range(ROUNDS):
        with interval.workprec(precision):
            osc = oscillator(setting.parameters)
            c = critical(osc, trap.critical, trap.events, turn, bits(setting.digits + 4))
            value = lemma_2_into_itself(setting.parameters, osc, trap, c)
            known = kneading_sequence(osc, setting.parameters, c, trap.events)
            symbols, slopes = compared(known, bits(setting.digits + 3))
            if slopes is not None:
                found = Kneading(c, symbols, precision)
                return claims_of(setting, found, value, slopes, halves), found
        if len(symbols) >= MOST_SYMBOLS:
            reason = f"{MOST_SYMBOLS} symbols do not decide so many digits of the entropy"
            raise NotProved("Lemma 3", reason, {"digits": setting.digits})
        setting.progress(f"{precision} bits decide {len(symbols)} symbols: more are needed")
        precision = precision * 3 // 2
    sets = {"symbols": len(symbols), "bits": precision}
    raise NotProved("Lemma 3", "the kneading sequence is not certain for long enough", sets)


def compared(known: Iterator[str], wanted: int) -> tuple[str, tuple[Fraction, Fraction] | None]:
    """Return the symbols that were needed to enclose the slope to ``wanted`` bits, and the slopes.

    As each symbol tells log2(slope) bits of it, only few lengths are tried.  None: too few symbols.
    """
    symbols, due = "", FIRST
    for symbol in islice(known, MOST_SYMBOLS):
        symbols += symbol
        if len(symbols) == due:
            lower, upper = kneading.slopes(symbols, wanted)
            if (upper - lower) * 2**wanted <= 2:
                return symbols, (lower, upper)
            estimate = ceil(wanted / log2((lower + upper) / 2)) + 1
            due = min(2 * due, max(due + STEP, estimate))
    return symbols, None


def lemma_2_into_itself(p: Parameters, osc: Oscillator[Any], trap: Trap, c: Critical) -> Ball:
    """*Statement.* G maps I into its interior.  Returns G(c).

    *Computed.* G is monotone on both sides of c: G of both ends and G(c) lie inside.
    """
    lower, upper = (interval.ball(end) for end in (trap.lower, trap.upper))
    value = image(osc, c.ball, trap.events)[0]
    ends = [image(osc, interval.ball(q), nearby(p, float(q)))[0] for q in (trap.lower, trap.upper)]
    for y in (value, *ends):
        if not lower < y < upper:
            sets = {"I": [float(trap.lower), float(trap.upper)], "G": y}
            raise NotProved("Lemma 2", "the release map may not take I into its interior", sets)
    return value


def claims_of(
    setting: Setting, found: Kneading, value: Ball, slopes: tuple[Fraction, Fraction], halves: int
) -> dict[str, Any]:
    """Return the claims about the critical point and the entropy, rounded outwards."""
    pair, length = setting.rounding.pair, setting.units.length
    lower, upper = (interval.ball(s).log() for s in slopes)
    entropy = pair(interval.hull(lower, upper)) if slopes[1] > 1 else ["0", "0"]
    ends = [Fraction(end) for end in entropy]
    for end, sign in zip(ends, (1, -1), strict=True):
        s = interval.ball(end).exp()
        if end and kneading.compared(found.symbols, kneading.tent(s)) != sign:
            raise TooFewDigits("Lemma 3", "the entropy rounded is not certain", {"entropy": end})
    each = interval.hull(*(interval.ball(2 * end / halves) for end in ends))
    return {
        "critical_point": pair(found.critical.ball, length),
        "critical_value": pair(value, length),
        "kneading": found.symbols,
        "entropy": entropy,
        "entropy_per_period": pair(each) if ends[1] else ["0", "0"],
    }
