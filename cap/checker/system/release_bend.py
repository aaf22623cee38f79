"""The second derivative of the map from the time of a release to that of the next one.

Times and states are jets of second order in the time of the release (``kernel.jet``): over a set
of releases their coefficients enclose those at each.  At each contact the time is solved for degree
by degree, as in ``strobe``; its constant term, and that of the state, are known (``releases``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet, RealJet, cos_sin_jet
from cap.checker.system.evaluation import evaluate
from cap.checker.system.legs import flights
from cap.checker.system.model import CLOCK, PI, Model
from cap.checker.system.passage import Contact
from cap.checker.system.polynomial import ONE, Polynomial, variable
from cap.checker.system.releases import Moment, Releases
from cap.checker.system.strobe import flown, part

ORDER = 2
ORIGIN, LINEAR, SQUARE = (0,), (1,), (2,)


def bend(F: Releases, t: Interval, moments: Sequence[Moment]) -> Interval:
    """Return F'' at all times in an interval; ``moments`` enclose the contacts after them."""
    model, contacts = F.model, F.contacts
    time: RealJet = Jet(ORDER, {ORIGIN: t, LINEAR: t.integer(1)})
    nothing: RealJet = Jet(ORDER, {ORIGIN: t.integer(0)})
    known = dict.fromkeys(model.state, nothing)
    known[F.x] = _value(F, F.place, time, known)
    state = _after(F, contacts[0], time, known)
    for k, moment in enumerate(moments):
        following = contacts[(k + 1) % len(contacts)]
        time, before = _contact(F, contacts[k].to, following, (time, state), moment)
        state = _after(F, following, time, before)
    return time.coefficients[SQUARE] * 2


def _contact(
    F: Releases,
    mode: str,
    contact: Contact,
    start: tuple[RealJet, Mapping[str, RealJet]],
    moment: Moment,
) -> tuple[RealJet, dict[str, RealJet]]:
    """Return the time of a contact, and the state just before it."""
    model: Model = F.model
    guard, moves = (
        model.modes[contact.mode].guards[contact.guard].value,
        flights(model, mode, F.bits),
    )
    began, z = start[0], [start[1][y] for y in model.state]
    point = {y: Jet(0, {ORIGIN: q}) for y, q in zip(model.state, moment.state, strict=True)}
    rate = _value(F, model.lie(mode, guard), Jet(0, {ORIGIN: moment.time}), point).constant
    t: RealJet = Jet(ORDER, {ORIGIN: moment.time})
    for degree in range(1, ORDER + 1):
        found = dict(zip(model.state, flown(moves, began, z, t), strict=True))
        h = _value(F, guard, t, found)
        t = t - part(h, degree) * (rate.integer(1) / rate)
    arrived = zip(model.state, moment.state, flown(moves, began, z, t), strict=True)
    return t, {y: Jet(ORDER, {ORIGIN: q}) + part(x, 1, ORDER) for y, q, x in arrived}


def _after(
    F: Releases, contact: Contact, t: RealJet, before: Mapping[str, RealJet]
) -> dict[str, RealJet]:
    """Return the state just after a contact."""
    guard = F.model.modes[contact.mode].guards[contact.guard]
    found = {z: _value(F, guard.reset.get(z, variable(z)), t, before) for z in F.model.state}
    if guard.divisor == ONE:
        return found
    over = _reciprocal(_value(F, guard.divisor, t, before))
    return {z: x * over if z in guard.reset else x for z, x in found.items()}


def _reciprocal(x: RealJet) -> RealJet:
    """Return 1/(c + h) = 1/c - h/c^2 + h^2/c^3, without the terms beyond the second order."""
    over = x.constant.integer(1) / x.constant
    h = part(x, 1, x.order) * over
    return (Jet(x.order, {ORIGIN: over.integer(1)}) - h + h * h) * over


def _value(F: Releases, q: Polynomial, t: RealJet, state: Mapping[str, RealJet]) -> RealJet:
    """Return a polynomial in the state and the clock."""
    clock = dict(zip(CLOCK, cos_sin_jet(t * F.flights.omega), strict=True))
    return evaluate(q, {**state, **clock, PI: Jet(t.order, {ORIGIN: F.flights.pi})})
