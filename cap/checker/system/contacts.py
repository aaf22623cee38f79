"""Periodic orbits by their contacts: the equations, their zero, and the return map.

The unknowns are the times and states just before the K contacts, z = (t_k, q_k), n + 1 numbers for
each.  With the guard h_k and the reset R_k of the contact, and the flight in the mode after it,

    h_k(q_k, t_k) = 0,      flight(R_k(q_k, t_k) from t_k to t_(k+1)) - q_(k+1) = 0,     F(z) = 0,

where the contact after the last one is the first, p periods of the clock later.  The flight is
P(t_(k+1)) + exp(N d) y, d = t_(k+1) - t_k, y = (z - P, 1)(t_k) (``legs``); its derivative in d is
exp(N d) N y.  All derivatives are by t_k, q_k, t_(k+1), which have the indices 0, 1, ..., n, n + 1.

*With a symmetry* S (``symmetry``) the contacts are those of half a round, which takes p/2 periods,
p odd: the contact after the last one is the image of the first.  S takes the flight to it to one in
the mode of the first contact, from S R at the time t_K - p T/2 to the first contact itself, with
the other signs of cos and sin at its begin.  So F, its derivatives and all that follows are those
of half a round, followed by S; the multipliers of the orbit are the squares of those found.

*Without a clock*, where cos and sin occur nowhere, orbits may be moved in time: the first contact
is at the time 0, and t_0 is the period, at which it comes again.  Then (t, q) after a round is (t_0
+ a function of q_0, a function of q_0): the latter's derivative has n - 1 multipliers, and 0.

*Existence.*  For a point m of a box Z and a matrix C, let

    K(Z) = m - C F(m) + (1 - C F'(Z)) (Z - m).

If K(Z) lies in the interior of Z, F has exactly one zero in Z, and it lies in K(Z) [Krawczyk].

*The return map.*  Where L h_(k+1) < 0 on arrival, t_(k+1) is a function of (t_k, q_k): with g the
gradient of h_(k+1) in (t, q), and the flight's derivatives, 0 = g_t dt + g_q dq, dq = A d(t_k, q_k)
+ B dt, where g_t + g_q B = L h_(k+1).  So (t, q)_(k+1) is a function of (t, q)_k near the orbit,
and of (t, q)_0 after a round.  Its values after a round lie on h_0 = 0, a surface of dimension n,
on which it is the return map: its derivative has the n multipliers of the orbit as eigenvalues, and
0.  Their elementary symmetric functions e_j are those of its eigenvalues: with the traces p_i of
its powers, j e_j = e_(j-1) p_1 - e_(j-2) p_2 + ... (Newton).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import NamedTuple

from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.elementary import cos_sin
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.system.legs import dot
from cap.checker.system.model import Guard, Model
from cap.checker.system.passage import Clock, Contact, Jet, Step, passage
from cap.checker.system.quiet import vanishing
from cap.checker.system.symmetry import Symmetry

SHIFT, AGAIN = 48, 3
Ends = tuple[Fraction, Fraction]
Matrix = list[list[Interval]]


class Round(NamedTuple):
    """A system, the contacts of one round, in order, and the periods of the clock that it takes.

    With a symmetry they are those of half a round.
    """

    model: Model
    contacts: Sequence[Contact]
    periods: int
    symmetry: Symmetry | None = None

    def confirm(self) -> None:
        """Reject what is no sequence of contacts of the system."""
        modes = self.model.modes
        if self.symmetry:
            need(self.periods % 2 == 1, "a symmetric orbit has an even number of periods")
            need(not self.model.autonomous, "a symmetry is one of half a period: there is no clock")
            self.symmetry.confirm(self.model)
            known = all(contact.to in self.symmetry.modes for contact in self.contacts)
            need(known, "a contact leads to a mode that is none")
        for k, (mode, guard, to) in enumerate(self.contacts):
            known = mode in modes and guard in modes[mode].guards
            need(known, f"contact {k + 1}: there is no guard {guard} of a mode {mode}")
            leads = to in modes[mode].guards[guard].to
            need(leads, f"contact {k + 1}: {guard} does not lead to the mode {to}")
            goes_on = self.following(k).mode == self.flown(k)
            need(goes_on, f"contact {k + 1}: the next contact is in another mode than {to}")

    def guard(self, k: int) -> Guard:
        """Return the guard of the k-th contact, counted from 0."""
        return self.model.modes[self.contacts[k].mode].guards[self.contacts[k].guard]

    def following(self, k: int) -> Contact:
        """Return the contact after the k-th; that after the last is the first."""
        return self.contacts[(k + 1) % len(self.contacts)]

    def is_moved(self, k: int) -> bool:
        """Return whether the flight after the k-th contact is looked at as S moves it back."""
        return self.symmetry is not None and k + 1 == len(self.contacts)

    def flown(self, k: int) -> str:
        """Return the mode of the flight after the k-th contact."""
        to = self.contacts[k].to
        return self.symmetry.modes[to] if self.symmetry and self.is_moved(k) else to

    def zeros(self, k: int) -> Mapping[str, int]:
        """Return how many of h, L h of the guards on that flight vanish at its begin."""
        mode, guard, to = self.contacts[k]
        found = vanishing(self.model, mode, guard, to)
        if self.symmetry and self.is_moved(k):
            images = self.symmetry.guards(self.model, self.flown(k))
            return {key: found[image] for key, image in images.items()}
        return found


class Equations:
    """F and F' at a precision."""

    def __init__(self, orbit: Round, bits: int) -> None:
        self.orbit, self.bits, self.model = orbit, bits, orbit.model
        self.n = len(orbit.model.state)
        self.size = (self.n + 1) * len(orbit.contacts)
        self.passages = [
            passage(
                orbit.model,
                contact._replace(to=orbit.flown(k)),
                bits,
                tuple(orbit.symmetry.signs) if orbit.symmetry and orbit.is_moved(k) else None,
            )
            for k, contact in enumerate(orbit.contacts)
        ]
        self.omega, self.pi = self.passages[0].flights.omega, pi(bits)
        self.period = self.pi * 2 / self.omega
        self.autonomous = orbit.model.autonomous

    def number(self, q: Fraction) -> Interval:
        """Return an enclosure of a rational number."""
        return Interval.enclosing(q, q, self.bits)

    def places(self, k: int) -> tuple[int, int]:
        """Return where the unknowns of a contact stand, and those of the next one."""
        here = k * (self.n + 1)
        return here, (here + self.n + 1) % self.size

    def start(self, z: Sequence[Interval], k: int) -> Interval:
        """Return the time at which the flight after the k-th contact begins.

        It is that of the contact, unless a symmetry moves it back.
        """
        if self.orbit.is_moved(k):
            return z[self.places(k)[0]] - self.period * self.orbit.periods / 2
        return z[0].integer(0) if self.autonomous and not k else z[self.places(k)[0]]

    def end(self, z: Sequence[Interval], k: int) -> Interval:
        """Return the time of the contact after the k-th."""
        here, there = self.places(k)
        later = there <= here and not self.autonomous and not self.orbit.is_moved(k)
        return z[there] + self.period * self.orbit.periods if later else z[there]

    def turned(self, k: int, clock: Clock) -> Clock:
        """Return the clock at the k-th contact from that at the begin of the flight after it."""
        return (-clock[0], -clock[1]) if self.orbit.is_moved(k) else clock

    def steps(self, z: Sequence[Interval]) -> list[Step]:
        """Return the steps over a box of unknowns."""
        return [self.passages[k].step(*at) for k, at in enumerate(self._places(z))]

    def value(self, z: Sequence[Interval]) -> list[Interval]:
        """Return F."""
        result = list[Interval]()
        for k, at in enumerate(self._places(z)):
            there = self.places(k)[1]
            h, *arrival = self.passages[k].values(*at)
            result.append(h)
            result += [x - z[there + 1 + i] for i, x in enumerate(arrival)]
        return result

    def _places(
        self, z: Sequence[Interval]
    ) -> Iterator[tuple[Clock, Sequence[Interval], Clock, Interval]]:
        """Give for each leg the clock and the state at its contact, the clock at its end, and d.

        A whole number of periods later the clock is the same.
        """
        count = len(self.orbit.contacts)
        clocks = [self.turned(k, self._clock(self.start(z, k))) for k in range(count)]
        for k in range(count):
            (here, _), t = self.places(k), self.start(z, k)
            clock = clocks[k], clocks[(k + 1) % count]
            yield clock[0], z[here + 1 : here + self.n + 1], clock[1], self.end(z, k) - t

    def _clock(self, t: Interval) -> Clock:
        """Return cos wt and sin wt; for t near m they differ by at most w |t - m| from those of m.

        Without a clock they occur nowhere.
        """
        if self.autonomous or t.width >> self.bits // 2:
            return cos_sin(t * self.omega)
        m = t.midpoint()
        far = ((max(t.hi - m.lo, m.hi - t.lo) * self.omega.hi) >> self.bits) + 1
        near = Interval(-far, far, self.bits)
        cos, sin = cos_sin(m * self.omega)
        return (cos + near, sin + near) if t.width else (cos, sin)

    def slope(self, steps: Sequence[Step]) -> list[dict[int, Interval]]:
        """Return the rows of F', without zeros."""
        return [row for k, step in enumerate(steps) for row in self._rows(k, step)]

    def _rows(self, k: int, step: Step) -> Iterator[dict[int, Interval]]:
        """Give the rows of the k-th contact; those of the next may be its own."""
        here, there = self.places(k)
        first = int(self.autonomous and not k)  # the first contact is at the time 0
        yield {here + i: x for i, x in step.guard.by.items() if i >= first}
        for i, x in enumerate(step.arrival):
            row = {here + j: entry for j, entry in x.by.items() if first <= j <= self.n}
            minus = x.value.integer(-1)
            for j, entry in ((there, x.by[self.n + 1]), (there + 1 + i, minus)):
                row[j] = row[j] + entry if j in row else entry
            yield row


