"""Which rotation number an invariant curve is to have: the options, and what is tried without."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from cap.errors import BadInput
from cap.floats.candidates import tori
from cap.option import Option
from cap.parameters import Parameters
from cap.proofs.fixed_point import Setting
from cap.tori.rotation import Quadratic

_FORM = re.compile(r"\[0;((?:\d{1,3},)*)(?:\((\d{1,3}(?:,\d{1,3})*)\)|(\d{1,3}),\.\.\.)\]")
LONGEST = 40
POINTS = 60
INWARDS = ((75, 88), (65, 75), (55, 65), (47, 55), (40, 47), (33, 40), (25, 33), (18, 25), (12, 18),
           (5, 8))  # fmt: skip
OUTERMOST = ((96, 100), (93, 97), (88, 94), (82, 89), *INWARDS)
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


class Sought(NamedTuple):
    """The rotation number of a curve, and between which radii to look for it."""

    rotation: Quadratic
    ring: tuple[float, float]


class Place(Protocol):
    """Where an island is."""

    @property
    def centre(self) -> tori.Centre:
        """The elliptic point, in floats."""

    @property
    def last(self) -> float:
        """The radius of the last orbit found that goes on."""


def together(options: Mapping[str, Any], parameters: Parameters) -> None:  # noqa: ARG001
    """Raise `BadInput` if both options are given."""
    if ROTATION.name in options and LARGEST.name in options:
        raise BadInput("--rotation and --largest do not go together")


def chosen(setting: Setting, place: Place) -> Iterator[Sought]:
    """Yield the curves to try, in this order."""
    asked, largest = setting.of(ROTATION), LARGEST.name in setting.options
    if asked:
        yield Sought(asked, (0.0, place.last))
        return
    setting.progress("the largest curve that floats show is looked for")
    yield from within(place, OUTERMOST if largest else INWARDS)


def within(place: Place, rings: Sequence[tuple[int, int]] = INWARDS) -> Iterator[Sought]:
    """Yield curves in the rings, each rotation number once."""
    known = set[Quadratic]()
    for begin, end in rings:
        ring = begin / 100 * place.last, end / 100 * place.last
        low, high = sorted(place.centre.turns(r, tori.LONG) for r in ring)
        found = noble(low, high)
        if found and found not in known:
            known.add(found)
            yield Sought(found, ring)


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
