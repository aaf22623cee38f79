"""The periodic orbits of a model that a search meets, and the commands that prove them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.models.closing import logged
from cap.floats.models.engine import Engine
from cap.floats.models.legs import Legs
from cap.floats.models.periodic import Closed, search
from cap.floats.models.spectrum import Floats, evaluated
from cap.floats.models.subject import OfModel, Subject, about, command
from cap.floats.models.trajectory import along
from cap.runner import Runner
from cap.system.polynomial import COS, SIN


@dataclass(frozen=True)
class FoundOrbit:
    """An orbit that closes: its ``state`` at t = 0, in ``mode``, and its curve (K, n).

    ``words`` are its events, ``contacts`` (E, n) the states just before them.
    """

    state: Floats
    mode: str
    words: tuple[str, ...]
    contacts: Floats
    curve: Floats
    multipliers: NDArray[np.complex128]
    attracts: bool
    told: str
    proof: str


@dataclass(frozen=True, kw_only=True)
class ModelOrbits(OfModel):
    """The orbits of a period of ``periods`` T that a search met, those that attract first."""

    periods: int
    orbits: tuple[FoundOrbit, ...]
    plane: tuple[str, str]
    others: tuple[str, ...]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return a row for each orbit."""
        states = np.array([each.state for each in self.orbits]).reshape(-1, len(self.state))
        largest = np.array([np.abs(each.multipliers).max() for each in self.orbits])
        events = np.array([" ".join(each.words) for each in self.orbits], dtype=np.str_)
        named = dict(zip(self.state, states.T, strict=True))
        return {**named, "largest multiplier": largest, "events": events}

    def lines(self) -> list[str]:
        """Return the orbits, each with the command that proves it."""
        count = len(self.orbits)
        what = f"{count} orbit{'s' * (count != 1)} of period {self.periods} T found"
        head = f"{what} of {self.described()}"
        rows = [
            line
            for k, each in enumerate(self.orbits, 1)
            for line in (
                f"  {k}  {'attracts' if each.attracts else 'does not attract'}: {each.told}",
                f"     {each.proof}",
            )
        ]
        return [f"{head} (there may be more)", *rows, *self.others]


def inventory(
    subject: Subject,
    *,
    period: int = 1,
    plane: tuple[str, ...] | None = None,
    runner: Runner | None = None,
) -> ModelOrbits:
    """Search for orbits of a period; nothing that is found is all that there is."""
    runner = runner or Runner()
    if subject.system.autonomous:
        raise BadInput("without a clock the period is unknown: `attractor` and `orbit` find it")
    pair = subject.named(plane) if plane else subject.plane()
    met = search(subject.system, period, runner.tell)
    others = [f"{n} that attract have the period {p} T" for p, n in sorted(met.periods.items())]
    if met.captured:
        others.append(f"of {met.settled} ends {met.captured} have contacts that accumulate")
    engine = subject.engine
    return ModelOrbits(
        **about(subject),
        periods=period,
        orbits=tuple(_found(subject, engine, each) for each in met.orbits),
        plane=pair,
        others=tuple(f"besides, {words}" for words in others),
    )


def _found(subject: Subject, engine: Engine, orbit: Closed) -> FoundOrbit:
    """Return an orbit with its curve, which begins just after its first contact."""
    system, contacts = subject.system, orbit.itinerary.contacts
    n, periods = len(system.state), orbit.itinerary.periods
    table = np.array(orbit.guess).reshape(len(contacts), n + 1)
    omega = 2 * np.pi / subject.period
    phase = omega * table[0, 0]
    values = {**dict(zip(system.state, table[0, 1:], strict=True)), COS: np.cos(phase)}
    values[SIN] = np.sin(phase)
    reset = system.reset(contacts[0].mode, contacts[0].guard)
    state = np.array([
        evaluated(reset[z].numerator, values) / evaluated(reset[z].denominator, values)
        for z in system.state
    ])  # fmt: skip
    modes = np.array([engine.modes.index(contacts[0].to)])
    ends = logged(engine, state[None], modes, periods, phase)
    legs = Legs.of(engine, state[None], modes, ends, periods * subject.period, phase)
    parts = [along(legs, k, legs.end[k], periods * subject.period) for k in range(len(legs.end))]
    start, mode = _at_zero(legs, periods * subject.period - table[0, 0])
    return FoundOrbit(
        state=start,
        mode=engine.modes[mode],
        words=tuple(contact.guard for contact in contacts),
        contacts=table[:, 1:],
        curve=np.concatenate([*(states for _, states in parts), state[None]]),
        multipliers=orbit.multipliers,
        attracts=orbit.attracts,
        told=orbit.shown(),
        proof=command(subject, periods, start, engine.modes[mode]),
    )


def _at_zero(legs: Legs, after: float) -> tuple[Floats, int]:
    """Return state and mode some time after the start."""
    k = int(np.searchsorted(legs.end, after))
    k = min(k, len(legs.end) - 1)
    _, states = along(legs, k, max(after, float(legs.begin[k])), after)
    return states[-1], int(legs.mode[k])
