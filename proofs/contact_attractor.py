"""Theorem (contact_attractor).  Let a system be given as data, and contacts from one release, which
gives the state after it by its time, to the next.  G maps the time of a release to that of the
next, less n periods.  If the lemmas succeed, G is defined on an interval I of times, takes it into
its interior, and

 (i)   if lambda < 1: G has exactly one fixed point in I, and all orbits in I tend to it;
 (ii)  if lambda >= 1: the entropy of G on I lies between log s and log lambda, s > 1.

Proof.  I is cut into cells, on each of which `cap.checker.system.releases` encloses G and G'.
Lemma 1: weights of the cells show |(Gᵐ)'| <= C lambdaᵐ: so some Gᵐ contracts, or the entropy is at
most log lambda.  Lemma 2: cells cover each other, and their matrix grows like s.  Where orbits stay
is found in floats.
"""

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.checker.system.given import SYSTEM, model
from cap.checker.system.passage import Contact
from cap.checker.system.releases import Releases
from cap.errors import NotProved
from cap.floats import candidates
from cap.maps.graphs import fastest
from cap.proofs.certified import certified
from cap.proofs.contacts import as_parameters
from cap.proofs.coverings import PLACES, SCALE
from cap.runner import Runner
from cap.sets import interval
from cap.system.model import System

BITS = 96
CELLS, MORE = 64, range(8, 120)  # at first; for entropy, the number that shows most
SMALLEST = Fraction(1, 1 << 12)  # the least cell, as a part of I
PADS = (Fraction(1), Fraction(4))  # of windows, as parts of the range of the times
FLAT = 20  # the range is taken to be at least such a part of the length of the cell
LEAST = Fraction(1, 10**7)  # of a period: the least room at the ends of a window
SIZES = (0.98, 0.95, 0.9, 0.8, 0.7, 0.5, 0.35, 0.2, 0.1, 0.05, 0.02, 0.01)  # of intervals tried
ROOMS = (0.02, 0.05, 0.01, 0.1, 0.003)  # of I beyond where orbits are seen, of its length
STEPS, HALF = 64, 0.5  # after so many a derivative is smaller than this
POWER = 400  # steps of the power method
NEAR = Fraction(1, 10**8)  # half the interval in which the fixed point is claimed
UNIT, FINE = Fraction(1, 10**PLACES), 10**10  # of what is claimed; of times


class Cell(NamedTuple):
    """A cell, the windows of its contacts, the size of G', and what contains its image."""

    lower: Fraction
    upper: Fraction
    windows: list[tuple[Fraction, Fraction]]
    size: Fraction
    image: tuple[Fraction, Fraction]
    ends: tuple[tuple[Fraction, Fraction], tuple[Fraction, Fraction]]


def prove_any(system: System, runner: Runner) -> dict[str, Any]:
    """Return a certificate about the first place where orbits stay of which one is proved."""
    parameters = as_parameters(system)
    reasons = list[str]()
    for stay in candidates.stays(system, lambda words: runner.tell(words, None)):
        try:
            return prove(stay, parameters, runner)
        except NotProved as failure:
            reasons.append(str(failure))
    none = "no interval of releases is found in floats that is taken into itself"
    raise NotProved("search", "; ".join(dict.fromkeys(reasons)) or none)


def prove(stay: candidates.Stay, parameters: dict[str, Any], runner: Runner) -> dict[str, Any]:
    """Return a certificate, which the checker accepts, about the largest interval that is proved.

    Raises `NotProved` with why none is.
    """
    why = NotProved("search", "no interval of releases is taken into itself, in floats")
    for a, b in _intervals(stay):
        try:
            return _proved(stay, parameters, (a, b), runner)
        except NotProved as failure:
            why = failure
    raise why


def _proved(
    stay: candidates.Stay,
    parameters: dict[str, Any],
    ends: tuple[Fraction, Fraction],
    runner: Runner,
) -> dict[str, Any]:
    """Return a certificate about an interval."""
    contacts = [Contact(*contact) for contact in stay.contacts]
    given = Releases(model(matched(parameters, SYSTEM, "the system")), contacts, BITS)
    runner.tell("enclosing the map on cells", None)
    cells = list(_cells(stay, given, *ends))
    rate, weights = lemma_1_rate(cells)
    claims = {
        "contacts": [contact._asdict() for contact in contacts],
        "periods": str(stay.periods),
        "interval": _shown(cells[0].lower, cells[-1].upper),
        "rate": interval.exact_decimal(rate),
    }
    hints = {
        "bits": str(BITS),
        "cells": [
            {"to": interval.exact_decimal(c.upper), "windows": [_shown(*w) for w in c.windows]}
            for c in cells
        ],
        "weights": [str(w) for w in weights],
    }
    if rate < 1:
        claims["fixed"] = _fixed(stay)
    else:
        growth, vector = lemma_2_growth(cells)
        claims |= {"growth": interval.exact_decimal(growth), "entropy": _entropy(growth, rate)}
        hints["vector"] = [str(v) for v in vector]
    return certified("contact_attractor", parameters, (claims, hints), runner)


