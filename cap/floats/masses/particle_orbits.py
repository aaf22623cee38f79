"""T-periodic orbits of N masses in floats: Newton's method, and continuation in the system.

Hints for a proof, not rigorous.  Two equal masses move as two masses alone that exchange their
names when they meet; so a pair of orbits of one mass is an orbit to start from.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations

import numpy as np

from cap.errors import BadInput
from cap.floats.masses.particles import Floats, Particles, Path, Unresolved, follow
from cap.floats.search.orbits import from_hit_times
from cap.floats.search.periodic import Guess

STEPS = 20
SMALLEST = Fraction(1, 200)  # step from equal masses
DOUBLE = 1e-6  # difference of reduced traces that rounding may have made
CLOSE = 1e-12  # of Newton's steps, beside the size of the state


class NotFound(Exception):
    """Newton's method does not converge to a T-periodic orbit on which no mass stops."""


def fixed_point(system: Particles, state: Sequence[float]) -> tuple[Floats, Path]:
    """Return the state (x, v) at t = 0 of a T-periodic orbit near ``state``, and the orbit.

    Raises `NotFound`.
    """
    z, n, T = np.array(state, dtype=np.float64), len(system.masses), system.period
    for _ in range(STEPS):
        try:
            path = follow(system, z[:n].tolist(), z[n:].tolist(), T)
            miss = np.array([*path.x, *path.v]) - z
            move = np.linalg.solve(path.monodromy - np.eye(2 * n), miss)
        except (BadInput, Unresolved, np.linalg.LinAlgError) as reason:
            raise NotFound(f"Newton's method leads astray: {reason}") from None
        if np.abs(move).max() < CLOSE * (1 + np.abs(z).max()) and path.least_speed > 0:
            return z, path
        z = z - move
    raise NotFound("Newton's method does not converge to an orbit on which no mass stops")


def continued(first: Particles, last: Particles, state: Sequence[float]) -> tuple[Floats, Path]:
    """Continue the `fixed_point` of a system to another one, in steps that are halved if need be.

    Raises `NotFound`, also if on the way the itinerary changes.
    """
    z, path = fixed_point(first, state)
    part, step = Fraction(0), Fraction(1, 10)
    while part < 1:
        then = min(part + step, Fraction(1))
        system = _between(first, last, then)
        try:
            following, further = fixed_point(system, z.tolist())
            if further.words != path.words:
                raise NotFound("its itinerary changes")
        except NotFound:
            step /= 2
            if step < SMALLEST:
                at = ", ".join(f"{float(m):.6g}" for m in system.masses)
                raise NotFound(
                    f"an orbit continued from equal masses ends, or is lost by Newton's method, "
                    f"before m = {at}"
                ) from None
        else:
            part, z, path = then, following, further
    return z, path


def _between(first: Particles, last: Particles, part: Fraction) -> Particles:
    """Return the system so far from the first to the last, which differ in masses or friction."""
    p, q = first.parameters, last.parameters
    pairs = zip(first.masses, last.masses, strict=True)
    masses = tuple(m + (other - m) * part for m, other in pairs)
    return replace(last, parameters=replace(q, f=p.f + (q.f - p.f) * part), masses=masses)


def reduced_traces(monodromy: Floats) -> tuple[complex, complex]:
    """Return z = λ + 1/λ of the multipliers λ of two masses: of a palindromic polynomial.

    With a = tr D and b = (a² - tr D²)/2 they are (a ± sqrt(a² - 4b + 8))/2; both real, different
    and in (-2, 2): two pairs on the unit circle.
    """
    a = float(np.trace(monodromy))
    b = (a * a - float(np.trace(monodromy @ monodromy))) / 2
    root = complex(a * a - 4 * b + 8) ** 0.5
    return (a + root) / 2, (a - root) / 2


@dataclass(frozen=True)
class Continued:
    """An orbit of two masses, continued from ``pair``, two orbits of one mass.

    ``state`` is (x, v) at t = 0, ``path`` its period.
    """

    pair: tuple[Guess, Guess]
    state: tuple[float, ...]
    path: Path

    @property
    def traces(self) -> tuple[complex, complex]:
        """The `reduced_traces`."""
        return reduced_traces(self.path.monodromy)

    @property
    def kind(self) -> str:
        """What its two pairs of multipliers are."""
        z = self.traces
        if abs(z[0] - z[1]) < DOUBLE:
            return "close to a double pair"
        if any(q.imag for q in z):
            return "complex quadruple"
        return " x ".join(
            "elliptic" if abs(q) < 2 else "hyperbolic" if q.real > 0 else "inverse hyperbolic"
            for q in z
        )


def from_equal_masses(system: Particles) -> Iterator[Continued | NotFound]:
    """Give the orbits of two masses that continue pairs of orbits of one mass, or why not.

    Pairs of elliptic orbits first.  The masses begin as two of the first one, then of the second.
    """
    for mass in sorted(set(system.masses), key=system.masses.index):
        p = system.parameters
        alone = replace(p, F=p.F / mass, f=p.f if system.proportional else p.f / mass)
        found = [guess for guesses in from_hit_times(alone) for guess in guesses]
        pairs = combinations(sorted(found, key=lambda guess: guess.x), 2)
        for pair in sorted(pairs, key=lambda pair: sum(guess.kind != "elliptic" for guess in pair)):
            try:
                one, other = pair
                equal = replace(system, masses=(mass, mass))
                z, path = continued(equal, system, (one.x, other.x, one.v, other.v))
                yield Continued(pair, tuple(z.tolist()), path)
            except NotFound as reason:
                yield reason
