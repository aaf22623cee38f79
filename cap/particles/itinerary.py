"""The events of a guess, in words, as contacts of the system of `cap.system.masses`.

The words are "hit l", "hit r", "meet 1 2", "turn 1 left", "stick 1", "release 1 right".  A mass
rests from its stick until it is released or hit.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction

from cap.errors import NotProved
from cap.orbits.itinerary import Contact, Itinerary
from cap.particles.guess import Guess
from cap.system.masses import word as mode_of
from cap.system.model import System
from cap.system.polynomial import Quotient, variable

SIDES = {"right": 1, "left": -1}


def itinerary(system: System, guess: Guess) -> Itinerary:
    """Return the itinerary of a guess; which signs velocities have is found by going round twice.

    Raises `NotProved` if no guard is met so.
    """
    signs, found = (1,) * len(guess.masses), list[Contact]()
    for event in [*guess.events, *guess.events]:
        before, signs = signs, _after(system, signs, event)
        found.append(Contact(mode_of(before), _guard(event[0]), mode_of(signs)))
    return Itinerary(system, found[len(guess.events) :], guess.periods)


def unknowns(guess: Guess) -> list[float]:
    """Return the time and the state before each contact."""
    return [q for _, t, x, v in guess.events for q in (t, *x, *v)]


def _guard(words: str) -> str:
    kind, *rest = words.split()
    names = {"turn": f"stop {rest[0]}", "stick": f"stop {rest[0]}"}
    return names.get(kind, words).replace("right", "r").replace("left", "l")


def _after(
    system: System, signs: Sequence[int], event: tuple[str, float, Sequence[float], Sequence[float]]
) -> tuple[int, ...]:
    """Return the signs of the velocities after an event; 0 is a mass at rest."""
    words, _, x, v = event
    kind, *rest = words.split()
    if kind in ("hit", "meet"):
        return tuple(_reflected(system, words, signs, (*x, *v)))
    side = SIDES[rest[1]] if kind != "stick" else 0
    return tuple(side if i == int(rest[0]) - 1 else s for i, s in enumerate(signs))


def _reflected(
    system: System, guard: str, signs: Sequence[int], state: Sequence[float]
) -> Iterator[int]:
    """Give the signs after a contact, new ones for the velocities that it changes."""
    mode = next((name for name, q in system.modes.items() if guard in q.guards), None)
    if mode is None:
        raise NotProved("itinerary", f"{guard!r} is no contact", {})
    values = {z: Fraction(q) for z, q in zip(system.state, state, strict=True)}
    for s, (v, new) in zip(
        signs, list(system.reset(mode, guard).items())[-len(signs) :], strict=True
    ):
        if new == Quotient.of(variable(v)):
            yield s
        else:
            after = new.numerator.evaluated(values, Fraction)
            yield (after > 0) - (after < 0)
