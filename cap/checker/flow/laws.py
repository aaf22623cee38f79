"""The oscillator with what follows from its data: its constants, and its flights in closed form."""

from __future__ import annotations

from functools import cache

from cap.checker.flow.one_mass import MODES, one_mass
from cap.checker.system.course import ELAPSED, flight, response
from cap.checker.system.friction import friction
from cap.checker.system.model import Model
from cap.checker.system.polynomial import Polynomial, variable
from cap.checker.system.walls import Parameters


class Laws:
    """A model with its constants, and with its flights and responses for both directions."""

    def __init__(self, model: Model) -> None:
        self.model, self.mass = model, one_mass(model)
        modes, state = MODES.items(), model.state
        self.flights = {s: {z: flight(model, mode, z) for z in state} for s, mode in modes}
        self.rests = {
            s: {z: variable(z) - response(model, mode, z) for z in state} for s, mode in modes
        }
        self._along: dict[tuple[int, Polynomial], list[Polynomial]] = {}

    def along(self, s: int, g: Polynomial) -> list[Polynomial]:
        """Return a polynomial in the state on the flights of a direction, by the powers of d."""
        if (s, g) not in self._along:
            self._along[s, g] = g.substituted(self.flights[s]).coefficients(ELAPSED)
        return self._along[s, g]


@cache
def laws(p: Parameters, names: tuple[str, ...]) -> Laws:
    """Return the laws of the oscillator, in which these constants are parameters."""
    numbers = {name: Polynomial.of(getattr(p, name)) for name in ("F", "f", "l", "r", "e", "mu")}
    return Laws(friction(p.omega, numbers | {name: variable(name) for name in names}))
