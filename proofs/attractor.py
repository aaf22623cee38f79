"""Theorem (attractor).  Let f > 0.  Consider

    x'' = F cos ωt - f sgn x' - μ x',   l < x < r,   v -> -e v at the walls,   T = 2π/ω,

and its release map G (`cap.release.passage`): a mass that has stuck at x and is released to the
right sticks next where it is released at G(x), a release to the left being mirrored by (x, v, t) ->
(l + r - x, -v, t + T/2).  If the lemmas below succeed, then

 (i)   G maps an explicit interval I into its interior.  All releases from I have the same events
       up to the next release, which is n half-periods later.
 (ii)  G is unimodal on I: it has one critical point c, inside; G' has one sign to the left of c, the
       other one to the right.
 (iii) The first symbols of the kneading sequence, the branches of G(c), G²(c), ..., are as claimed.
 (iv)  The topological entropy h of G on I lies in `entropy`, that of the flow per period T on the
       orbits released in A = ∩ Gᵏ(I), which is 2h/n, in `entropy_per_period`.
 (v)   All orbits from an explicit box of states at t = 0 come to be released in I.  So an open set of
       states of positive area tends to the orbits released in A.

If h > 0: some iterate of G has a horseshoe (Misiurewicz), G has periodic points of infinitely many
periods, and an uncountable scrambled set (Li and Yorke).  Not claimed: that no periodic orbit of G
attracts, an invariant density, or a Lyapunov exponent.

Proof of (iv).  Entropy is a monotone function of the kneading sequence (Milnor and Thurston), and
log s for the tent map of slope s: `cap.release.kneading` compares.  G on I takes n half-periods, so it
is the n-th power of the map over half a period with the mirror image.
"""

from collections.abc import Iterator
from dataclasses import astuple
from fractions import Fraction
from itertools import islice
from math import ceil, log2
from typing import Any, NamedTuple

from cap.certificate import writer as certificate
from cap.checker.flow.mechanics import Parameters as Checked
from cap.checker.kernel.certificate import Certificate
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.attractor import Attractor
from cap.errors import NotProved, TooFewDigits
from cap.flow.course import State
from cap.flow.event import BALLS, TAYLOR_MODELS, Expected
from cap.flow.model import Moment, Oscillator
from cap.flow.strobe import oscillator
from cap.maps.fixed_point import windows_for
from cap.parameters import Parameters
from cap.release import kneading
from cap.release.cell import Cell, slack
from cap.release.passage import arrival, foreseen_from, image, words
from cap.release.trap import Trap, trap
from cap.release.unimodal import Critical, cover, critical, kneading_sequence, nearby, turning
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain
from proofs.citation import cited
from proofs.fixed_point import Proof, Setting, assembled, bits, inside

COARSE = 80  # bits, for the cells and the basin
MOST_SYMBOLS = 6000
MOST_CELLS = 500
FIRST, STEP = 24, 8  # numbers of symbols after which the slopes are computed
ORDER = 3  # of the Taylor models over the box
ROUNDS = 8  # of precision, each half as much more

MILNOR_THURSTON = cited(
    "Milnor-Thurston",
    "Milnor and Thurston, On iterated maps of the interval, Springer LNM 1342, 1988",
    (
        "unimodal",
        "G is continuous on the interval, maps it into itself, and has one critical point there, on "
        "both sides of which it is strictly monotone",
        "interval, itinerary, critical_point",
    ),
    (
        "order",
        "the kneading sequence of G is decided up to where it differs from those of the tent maps "
        "with the slopes exp(lower) and exp(upper), lower and upper the ends of entropy",
        "kneading, entropy",
    ),
)
MISIUREWICZ = cited(
    "Misiurewicz",
    "Misiurewicz, Horseshoes for mappings of the interval, Bull. Acad. Polon. Sci. 27, 1979",
    ("positive", "the entropy of the continuous map G of the interval is positive", "entropy"),
)
LI_YORKE = cited(
    "Li-Yorke",
    "Li and Yorke, Period three implies chaos, Amer. Math. Monthly 82, 1975; Block and Coppel, "
    "Dynamics in One Dimension, 1992, Chapters II and VI",
    ("positive", "the entropy of the continuous map G of the interval is positive", "entropy"),
)


