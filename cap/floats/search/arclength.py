"""Pseudo-arclength continuation of curves of periodic orbits, and the changes on the way."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from cap.errors import BadInput
from cap.floats.findings import Floats
from cap.floats.search.curve import FixedPoints, Station, halve
from cap.flow.itinerary import oscillator
from cap.parameters import Parameters
from cap.runner import Runner

FIRST, LEAST, MOST = 0.005, 1e-7, 0.02  # step lengths, in units of `cap.floats.search.curve`
SYMMETRIC = 1e-4
EXACT = 1e-10  # distance of neighbours between which a fold or flip is located; for a branch …
CHORD = 1e-5  # … point, at which Newton's method is singular; its square is the error
MULTIPLIER = 1e-2  # |1 - trace + det| over 1 + |trace|, where there is a multiplier 1
AT_WALL = 1e-5  # distance from a wall at t = 0, in units of R, that a branch keeps …
JUMP = 1e-3  # … and from which it may jump, from the velocity before a hit to that after it
NEAR = 0.05  # of the end of a branch to a margin's zero, for its reason


@dataclass(frozen=True)
class Change:
    """A change between two stations."""

    label: str
    station: Station
    around: tuple[Station, ...] = ()


class CurveFollower:
    """Follows curves of a family by pseudo-arclength."""

    def __init__(
        self, family: FixedPoints, limits: tuple[float, float], points: int, runner: Runner
    ) -> None:
        self.family, self.limits, self.points, self.runner = family, limits, points, runner

    def both_ways(self, seed: Station) -> tuple[list[Station], list[Change]]:
        """Return the curve through a station and the changes on it."""
        curve, changes = [seed], []
        for side in (1, -1):
            begin = replace(seed, tangent=side * seed.tangent, branching=side * seed.branching)
            way, found = self._followed(begin, side)
            curve = curve + way if side > 0 else [*way[::-1], *curve]
            changes += found
        return curve, changes

    def _followed(self, station: Station, side: int) -> tuple[list[Station], list[Change]]:
        begin, step = station, FIRST
        way: list[Station] = []
        changes: list[Change] = []
        with self.runner.keeping():
            while True:
                if len(way) >= self.points:
                    changes.append(Change(f"followed no further: {self.points} points", station))
                    break
                self.runner.tell("continuation", len(way) / self.points)
                following = self._next(station, step) or self._beyond_the_wall(station)
                if following is None and step > LEAST:
                    step /= 2
                    continue
                if following is None:
                    changes += self._end(station)
                    break
                found = [
                    each for each in self._changes(station, following) if self._covers(each.station)
                ]
                changes += found
                way += _in_order(station, following, found)
                way.append(following)
                station, step = following, min(1.3 * step, MOST)
                if not self._covers(station):
                    way.pop()
                    break
                if len(way) > 10 and np.linalg.norm(station.y - begin.y) < step and side > 0:
                    break
        return way, changes

    def _covers(self, station: Station) -> bool:
        """Return whether a station lies between the limits: the last one found may lie beyond."""
        return bool(self.limits[0] <= station.y[2] <= self.limits[1])

    def _next(self, station: Station, step: float) -> Station | None:
        y = self.family.corrected(station.y + step * station.tangent, station.tangent)
        if y is None or not np.linalg.norm(y - station.y) < 2 * step:
            return None
        p, (x, _) = self.family.at(y)
        if min(x - p.l, p.r - x) < AT_WALL * p.R:
            return None
        chord = y - station.y
        try:
            found = self.family.station(y, chord / np.linalg.norm(chord))
        except BadInput:
            return None
        same = found.margins.words == station.margins.words
        bend = found.tangent @ station.tangent
        return found if bend > 0.95 or (not same and step < 1e-4) or step < 1e-5 else None

    def _end(self, station: Station) -> list[Change]:
        """Return why a branch ends; nothing if that is at the end of the range."""
        value = station.y[2]
        if min(abs(value - limit) for limit in self.limits) < 1e-4 * max(1.0, abs(value)):
            return []
        return [Change(_reason(station), station)]

    def _beyond_the_wall(self, station: Station) -> Station | None:
        """Return the station after a hit has passed t = 0, where v jumps."""
        p, (x, v) = self.family.at(station.y)
        side = 1 if p.r - x < x - p.l else -1
        wall = float(p.r if side > 0 else p.l)
        gap = abs(x - wall) / self.family.unit[0]
        speed = side * station.tangent[0]
        if not (gap < JUMP and speed > 1e-3):
            return None
        unit = self.family.unit
        across = np.eye(3)
        across[:2, :2] = _passage(p, side, v) * unit[:2] / unit[:2, None]
        at_wall = np.array([wall / unit[0], 0.0, 0.0])
        if self.family.name == "R":  # the wall moves
            drift = np.array([side * unit[2] / unit[0] / 2, 0.0, 0.0])
            across[:, 2] += drift - across @ drift
            at_wall = at_wall + np.array([0.0, 0.0, station.y[2]])
        if self.family.name == "e":  # the velocity after the hit is -e times that before it
            across[1, 2] = (-v if side * v > 0 else v / float(p.e) ** 2) * unit[2] / unit[1]
            at_wall = at_wall + np.array([0.0, 0.0, station.y[2]])
        tangent = across @ station.tangent
        tangent /= np.linalg.norm(tangent)
        beyond = station.y + (gap + 2 * AT_WALL) / speed * station.tangent
        begin = across @ (beyond - at_wall) + at_wall
        y = self.family.corrected(begin, tangent)
        if y is None or not np.linalg.norm(y - begin) < JUMP or abs(y[2] - station.y[2]) > JUMP:
            return None
        return self.family.station(y, tangent)

    def _changes(self, a: Station, b: Station) -> list[Change]:
        """Return the changes between neighbours."""
        family = self.family
        if a.margins.words != b.margins.words:
            before, after = halve(family, a, b, lambda s: s.margins.words == a.margins.words)
            _, label = min(before.margins.nearest, after.margins.nearest)
            turns_back = before.tangent[2] * after.tangent[2] < 0
            return [Change(label + (", fold" if turns_back else ""), before, (before, after))]
        found: list[Change] = []
        if np.linalg.norm(b.y - a.y) > 2 * MOST:
            return found  # a hit has passed t = 0
        tests: list[tuple[str, Callable[[Station], float]]] = [
            ("branch point", lambda s: s.branching),
            ("fold", lambda s: float(s.tangent[2])),
            ("flip", lambda s: 1 + s.trace + s.determinant),
        ]
        for label, test in tests:
            begin, end = test(a), test(b)
            if begin * end >= 0 or (label == "fold" and found):
                continue  # where branches cross, one of them may turn back
            at = self._zero(test, a, b, CHORD if label == "branch point" else EXACT)
            if abs(test(at)) > max(abs(begin), abs(end)) / 10:
                continue  # a jump, next to a border
            if label != "flip" and not _has_multiplier_1(at):
                continue  # next to a grazing, where the derivative is infinite, and changes sign
            mirrored = label == "branch point" and family.symmetry_defect(at.y) < SYMMETRIC
            found.append(Change("pitchfork" if mirrored else label, at, (at,)))
        return found

    def _zero(
        self, test: Callable[[Station], float], a: Station, b: Station, least: float
    ) -> Station:
        """Return the station at which a test is 0, on the chord of neighbours ``least`` apart."""
        begin = test(a)
        a, b = halve(self.family, a, b, lambda s: test(s) * begin > 0, least)
        along = b.y - a.y
        y = a.y + test(a) / (test(a) - test(b)) * along
        tangent = along / np.linalg.norm(along)
        return replace(self.family.station(y, tangent), tangent=tangent)

    def switched(self, at: Station) -> list[Station]:
        """Return stations on the branch that crosses the one of ``at``, on either side."""
        _, jacobian = self.family.defect(at.y)
        kernel = np.linalg.svd(jacobian)[2][1:]
        other = kernel[0] * (kernel[1] @ at.tangent) - kernel[1] * (kernel[0] @ at.tangent)
        other = other / np.linalg.norm(other)
        found = []
        for side in (1, -1):
            y = self.family.corrected(at.y + side * 2 * FIRST * other, other)
            if y is not None and np.linalg.norm(y - at.y) < 6 * FIRST:
                found.append(self.family.station(y, side * other))
        return found


class DoubledFollower(CurveFollower):
    """Follows a branch that begins at a flip, but not on to the orbits of half its period."""

    def _next(self, station: Station, step: float) -> Station | None:
        found = super()._next(station, step)
        return None if found is None or self.family.repeats(found.y) else found


def _passage(p: Parameters, side: int, v: float) -> Floats:
    """Return the saltation matrix of a hit at t = 0, or its inverse if v is that after the hit."""
    o, ahead = oscillator(p), side * v > 0
    before = v if ahead else -v / o.e
    matrix = np.array(o.hit(((1.0, 0.0), (0.0, 1.0)), o.saltation(side, before, 1.0)))
    return matrix if ahead else np.linalg.inv(matrix)


def _in_order(a: Station, b: Station, found: list[Change]) -> list[Station]:
    """Return the stations located between a and b, along the curve."""
    located = [station for each in found for station in each.around]
    return sorted(located, key=lambda s: float((s.y - a.y) @ (b.y - a.y)))


def _has_multiplier_1(station: Station) -> bool:
    """Return whether the implicit function theorem fails: at folds, and where branches cross."""
    defect = abs(1 - station.trace + station.determinant)
    return defect < MULTIPLIER * (1 + abs(station.trace))


def _reason(station: Station) -> str:
    margin, label = station.margins.nearest
    return f"end: {label}" if margin < NEAR else "end: Newton's method fails"
