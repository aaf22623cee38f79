"""The product of the two multipliers of an orbit, exactly, where flights and contacts allow it.

The divergence of a flight is the trace of A; if it is 0, flights preserve area in the plane of the
state.  At a contact let R be the reset, without divisor, f and f' the fields before and after it.
What is near on arrival is mapped by

    S = DR + (f' - DR f - R_t) grad h/(L h),
    det S = det DR (h_t + grad h DR^-1 (f' - R_t))/(L h).

If h(R) = c h with a constant c /= 0, for all states and times, then grad h(R) DR = c grad h and
grad h(R) R_t + h_t(R) = c h_t, so the bracket is (L' h)(R)/c, with L' of the mode after it; and if
(L' h)(R) = k L h, det S = k det DR/c.  The product of the multipliers is that of all det S.

S depends on R where h = 0 alone: what R adds to a variable may be left out if it is a multiple of
h.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache

from cap.checker.system.model import Model
from cap.checker.system.polynomial import ONE, Polynomial, variable


def product_of_two(model: Model, contacts: Sequence[tuple[str, str, str]]) -> Fraction | None:
    """Return the product of the multipliers of an orbit; None if it is not found by this."""
    total = Fraction(1)
    for mode, guard, to in contacts:
        factor = _factor_of(model, mode, guard, to)
        if factor is None:
            return None
        total *= factor
    return total


@lru_cache
def _factor_of(model: Model, mode: str, guard: str, to: str) -> Fraction | None:
    """Return det S of a contact, if the flight after it has no divergence."""
    event, field, state = model.modes[mode].guards[guard], model.modes[to].field, model.state
    divergence = sum((field[z].derivative(z) for z in state), Polynomial({}))
    if len(state) != 2 or divergence.terms or event.divisor != ONE:
        return None
    h, x, y = event.value, *state
    R = {z: variable(z) for z in state}
    moved = {z: q for z, q in event.reset.items() if _multiple(q - R[z], h) is None}
    R |= moved
    c = _multiple(h.substituted(R), h)
    k = _multiple(model.lie(to, h).substituted(R), model.lie(mode, h))
    area = R[x].derivative(x) * R[y].derivative(y) - R[x].derivative(y) * R[y].derivative(x)
    if c is None or k is None or area.variables:
        return None
    return k * area.number / c


def _multiple(p: Polynomial, q: Polynomial) -> Fraction | None:
    """Return c /= 0 with p = c q."""
    if not p.terms or p.terms.keys() != q.terms.keys():
        return None
    monomial, c = next(iter(p.terms.items()))
    c = c / q.terms[monomial]
    return c if p == q * c else None
