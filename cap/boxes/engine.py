"""The door to the compiled flow of cells."""

from dataclasses import fields
from fractions import Fraction

import numpy as np

from cap.boxes import units
from cap.boxes.follow import FOLLOW, Result, memory
from cap.boxes.krawczyk import SEARCH, Found
from cap.boxes.launches import FLY_OVER, Flights
from cap.boxes.motion import Motion
from cap.boxes.period import World
from cap.boxes.releases import LONGEST, PASS_ON, START, Rows
from cap.boxes.results import (
    NOWHERE,
    UNDECIDED,
    FixedPoints,
    Floats,
    Goals,
    Images,
    Launches,
    Passages,
)
from cap.boxes.targets import BOX, ELLIPSE, Targets
from cap.parameters import Parameters
from cap.sets.compiled import PROBE, require_ieee

HORIZON = Fraction(2)  # periods: no launch is followed longer


def world_of(
    p: Parameters, start: Fraction, span: Fraction, friction: Fraction = Fraction(1)
) -> World:
    """Return what is the same for all cells; ``friction`` is 1, or -1 for the friction -f."""
    system = units.system_of(p, friction)
    return World(
        system=system,
        near=units.near(system),
        start=units.instant(start),
        end=units.instant(start + span),
        units=units.units_of(p),
    )


def follow(
    p: Parameters, boxes: Floats, periods: Fraction, start: Fraction, goals: Goals
) -> Images:
    """Follow cells; see `cap.boxes.flow.flow`."""
    spans, span = (int(periods), Fraction(1)) if periods.denominator == 1 else (1, periods)
    images, world = Images.unknown(len(boxes)), world_of(p, start, span)
    arrays = [getattr(images, field.name) for field in fields(images)]
    flat = (array.reshape(len(boxes), -1) if array.ndim > 1 else array for array in arrays)
    result = Result(*flat)
    require_ieee(FOLLOW(world, targets_of(goals), boxes, spans, memory(), result))
    return images


def targets_of(goals: Goals) -> Targets:
    """Return targets as arrays."""
    rows = [
        [*r.centre, *r.matrix[0], *r.matrix[1], ELLIPSE if r.round else BOX] for r in goals.regions
    ]
    return Targets(
        goals.stops,
        np.array(goals.right[0], dtype=np.float64),
        np.array(goals.right[1], dtype=np.int64),
        np.array(goals.left[0], dtype=np.float64),
        np.array(goals.left[1], dtype=np.int64),
        np.array(rows, dtype=np.float64).reshape(-1, 7),
        np.array([r.label for r in goals.regions], dtype=np.int64),
    )


def fly(p: Parameters, boxes: Floats, friction: Fraction) -> Launches:
    """Follow launches; see `cap.boxes.launch.launches`.  ``friction`` is 1, or -1 for -f."""
    n = len(boxes)
    result = Flights(np.zeros(n, dtype=np.int8), np.full((n, 4), np.nan), np.full((n, 8), np.nan))
    world = world_of(p, Fraction(0), HORIZON, friction)
    require_ieee(FLY_OVER(world, boxes, Motion(), PROBE, result))
    return Launches(
        result.verdict, result.images.reshape(n, 2, 2), result.derivative.reshape(n, 2, 2, 2)
    )


def released(p: Parameters, cells: Floats, periods: int) -> Passages:
    """Follow releases to the next ones; see `cap.boxes.release.passages`."""
    n, world = len(cells), world_of(p, START, Fraction(1))
    rows = Rows(
        verdict=np.full(n, UNDECIDED, dtype=np.int8),
        half_periods=np.zeros(n, dtype=np.int64),
        events=np.zeros((n, LONGEST), dtype=np.int8),
        maybe=np.zeros(n, dtype=np.int64),
        value=np.full((n, 2), np.nan),
        slope=np.full((n, 2), np.nan),
    )
    require_ieee(PASS_ON(world, cells, periods, memory(), rows))
    return Passages(*rows)


def search(p: Parameters, boxes: Floats, frictions: Floats) -> FixedPoints:
    """Prove fixed points; see `cap.boxes.existence.fixed_points`."""
    n = len(boxes)
    ends = (np.full((n, width), np.nan) for width in (4, 2, 2))
    found = Found(np.zeros(n, dtype=np.bool_), np.full(n, -1, dtype=np.int64), *ends)
    world, targets = world_of(p, Fraction(0), Fraction(1)), targets_of(NOWHERE)
    require_ieee(SEARCH(world, targets, boxes, frictions, memory(), found))
    proved, itinerary, inner, trace, rotation = found
    return FixedPoints(proved, itinerary, inner.reshape(n, 2, 2), trace, rotation)
