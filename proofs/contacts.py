"""Theorem (contacts).  Let a system be given as data (`cap.system.model`): modes with linear
fields, guards that are positive in their modes, resets, all with rational numbers.  Let contacts be
given, one round of a periodic orbit, with a guess of their times and states.  If the lemmas below
succeed, then

 (i)   the system has exactly one periodic orbit with these contacts whose times and states just
       before them lie in an explicit box;
 (ii)  nothing else happens on it: between its contacts all guards of its mode are positive, and
       each guard that comes to zero falls through it;
 (iii) the times, the states, and the elementary symmetric functions of its multipliers lie in
       explicit intervals; so many of these lie outside the unit circle, and none on it.

Proof.  `cap.orbits.periodic` proves all of it.  The certificate has the system, the box, the
Krawczyk hints, and for each leg and guard cuts between which the mean value form with L h shows
that h > 0 (`cuts`): so the checker searches nothing.
"""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

from cap.certificate import writer
from cap.certificate.writer import Pair, Rounding
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems import load
from cap.checker.verdict import check
from cap.errors import BadInput, NotProved
from cap.orbits.along import Along
from cap.orbits.equations import Equations
from cap.orbits.itinerary import Itinerary
from cap.orbits.periodic import PeriodicOrbit, Prover
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.interval import exact_decimal as _decimal
from cap.system.exponential import number
from cap.system.model import System
from cap.system.polynomial import ONE, Polynomial

ATTEMPTS = 4  # after each that leaves a leg open, all pieces of legs are cut in halves
QUIET = ("a guard may vanish", "a piece of a flight is too long")
DEPTH = 24  # of halves
EXTRA = 4  # digits of the centre beyond those that are claimed
PLACES = 12  # decimals of a cut

Times = list[Fraction]


def prove(itinerary: Itinerary, guess: Sequence[float], digits: int = 10) -> dict[str, Any]:
    """Return a certificate, which the independent checker accepts, of an orbit near a guess.

    The guess has the time and the state just before each contact.  Raises `NotProved` with the
    step that failed, and `BadInput` if the system is none that a certificate can hold.
    """
    parameters = as_parameters(itinerary.system)
    bits = 96 + 8 * digits
    with interval.workprec(bits):
        prover = Prover(Equations(itinerary))
        orbit = prover.prove(guess, digits + EXTRA)
        certificate = {
            "format": writer.FORMAT,
            "theorem": "contacts",
            "parameters": parameters,
            "digits": str(digits),
            "claims": claims(orbit, digits),
            "hints": hints(orbit, digits, bits),
            "cites": list(load("contacts").CITES),
            "provenance": writer.provenance(bits),
        }
        return _checked(certificate, legs(prover, orbit))


def _checked(certificate: dict[str, Any], cuts: list[dict[str, Times]]) -> dict[str, Any]:
    """Return the certificate with cuts, so fine that the checker accepts it."""
    for _ in range(ATTEMPTS):
        shown = [{g: list(map(str, times[1:-1])) for g, times in leg.items()} for leg in cuts]
        certificate["hints"]["cuts"] = shown
        try:
            check(writer.dumps(certificate).encode(), lambda _step: None)
        except Rejected as reason:
            rejection = str(reason)
            if not rejection.startswith(QUIET):
                break
            cuts = [{g: _halved(times) for g, times in leg.items()} for leg in cuts]
        else:
            return certificate
    raise NotProved("checker", f"the independent checker rejects the certificate: {rejection}")


def _halved(times: Times) -> Times:
    """Return times with the middles between them."""
    middles = [(a + b) / 2 for a, b in pairwise(times)]
    return sorted([*times, *middles])


# the system


def as_parameters(system: System) -> dict[str, Any]:
    """Return a system in the form that a certificate holds."""
    return {
        "state": list(system.state),
        "omega": str(_rational(system.omega, "the frequency")),
        "modes": {
            key: {
                "field": {z: _polynomial(q, f"{z}' of {key}") for z, q in mode.field.items()},
                "guards": {
                    g: {
                        "value": _polynomial(guard.value, f"the guard {g} of {key}"),
                        "reset": _reset(system, key, g),
                        "to": list(guard.to),
                    }
                    for g, guard in mode.guards.items()
                },
            }
            for key, mode in system.modes.items()
        },
    }


def _reset(system: System, mode: str, guard: str) -> dict[str, Any]:
    """Return the variables that jump, and their new values."""
    found, where = {}, f"the reset at {guard} of {mode}"
    for z, q in system.reset(mode, guard).items():
        if q.denominator != ONE or q.numerator.degree > 1:
            raise BadInput(f"{where} is not linear: certificates of own systems cannot hold it yet")
        value = _polynomial(q.numerator, where)
        if value != [["1", z]]:
            found[z] = value
    return found