def _shown(low: Fraction, high: Fraction) -> list[str]:
    return [interval.exact_decimal(low), interval.exact_decimal(high)]


def _decimal(x: float) -> Fraction:
    """Return a decimal near a double."""
    return Fraction(round(x * FINE), FINE)


def _intervals(stay: candidates.Stay) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield intervals that G takes into themselves, in floats, the largest ones first."""
    at, images = stay.within, stay.images
    low, high = stay.ends
    if stay.closes:
        sides = [(low - s * (low - at[0]), high + s * (at[-1] - high)) for s in SIZES]
    else:
        sides = [(low - s * (high - low), high + s * (high - low)) for s in ROOMS]
    for a, b in sides:
        t = np.concatenate([[a], at[(a < at) & (at < b)], [b]])
        image = np.interp(t, at, images)
        room = (b - a) * 1e-4
        if not (at[0] <= a and b <= at[-1] and a + room < image.min() and image.max() < b - room):
            continue
        if not stay.closes or _contracts(t, image):
            yield _decimal(a), _decimal(b)


def _contracts(t: Any, image: Any) -> bool:
    """Return whether the derivative of some iterate is small everywhere, in floats."""
    slope, x, total = np.abs(np.gradient(image, t)), t, np.ones(len(t))
    for _ in range(STEPS):
        total = total * np.interp(x, t, slope)
        x = np.interp(x, t, image)
        if total.max() < HALF:
            return True
    return False


def _cells(stay: candidates.Stay, given: Releases, a: Fraction, b: Fraction) -> Iterator[Cell]:
    """Yield the cells, from left to right; those that are too large are halved."""
    least = _decimal(float((b - a) * SMALLEST))
    for c, d in ((a, a + least), (b - least, b)):  # where a proof fails most often
        try:
            _cell(stay, given, c, d)
        except Rejected as reason:
            raise _uncertain(c, reason) from None
    count = CELLS if stay.closes else _count(stay, float(a), float(b))
    ends = [_decimal(float(a + (b - a) * k / count)) for k in range(count + 1)]
    waiting = [*pairwise(ends)][::-1]
    while waiting:
        c, d = waiting.pop()
        try:
            yield _cell(stay, given, c, d)
        except Rejected as reason:
            if d - c < (b - a) * SMALLEST:
                raise _uncertain(c, reason) from None
            m = _decimal(float((c + d) / 2))
            waiting += [(m, d), (c, m)]


def _uncertain(t: Fraction, reason: Rejected) -> NotProved:
    where = f"near the time {float(t):.8g} the next contact is not certain"
    return NotProved("releases", f"{where}: {reason}")


def _count(stay: candidates.Stay, a: float, b: float) -> int:
    """Return the number of equal cells whose coverings grow fastest, in floats."""

    def growth(count: int) -> float:
        ends = np.linspace(a, b, count + 1)
        images = np.interp(ends, stay.within, stay.images)
        low, high = np.minimum(images[:-1], images[1:]), np.maximum(images[:-1], images[1:])
        A = (ends[:-1] >= low[:, None]) & (ends[1:] <= high[:, None])
        return float(np.abs(np.linalg.eigvals(A.astype(float))).max())

    return max(MORE, key=growth)


def _cell(stay: candidates.Stay, given: Releases, c: Fraction, d: Fraction) -> Cell:
    """Return the cell [c, d]; raise `Rejected` if it is too large."""
    rows = [stay.times(float(t)) for t in (c, (c + d) / 2, d)]
    if not all(rows):
        raise Rejected("the contacts are others")
    why = Rejected("no windows are tried")
    least = LEAST * Fraction(given.period.upper)
    for pad in PADS:
        windows = list[tuple[Fraction, Fraction]]()
        for times in zip(*rows, strict=True):
            low, high = _decimal(min(times)), _decimal(max(times))
            room = _decimal(float(max(high - low, (d - c) / FLAT) * pad + least))
            windows.append((low - room, high + room))
        try:
            return _enclosed(stay, given, c, d, windows)
        except Rejected as reason:
            why = reason
    raise why


def _enclosed(
    stay: candidates.Stay,
    given: Releases,
    c: Fraction,
    d: Fraction,
    windows: list[tuple[Fraction, Fraction]],
) -> Cell:
    """Return the cell with these windows."""
    boxes = [Interval.enclosing(*w, BITS) for w in windows]
    shift = given.period * stay.periods
    S = given.over(Interval.enclosing(c, d, BITS), boxes).by[0]
    low, high = (given.at(Interval.enclosing(t, t, BITS), boxes).time - shift for t in (c, d))
    size = max(abs(S.lower), abs(S.upper))
    ends = (low.lower, low.upper), (high.lower, high.upper)
    if not S.contains_zero():
        image = min(low.lower, high.lower), max(low.upper, high.upper)
    else:
        run = S * Interval.enclosing(0, d - c, BITS)
        met = (low + run).intersection(high - run)
        image = met.lower, met.upper
    return Cell(c, d, windows, size, image, ends)


def _met(cells: Sequence[Cell]) -> list[tuple[int, int]]:
    """Return for each cell which cells its image meets: from the first to before the last."""
    lower, upper = [float(c.lower) for c in cells], [float(c.upper) for c in cells]
    found = []
    for c in cells:
        low, high = (float(x) for x in c.image)
        pair = (
            int(np.searchsorted(upper, low - 1e-12)),
            int(np.searchsorted(lower, high + 1e-12, "right")),
        )
        found.append(pair)
    return found


def lemma_1_rate(cells: Sequence[Cell]) -> tuple[Fraction, list[int]]:
    """*Statement.* |G'| w_K <= lambda w_J if the image of the cell J meets K.

    *Computed.* The logarithms of the largest products of sizes along paths of m cells grow like m
    log lambda; the weights are the largest products of sizes over powers of lambda.
    """
    met = _met(cells)
    if any(not first < last for first, last in met):
        raise NotProved("Lemma 1", "the image of a cell is not certain to lie in I")
    logs = np.array([math.log(max(float(c.size), 1e-12)) for c in cells])
    values = [np.zeros(len(cells))]
    for _ in range(POWER):
        values.append(logs + np.array([values[-1][i:j].max() for i, j in met]))
    half = POWER // 2
    rate = float((values[-1] - values[half]).max()) / half + 1e-6
    best = np.max([v - n * rate for n, v in enumerate(values)], axis=0)
    scaled = np.exp(best - best.min())
    weights = [max(1, round(float(w) * 10**12)) for w in scaled]
    need = max(
        c.size * max(weights[i:j]) / w for c, (i, j), w in zip(cells, met, weights, strict=True)
    )
    return UNIT * (math.ceil(need / UNIT) + 1), weights


def lemma_2_growth(cells: Sequence[Cell]) -> tuple[Fraction, list[int]]:
    """*Statement.* A v >= s v for the matrix A of the coverings.

    *Computed.* Which cells lie between the images of the ends of a cell; the vector is that of the
    power method, and s the least quotient of the entries.
    """
    edges = list[range]()
    lower, upper = [float(c.lower) for c in cells], [float(c.upper) for c in cells]
    for c in cells:
        low, high = sorted(c.ends)
        i = int(np.searchsorted(lower, float(low[1]) + 1e-12))
        j = int(np.searchsorted(upper, float(high[0]) - 1e-12, "right"))
        edges.append(range(i, max(i, j)))
    source = np.array([k for k, targets in enumerate(edges) for _ in targets], dtype=np.int64)
    target = np.array([j for targets in edges for j in targets], dtype=np.int64)
    part = fastest(source, target, len(cells))
    vector = [int(float(v) * SCALE) for v in part.right]
    quotients = [
        Fraction(sum(vector[j] for j in targets), v)
        for targets, v in zip(edges, vector, strict=True)
        if v
    ]
    growth = UNIT * math.floor(min(quotients, default=Fraction(0)) / UNIT)
    if growth <= 1:
        raise NotProved(
            "Lemma 2",
            "neither does an iterate of the map contract, nor do cells cover"
            " each other in two loops",
        )
    return growth, vector


def _entropy(growth: Fraction, rate: Fraction) -> list[str]:
    """Return bounds of the entropy: a little less than log s, and more than log lambda."""
    low = UNIT * (math.floor(math.log(growth) / UNIT) - 1)
    high = UNIT * (math.ceil(math.log(rate) / UNIT) + 1)
    return _shown(low, high)


def _fixed(stay: candidates.Stay) -> list[str]:
    """Return an interval around the fixed point."""
    t = stay.ends[0]
    for _ in range(POWER):
        t = stay.map(t)
    middle = _decimal(t)
    return _shown(middle - NEAR, middle + NEAR)
