"""The product of the two multipliers of an orbit, exactly, where flights and contacts allow it.

With the reset R and h(R) = c h, (L' h)(R) = k L h, L' of the mode after a contact, what is near on
arrival is mapped with the determinant k det DR/c; flights without divergence preserve area.  What R
adds to a variable may be left out if it is a multiple of h.  The proof is in the checker's
`conserved`.
"""

from fractions import Fraction

from cap.orbits.itinerary import Contact, Itinerary
from cap.system.model import System
from cap.system.polynomial import ONE, ZERO, variable


def product_of_two(itinerary: Itinerary) -> Fraction | None:
    """Return the product of the multipliers of an orbit; None if it is not found by this."""
    total = Fraction(1)
    for contact in itinerary.contacts:
        factor = _factor_of(itinerary.system, contact)
        if factor is None:
            return None
        total *= factor
    return total


def _factor_of(system: System, contact: Contact) -> Fraction | None:
    """Return the determinant of a contact, if the flight after it has no divergence."""
    mode, guard, to = contact
    field, reset = system.modes[to].field, system.reset(mode, guard)
    divergence = sum((field[z].derivative(z) for z in system.state), ZERO)
    if len(system.state) != 2 or divergence or any(q.denominator != ONE for q in reset.values()):
        return None
    h, (x, y) = system.guard(mode, guard).value, system.state
    R = {z: variable(z) for z in (x, y)}
    R |= {z: q.numerator for z, q in reset.items() if not (q.numerator - R[z]).multiple_of(h)}
    c = h.substituted(R).multiple_of(h)
    k = system.lie(to, h).substituted(R).multiple_of(system.lie(mode, h))
    area = R[x].derivative(x) * R[y].derivative(y) - R[x].derivative(y) * R[y].derivative(x)
    if not c or not k or set(area.terms) != {()}:
        return None
    return k * area.terms[()] / c


def why_lost(itinerary: Itinerary) -> str:
    """Return in words why it is not known that a round preserves area, of a state of two."""
    system = itinerary.system
    for contact in itinerary.contacts:
        field = system.modes[contact.to].field
        divergence = sum((field[z].derivative(z) for z in system.state), ZERO)
        if divergence:
            return f"flights of the mode {contact.to} do not preserve area: they have a divergence"
        factor = _factor_of(system, contact)
        if factor is None:
            return f"{contact.guard} of {contact.mode} is not found to preserve area"
        if factor != 1:
            return f"{contact.guard} of {contact.mode} multiplies area by {factor}"
    return "area is preserved"
