"""Intervals of doubles, rounded outwards: what sweeps over millions of cells compute with.

`Interval` (m, r) is the set of the reals x with |x - m| <= r.  Every operation returns an interval
that contains the exact results for all points of its operands.  An interval with a NaN or an
infinity says nothing, and no comparison holds for it: overflow and division by zero are failures,
never results.

*Rounding.*  Only + - * / and sqrt of doubles are used, rounded to nearest, with gradual underflow
(`cap.sets.compiled.require_ieee` asks the processor).  Let u = 2^-53.  Then, without overflow,

    |fl(a ± b) - (a ± b)| <= u |fl(a ± b)|,       |fl(a ∘ b) - a ∘ b| <= u |fl(a ∘ b)| + 2^-1075

for ∘ among * and /, and the first also holds for sqrt.  A radius is a sum of nonnegative terms.
Each rounding on the way may lose a factor of 1 - u, and (1 - u)^15 (1 + 2^-49) > 1, so after at
most 14 of them a product with `GROWTH` = 1 + 2^-49, itself rounded, is an upper bound.
What underflow can lose, a few times 2^-1075, is covered by `TINY` = 2^-1022.  (Where only sums are
formed, as in x + y, nothing underflows: sums of doubles below 2^-1021 are exact.)

The same functions run in Python and, by `cap.sets.compiled`, in compiled code.
"""

import math
from fractions import Fraction
from typing import Union

UNIT = 2.0**-53
GROWTH = 1 + 2.0**-49
TINY = 2.0**-1022

Operand = Union["Interval", float]


class Interval:
    """The reals within ``rad`` >= 0 of ``mid``; a float operand stands for itself, exactly."""

    __slots__ = ("mid", "rad")

    def __init__(self, mid: float, rad: float) -> None:
        self.mid = mid
        self.rad = rad

    def __repr__(self) -> str:
        return f"Interval({self.mid!r}, {self.rad!r})"

    def __reduce__(self) -> tuple[type["Interval"], tuple[float, float]]:
        return Interval, (self.mid, self.rad)

    def __neg__(self) -> "Interval":
        return negative(self)

    def __add__(self, other: Operand) -> "Interval":
        return add(self, _lifted(other))

    def __radd__(self, other: float) -> "Interval":
        return add(_lifted(other), self)

    def __sub__(self, other: Operand) -> "Interval":
        return subtract(self, _lifted(other))

    def __rsub__(self, other: float) -> "Interval":
        return subtract(_lifted(other), self)

    def __mul__(self, other: Operand) -> "Interval":
        return multiply(self, _lifted(other))

    def __rmul__(self, other: float) -> "Interval":
        return multiply(_lifted(other), self)

    def __truediv__(self, other: Operand) -> "Interval":
        return divide(self, _lifted(other))

    def __rtruediv__(self, other: float) -> "Interval":
        return divide(_lifted(other), self)


def _lifted(x: Operand) -> Interval:
    return x if isinstance(x, Interval) else Interval(x, 0.0)


def negative(x: Interval) -> Interval:
    """Return -x, exactly."""
    return Interval(-x.mid, x.rad)


def add(x: Interval, y: Interval) -> Interval:
    """Return x + y.  The radius is r_x + r_y and the rounding of the midpoint: 3 roundings."""
    m = x.mid + y.mid
    return Interval(m, ((x.rad + y.rad) + UNIT * abs(m)) * GROWTH)


def subtract(x: Interval, y: Interval) -> Interval:
    """Return x - y, as `add`."""
    m = x.mid - y.mid
    return Interval(m, ((x.rad + y.rad) + UNIT * abs(m)) * GROWTH)


def multiply(x: Interval, y: Interval) -> Interval:
    """Return x y.

    With x = m + a, y = n + b: |x y - m n| = |m b + a (n + b)| <= |m| r_y + r_x (|n| + r_y).
    Six roundings.
    """
    m = x.mid * y.mid
    spread = abs(x.mid) * y.rad + x.rad * (abs(y.mid) + y.rad)
    return Interval(m, ((spread + UNIT * abs(m)) + TINY) * GROWTH)


