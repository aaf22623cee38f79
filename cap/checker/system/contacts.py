"""Periodic orbits by their contacts: the equations, their zero, and the return map.

The unknowns are the times and states just before the K contacts, z = (t_k, q_k), n + 1 numbers for
each.  With the guard h_k and the reset R_k of the contact, and the flight in the mode after it,

    h_k(q_k, t_k) = 0,      flight(R_k(q_k, t_k) from t_k to t_(k+1)) - q_(k+1) = 0,     F(z) = 0,

where the contact after the last one is the first, p periods of the clock later.  In the variables
y = (q, cos wt, sin wt, 1) the flight is exp(M d) y, d = t_(k+1) - t_k (``legs``); its derivative in
d is exp(M d) M y.  All derivatives are those of jets of order one in t_k, q_k, t_(k+1).

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
from typing import NamedTuple

from cap.checker.kernel.elementary import pi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet, RealJet, cos_sin_jet
from cap.checker.kernel.rejection import need
from cap.checker.system.evaluation import evaluate
from cap.checker.system.exponential import Exponential
from cap.checker.system.legs import matrix
from cap.checker.system.model import CLOCK, Guard, Model
from cap.checker.system.polynomial import variable

Ends = tuple[Fraction, Fraction]
Matrix = list[list[Interval]]


class Contact(NamedTuple):
    """A guard of a mode comes to zero, and the system goes on in the mode ``to``."""

    mode: str
    guard: str
    to: str


class Round(NamedTuple):
    """A system, the contacts of one round, in order, and the periods of the clock that it takes."""

    model: Model
    contacts: Sequence[Contact]
    periods: int

    def confirm(self) -> None:
        """Reject what is no sequence of contacts of the system."""
        modes = self.model.modes
        for k, (mode, guard, to) in enumerate(self.contacts):
            known = mode in modes and guard in modes[mode].guards
            need(known, f"contact {k + 1}: there is no guard {guard} of a mode {mode}")
            leads = to in modes[mode].guards[guard].to
            need(leads, f"contact {k + 1}: {guard} does not lead to the mode {to}")
            goes_on = self.following(k).mode == to
            need(goes_on, f"contact {k + 1}: the next contact is in another mode than {to}")

    def guard(self, k: int) -> Guard:
        """Return the guard of the k-th contact, counted from 0."""
        return self.model.modes[self.contacts[k].mode].guards[self.contacts[k].guard]

    def following(self, k: int) -> Contact:
        """Return the contact after the k-th."""
        return self.contacts[(k + 1) % len(self.contacts)]


class Step(NamedTuple):
    """From one contact to the next: h and the state on arrival, in (t, q, the next t)."""

    guard: RealJet
    arrival: list[RealJet]


class Equations:
    """F and F' at a precision."""

    def __init__(self, orbit: Round, bits: int) -> None:
        self.orbit, self.bits, self.model = orbit, bits, orbit.model
        self.n = len(orbit.model.state)
        self.size = (self.n + 1) * len(orbit.contacts)
        omega = orbit.model.omega
        self.period = pi(bits) * 2 / self.number(omega)
        modes = {contact.to for contact in orbit.contacts}
        self.flights = {m: Exponential(matrix(orbit.model, m), bits) for m in sorted(modes)}

    def number(self, q: Fraction) -> Interval:
        """Return an enclosure of a rational number."""
        return Interval.enclosing(q, q, self.bits)

    def places(self, k: int) -> tuple[int, int]:
        """Return where the unknowns of a contact stand, and those of the next one."""
        here = k * (self.n + 1)
        return here, (here + self.n + 1) % self.size

    def end(self, z: Sequence[Interval], k: int) -> Interval:
        """Return the time of the contact after the k-th."""
        here, there = self.places(k)
        return z[there] if there > here else z[there] + self.period * self.orbit.periods

    def after(self, k: int, before: Mapping[str, RealJet]) -> dict[str, RealJet]:
        """Return the state just after a contact."""
        reset = self.orbit.guard(k).reset
        return {z: evaluate(reset.get(z, variable(z)), before) for z in self.model.state}

    def steps(self, z: Sequence[Interval]) -> list[Step]:
        """Return the steps over a box of unknowns."""
        return [self._step(z, k) for k in range(len(self.orbit.contacts))]

    def _step(self, z: Sequence[Interval], k: int) -> Step:
        here, count = self.places(k)[0], self.n + 2
        inputs = [*z[here : here + self.n + 1], self.end(z, k)]
        t, *q, arrival = (
            Jet(1, {_power(count): x, _power(count, i): x.integer(1)}) for i, x in enumerate(inputs)
        )
        clock = dict(zip(CLOCK, cos_sin_jet(t * self.number(self.model.omega)), strict=True))
        before = dict(zip(self.model.state, q, strict=True)) | clock
        one = Jet(1, {_power(count): inputs[0].integer(1)})
        start = [*self.after(k, before).values(), *clock.values(), one]
        mode = self.orbit.contacts[k].to
        rows = [self._row(mode, i, arrival.constant - t.constant) for i in range(self.n)]
        flown = [
            reduce(Jet.__add__, (a * y for a, y in zip(row, start, strict=True))) for row in rows
        ]
        return Step(evaluate(self.orbit.guard(k).value, before), flown)

    def _row(self, mode: str, i: int, d: Interval) -> list[RealJet]:
        """Return a row of exp(M d), where d is the last variable minus the first one."""
        count = self.n + 2
        value, slope = self.flights[mode].over(i, d, 1)
        origin, first, last = _power(count), _power(count, 0), _power(count, count - 1)
        pairs = zip(value, slope, strict=True)
        return [Jet(1, {origin: x, first: -rate, last: rate}) for x, rate in pairs]

    def value(self, z: Sequence[Interval]) -> list[Interval]:
        """Return F."""
        result = list[Interval]()
        for k, (h, arrival) in enumerate(self.steps(z)):
            there = self.places(k)[1]
            result.append(h.constant)
            result += [x.constant - z[there + 1 + i] for i, x in enumerate(arrival)]
        return result

    def slope(self, z: Sequence[Interval]) -> list[dict[int, Interval]]:
        """Return the rows of F', without zeros."""
        return [row for k, step in enumerate(self.steps(z)) for row in self._rows(k, step)]

    def _rows(self, k: int, step: Step) -> Iterator[dict[int, Interval]]:
        """Give the rows of the k-th contact; those of the next may be its own."""
        here, there = self.places(k)
        yield dict(enumerate(derivatives(step.guard, self.n + 1), start=here))
        for i, x in enumerate(step.arrival):
            *own, last = derivatives(x, self.n + 2)
            row = dict(enumerate(own, start=here))
            for j, entry in ((there, last), (there + 1 + i, last.integer(-1))):
                row[j] = row[j] + entry if j in row else entry
            yield row


