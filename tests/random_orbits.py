"""Random boxes of states, at random parameters, for random times: what the certified flow is for.

All numbers are rationals of small denominators that are no powers of two.
"""

from dataclasses import dataclass
from fractions import Fraction

from mpmath import mp, workdps
from support import rational

from cap.parameters import Parameters

KINDS = ("flying", "leaving a wall", "at rest", "at rest at a wall")
with workdps(80):
    TURN = rational(2 * mp.pi)


@dataclass(frozen=True)
class Case:
    """All states within ``radius`` of (``x``, ``v``), at the time ``start``, until ``end``.

    At a ``wall`` x is exactly that wall; a v that is 0 is exactly 0.  If ``periods`` is not 0, the
    start is at 0 and the end is so many periods later, to 80 digits.
    """

    p: Parameters
    x: Fraction
    v: Fraction
    wall: int
    radius: tuple[Fraction, Fraction]
    start: Fraction
    end: Fraction
    periods: int
    bits: int

    @property
    def varies(self):
        """Whether x and v vary in the box."""
        return not self.wall, self.v != 0

    def state(self, random):
        """Return a point of the box, a corner as often as not."""
        part = [random.choice([1, -1, Fraction(random.randint(-99, 99), 100)]) for _ in "xv"]
        far = [k * r * free for k, r, free in zip(part, self.radius, self.varies, strict=True)]
        return self.x + far[0], self.v + far[1]


def case(random, kind, longest):
    """Return a case that starts in this way and lasts up to so many periods."""
    p = parameters(random)
    wall = random.choice([1, -1]) if kind.endswith("a wall") else 0
    x = {1: p.r, -1: p.l, 0: p.l + p.R * Fraction(random.randint(1, 96), 97)}[wall]
    v = p.F / p.omega * Fraction(random.randint(1, 500), 199) * random.choice([1, -1])
    v = Fraction(0) if "rest" in kind else -wall * abs(v) or v
    start, end, periods, bits = times(random, longest, wall)
    size = random.choice([0, Fraction(1, 10**12), Fraction(1, 10**9), Fraction(1, 3 * 10**6)])
    room = min(p.R, p.F / p.omega**2)
    radius = room * size, p.omega * room * size
    return Case(p, x, v, wall, radius, start / p.omega, end / p.omega, periods, bits)


def times(random, longest, wall):
    """Return start and end, for ω = 1, whole periods or 0, and bits that are enough for them."""
    bits = random.choice([53, 80, 150])
    if not wall and random.random() < 0.3:
        periods = random.randint(1, longest)
        return Fraction(0), periods * TURN, periods, bits
    late = random.choice([0, 0, 1, 17, 10**3 + 1, 10**6 + 3, 10**11 + 7])
    start = Fraction(round(late * TURN * 1009 + random.randint(0, 6300)), 1009)
    last = start + Fraction(random.randint(1, 44 * longest), 7)
    return start, last, 0, bits + late.bit_length()


def parameters(random):
    """Return parameters: with or without losses, little friction or much, narrow or wide."""
    F, omega = (Fraction(random.randint(1, 40), random.choice([3, 7, 10, 13])) for _ in "Fw")
    f = F * random.choice(
        [Fraction(0), Fraction(1, 50), Fraction(99, 100)]
        + [Fraction(random.randint(1, 30), 31) for _ in range(7)]
    )
    R = F / omega**2 * Fraction(random.choice([1, 3, 9, 15, 25, 60, 150]), random.choice([7, 11]))
    left = R * Fraction(random.randint(-300, 100), 97)
    e = random.choice([Fraction(1), Fraction(1), *(Fraction(n, 30) for n in (1, 9, 20, 27, 29))])
    mu = omega * random.choice([Fraction(0), Fraction(0), *(Fraction(n, 70) for n in (1, 9, 99))])
    return Parameters(F, omega, f, left, left + R, e, mu)