def krawczyk(
    equations: Equations,
    region: Sequence[Ends],
    centre: Sequence[Fraction],
    preconditioner: Sequence[Sequence[int]],
) -> list[Interval]:
    """Return K(K(K(K(region)))) if K(region) lies in the interior of the region.

    C is the preconditioner in units 2^-`SHIFT`.  The centre lies in the region.  F' is in all steps
    that over the region, which contains the zero as K(region) does.
    """
    inside = zip(region, centre, strict=True)
    need(all(a <= c <= b for (a, b), c in inside), "the centre is not in the box")
    box = [Interval.enclosing(*ends, equations.bits) for ends in region]
    middle = [equations.number(c) for c in centre]
    value, slope = equations.value(middle), equations.slope(equations.steps(box))
    newton = [c - f for c, f in zip(middle, times(preconditioner, value), strict=True)]
    rows = residual(preconditioner, slope)
    K = _moved(newton, rows, box, middle)
    inner = all(z.lies_inside(*ends) for z, ends in zip(K, region, strict=True))
    need(inner, "K does not lie in the interior of its box")
    for _ in range(AGAIN):
        K = _moved(newton, rows, K, middle)
    return K


def times(C: Sequence[Sequence[int]], v: Sequence[Interval]) -> list[Interval]:
    """Return C v; C in units 2^-`SHIFT`.  Twice the sum of middles, and a bound of the rest."""
    twice, width, bits = [x.lo + x.hi for x in v], [x.width for x in v], v[0].bits
    found = []
    for row in C:
        total, rest = sum(map(mul, row, twice)), sum(map(mul, map(abs, row), width))
        lo, hi = total - rest >> SHIFT + 1, -(-(total + rest) >> SHIFT + 1)
        found.append(Interval(lo, hi, bits))
    return found