def _power(count: int, *raised: int) -> tuple[int, ...]:
    """Return the power with ones at some places."""
    return tuple(int(i in raised) for i in range(count))


def derivatives(x: RealJet, count: int) -> list[Interval]:
    """Return the first few derivatives."""
    size, zero = len(x.origin), x.constant.integer(0)
    return [x.coefficients.get(_power(size, i), zero) for i in range(count)]


def krawczyk(
    equations: Equations,
    region: Sequence[Ends],
    centre: Sequence[Fraction],
    preconditioner: Sequence[Sequence[Fraction]],
) -> list[Interval]:
    """Return K(region) if it lies in the interior of the region, which contains the centre."""
    inside = zip(region, centre, strict=True)
    need(all(a <= c <= b for (a, b), c in inside), "the centre is not in the box")
    box = [Interval.enclosing(*ends, equations.bits) for ends in region]
    middle = [equations.number(c) for c in centre]
    offsets = [z - c for z, c in zip(box, middle, strict=True)]
    value, slope, K = equations.value(middle), equations.slope(box), list[Interval]()
    for i, given in enumerate(preconditioner):
        row = [*map(equations.number, given)]
        residual = [c.integer(int(i == j)) for j, c in enumerate(row)]  # of 1 - C F'
        for c, entries in zip(row, slope, strict=True):
            for j, entry in entries.items():
                residual[j] = residual[j] - c * entry
        K.append(middle[i] - dot(row, value) + dot(residual, offsets))
        need(K[i].lies_inside(*region[i]), "K does not lie in the interior of its box")
    return K


def dot(row: Sequence[Interval], column: Sequence[Interval]) -> Interval:
    """Return the sum of products."""
    products = (a * b for a, b in zip(row, column, strict=True))
    return reduce(Interval.__add__, products)


def return_map(equations: Equations, z: Sequence[Interval]) -> Matrix:
    """Return the derivative of a round by (t, q) at the first contact."""
    steps = equations.steps(z)
    ends = [*steps[1:], steps[0]]
    parts = [_leg(step, end.guard, equations.n) for step, end in zip(steps, ends, strict=True)]
    return reduce(lambda total, part: product(part, total), parts)


def _leg(step: Step, guard: RealJet, n: int) -> Matrix:
    """Return the derivative of (t, q) at a contact by (t, q) at the one before."""
    by_time, *by_state = derivatives(guard, n + 1)
    rows = [derivatives(x, n + 2) for x in step.arrival]
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
    one = D[0][0].integer(1)
    found, traces, power = [one], list[Interval](), D
    for j in range(1, count + 1):
        if j > 1:
            power = product(power, D)
        traces.append(reduce(Interval.__add__, (power[i][i] for i in range(len(D)))))
        signs = [1 if i % 2 == 0 else -1 for i in range(j)]
        total = dot([found[j - 1 - i] * s for i, s in enumerate(signs)], traces)
        found.append(total / j)
    return found[1:]
