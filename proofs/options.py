"""Options of the command line that several theorems take; each theorem names those that it takes.

An option of one theorem is declared in its module.  `Setting.of` gives the value.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any, NoReturn

from cap.errors import BadInput
from cap.option import Option, count, exact_number, masses, path
from cap.parameters import Parameters, exact

FROM = Option("from", exact_number, "for f from here", "Q", word="lowest", about=True)
TO = Option("to", exact_number, "for f up to here", "Q", word="highest", about=True)
RANGE_OF_F = (FROM, TO)
MOST_PERIODS = 10**18

JOBS = Option("jobs", count(1, 1024), "processes (default 1)", "N", default=1)
JOURNAL = Option(
    "journal", path, "a file of what is done, from which an interrupted proof goes on", "FILE"
)


def _proportional(_words: Sequence[str], _name: str) -> NoReturn:
    raise BadInput(
        "with friction f m_i and unequal masses a collision preserves sum m_i dv_i^dx_i only if it "
        "keeps the signs of both velocities, and no orbit that never stops has such collisions "
        "only (theorem symplectic); two equal masses m have the friction force f m: give it as --f"
    )


MASSES = Option(
    "masses",
    masses,
    "two masses, as 1,9/10, on each of which the forcing F and the friction f act; their orbits "
    "are found from equal masses, or from random states",
    "M1,M2",
    default=(),
    about=True,
)
PROPORTIONAL = Option(
    "proportional",
    _proportional,
    "with --masses: the friction f m_i instead of f; there is nothing to prove then, and this says "
    "why",
    nargs=0,
)
OF_MASSES = (MASSES, PROPORTIONAL)


def _periods(words: Sequence[str], name: str) -> Fraction:
    value = exact(words[0])
    if value.denominator != 1 or not 1 <= value <= MOST_PERIODS:
        raise BadInput(f"--{name} must be an integer from 1 to 1e18: {words[0].strip()[:40]!r}")
    return value


PERIODS = Option(
    "periods",
    _periods,
    "so many periods N, forwards and backwards, at most 1e18 (default 1e9, of two masses 1e6): the "
    "more, the smaller the ellipse",
    "N",
    about=True,
)


def range_of_f(
    options: Mapping[str, Any], _parameters: Parameters
) -> tuple[Fraction | None, Fraction | None]:
    """Return the ends of the range of f, as far as they are given.

    Raises `BadInput` unless 0 < from < to.
    """
    low, high = (options.get(option.name) for option in RANGE_OF_F)
    ends = [f for f in (Fraction(0), low, high) if f is not None]
    if any(a >= b for a, b in pairwise(ends)):
        raise BadInput("the range must be 0 < from < to")
    return low, high


def whole_range_of_f(
    options: Mapping[str, Any], parameters: Parameters
) -> tuple[Fraction, Fraction]:
    """Return both ends of the range of f; raise `BadInput` unless 0 < from < to < F."""
    low, high = range_of_f(options, parameters)
    if low is None or high is None or not high < parameters.F:
        raise BadInput("say for which f: --from Q --to Q, below F")
    return low, high