def square(x: Interval) -> Interval:
    """Return the squares of the points: |(m + a)² - m²| <= r (2|m| + r)."""
    m = x.mid * x.mid
    spread = x.rad * (2 * abs(x.mid) + x.rad)
    return Interval(m, ((spread + UNIT * abs(m)) + TINY) * GROWTH)


def divide(x: Interval, y: Interval) -> Interval:
    """Return x / y; NaN unless y is bounded, and certain not to contain 0.

    With q = fl(m/n): x/y - m/n = ((x - m) + (m/n)(n - y))/y, and |m/n| <= |q| (1 + u) + 2^-1075,
    so |x/y - m/n| <= (r_x + (|q| (1 + u) + 2^-1075) r_y)/(|n| - r_y).  Nine roundings.
    """
    least = abs(y.mid) - y.rad
    if not 0 < least < math.inf:
        return Interval(math.nan, math.nan)
    q = x.mid / y.mid
    spread = ((x.rad + (abs(q) + TINY) * y.rad) + TINY) / least
    return Interval(q, ((spread + UNIT * abs(q)) + TINY) * GROWTH)


def sqrt(x: Interval) -> Interval:
    """Return the square roots; NaN unless all points are certain to be positive.

    |√x - √m| = |x - m|/(√x + √m) <= r/(√(m - r) + √m).
    """
    least = x.mid - x.rad
    if not least > 0:
        return Interval(math.nan, math.nan)
    s = math.sqrt(x.mid)
    spread = x.rad / (s + math.sqrt(least))
    return Interval(s, (spread + UNIT * s) * GROWTH)


def is_positive(x: Interval) -> bool:
    """Return whether all points are certain to be > 0: exact, and False for NaN."""
    return x.mid > x.rad


def is_negative(x: Interval) -> bool:
    """Return whether all points are certain to be < 0."""
    return -x.mid > x.rad


def is_finite(x: Interval) -> bool:
    """Return whether it is a bounded set."""
    return abs(x.mid) < math.inf and 0 <= x.rad < math.inf


def below(x: Interval, y: Interval) -> bool:
    """Return whether each point of x is certain to be less than each of y."""
    return upper(x) < lower(y)


def upper(x: Interval) -> float:
    """Return a double that is >= all points.

    With h = fl(m + r) >= (m + r) - u|h|, fl(h + 4u|h|) >= (h + 4u|h|)(1 ∓ u) >= h + u|h|.
    """
    h = x.mid + x.rad
    return h + 4 * UNIT * abs(h)


def lower(x: Interval) -> float:
    """Return a double that is <= all points."""
    h = x.mid - x.rad
    return h - 4 * UNIT * abs(h)


def magnitude(x: Interval) -> float:
    """Return a double that is >= the absolute values of all points."""
    return (abs(x.mid) + x.rad) * GROWTH


def widened(x: Interval, by: float) -> Interval:
    """Return the points within ``by`` >= 0 of those of x."""
    return Interval(x.mid, (x.rad + by) * GROWTH)


def between(low: float, high: float) -> Interval:
    """Return an interval that contains [low, high]; NaN unless low <= high.

    m may be any double.  Each of |high - m| and |m - low| is rounded once.
    """
    if not low <= high:
        return Interval(math.nan, math.nan)
    m = 0.5 * low + 0.5 * high
    return Interval(m, max(high - m, m - low) * GROWTH)


def hull(x: Interval, y: Interval) -> Interval:
    """Return an interval that contains both; NaN unless both are bounded."""
    if not (is_finite(x) and is_finite(y)):
        return Interval(math.nan, math.nan)
    return between(min(lower(x), lower(y)), max(upper(x), upper(y)))


def clipped(x: Interval, low: float, high: float) -> Interval:
    """Return an interval that contains the points of x in [low, high]; NaN if there is none."""
    least, most = lower(x), upper(x)
    if least >= low and most <= high:
        return x
    return between(low if least < low else least, high if most > high else most)


def enclosing(value: Fraction | int) -> Interval:
    """Return the interval around the nearest double that contains a rational."""
    exact = Fraction(value)
    mid = float(exact)
    gap = abs(exact - Fraction(mid))
    rad = float(gap)
    return Interval(mid, rad if Fraction(rad) >= gap else math.nextafter(rad, math.inf))


BRANCHING = (divide, sqrt, is_finite, between, hull, clipped)