def residual(
    C: Sequence[Sequence[int]], slope: Sequence[Mapping[int, Interval]]
) -> list[list[int]]:
    """Return bounds of the entries of |1 - C F'|; C in units 2^-`SHIFT`.

    With F' = F_0 + D, F_0 of middles, |1 - C F'| <= |1 - C F_0| + |C| |D|; what is at most the
    greatest entry in its row stands for an entry of |D|.  All is computed twice as large.
    """
    columns: list[list[tuple[int, int]]] = [[] for _ in slope]
    for k, entries in enumerate(slope):
        for j, x in entries.items():
            columns[j].append((k, x.lo + x.hi))
    wide = [max(x.width for x in entries.values()) for entries in slope]
    two, found = 2 << next(iter(slope[0].values())).bits + SHIFT, list[list[int]]()
    for i, row in enumerate(C):
        rest = sum(map(mul, map(abs, row), wide))
        sums = [sum([row[k] * x for k, x in column]) for column in columns]
        sums[i] -= two
        found.append([(abs(x) + rest >> SHIFT + 1) + 1 for x in sums])
    return found


def _moved(
    newton: Sequence[Interval],
    rows: Sequence[Sequence[int]],
    box: Sequence[Interval],
    middle: Sequence[Interval],
) -> list[Interval]:
    """Return m - C F(m) + (1 - C F') (box - m), by the sizes of the factors."""
    far, found = [max(m.hi - z.lo, z.hi - m.lo) for z, m in zip(box, middle, strict=True)], []
    for z, row in zip(newton, rows, strict=True):
        reach = (sum(map(mul, row, far)) >> z.bits) + 1
        found.append(Interval(z.lo - reach, z.hi + reach, z.bits))
    return found


