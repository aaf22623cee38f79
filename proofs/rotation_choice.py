"""Which rotation number an invariant curve is to have: the options, and what is tried without."""

import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any

from cap.errors import BadInput, NotProved
from cap.floats.candidates import tori
from cap.option import Option
from cap.parameters import Parameters
from cap.proofs.fixed_point import Setting
from cap.tori.rotation import Quadratic

_FORM = re.compile(r"\[0;((?:\d{1,3},)*)(?:\((\d{1,3}(?:,\d{1,3})*)\)|(\d{1,3}),\.\.\.)\]")
LONGEST = 40
POINTS = 60
USUAL = Fraction(3, 4), Fraction(22, 25)  # of the largest radius: where the usual curve is
OUTWARDS = ((93, 97), (96, 100))  # the same, in hundredths, for the largest


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
    "is the result; this takes minutes to a quarter of an hour",
    nargs=0,
)


def together(options: Mapping[str, Any], parameters: Parameters) -> None:  # noqa: ARG001
    """Raise `BadInput` if both options are given."""
    if ROTATION.name in options and LARGEST.name in options:
        raise BadInput("--rotation and --largest do not go together")


def chosen(setting: Setting, centre: Any) -> Iterator[Quadratic]:
    """Yield the rotation numbers to try, in this order."""
    asked, largest = setting.of(ROTATION), LARGEST.name in setting.options
    if asked:
        yield asked
        return
    setting.progress("the largest curve that floats show is looked for")
    last = tori.last_radius(centre)
    usual = [tuple(float(part) * last for part in USUAL)]
    rings = [(a / 100 * last, b / 100 * last) for a, b in OUTWARDS[::-1]] if largest else usual
    for ring in rings:
        ends = sorted(centre.turns(r, tori.LONG) for r in ring)
        found = noble(ends[0], ends[1])
        if found:
            yield found
    if not largest:
        return
    yield from (noble_near(centre.turns(part / 100 * last, tori.LONG)) for part in (90, 80, 70))


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


def noble_near(value: float) -> Quadratic:
    """Return a noble number within 1e-4."""
    found = noble(value - 1e-4, value + 1e-4)
    if found is None:
        raise NotProved("search", "no noble rotation number was found", {"near": value})
    return found
