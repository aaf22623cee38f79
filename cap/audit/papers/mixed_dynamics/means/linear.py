"""The derivative of an event, from first principles: two orbits that are δ apart.

An orbit that is (δx, δv) away before an event has it at another time.  Both orbits are compared
just after the later one, at first order in δ; no saltation formula is used.
"""

from typing import Any, NamedTuple

from cap.audit.means.lazy import sympy as sp


class Event(NamedTuple):
    """The velocity and the acceleration just before an event, and just after it."""

    v: Any
    a: Any
    v_after: Any
    a_after: Any


def derivative(event: Event, hit: bool, restitution: Any = 1) -> Any:
    """Return the derivative of the state after an event by the state before, a 2 × 2 matrix.

    The event is x = wall if it is a ``hit``, v -> -e v there, and v = 0 if not.
    """
    dx, dv, small = sp.symbols("dx dv small", real=True)
    x, v = small * dx, event.v + small * dv  # at the time of the unperturbed event, wall at x = 0
    delay = -x / event.v if hit else -(v - event.v) / event.a
    x, v = x + v * delay, v + event.a * delay  # at its own event
    if hit:
        v = -restitution * v
    back = -delay  # to the time of the unperturbed event, with the flow after it
    x, v = x + v * back, v + event.a_after * back
    deviation = sp.Matrix([x, v - event.v_after])
    linear = [sp.simplify(sp.diff(each, small).subs(small, 0)) for each in deviation]
    return sp.Matrix([[sp.diff(each, z) for z in (dx, dv)] for each in linear])


def hit(side: int, restitution: Any = 1) -> Any:
    """Return the derivative of a hit of r (1) or l (-1), by u = |v| > 0, f > 0, c = F cos ωt."""
    (u, f), c = sp.symbols("u f", positive=True), sp.Symbol("c", real=True)
    v = side * u
    event = Event(v, c - f * side, -restitution * v, c + f * side)
    return derivative(event, True, restitution)


def turn(before: Any, after: Any) -> Any:
    """Return the derivative of a moment with v = 0, by the accelerations before and after it."""
    return derivative(Event(sp.S.Zero, before, sp.S.Zero, after), False)
