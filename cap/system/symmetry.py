"""Symmetries of a system: signs of its variables, half a period of the clock later.

S takes a state to that with some signs, the clock (cos, sin) to (-cos, -sin), each mode and each
guard to an *image*, as `cap.checker.system.symmetry` says.  Then for each motion z(t) S z(t - T/2)
is one.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from cap.system.model import System
from cap.system.polynomial import COS, SIN, Polynomial


@dataclass(frozen=True)
class Symmetry:
    """The signs of the variables, the images of modes, and of guards, by mode and name."""

    signs: tuple[int, ...]
    modes: Mapping[str, str]
    guards: Mapping[tuple[str, str], str]


def symmetries(system: System, even: Sequence[str] = ()) -> Iterator[Symmetry]:
    """Give the symmetries of a system that leave the variables ``even`` as they are."""
    for signs in product((-1, 1), repeat=len(system.state)):
        fixed = all(s > 0 for z, s in zip(system.state, signs, strict=True) if z in even)
        if fixed and (found := _Images(system, signs).symmetry()):
            yield found


class _Images:
    """What modes and guards become by S."""

    def __init__(self, system: System, signs: tuple[int, ...]) -> None:
        self.system, self.signs = system, signs
        odd = [z for z, s in zip(system.state, signs, strict=True) if s < 0]
        self.odd = {*odd, COS, SIN}

    def symmetry(self) -> Symmetry | None:
        """Return the symmetry, None if this is none."""
        modes = {}
        for mode in self.system.modes:
            images = [m for m in self.system.modes if self._maps(mode, m)]
            if len(images) != 1:
                return None
            modes[mode] = images[0]
        if any(modes[image] != mode for mode, image in modes.items()):
            return None
        guards = {}
        for mode, image in modes.items():
            for name in self.system.modes[mode].guards:
                there = self.system.modes[image].guards
                found = next((g for g in there if self._same(mode, name, image, g, modes)), None)
                if found is None:
                    return None
                guards[mode, name] = found
        return Symmetry(self.signs, modes, guards)

    def of(self, q: Polynomial) -> Polynomial:
        """Return q(S z)."""
        return Polynomial(
            {
                m: -c if sum(k for name, k in m if name in self.odd) % 2 else c
                for m, c in q.terms.items()
            }
        )

    def _maps(self, mode: str, image: str) -> bool:
        """Return whether the field and the guards of a mode are those of another one at S z."""
        here, there = self.system.modes[mode], self.system.modes[image]
        field = all(
            self.of(there.field[z]) == here.field[z] * s
            for z, s in zip(self.system.state, self.signs, strict=True)
        )
        values = [self.of(guard.value) for guard in there.guards.values()]
        return (
            field
            and len(values) == len(here.guards)
            and all(guard.value in values for guard in here.guards.values())
        )

    def _same(self, mode: str, name: str, image: str, other: str, modes: Mapping[str, str]) -> bool:
        """Return whether a guard, its reset and where it leads to, go to another guard."""
        here, there = self.system.guard(mode, name), self.system.guard(image, other)
        if self.of(there.value) != here.value or {modes[m] for m in here.to} != {*there.to}:
            return False
        before, after = self.system.reset(mode, name), self.system.reset(image, other)
        return all(
            self.of(after[z].numerator) * before[z].denominator
            == before[z].numerator * self.of(after[z].denominator) * s
            for z, s in zip(self.system.state, self.signs, strict=True)
        )
