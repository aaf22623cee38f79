"""Theorem (contacts).  Let a system be given as data (`cap.system.model`): modes with linear
fields, guards that are positive in their modes, resets, all with rational numbers.  Let contacts be
given, one round of a periodic orbit, with a guess of their times and states.  If the lemmas below
succeed, then

 (i)   the system has exactly one periodic orbit with these contacts whose times and states just
       before them lie in an explicit box;
 (ii)  nothing else happens on it: between its contacts all guards of its mode are positive, and
       each guard that comes to zero falls through it;
 (iii) the times, the states, and the elementary symmetric functions of its multipliers lie in
       explicit intervals; so many of these lie outside the unit circle, and none on it;
 (iv)  if none does: motions that come to the first contact in an explicit ellipsoid around the
       orbit have these contacts for ever, and each round brings them nearer by a factor below 1.

Proof.  `cap.orbits.periodic` proves all but (iv), which `cap.orbits.ellipsoid` proves.  The
certificate has the system, the box, the Krawczyk hints, and for each leg and guard the cuts of
Lemma B (`cap.orbits.pieces`), unless it falls by Lemma M: so the checker searches nothing.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import reduce
from itertools import islice, pairwise
from operator import mul
from typing import Any, NamedTuple

from cap.certificate import writer
from cap.certificate.writer import Pair, Rounding
from cap.checker.kernel.rejection import Rejected, TooCoarse
from cap.checker.system.contacts import SHIFT
from cap.checker.system.given import DEGREE, OF_GUARDS, TERMS
from cap.checker.verdict import check
from cap.errors import BadInput, NotProved
from cap.maps.zero import Box
from cap.orbits.choice import without_choice
from cap.orbits.conserved import product_of_two
from cap.orbits.ellipsoid import Ellipsoid, attracted
from cap.orbits.equations import Equations
from cap.orbits.itinerary import Itinerary
from cap.orbits.leg import Kinds
from cap.orbits.periodic import PeriodicOrbit, Prover
from cap.orbits.pieces import PLACES
from cap.orbits.quiet import Reason
from cap.proofs.certified import assembled
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.interval import exact_decimal as _decimal
from cap.system.model import System
from cap.system.polynomial import ONE, Polynomial, variable

SCALE = 2.0**SHIFT  # exact
SIZES = 4  # of ellipsoids that are tried, if the checker rejects them
ATTEMPTS = 4  # after each that leaves a leg open, all pieces of legs are cut in halves
EXTRA = 20  # digits of the centre beyond those that are claimed

RADII = (Fraction(1), *(1 + Fraction(1, 10**k) for k in (6, 3, 2, 1)))

Times = list[Fraction]
Cuts = list[dict[str, Times]]


class Prepared(NamedTuple):
    """What the orbits of one system share."""

    kinds: Kinds
    parameters: dict[str, Any]

    @classmethod
    def of(cls, system: System) -> "Prepared":
        """Return it; raise `BadInput` if the system is none that a certificate can hold."""
        return cls(Kinds(system), as_parameters(system))


def prove(
    itinerary: Itinerary, guess: Sequence[float], digits: int = 10, shared: Prepared | None = None
) -> dict[str, Any]:
    """Return a certificate, which the independent checker accepts, of an orbit near a guess.

    The guess has the time and the state just before each contact; what is ``shared`` may serve
    several orbits of the system.  Raises `NotProved` with the
    step that failed, and `BadInput` if the system is none that a certificate can hold.
    """
    kinds, parameters = shared or Prepared.of(itinerary.system)
    bits = 96 + 8 * digits
    with interval.workprec(bits):
        prover = Prover(Equations(itinerary, kinds), pieces=True)
        orbit = prover.prove(guess, digits + EXTRA, Fraction(1, 10 ** (digits + 2)))
        found = claims(orbit, digits)
        content = found, hints(orbit, bits)
        certificate = assembled("contacts", parameters, digits, content, bits)
        if found.get("unstable") == "0" and "radius" not in found:
            without_choice(prover, orbit.box)
            attracting = _attracting(certificate, prover, orbit)
            if attracting:
                return attracting
        return checked(certificate, legs(prover, orbit.box, orbit.reasons))


def _attracting(
    certificate: dict[str, Any], prover: Prover, orbit: PeriodicOrbit
) -> dict[str, Any] | None:
    """Return the certificate with an ellipsoid of motions that are attracted, if one is found."""
    sizes = attracted(prover, orbit, lambda box: legs(prover, box, prover.reasons(box)))
    with suppress(NotProved):
        for ellipsoid, cuts in islice(sizes, SIZES):
            with suppress(NotProved):
                return checked(_with_basin(certificate, ellipsoid), cuts)
    return None


def _with_basin(certificate: dict[str, Any], found: Ellipsoid) -> dict[str, Any]:
    """Return a certificate with an ellipsoid."""
    shown = [[_decimal(q) for q in row] for row in found.matrix]
    basin = {"matrix": shown, "contraction": _decimal(found.contraction)}
    reach = [[_decimal(q) for q in row] for row in found.reach]
    return {
        **certificate,
        "claims": {**certificate["claims"], "basin": basin},
        "hints": {**certificate["hints"], "reach": reach},
    }


def checked(
    certificate: dict[str, Any], cuts: Cuts, shape: Callable[[list[Any]], Any] = list
) -> dict[str, Any]:
    """Return the certificate with cuts, of this shape, so fine that the checker accepts it."""
    for _ in range(ATTEMPTS):
        certificate["hints"]["cuts"] = shape(shown(cuts))
        try:
            check(writer.dumps(certificate).encode(), lambda _step: None)
        except TooCoarse as reason:
            rejection: Rejected = reason
            cuts = [{g: _halved(times) for g, times in leg.items()} for leg in cuts]
        except Rejected as reason:
            rejection = reason
            break
        else:
            return certificate
    raise NotProved("checker", f"the independent checker rejects the certificate: {rejection}")


def grouped(count: int) -> Callable[[list[Any]], list[list[Any]]]:
    """Return how cuts are written where those of so many legs belong together."""
    return lambda cuts: [cuts[k : k + count] for k in range(0, len(cuts), count)]


def shown(cuts: Cuts) -> list[dict[str, list[str]]]:
    """Return the cuts of legs as a certificate has them."""
    return [{g: [*map(_decimal, at[1:-1])] for g, at in leg.items()} for leg in cuts]


def _halved(times: Times) -> Times:
    """Return times with the middles between them."""
    return sorted([*times, *(round((a + b) / 2, PLACES) for a, b in pairwise(times))])


# the system


def as_parameters(system: System, *, rests: bool = False) -> dict[str, Any]:
    """Return a system in the form that a certificate holds; ``rests``: with the modes of rest."""
    pi, omega = _frequency(system)
    return {
        "state": list(system.state),
        "omega": str(omega),
        **({"times_pi": "1"} if pi else {}),
        "modes": {
            key: {
                "field": {z: terms(q, f"{z}' of {key}") for z, q in mode.field.items()},
                "guards": {
                    g: {
                        "value": terms(guard.value, f"the guard {g} of {key}", OF_GUARDS),
                        **_reset(system, key, g),
                        "to": list(guard.to),
                        **({"rest": guard.rest} if rests and guard.rest else {}),
                    }
                    for g, guard in mode.guards.items()
                },
            }
            for key, mode in system.modes.items()
        },
    }


def _frequency(system: System) -> tuple[bool, Fraction]:
    """Return whether the frequency is a multiple of pi, and the rational number of it."""
    ((monomial, omega),) = system.omega.terms.items()
    if monomial not in ((), (("pi", 1),)):
        raise BadInput("the frequency is neither rational nor that times pi: a certificate cannot")
    return bool(monomial), omega


def _reset(system: System, mode: str, guard: str) -> dict[str, Any]:
    """Return the variables that jump, with their new values, and what divides these."""
    where, given = f"the reset at {guard} of {mode}", system.reset(mode, guard)
    new = {z: q for z, q in given.items() if (q.numerator, q.denominator) != (variable(z), ONE)}
    divisors = list(dict.fromkeys(q.denominator for q in new.values()))
    divisor = reduce(mul, divisors, ONE)
    over = {d: reduce(mul, (other for other in divisors if other != d), ONE) for d in divisors}
    reset = {z: terms(q.numerator * over[q.denominator], where) for z, q in new.items()}
    divided = {} if divisor == ONE else {"divisor": terms(divisor, f"the divisor of {where}")}
    return {"reset": reset, **divided}


def terms(q: Polynomial, where: str, degree: int = DEGREE) -> list[list[str]]:
    """Return the terms, each a number and the names of its factors."""
    if any(power < 0 for monomial in q.terms for _, power in monomial):
        raise BadInput(f"{where} is divided by pi: a certificate cannot hold it yet")
    longest = max((sum(power for _, power in monomial) for monomial in q.terms), default=0)
    if longest > degree or len(q.terms) > TERMS:
        raise BadInput(f"{where} has more than {TERMS} terms, or a degree (with pi) above {degree}")
    return [
        [str(c), *(name for name, power in monomial for _ in range(power))]
        for monomial, c in sorted(q.terms.items())
    ]


# claims and hints


def claims(orbit: PeriodicOrbit, digits: int) -> dict[str, Any]:
    """Return what is claimed of an orbit."""
    return orbit_claims(orbit, digits) | unstable(orbit)


def orbit_claims(orbit: PeriodicOrbit, digits: int) -> dict[str, Any]:
    """Return what is claimed of an orbit, but for its stability."""
    contacts = orbit.contacts
    return {
        "contacts": [contact._asdict() for contact in orbit.itinerary.contacts],
        "periods": str(orbit.itinerary.periods),
        "box": [
            [[_decimal(c - r), _decimal(c + r)] for c, r in zip(place, reach, strict=True)]
            for place, reach in zip(
                _places(orbit, orbit.hint.centre), _places(orbit, orbit.reach), strict=True
            )
        ],
        "times": [pair(t, digits) for t, _ in contacts],
        "states": [[pair(x, digits) for x in q] for _, q in contacts],
        "symmetric": [pair(x, digits) for x in orbit.symmetric],
    }


def unstable(orbit: PeriodicOrbit) -> dict[str, str]:
    """Return how many multipliers lie outside a circle, the first of `RADII` for which it is clear.

    Where nothing is lost, multipliers may lie on the unit circle: two do, if they are not real and
    their product is 1.
    """
    if abs(orbit.trace) < 2 and product_of_two(orbit.itinerary) == 1 and not orbit.autonomous:
        return {"kind": "elliptic"}
    for radius in RADII:
        count = orbit.unstable(radius)
        if count is not None:
            others = {} if radius == 1 else {"radius": _decimal(radius)}
            return {"unstable": str(count), **others}
    return {}


def pair(x: Ball, digits: int) -> Pair:
    """Return decimals that enclose x, and what a looser arithmetic finds."""
    room = abs(x).max(interval.ONE) * interval.ball(Fraction(1, 10 ** (digits + 2)))
    return Rounding(digits).pair(x + interval.symmetric(interval.upper(room)))


def _places(orbit: PeriodicOrbit, unknowns: Sequence[Fraction]) -> list[list[Fraction]]:
    """Return the unknowns of each contact."""
    return grouped(len(orbit.itinerary.system.state) + 1)(list(unknowns))


def hints(orbit: PeriodicOrbit, bits: int) -> dict[str, Any]:
    """Return what the checker need not search, but the cuts."""
    return {
        "bits": str(bits),
        "centre": [[_decimal(c) for c in place] for place in _places(orbit, orbit.hint.centre)],
        "preconditioner": [[str(round(c * SCALE)) for c in row] for row in orbit.hint.matrix],
        "cuts": [],
    }


def legs(prover: Prover, box: Box, reasons: Sequence[Reason]) -> Cuts:
    """Return for each leg, and guard that falls by no lemma, its ends and the cuts of Lemma B.

    They are those of the motions whose contacts lie in a box.
    """
    found = Cuts()
    for number, span in enumerate(prover.spans(box)):
        begin, end = (Fraction(float(time)) for time in span)
        cut = [r for r in reasons if r.leg == number and r.lemma == "B"]
        found.append({r.guard: [begin, *map(decimal_of, r.cuts), end] for r in cut})
    return found


def decimal_of(cut: float) -> Fraction:
    """Return the decimal that a double stands for."""
    return Fraction(round(cut * 10**PLACES), 10**PLACES)
