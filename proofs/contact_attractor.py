"""Theorem (contact_attractor).  Let a system be given as data, and contacts from one release, which
gives the state after it by its time, to the next.  G maps the time of a release to that of the
next, less n periods.  If the lemmas succeed, G is defined on an interval I of times, takes it into
its interior, and

 (i)   either |(Gᵐ)'| <= C lambdaᵐ, lambda < 1: G has exactly one fixed point in I, and all orbits
       in I tend to it;
 (ii)  or: the entropy of G on I lies between log s and log S, s > 1, and over one period of the
       clock between 1/n of them; G has at least so many orbits of the least periods 1, 2, ...

Proof.  I is cut into cells, on each of which `cap.checker.system.releases` encloses G and G'.
Lemma 1: weights of the cells show |(Gᵐ)'| <= C lambdaᵐ: some Gᵐ contracts.  Lemma 2: cells cover
each other, and their matrix grows at least like s.  Lemma 3: the laps of cells meet cells, and that
matrix grows at most like S.  Lemma 4: closed paths of coverings have periodic orbits.  Where orbits
stay is found in floats.
"""

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from cap.checker.kernel.shapes import matched
from cap.checker.system.given import SYSTEM, model
from cap.checker.system.laps import PATHS, closed_paths, orbits, rank, sums
from cap.checker.system.passage import Contact
from cap.checker.system.release_cells import Cell, coverings, met
from cap.checker.system.releases import Releases
from cap.errors import NotProved
from cap.floats import candidates
from cap.maps.graphs import fastest
from cap.proofs.certified import certified
from cap.proofs.contacts import as_parameters
from cap.proofs.coverings import PLACES, SCALE
from cap.proofs.release_cells import cells
from cap.proofs.release_ends import near
from cap.runner import Runner
from cap.sets import interval
from cap.system.model import System

BITS = 96
SIZES = (0.98, 0.95, 0.9, 0.8, 0.7, 0.5, 0.35, 0.2, 0.1, 0.05, 0.02, 0.01)  # of intervals tried
ROOMS = (0.02, 0.05, 0.01, 0.1, 0.003)  # of I beyond where orbits are seen, of its length
STEPS, HALF = 64, 0.5  # after so many a derivative is smaller than this
POWER = 400  # steps of the power method
ABOVE = 1e-6  # of the spectral radius
NEAR = Fraction(1, 10**8)  # half the interval in which the fixed point is claimed
UNIT = Fraction(1, 10**PLACES)  # of what is claimed
ORBITS, MOST_ORBITS = 12, 999_999  # the longest periods, the most orbits that are claimed


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
    found, windows = zip(*cells(stay, given, *ends), strict=True)
    claims = {
        "contacts": [contact._asdict() for contact in contacts],
        "periods": str(stay.periods),
        "interval": _shown(found[0].lower, found[-1].upper),
    }
    hints = {
        "bits": str(BITS),
        "cells": [
            {"to": interval.exact_decimal(c.upper), "windows": [_shown(*w) for w in listed]}
            for c, listed in zip(found, windows, strict=True)
        ],
    }
    rate, weights = lemma_1_rate(found) if stay.closes else (Fraction(1), [])
    if rate < 1:
        claims |= {"rate": interval.exact_decimal(rate), "fixed": _fixed(stay)}
    else:
        growth, vector = lemma_2_growth(found)
        laps, weights = lemma_3_laps(found)
        claims |= {"growth": interval.exact_decimal(growth), "laps": interval.exact_decimal(laps)}
        claims |= _entropy(growth, laps, stay.periods) | lemma_4_orbits(found)
        hints["vector"] = [str(v) for v in vector]
    hints["weights"] = [str(w) for w in weights]
    return certified("contact_attractor", parameters, (claims, hints), runner)


def _shown(low: Fraction, high: Fraction) -> list[str]:
    return [interval.exact_decimal(low), interval.exact_decimal(high)]


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
            yield near(a), near(b)


def _contracts(t: Any, image: Any) -> bool:
    """Return whether the derivative of some iterate is small everywhere, in floats."""
    slope, x, total = np.abs(np.gradient(image, t)), t, np.ones(len(t))
    for _ in range(STEPS):
        total = total * np.interp(x, t, slope)
        x = np.interp(x, t, image)
        if total.max() < HALF:
            return True
    return False


def _size(c: Cell) -> Fraction:
    """Return a bound of |G'| on a cell."""
    return max(abs(c.slope.lower), abs(c.slope.upper))


