"""A periodic orbit of two masses, by its contacts: equations, derivative, Krawczyk's operator.

*The unknowns* are, for each of K contacts in a period, its time, the free coordinate (of the mass
that is not at a wall, or of both), and the velocities just before: z_k = (t, xi, v_1, v_2).  A
T-periodic orbit on which no mass stops, with these contacts and no other, is a zero of G = (G_1, ..
, G_K), where the flight after the contact k ends at the contact k + 1 (after the last one: at the
first, a period later):

    G_k = (x(t_(k+1)) - X_(k+1), v(t_(k+1)) - v_(k+1)),      X the places at a contact.

The signs of the flights are those of the velocities after the contacts, certain for all z of a box.

*The derivative.*  At the end of a flight, with a_i = (F cos wt - s_i f)/m_i and its duration d,

    dx_i = dx_i(a) + d dv_i(a) - (v_i(a) + d a_i(t_k)) dt_k + v_i(t_(k+1)) dt_(k+1)
    dv_i = dv_i(a) - a_i(t_k) dt_k + a_i(t_(k+1)) dt_(k+1),

dx_i(a) = (dX/dxi)_i dxi, dv(a) = C dv.  Each G_k depends on eight unknowns.

*Krawczyk's operator.*  For a point c of a box Z, and any matrix C,

    K(Z) = c - C G(c) + (1 - C G'(Z)) (Z - c).

If K(Z) lies in the interior of Z, there is exactly one zero of G in Z, and it lies in K(Z).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.particles.mechanics import Contact, Mechanics, contacts

Ends = tuple[Fraction, Fraction]
SIZE = 4  # unknowns of a contact, and equations of a flight
Row = list[Interval]
Matrix = list[Row]


class Moved(NamedTuple):
    """G(c) + slope by: G at the centre for the members of a family."""

    G: Row
    slope: Row
    by: Interval


def arrivals(orbit: Sequence[Contact], M: Mechanics) -> list[Contact]:
    """Return the contacts at which the flights after the contacts end, the last a period later."""
    first = orbit[0]
    return [*orbit[1:], first._replace(at=M.later(first.at))]


def defects(M: Mechanics, orbit: Sequence[Contact]) -> list[Interval]:
    """Return G."""
    result = list[Interval]()
    for contact, end in zip(orbit, arrivals(orbit, M), strict=True):
        flight, places = M.flight(contact), M.places(end.word, end.xi)
        result += [M.place(i, flight, end.at) - places[i] for i in (0, 1)]
        result += [M.velocity(i, flight, end.at) - end.v[i] for i in (0, 1)]
    return result


def slopes(M: Mechanics, contact: Contact, end: Contact) -> tuple[Matrix, Matrix]:
    """Return the derivatives of G_k in the unknowns of its contact, and in those of its end."""
    flight, C = M.flight(contact), M.rule(contact.word)
    d, zero, one = end.at.t - contact.at.t, M.number(0), M.number(1)
    places, velocities, placed, reached = list[Row](), list[Row](), list[Row](), list[Row]()
    for i, s in enumerate(flight.signs):
        before, after = (M.acceleration(i, s, c.at) for c in (contact, end))
        moved, free = (one * _moves(c.word, i) for c in (contact, end))
        places.append([-flight.v[i] - d * before, moved, d * C[i][0], d * C[i][1]])
        velocities.append([-before, zero, *C[i]])
        placed.append([M.velocity(i, flight, end.at), -free, zero, zero])
        reached.append([after, zero, -one if i == 0 else zero, -one if i == 1 else zero])
    return places + velocities, placed + reached


def _moves(word: str, i: int) -> int:
    """Return the derivative of x_i at a contact in the free coordinate."""
    return int(word == "meet 1 2" or (word == "hit l") == (i == 1))


class Equations(NamedTuple):
    """G of some unknowns, and its derivatives: of each G_k in its contact, and in the next one."""

    value: Callable[[Sequence[Interval]], list[Interval]]
    slopes: Callable[[Sequence[Interval]], list[tuple[Matrix, Matrix]]]


def of_contacts(M: Mechanics, itinerary: Sequence[str]) -> Equations:
    """Return the equations of an itinerary of contacts."""

    def parts(data: Sequence[Interval]) -> list[tuple[Matrix, Matrix]]:
        orbit = contacts(M, itinerary, data)
        pairs = zip(orbit, arrivals(orbit, M), strict=True)
        return [slopes(M, contact, end) for contact, end in pairs]

    return Equations(lambda data: defects(M, contacts(M, itinerary, data)), parts)


def krawczyk(
    M: Mechanics,
    equations: Equations,
    region: Sequence[Ends],
    centre: Sequence[Fraction],
    preconditioner: Sequence[Sequence[Fraction]],
    value: Moved | None = None,
) -> list[Interval]:
    """Return K(region) if it lies in the interior of the region, which contains the centre.

    If M is a family, the value of G(c) may be given in mean value form: for all its members.
    """
    inside = zip(region, centre, strict=True)
    need(all(z[0] <= c <= z[1] for z, c in inside), "the centre is not in the box")
    box = [Interval.enclosing(*z, M.bits) for z in region]
    middle = [M.number(c) for c in centre]
    offsets = [z - c for z, c in zip(box, middle, strict=True)]
    G = value.G if value else equations.value(middle)
    parts = equations.slopes(box)
    K = list[Interval]()
    for i, given in enumerate(preconditioner):
        row = [M.number(c) for c in given]
        residual = times(row, parts)
        residual[i] = residual[i] - 1
        K.append(middle[i] - dot(row, G) - dot(residual, offsets))
        if value:
            K[i] = K[i] - dot(row, value.slope) * value.by
        need(K[i].lies_inside(*region[i]), "K does not lie in the interior of its box")
    return K


def needs_matrix(rows: Sequence[Sequence[Fraction]], count: int, name: str) -> None:
    """Reject what is not a matrix for the unknowns of so many events."""
    size = SIZE * count
    whole = len(rows) == size and all(len(row) == size for row in rows)
    need(whole, f"{name} is not a matrix of {size} rows and columns")


def lies_in(small: Sequence[Ends], large: Sequence[Ends]) -> bool:
    """Return whether one box lies in another."""
    return all(z[0] <= s[0] and s[1] <= z[1] for s, z in zip(small, large, strict=True))


def dot(row: Sequence[Interval], column: Sequence[Interval]) -> Interval:
    """Return the sum of products."""
    total = row[0] * column[0]
    for a, b in zip(row[1:], column[1:], strict=True):
        total = total + a * b
    return total


def times(row: Sequence[Interval], parts: Sequence[tuple[Matrix, Matrix]]) -> list[Interval]:
    """Return a row of C G': the k-th flight depends on the contacts k and k + 1."""
    size, count = SIZE, len(parts)
    result = [row[0].integer(0)] * (size * count)
    for k, part in enumerate(parts):
        weights = row[size * k : size * k + size]
        for block, contact in zip(part, (k, (k + 1) % count), strict=True):
            for j in range(size):
                here = size * contact + j
                result[here] = result[here] + dot(weights, [line[j] for line in block])
    return result