def return_map(steps: Sequence[Step], n: int) -> Matrix:
    """Return the derivative of a round by (t, q) at the first contact."""
    return reduce(lambda total, part: product(part, total), leg_maps(steps, n))


def leg_maps(steps: Sequence[Step], n: int) -> list[Matrix]:
    """Return the derivative of (t, q) at each contact by that at the one before."""
    ends = [*steps[1:], steps[0]]
    return [_leg(step, end.guard, n) for step, end in zip(steps, ends, strict=True)]


def _leg(step: Step, guard: Jet, n: int) -> Matrix:
    """Return the derivative of (t, q) at a contact by (t, q) at the one before."""
    by_time, *by_state = guard.derivatives(n + 1)
    rows = [x.derivatives(n + 2) for x in step.arrival]
    rate = by_time + dot(by_state, [row[-1] for row in rows])
    need((-rate).is_positive(), "a guard may not be crossed: a graze")
    time = [-dot(by_state, [row[j] for row in rows]) / rate for j in range(n + 1)]
    state = [[a + row[-1] * b for a, b in zip(row[:-1], time, strict=True)] for row in rows]
    return [time, *state]


def product(A: Matrix, B: Matrix) -> Matrix:
    """Return A B."""
    return [[dot(row, column) for column in zip(*B, strict=True)] for row in A]


def symmetric(D: Matrix, count: int) -> list[Interval]:
    """Return the first few elementary symmetric functions of the eigenvalues."""
    found, traces, powers = [D[0][0].integer(1)], list[Interval](), [D]  # D, D^2, ...
    for j in range(1, count + 1):
        traces.append(_trace(powers, j))
        signs = [1 if i % 2 == 0 else -1 for i in range(j)]
        total = dot([found[j - 1 - i] * s for i, s in enumerate(signs)], traces)
        found.append(total / j)
    return found[1:]


def _trace(powers: list[Matrix], j: int) -> Interval:
    """Return the trace of D^j, from the powers with half the exponent, which are kept."""
    first, D = j // 2, powers[0]
    if not first:
        return reduce(add, (D[i][i] for i in range(len(D))))
    while len(powers) < j - first:
        powers.append(product(powers[-1], D))
    A, B = powers[first - 1], powers[j - first - 1]
    return reduce(
        add, (dot(row, column) for row, column in zip(A, zip(*B, strict=True), strict=True))
    )
