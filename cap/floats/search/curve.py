"""Curves of fixed points of Φⁿ over a parameter: Newton's method in the plane across the curve.

A point is y = (x/R, v/(Rω), λ/scale) with R and ω where the curve begins.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.findings import Floats, State
from cap.floats.search.border import Margins, margins
from cap.floats.variation import value_of, varied
from cap.parameters import Parameters

EXACT = 1e-11  # residual of a point of the curve
STEPS = 10  # of Newton's method
SMALL = 1e-6  # by how much the image moves, at least, in a divided difference in the parameter
HALVINGS = 40
SAME = 1e-6  # states that differ by less are of one orbit


@dataclass(frozen=True)
class FixedPoints:
    """The fixed points of Φⁿ for all values of one parameter."""

    p: Parameters
    name: str
    periods: int

    @cached_property
    def unit(self) -> Floats:
        """The natural units of y."""
        value = abs(value_of(self.p, self.name))
        return np.array([float(self.p.R), float(self.p.R * self.p.omega), value or 1.0])

    def at(self, y: Floats) -> tuple[Parameters, State]:
        """Return the parameters and the state of a point."""
        x, v, value = (y * self.unit).tolist()
        return varied(self.p, self.name, value), (x, v)

    def point(self, state: State) -> Floats:
        """Return y for a state at the parameters themselves."""
        return np.array([*state, value_of(self.p, self.name)]) / self.unit

    def _image(self, y: Floats) -> tuple[Floats, Floats]:
        p, state = self.at(y)
        found = swarm.follow(p, [state], self.periods, derivative=True)
        if found.monodromy is None or not np.isfinite(found.states).all():
            raise BadInput(f"no state: {state}")
        return found.states[0] / self.unit[:2], found.monodromy[0]

    def defect(self, y: Floats) -> tuple[Floats, Floats]:
        """Return G = Φⁿ - 1 and its derivative (2, 3), in units of y."""
        image, monodromy = self._image(y)
        jacobian = np.empty((2, 3))
        jacobian[:, :2] = monodromy / self.unit[:2, None] * self.unit[:2] - np.eye(2)
        small = SMALL / max(1.0, float(np.abs(jacobian[:, :2]).max()))  # an orbit so unstable …
        step = np.array([0, 0, small])  # … soon has other events
        ends = []
        for side in (1, -1):
            try:
                ends.append((self._image(y + side * step)[0], side))
            except BadInput:
                ends.append((image, 0))  # at the end of the parameter's range
        (high, a), (low, b) = ends
        jacobian[:, 2] = (high - low) / (small * ((a - b) or 1))
        return image - y[:2], jacobian

    def corrected(self, y: Floats, across: Floats) -> Floats | None:
        """Return the point of the curve in the plane through y across a direction, or None."""
        begin = y
        for _ in range(STEPS):
            try:
                defect, jacobian = self.defect(y)
            except BadInput:
                return None
            square = np.vstack([jacobian, across])
            right = np.append(defect, (y - begin) @ across)
            if not np.isfinite(square).all() or abs(np.linalg.det(square)) < 1e-14:
                return None
            step = np.linalg.solve(square, right)
            y = y - step
            size = float(np.abs(step).max())
            if size < EXACT:
                return y
            if not size < 0.3:
                return None
        return y if size < 1e-8 else None

    def station(self, y: Floats, forward: Floats) -> "Station":
        """Return a point of the curve with what tells its bifurcations."""
        p, state = self.at(y)
        _, jacobian = self.defect(y)
        tangent = np.cross(jacobian[0], jacobian[1])
        size = float(np.linalg.norm(tangent))
        tangent = tangent / size if size > 1e-12 else forward
        square = np.vstack([jacobian, tangent])  # det = size > 0 before it is turned
        if tangent @ forward < 0:
            tangent = -tangent
            square[2] = tangent
        monodromy = jacobian[:, :2] + np.eye(2)
        return Station(
            y,
            tangent,
            float(np.trace(monodromy)),
            float(np.linalg.det(monodromy)),
            float(np.linalg.det(square)),
            margins(p, state, self.periods),
        )

    def repeats(self, y: Floats) -> bool:
        """Return whether half of the n periods are a period already; n is even."""
        p, state = self.at(y)
        half = swarm.follow(p, [state], self.periods // 2).states[0]
        return bool(np.abs((half - state) / self.unit[:2]).max() < SAME)

    def symmetry_defect(self, y: Floats) -> float:
        """Return how far the orbit is from its mirror image half a period later; n = 1."""
        p, (x, v) = self.at(y)
        half = swarm.follow(p, [(x, v)], self.periods / 2).states[0]
        mirror = np.array([float(p.l + p.r) - half[0], -half[1]])
        return float(np.abs((mirror - [x, v]) / self.unit[:2]).max())


@dataclass(frozen=True)
class Station:
    """A point of a curve: y, the unit tangent, trace and determinant of the monodromy.

    ``branching`` changes its sign where another curve crosses.
    """

    y: Floats
    tangent: Floats
    trace: float
    determinant: float
    branching: float
    margins: Margins


def halve(
    family: FixedPoints,
    a: Station,
    b: Station,
    is_before: Callable[[Station], bool],
    least: float = 1e-10,
) -> tuple[Station, Station]:
    """Return neighbours between a and b on the curve, the first before a change, the other not.

    They are ``least`` apart, or farther where Newton's method fails.
    """
    for _ in range(HALVINGS):
        chord = b.y - a.y
        length = float(np.linalg.norm(chord))
        if length < least:
            break
        y = family.corrected((a.y + b.y) / 2, chord / length)
        if y is None or not abs((y - a.y) @ chord) < length**2:
            break
        try:
            middle = family.station(y, chord / length)
        except BadInput:
            break
        a, b = (middle, b) if is_before(middle) else (a, middle)
    return a, b
