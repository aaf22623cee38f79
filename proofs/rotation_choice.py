"""Which rotation number an invariant curve is to have: the options, and what is tried without."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from cap.errors import BadInput
from cap.floats.candidates import tori
from cap.option import Option
from cap.parameters import Parameters
from cap.proofs.fixed_point import Setting
from cap.tori.rotation import Quadratic

_FORM = re.compile(r"\[0;((?:\d{1,3},)*)(?:\((\d{1,3}(?:,\d{1,3})*)\)|(\d{1,3}),\.\.\.)\]")
LONGEST = 40
POINTS = 60
INWARDS = ((75, 88), (55, 65), (40, 50), (25, 35), (12, 18), (5, 8))
OUTERMOST = ((96, 100), (93, 97), (88, 94), (82, 89), (75, 83), (68, 76), *INWARDS[1:])
"""Where curves are tried, one after the other, in hundredths of the largest radius."""


def rotation(words: Sequence[str], name: str) -> Quadratic:
    """Read [0;3,1,1,6,(1)], or [0;3,1,1,6,1,...]."""
    match = _FORM.fullmatch(words[0].replace(" ", "").replace("…", "..."))
    if match is None:
        raise BadInput(
            f"--{name} must be a periodic continued fraction, as [0;3,1,(1)] with the period in "
            f"parentheses, or [0;3,1,...] where the last quotient is repeated: {words[0][:40]!r}"
        )
    head = tuple(int(a) for a in match[1].split(",") if a)
    period = tuple(int(a) for a in (match[2] or match[3]).split(","))
    if 0 in head + period or not 0 < len(head) + len(period) <= LONGEST:
        raise BadInput(f"--{name} has a quotient 0, or more than {LONGEST} quotients")
    return Quadratic(head or period, period)


ROTATION = Option(
    "rotation",
    rotation,
    "the rotation number of the curve, as [0;3,1,1,6,(1)]: a continued fraction with its period in "
    "parentheses; [0;3,1,...] repeats the last quotient.  Default: a noble number of a curve well "
    "inside the last one",
    "[0;A,...]",
)
LARGEST = Option(
    "largest",
    None,
    "try curves from the outside inwards, from the last that floats show: the first that is proved "
    "is the result; this takes minutes, at the paper's parameters three",
    nargs=0,
)


def together(options: Mapping[str, Any], parameters: Parameters) -> None:  # noqa: ARG001
    """Raise `BadInput` if both options are given."""
    if ROTATION.name in options and LARGEST.name in options:
        raise BadInput("--rotation and --largest do not go together")


def chosen(setting: Setting, centre: tori.Centre) -> Iterator[Quadratic]:
    """Yield the rotation numbers to try, in this order."""
    asked, largest = setting.of(ROTATION), LARGEST.name in setting.options
    if asked:
        yield asked
        return
    setting.progress("the largest curve that floats show is looked for")
    yield from within(centre, OUTERMOST if largest else INWARDS)


def within(centre: tori.Centre, rings: Sequence[tuple[int, int]] = INWARDS) -> Iterator[Quadratic]:
    """Yield rotation numbers of curves in the rings, each once."""
    last, known = tori.last_radius(centre), set[Quadratic]()
    for ring in rings:
        low, high = sorted(centre.turns(part / 100 * last, tori.LONG) for part in ring)
        found = noble(low, high)
        if found and found not in known:
            known.add(found)
            yield found


def noble(low: float, high: float) -> Quadratic | None:
    """Return, of the noble numbers near some points of (low, high), the farthest from rationals."""
    points = (low + (high - low) * (k + 0.5) / POINTS for k in range(POINTS))
    found = [q for q in (simplest(point, low, high) for point in points) if q]
    return max(found, key=lambda q: (q.diophantine(), -len(q.head)), default=None)


def simplest(point: float, low: float, high: float) -> Quadratic | None:
    """Return the number in (low, high) with the shortest head of the point, before ones."""
    head, rest = list[int](), point
    while len(head) < 16 and rest > 1e-9:
        rest = 1 / rest
        head.append(int(rest))
        rest -= int(rest)
        found = Quadratic(tuple(head), (1,))
        if head[-1] < 1000 and low < float(found.value()) < high:
            return found
    return None