def prove(setting: Setting) -> Proof:
    """Prove the theorem up to the size of its cells and of the box; return the rest of the proof."""
    proved = Prepared(setting)
    cites = MILNOR_THURSTON, MISIUREWICZ, LI_YORKE
    strings = setting.parameters.strings()
    return lambda part: assembled("attractor", setting, strings, proved.parts(part), *cites)


class Prepared:
    """Lemmas 1 to 4, proved; what is left is the size of the cells and Lemma 5."""

    def __init__(self, setting: Setting) -> None:
        self.setting, self.p = setting, setting.parameters
        self.trap = trap(self.p, setting.start.x)
        with interval.workprec(COARSE):
            self.osc = oscillator(self.p)
            self.cells = cover(self.osc, self.p, self.trap.lower, self.trap.upper)
            self.turn = lemma_1_unimodal(self.cells)
            self.pieces = followable(setting, self.osc, self.cells)
        halves = self.cells[0].half_periods
        self.numbers, self.found = lemma_3_entropy(setting, self.trap, self.turn, halves)
        with interval.workprec(COARSE):
            self.box = Box(self.p, self.osc, self.trap)

    def parts(self, part: Fraction) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return claims and hints, for cells cut into 1/part pieces, and a part of the box."""
        lower, upper = self.trap.lower, self.trap.upper
        with interval.workprec(COARSE):
            box, windows = self.box.claimed(part)
        claims = {
            "interval": [interval.exact_decimal(end) for end in (lower, upper)],
            "itinerary": [event.word for event in self.trap.events],
            "half_periods": str(self.cells[0].half_periods),
            "turn": "minimum" if self.turn > 0 else "maximum",
            **self.numbers,
            "basin": box,
        }
        hints = {
            "bits": str(self.found.bits),
            "cell_bits": str(cell_bits(self.setting)),
            "critical": [str(end) for end in (self.found.critical.lower, self.found.critical.upper)],
            "cells": [
                {"to": str(piece.upper), "events": [certificate.window(e.window) for e in piece.windows()]}
                for piece in self.pieces
            ],
            "basin_events": [certificate.window(e.window) for e in windows],
        }
        return claims, hints


class Kneading(NamedTuple):
    """The critical point, the symbols known, and the precision at which they are."""

    critical: Critical
    symbols: str
    bits: int


def lemma_1_unimodal(cells: list[Cell]) -> int:
    """*Statement.* G has one itinerary and is unimodal on I; return 1 for a minimum, -1 for a maximum.

    *Computed.* G', and near the critical point G'', over the cells, as Taylor models.
    """
    if len({(each.half_periods, words(each.times)) for each in cells}) > 1:
        raise NotProved("Lemma 1", "the releases have several itineraries")
    return turning(cells)


def followable(setting: Setting, osc: Oscillator[Any], cells: list[Cell]) -> list[Cell]:
    """Return cells, cut into pieces that the checker, in its looser arithmetic, can follow.

    Nothing is proved here: it finds hints.
    """
    p = setting.parameters
    itinerary = [event.word for event in cells[0].times]
    claims = {"itinerary": itinerary, "half_periods": cells[0].half_periods}
    hints = {"cell_bits": cell_bits(setting)}
    known = Certificate("attractor", Checked(*astuple(p)), setting.digits, claims, hints)
    checker = Attractor(known, lambda _: None)

    def follows(piece: Cell) -> bool:
        windows = [interval.ends(e.window) for e in piece.windows()]
        try:
            found = checker.cell(piece.lower, piece.upper, windows)
        except Rejected:
            return False
        return bool(found.slope or found.curve and piece.curve is not None)

    done: list[Cell] = []
    waiting = cells[::-1]
    while waiting:
        piece = waiting.pop()
        if follows(piece):
            done.append(piece)
        elif len(done) + len(waiting) > MOST_CELLS:
            raise NotProved("checker", "the cells are too many for the independent checker")
        else:
            waiting += piece.pieces(osc, 2)[::-1]
    return done


def cell_bits(setting: Setting) -> int:
    """Return the precision at which the checker looks at cells."""
    return Setting(setting.parameters, setting.start, 6, guard=0).checker_bits


def lemma_3_entropy(
    setting: Setting, trap: Trap, turn: int, halves: int
) -> tuple[dict[str, Any], Kneading]:
    """*Statement.* The critical point, its value, its kneading sequence, the entropy.

    *Computed.* G' has opposite signs at the ends of a short interval; G(c), G²(c), ... in mean value
    form, with more bits until there are symbols enough to compare with tent maps.
    """
    precision = setting.checker_bits
    for _ in range(ROUNDS):
        with interval.workprec(precision):
            osc = oscillator(setting.parameters)
            c = critical(osc, trap.critical, trap.events, turn)
            value = lemma_2_into_itself(setting.parameters, osc, trap, c)
            known = kneading_sequence(osc, setting.parameters, c, trap.events)
            symbols, slopes = compared(known, bits(setting.digits + 3))
            if slopes is not None:
                found = Kneading(c, symbols, precision)
                return claims_of(setting, found, value, slopes, halves), found
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


class Box:
    """A box of states at t = 0 from which the mass comes to be released in I (Lemma 5)."""

    def __init__(self, p: Parameters, osc: Oscillator[Any], trap: Trap) -> None:
        self.osc, self.trap = osc, trap
        start = osc.slow(1, 0)
        middle = interval.ball((trap.lower + trap.upper) / 2)
        flight = osc.launch(1, start, middle, Ball(0))
        end = Moment(osc.T, Ball(0), Ball(1))
        state = osc.position(flight, end), osc.velocity(flight, end)
        self.centre = tuple(Fraction(float(z.mid())) for z in state)
        self.events = foreseen_from(p, (float(self.centre[0]), float(self.centre[1])))
        unit = osc.r - osc.l
        self.units = tuple(interval.midpoint(u) for u in (unit, unit * osc.omega))
        self.size = bisection.largest(self.lemma_5, Fraction(1, 8), 6)
        if self.size is None:
            raise NotProved("Lemma 5", "no box of states was found whose releases lie in I")

    def lemma_5(self, size: Fraction) -> tuple[Expected, ...]:
        """*Statement.* All orbits from the box of this size come to be released in I.

        *Computed.* Their events, and where the last release is, as Taylor models.
        """
        halves = [interval.ball(size * unit) for unit in self.units]
        models = Domain(halves, ORDER).variables([interval.ball(z) for z in self.centre])
        state = State(Moment(Ball(0), Ball(0), Ball(1)), *models)

        def attempt(events: Any) -> Any:
            return arrival(self.osc, state, events, TAYLOR_MODELS)

        found = attempt(windows_for(attempt, self.events, TAYLOR_MODELS.bound))
        where = TAYLOR_MODELS.bound(found.value)
        lower, upper = (interval.ball(end) for end in (self.trap.lower, self.trap.upper))
        if not lower < where < upper:
            raise NotProved("Lemma 5", "the releases may not lie in I", {"release": where})
        return slack(found.times(TAYLOR_MODELS.bound))

    def claimed(self, part: Fraction) -> tuple[dict[str, Any], tuple[Expected, ...]]:
        """Return a part of the box, and windows for its events."""
        size = self.size * part
        parts = zip("xv", self.centre, self.units, strict=True)
        box = {name: inside(z, size * unit) for name, z, unit in parts}
        return box, self.lemma_5(size)
