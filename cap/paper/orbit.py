"""fig:orbit: the elliptic orbit, its linearization, and the enclosures of Theorem CAP-elliptic."""

import math
from decimal import Decimal
from fractions import Fraction

import numpy as np

from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.maps.twist import regular_twist
from cap.paper.certified import theorem
from cap.paper.figure import Found, Run, differences
from cap.paper.nine_points import number_of_orbits
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.jet import Jet, Space

STATE = 0.1002798898441954, 0.5419433067664584  # the paper's
BOX = {"x": Fraction("0.1002798898"), "v": Fraction("0.5419433068")}  # its centre; the paper's
RADIUS = Fraction(1, 10**9)
TURNS = 0.286959765175, 0.286959765193  # the paper's enclosure of the rotation number
STENCILS = ([0, 0, 1, 0, 0], [0, -0.5, 0, 0.5, 0], [0, 1, -2, 1, 0], [-0.5, 1, 0, -1, 0.5])
"""Of the derivatives of order 0 to 3, by central differences."""


def data(_run: Run) -> Trajectory:
    """Follow the orbit for a period."""
    return trajectory(PAPER, orbit=STATE, periods=1)


def proved(_run: Run) -> Found:
    """Enclose the orbit and what follows from it; say how near the paper's numbers are.

    The determinant is 1, as that of every flight and hit.
    """
    own = theorem("elliptic", STATE)
    quarter = float(own["resonance_distances"]["1/4"][0])
    return own | {
        "right": [_right(value, own[name]) for value, name in zip(STATE, "xv", strict=True)],
        "speed": own["least_speed"][0][:10],
        "moves": Fraction(own["least_speed"][0]) > 0,
        "determinant": ["1", "1"],
        "degrees": math.degrees(float(own["rotation_angle"][0])),
        "unique": f"{own['box']['x']} x {own['box']['v']}".replace("'", ""),
        "inside": all(
            Fraction(low) < BOX[name] - RADIUS and BOX[name] + RADIUS < Fraction(high)
            for name, (low, high) in own["box"].items()
        ),
        "orders": math.log10(quarter / (TURNS[1] - TURNS[0])),
    }


def _right(value: float, pair: list[str]) -> int:
    """Return to how many digits a number is right."""
    error = abs(Decimal(repr(value)) - Decimal(pair[0]))
    return math.floor(-math.log10(float(error) / abs(value)))


def returns(_run: Run) -> Found:
    """Follow the printed state for a period, and take the paper's differences there."""
    defect = np.abs(swarm.follow(PAPER, [STATE], 1).states[0] - STATE).max()
    determinant = float(np.linalg.det(differences(np.array([STATE]))[0]))
    return {
        "defect": defect,
        "events": len(swarm.itinerary(PAPER, STATE, 1)) + 1,
        "determinant": determinant,
        "error": abs(determinant - 1),
    }


def alone(_run: Run) -> Found:
    """Count the orbits that hit each wall once per period."""
    return {"orbits": number_of_orbits()}


def twist(_run: Run) -> Found:
    """Take the twist from differences."""
    return {"by_differences": by_differences(1e-3)}


def by_differences(step: float) -> float:
    """Return τ₁ from the Taylor polynomial of Φ at P* by central differences."""
    k = np.arange(-2, 3)
    x, v = np.meshgrid(k, k, indexing="ij")
    starts = np.array(STATE) + step * np.stack([x.ravel(), v.ravel()], axis=-1)
    images = swarm.follow(PAPER, starts, 1).states - np.array(STATE)
    space = Space(2, 3)
    jets = [
        Jet(space, [interval.ball(Fraction(_difference(images[:, c], i, j, step)))
                    for i, j in space.exponents])
        for c in (0, 1)
    ]  # fmt: skip
    sign = 1 if jets[1][1, 0] > 0 else -1
    return float(regular_twist(jets[0], jets[1], sign) / (1 + jets[0][1, 0] + jets[1][0, 1]))


def _difference(values: Floats, i: int, j: int, step: float) -> float:
    """Return the coefficient of x^i v^j from values on 5 x 5 points."""
    weights = np.outer(STENCILS[i], STENCILS[j]).ravel()
    return float(weights @ values) / (step ** (i + j) * math.factorial(i) * math.factorial(j))