def _polynomial(q: Polynomial, where: str) -> list[list[str]]:
    """Return the terms, each a number and the names of its factors."""
    _no_pi(q, where)
    return [
        [str(c), *(name for name, power in monomial for _ in range(power))]
        for monomial, c in sorted(q.terms.items())
    ]


def _rational(q: Polynomial, where: str) -> Fraction:
    _no_pi(q, where)
    return q.terms[()]


def _no_pi(q: Polynomial, where: str) -> None:
    """Refuse the number pi."""
    if any(name == "pi" for monomial in q.terms for name, _ in monomial):
        raise BadInput(f"{where} has pi: certificates of own systems hold rational numbers yet")


# claims and hints


def claims(orbit: PeriodicOrbit, digits: int) -> dict[str, Any]:
    """Return what is claimed of an orbit."""
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
        "times": [_pair(t, digits) for t, _ in contacts],
        "states": [[_pair(x, digits) for x in q] for _, q in contacts],
        "symmetric": [_pair(x, digits) for x in orbit.symmetric],
    } | ({} if orbit.unstable is None else {"unstable": str(orbit.unstable)})


def _pair(x: Ball, digits: int) -> Pair:
    """Return decimals that enclose x, and what a looser arithmetic finds."""
    room = abs(x).max(interval.ONE) * interval.ball(Fraction(1, 10 ** (digits + 2)))
    return Rounding(digits).pair(x + interval.symmetric(interval.upper(room)))


def _places(orbit: PeriodicOrbit, unknowns: Sequence[Fraction]) -> list[Sequence[Fraction]]:
    """Return the unknowns of each contact."""
    step = len(orbit.itinerary.system.state) + 1
    return [unknowns[k : k + step] for k in range(0, len(unknowns), step)]


def hints(orbit: PeriodicOrbit, digits: int, bits: int) -> dict[str, Any]:
    """Return what the checker need not search, but the cuts."""
    return {
        "bits": str(bits),
        "centre": [[_decimal(c) for c in place] for place in _places(orbit, orbit.hint.centre)],
        "radius": _decimal(Fraction(10, 10 ** (digits + EXTRA))),
        "preconditioner": [[_decimal(c) for c in row] for row in orbit.hint.matrix],
        "cuts": [],
    }


def legs(prover: Prover, orbit: PeriodicOrbit) -> list[dict[str, Times]]:
    """Return for each leg and guard its ends, and cuts between which it is positive."""
    itinerary, kinds, found = orbit.itinerary, prover.equations.kinds, []
    for leg in prover.legs(orbit.box):
        mode, following = itinerary.contacts[leg.number].to, itinerary.following(leg.number).guard
        cuts, span = {}, _span(itinerary.system, mode)
        for name in itinerary.system.modes[mode].guards:
            zeros = itinerary.vanishing[leg.number][name]
            along = Along(leg, name, kinds.watch(mode, name), zeros, name == following)
            cuts[name] = _cuts(along, span)
        found.append(cuts)
    return found


def _span(system: System, mode: str) -> float:
    """Return how long a piece may be: less than 1/|M|, the largest column sum."""
    columns = zip(*system.matrix(mode), strict=True)
    return 0.9 / max(sum(abs(float(number(q))) for q in column) for column in columns)


def _cuts(along: Along, span: float) -> Times:
    """Return the ends of a leg and cuts between them: on each piece the mean value form decides."""
    leg = along.leg
    ends = interval.midpoint(leg.start.time), interval.midpoint(leg.end.time)
    found, stack = [ends[0]], [(*ends, 0)]
    while stack:
        a, b, depth = stack.pop()
        if b - a < span and _is_positive(along, a, b, (a == ends[0], b == ends[1])):
            found.append(b)
            continue
        if depth == DEPTH:
            time = interval.ball(a)
            raise along.failed("is not certain to be positive", time, along.height(time))
        middle = round((a + b) / 2, PLACES)
        stack += [(middle, b, depth + 1), (a, middle, depth + 1)]
    return found


def _is_positive(along: Along, a: Fraction, b: Fraction, outer: tuple[bool, bool]) -> bool:
    """Return whether h > 0 on a piece, but at an end of the leg where it vanishes."""
    starts, ends = outer[0] and along.vanishing > 0, outer[1] and along.last
    piece = interval.hull(interval.ball(a), interval.ball(b))
    if starts and ends:
        return False
    if starts and along.vanishing > 1:
        return bool(along.bend(piece) > 0)
    _, rate = along.line(piece)
    if starts or ends:
        return bool(rate > 0 if starts else rate < 0)
    middle = interval.ball((a + b) / 2)
    return bool(along.height(middle) + rate * (piece - middle) > 0)
