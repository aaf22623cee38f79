"""Theorem (contact_elliptic).  Let a system be given as data (`cap.system.model`), with a clock and
a state of two variables, and contacts of a periodic orbit with a guess.  If the lemmas succeed,

 (i)   the orbit exists, with these contacts and no others: (i) to (iii) of `cap.proofs.contacts`;
 (ii)  Φ, from the state at an explicit time s between two contacts to that p periods later, is
       real analytic near the point of the orbit, and preserves area;
 (iii) this fixed point is elliptic, with Θ enclosed and without resonance of order <= 4;
 (iv)  in a complex coordinate z with dx∧dv = (i/2) dz∧dz̄ there, Φ(z) = z exp(i(Θ + τ_1|z|²)) +
       O(|z|⁴), with τ_1 enclosed and not zero;
 (v)   hence, by Moser's twist theorem, every neighbourhood of it contains invariant closed curves
       around it, and it is stable.

Proof.  `cap.orbits.periodic` and `cap.orbits.choice` (i), (ii); area: flights without divergence
preserve it, and the contacts multiply it by numbers with the product 1 (`cap.orbits.conserved`);
`cap.orbits.strobe` has the jet of Φ, `cap.maps.normal_form` (iii) and (iv).
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from cap.certificate.writer import Rounding
from cap.errors import BadInput, NotProved
from cap.maps import normal_form
from cap.orbits.choice import without_choice
from cap.orbits.conserved import product_of_two, why_lost
from cap.orbits.equations import Equations
from cap.orbits.itinerary import Itinerary
from cap.orbits.periodic import PeriodicOrbit, Prover
from cap.orbits.strobe import Strobe
from cap.proofs import contacts
from cap.proofs.certified import assembled
from cap.proofs.contacts import Prepared
from cap.proofs.elliptic import without_resonance
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.interval import exact_decimal as _decimal
from cap.system.model import System

ORDER, ROUND = 3, 3  # of the jet; decimals of a phase


def refuse(system: System) -> None:
    """Raise `BadInput` with the reason if the theorem does not apply to a system."""
    n = len(system.state)
    if n != 2:
        raise BadInput(f"the state has {n} variables: the twist is that of maps of the plane")
    if system.autonomous:
        raise BadInput("nothing depends on the clock: there is no map over a period that twists")


def why_not(itinerary: Itinerary) -> str:
    """Return in words why area is not known to be preserved over a round; nothing if it is."""
    return "" if product_of_two(itinerary) == 1 else why_lost(itinerary)


def prove(
    itinerary: Itinerary, guess: Sequence[float], digits: int = 10, shared: Prepared | None = None
) -> dict[str, Any]:
    """Return a certificate, which the independent checker accepts, of an orbit near a guess.

    As `contacts.prove`.
    """
    refuse(itinerary.system)
    lost = why_not(itinerary)
    if lost:
        raise NotProved("area", lost)
    kinds, parameters = shared or Prepared.of(itinerary.system)
    bits = 96 + 8 * digits
    with interval.workprec(bits):
        prover = Prover(Equations(itinerary, kinds), pieces=True)
        orbit = prover.prove(guess, digits + contacts.EXTRA, Fraction(1, 10 ** (digits + 2)))
        without_choice(prover, orbit.box)
        found = contacts.orbit_claims(orbit, digits) | twist(orbit, prover, digits)
        content = found, contacts.hints(orbit, bits)
        certificate = assembled("contact_elliptic", parameters, digits, content, bits)
        return contacts.checked(certificate, contacts.legs(prover, orbit.box, orbit.reasons))


def twist(orbit: PeriodicOrbit, prover: Prover, digits: int) -> dict[str, Any]:
    """Return the claims about Φ at the orbit."""
    s = phase(orbit, prover.balls.period * orbit.itinerary.periods)
    strobe = Strobe(prover.equations, prover.balls, orbit.contacts, s)
    jets = strobe.jet(ORDER)
    a, d = jets[0][1, 0], jets[1][0, 1]
    if not abs(a + d) < 2:
        sets = {"trace": a + d}
        raise NotProved("elliptic", "the sum of the multipliers is not in (-2, 2)", sets)
    linear = normal_form.ellipticity(*jets)
    rotation, far = without_resonance(linear, "resonance")
    (tau,) = normal_form.twists(*jets)
    if not (tau > 0 or tau < 0):
        raise NotProved("twist", "the twist coefficient may vanish", {"tau_1": tau})
    pair = Rounding(digits).pair
    return {
        "phase": _decimal(s),
        "point": [contacts.pair(z, digits) for z in strobe.point],
        "rotation_angle": pair(linear.theta),
        "rotation_number": pair(rotation),
        "resonance_distances": {name: pair(value) for name, value in far.items()},
        "twist": pair(tau),
    }


def phase(orbit: PeriodicOrbit, period: Ball) -> Fraction:
    """Return a short number between the last contact, less p periods, and the first one: 0, if it
    is one.
    """
    before, after = orbit.contacts[-1][0] - period, orbit.contacts[0][0]
    if before < 0 < after:
        return Fraction(0)
    middle = Fraction(float(((before + after) / 2).mid()))
    for places in range(ROUND, 16):
        s = round(middle, places)
        if before < interval.ball(s) < after:
            return s
    return middle
