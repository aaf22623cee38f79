"""Formulas of the paper for where orbits should begin and end, in floats; F and ω are 1."""

import math

from cap.parameters import PAPER


def impulse_bound() -> float:
    """Return f_imp = 2F/π."""
    return 2 * float(PAPER.F) / math.pi


def impulse_forcing() -> float:
    """Return F_imp = πf/2."""
    return math.pi * float(PAPER.f) / 2


def saddle_center(R: float, F: float = 1) -> float:
    """Return f_sc = 4 (2F + R - πF)/π², at which no orbit bifurcates."""
    return 4 * (2 * F + R - F * math.pi) / math.pi**2


def saddle_center_forcing() -> float:
    """Return F_sc, the F at which f_sc is the paper's f."""
    f, R = float(PAPER.f), float(PAPER.R)
    return (f * math.pi**2 - 4 * R) / (4 * (2 - math.pi))