def lemma_1_rate(cells: Sequence[Cell]) -> tuple[Fraction, list[int]]:
    """*Statement.* |G'| w_K <= lambda w_J if the image of the cell J meets K.

    *Computed.* The logarithms of the largest products of sizes along paths of m cells grow like m
    log lambda; the weights are the largest products of sizes over powers of lambda.
    """
    images = met(cells)
    if not all(images):
        raise NotProved("Lemma 1", "the image of a cell is not certain to lie in I")
    logs = np.array([math.log(max(float(_size(c)), 1e-12)) for c in cells])
    values = [np.zeros(len(cells))]
    for _ in range(POWER):
        values.append(logs + np.array([values[-1][e.start : e.stop].max() for e in images]))
    half = POWER // 2
    rate = float((values[-1] - values[half]).max()) / half + 1e-6
    best = np.max([v - n * rate for n, v in enumerate(values)], axis=0)
    scaled = np.exp(best - best.min())
    weights = [max(1, round(float(w) * 10**12)) for w in scaled]
    need = max(
        _size(c) * max(weights[e.start : e.stop]) / w
        for c, e, w in zip(cells, images, weights, strict=True)
    )
    return UNIT * (math.ceil(need / UNIT) + 1), weights


def lemma_2_growth(cells: Sequence[Cell]) -> tuple[Fraction, list[int]]:
    """*Statement.* A v >= s v for the matrix A of the coverings.

    *Computed.* Which cells lie between the images of the ends of a cell; the vector is that of the
    power method, and s the least quotient of the entries.
    """
    edges = coverings(cells)
    source = np.array([k for k, targets in enumerate(edges) for _ in targets], dtype=np.int64)
    target = np.array([j for targets in edges for j in targets], dtype=np.int64)
    part = fastest(source, target, len(cells))
    vector = [int(float(v) * SCALE) for v in part.right]
    quotients = [Fraction(x, v) for x, v in zip(sums(edges, vector), vector, strict=True) if v]
    growth = UNIT * math.floor(min(quotients, default=Fraction(0)) / UNIT)
    if growth <= 1:
        raise NotProved(
            "Lemma 2",
            "neither does an iterate of the map contract, nor do cells cover"
            " each other in two loops",
        )
    return growth, vector


def lemma_3_laps(cells: Sequence[Cell]) -> tuple[Fraction, list[int]]:
    """*Statement.* B w <= S w for the matrix B of the laps of cells and the cells that they meet.

    *Computed.* (r - B) w = 1, r a little more than the spectral radius: then B w = r w - 1.
    """
    images, count = met(cells), len(cells)
    B = np.zeros((count, count))
    for row, cell, edges in zip(B, cells, images, strict=True):
        row[edges.start : edges.stop] = cell.laps
    radius = float(np.abs(np.linalg.eigvals(B)).max())
    w = np.linalg.solve((radius + ABOVE) * np.eye(count) - B, np.ones(count))
    if not w.min() > 0:
        raise NotProved("Lemma 3", "no bound of the number of laps is found")
    weights = [max(1, round(x * SCALE)) for x in (w / w.min()).tolist()]
    parts = zip(cells, sums(images, weights), weights, strict=True)
    bound = max(Fraction(c.laps * x, y) for c, x, y in parts)
    return UNIT * (math.ceil(bound / UNIT) + 1), weights


def lemma_4_orbits(cells: Sequence[Cell]) -> dict[str, Any]:
    """*Statement.* G has at least so many orbits of the least periods 1, 2, ...

    *Computed.* From the closed paths of coverings.
    """
    covered = coverings(cells)
    longest = max(1, min(ORBITS, PATHS // sum(map(bool, covered)) ** 2))
    found = orbits(closed_paths(covered, longest))
    if not any(found):
        raise NotProved("Lemma 4", f"no closed path of at most {longest} coverings is found")
    first = min((m for m, n in enumerate(found, 1) if n), key=rank)
    return {"orbits": [str(min(n, MOST_ORBITS)) for n in found], "period": str(first)}


def _entropy(growth: Fraction, laps: Fraction, periods: int) -> dict[str, list[str]]:
    """Return bounds of the entropy: a little less than log s, and more than log S; and over n."""
    low = UNIT * (math.floor(math.log(growth) / UNIT) - 1)
    high = UNIT * (math.ceil(math.log(laps) / UNIT) + 1)
    each = UNIT * math.floor(low / periods / UNIT), UNIT * math.ceil(high / periods / UNIT)
    return {"entropy": _shown(low, high), "entropy_per_period": _shown(*each)}


def _fixed(stay: candidates.Stay) -> list[str]:
    """Return an interval around the fixed point."""
    t = stay.ends[0]
    for _ in range(POWER):
        t = stay.map(t)
    middle = near(t)
    return _shown(middle - NEAR, middle + NEAR)
