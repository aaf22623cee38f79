"""A symmetry of a system: signs of its variables, half a period of the clock later.

Let S take a state z to that with the given signs, and the clock (cos, sin) to (-cos, -sin).  Let
the *image* of a mode be a mode, each mode that of one, such that for a mode m and its image m'

- the field of m' at S z is S (the field of m at z),
- each guard h of m has an image: a guard h' of m' with h'(S z) = h(z), whose reset takes S z to S
  (that of h at z), and which leads to the images of the modes that h leads to,

all of these as polynomials, and m and m' have equally many guards; and let the image of m' be m.
Then for each motion z(t) of the system S z(t - T/2) is one, T the period of the clock, in the
images of the modes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from cap.checker.kernel.rejection import need
from cap.checker.system.model import CLOCK, Guard, Model
from cap.checker.system.polynomial import Polynomial, variable


class Symmetry(NamedTuple):
    """The signs of the variables, and the image of each mode."""

    signs: Sequence[int]
    modes: Mapping[str, str]

    def confirm(self, model: Model) -> None:
        """Reject what is no symmetry of the system."""
        need(len(self.signs) == len(model.state), "a symmetry has not a sign for each variable")
        known = self.modes.keys() == model.modes.keys()
        back = known and all(self.modes.get(m) == k for k, m in self.modes.items())
        need(back, "a symmetry does not exchange the modes")
        for mode, image in self.modes.items():
            field, other = model.modes[mode].field, model.modes[image].field
            same = all(
                self._of(model, other[z]) == field[z] * s
                for z, s in zip(model.state, self.signs, strict=True)
            )
            need(same, f"the field of '{image}' is not the image of that of '{mode}'")
            self.guards(model, mode)

    def guards(self, model: Model, mode: str) -> dict[str, str]:
        """Return the image of each guard of a mode; reject if there is none."""
        there, found = model.modes[self.modes[mode]].guards, dict[str, str]()
        for key, guard in model.modes[mode].guards.items():
            image = next((k for k, g in there.items() if self._maps(model, guard, g)), None)
            if image is not None:
                found[key] = image
        complete = len(found) == len(set(found.values())) == len(there)
        every = complete and found.keys() == model.modes[mode].guards.keys()
        need(every, f"the guards of '{self.modes[mode]}' are not the images of those of '{mode}'")
        return found

    def _maps(self, model: Model, guard: Guard, image: Guard) -> bool:
        """Return whether a guard with its reset goes to another one."""
        if self._of(model, image.value) != guard.value:
            return False
        if {self.modes[m] for m in guard.to} != {*image.to}:
            return False
        divisor = self._of(model, image.divisor)
        return all(
            self._of(model, q) * guard.divisor == p * divisor * s
            for p, q, s in self._resets(model, guard, image)
        )

    def _resets(
        self, model: Model, guard: Guard, image: Guard
    ) -> list[tuple[Polynomial, Polynomial, int]]:
        """Return the numerators of both resets with the sign of each variable."""
        return [
            (_numerator(guard, z), _numerator(image, z), s)
            for z, s in zip(model.state, self.signs, strict=True)
        ]

    def _of(self, model: Model, q: Polynomial) -> Polynomial:
        """Return q(S z)."""
        odd = {z for z, s in zip(model.state, self.signs, strict=True) if s < 0} | {*CLOCK}
        return Polynomial(
            {m: -c if sum(z in odd for z in m) % 2 else c for m, c in q.terms.items()}
        )


def _numerator(guard: Guard, z: str) -> Polynomial:
    """Return what a variable becomes at a guard, times the divisor."""
    return guard.reset[z] if z in guard.reset else variable(z) * guard.divisor
