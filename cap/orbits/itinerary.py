"""The itinerary of a periodic orbit: its contacts in one round, and what vanishes after each.

*What vanishes.*  Some variables are numbers at a contact of every orbit with the itinerary: a reset
made them so, and no flight since then moved them.  With these, a guard h or its derivatives L h,
L² h may vanish just after a contact by an identity of polynomials, because the reset makes them
zero, or a multiple of the guard that has come to zero.  That, and no enclosure, decides what starts
at zero.

*With a symmetry* S (`cap.system.symmetry`) the contacts are those of half a round of a symmetric
orbit: the contact after the last one is the image of the first, an odd number of half periods
later.  The flight to it is looked at as S *moves it back*, in the mode of the first contact.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from cap.errors import BadInput
from cap.system.model import System
from cap.system.polynomial import COS, SIN, Polynomial
from cap.system.symmetry import Symmetry

Facts = Mapping[str, Polynomial]
MOST = 3  # derivatives looked at


class Contact(NamedTuple):
    """A guard of a mode comes to zero, and the system goes on in the mode ``to``."""

    mode: str
    guard: str
    to: str


@dataclass(frozen=True)
class Itinerary:
    """The contacts of one round, in order, after which ``periods`` of the clock have passed.

    With a symmetry they are those of half a round.
    """

    system: System
    contacts: Sequence[Contact]
    periods: int = 1
    symmetry: Symmetry | None = None

    def __post_init__(self) -> None:
        modes = self.system.modes
        if not self.contacts or self.periods < 1:
            raise BadInput("an itinerary has a contact and takes a period, at least")
        if self.symmetry and self.periods % 2 == 0:
            raise BadInput("a symmetric orbit has an odd number of periods")
        for k, contact in enumerate(self.contacts):
            mode, guard, to = contact
            if mode not in modes or guard not in modes[mode].guards:
                raise BadInput(f"contact {k + 1}: there is no guard {guard} of a mode {mode}")
            if to not in modes[mode].guards[guard].to:
                raise BadInput(f"contact {k + 1}: {guard} does not lead from {mode} to {to}")
            if self.following(k).mode != self.flown(k):
                raise BadInput(f"contact {k + 1} leads to {to}, the next is in another mode")

    def following(self, k: int) -> Contact:
        """Return the contact after the k-th, counted from 0; after the last it is the first."""
        return self.contacts[self.after(k)]

    def after(self, k: int) -> int:
        """Return the number of that contact."""
        return (k + 1) % len(self.contacts)

    def is_moved(self, k: int) -> bool:
        """Return whether the flight after the k-th contact is looked at as S moves it back."""
        return self.symmetry is not None and k + 1 == len(self.contacts)

    def flown(self, k: int) -> str:
        """Return the mode of the flight after the k-th contact."""
        to = self.contacts[k].to
        return self.symmetry.modes[to] if self.symmetry and self.is_moved(k) else to

    @cached_property
    def known(self) -> list[Facts]:
        """For each contact the variables that are numbers just before it, on every orbit."""
        facts: Facts = {}
        found = list[Facts]()
        for _ in range(2):  # the first round shows what the first contact begins with
            found = []
            for k, contact in enumerate(self.contacts):
                found.append(facts)
                facts = self._back(k, self._moved(contact, self._reset(contact, facts)))
        return found

    @cached_property
    def vanishing(self) -> list[dict[str, int]]:
        """For each contact and guard of the mode after it: how many of h, L h, .. vanish there."""
        return [
            {
                name: self._order(contact, self._image(k, name), facts)
                for name in self.system.modes[self.flown(k)].guards
            }
            for k, (contact, facts) in enumerate(zip(self.contacts, self.known, strict=True))
        ]

    def _image(self, k: int, name: str) -> str:
        """Return the guard of the mode after a contact that this one is on the flight."""
        moved = self.symmetry if self.is_moved(k) else None
        return moved.guards[self.flown(k), name] if moved else name

    def _back(self, k: int, facts: Facts) -> Facts:
        """Return facts as the flight after a contact has them at its end."""
        if self.symmetry is None or not self.is_moved(k):
            return facts
        signs = dict(zip(self.system.state, self.symmetry.signs, strict=True))
        return {z: value * signs[z] for z, value in facts.items()}

    def zeros_in(self, k: int, mode: str, name: str) -> int:
        """Return how many of h, L h, .. of a guard of any mode vanish after the k-th contact.

        They do so whatever the state before is.
        """
        return self._order(self.contacts[k]._replace(to=mode), name, {})

    def _reset(self, contact: Contact, facts: Facts) -> Facts:
        """Return the variables that are numbers after a contact."""
        found = {}
        for z, q in self.system.reset(contact.mode, contact.guard).items():
            value = q.numerator.substituted(facts)
            if value.is_number and q.denominator == 1:
                found[z] = value
        return found

    def _moved(self, contact: Contact, facts: Facts) -> Facts:
        """Return those that the flight after the contact does not move."""
        field = self.system.modes[contact.to].field
        kept = facts
        while moved := [z for z in kept if field[z].substituted(kept)]:
            kept = {z: q for z, q in kept.items() if z not in moved}
        return kept

    def _order(self, contact: Contact, name: str, facts: Facts) -> int:
        """Return how many of h, L h, .. vanish just after a contact, by an identity."""
        system, mode = self.system, contact.to
        reset = system.reset(contact.mode, contact.guard)
        zero = system.guard(contact.mode, contact.guard).value.substituted(facts)
        h = system.guard(mode, name).value
        for order in range(MOST):
            if any(reset[z].denominator != 1 for z in h.variables - {COS, SIN}):
                return order
            values = {z: reset[z].numerator for z in h.variables - {COS, SIN}}
            if h.substituted(values).substituted(facts).multiple_of(zero) is None:
                return order
            h = system.lie(mode, h)
        return MOST
