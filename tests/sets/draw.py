"""Random doubles and intervals: zeros, ends of the range, subnormals and powers of two are among
them."""

import math
import sys
from fractions import Fraction

from cap.sets.doubles import Interval

SPECIAL = (0.0, 1.0, 2.0**-1074, 2.0**-1022, 2.0**-1023, 3 * 2.0**-1074, 2.0**-53, 1 + 2.0**-52)


def double(random, most=300):
    """Return a double of either sign; its decimal exponent is at most ``most`` in size."""
    if random.random() < 0.1:
        value = random.choice(SPECIAL)
    elif random.random() < 0.1:
        value = math.ldexp(1.0, random.randint(-1074, 4 * most // 3))
    elif random.random() < 0.5:
        value = random.uniform(0, 2)
    else:
        value = random.uniform(1, 10) * 10.0 ** random.uniform(-most, most - 1)
    value = min(value, 10.0**most)
    return random.choice((-1, 1)) * value


def interval(random, most=300):
    """Return an interval; points are among them."""
    mid = double(random, most)
    kind = random.randint(0, 3)
    if kind == 0:
        return Interval(mid, 0.0)
    if kind == 1:
        return Interval(mid, abs(double(random, most)))
    return Interval(mid, abs(mid) * 10.0 ** random.uniform(-18, 0.3))


def point(random, x):
    """Return a rational in an interval; the ends are among them."""
    mid, rad = Fraction(x.mid), Fraction(x.rad)
    return mid + rad * random.choice((-1, 0, 1, Fraction(random.randint(-97, 97), 97)))


def holds(x, value):
    """Return whether a bounded interval contains a rational."""
    return abs(Fraction(x.mid) - value) <= Fraction(x.rad)


def bounded(x):
    """Return whether an interval is bounded."""
    return math.isfinite(x.mid) and 0 <= x.rad <= sys.float_info.max
