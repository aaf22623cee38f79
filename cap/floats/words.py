"""Parameters and numbers for a line of text."""

import math
from collections.abc import Mapping
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from cap.parameters import PAPER, Parameters


def described(p: Parameters, varying: Mapping[str, ArrayLike] | None = None) -> str:
    """Return the parameters for a line of text; those that vary with the least and largest value.

    Those of losses only if there are any.
    """
    paper, varying = PAPER.strings(), varying or {}
    strings = {**p.strings(), "R": str(p.R)}
    shown = ["F", "omega", "f", "R"]
    shown += [n for n in ("e", "mu") if n in varying or strings[n] != paper[n]]
    values = {
        n: " .. ".join(ends(varying[n])) if n in varying else short(strings[n]) for n in shown
    }
    return ", ".join(f"{name} = {value}" for name, value in values.items())


def ends(values: ArrayLike) -> list[str]:
    """Return the least and the largest of some values for a text: one word if they are the same."""
    known = np.asarray(values, dtype=float)
    if not known.size:
        return ["?"]
    return list(dict.fromkeys(f"{end:.6g}" for end in (known.min(), known.max())))


def short(number: str) -> str:
    """Return an exact number as it is if it is short, else six digits of it."""
    return number if len(number) <= 8 else f"{float(Fraction(number)):.6g}"


def with_error(value: float, error: float) -> str:
    """Return a number with two digits of its error; with six digits if it has none."""
    if not (math.isfinite(value) and error > 0):
        return f"{value:.6g}"
    places = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{places}f} +- {error:.{places}f}"
