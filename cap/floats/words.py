"""Parameters and numbers for a line of text."""

import math
from fractions import Fraction

from cap.parameters import PAPER, Parameters


def described(p: Parameters) -> str:
    """Return the parameters for a line of text; those of losses only if there are any."""
    paper = PAPER.strings()
    strings = {**p.strings(), "R": str(p.R)}
    shown = ["F", "omega", "f", "R"]
    shown += [name for name in ("e", "mu") if strings[name] != paper[name]]
    return ", ".join(f"{name} = {short(strings[name])}" for name in shown)


def short(number: str) -> str:
    """Return an exact number as it is if it is short, else six digits of it."""
    return number if len(number) <= 8 else f"{float(Fraction(number)):.6g}"


def with_error(value: float, error: float) -> str:
    """Return a number with two digits of its error; with six digits if it has none."""
    if not (math.isfinite(value) and error > 0):
        return f"{value:.6g}"
    places = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{places}f} +- {error:.{places}f}"
