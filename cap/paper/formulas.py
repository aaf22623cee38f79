"""Formulas of the paper for where orbits should begin and end, in floats, at ω = 1."""

import math

from cap.paper.figure import Found, Run
from cap.parameters import PAPER


def impulse_forcing() -> float:
    """Return F_imp = πf/2."""
    return math.pi * float(PAPER.f) / 2


def saddle_center(R: float, F: float = 1) -> float:
    """Return f_sc = 4 (2F + R - πF)/π², at which no orbit bifurcates."""
    return 4 * (2 * F + R - F * math.pi) / math.pi**2


def evaluated(_run: Run, F: str = "1") -> Found:
    """Evaluate them at F: f_imp = 2F/π, F_imp, f_sc, and the F at which f_sc is the paper's f."""
    f, R = float(PAPER.f), float(PAPER.R)
    return {
        "impulse": 2 * float(F) / math.pi,
        "forcing": impulse_forcing(),
        "saddle_center": saddle_center(R, float(F)),
        "saddle_center_forcing": (f * math.pi**2 - 4 * R) / (4 * (2 - math.pi)),
    }
