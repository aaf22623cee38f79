"""Which states of a rectangle turn, stick or are captured, and when they first do."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.floats.diagnostics.grid import Box, grid, require_followed
from cap.floats.diagnostics.stops import KINDS, stops
from cap.floats.engine import swarm
from cap.floats.engine.pieces import in_pieces
from cap.floats.findings import Findings, Floats, State
from cap.floats.search.fixed_point import region
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

FATES = ("never turns", "turns", "sticks", "is captured")
REACH = 0.05, 0.035
LOST = -1


@dataclass(frozen=True, kw_only=True)
class Fate(Findings):
    """The fates of the states (x_j, v_i) at t = 0 within some periods.

    ``fate`` (M, N) is a place in `FATES`, the last that applies; -1: lost, or not computed.
    ``turn``, ``stick``, ``capture`` (M, N): the times t of the first, nan for never.
    """

    periods: int
    x: Floats
    v: Floats
    fate: NDArray[np.int8]
    turn: Floats
    stick: Floats
    capture: Floats
    centre: State | None

    @property
    def first(self) -> Floats:
        """The time (M, N) at which an orbit first turned, stuck or was captured; nan for never."""
        return np.asarray(np.fmin(np.fmin(self.turn, self.stick), self.capture))

    @property
    def dissipates(self) -> NDArray[np.bool_]:
        """Which orbits, (M, N), turned, stuck or were captured."""
        return self.fate > 0

    @property
    def counts(self) -> dict[str, int]:
        """How many states have which fate."""
        return {name: int((self.fate == k).sum()) for k, name in enumerate(FATES)}

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return the states, fates and times."""
        return {
            "x": self.x[None, :],
            "v": self.v[:, None],
            "fate": self.fate,
            "first_turn": self.turn,
            "first_stick": self.stick,
            "first_capture": self.capture,
        }

    def lines(self) -> list[str]:
        """Return the counts."""
        total = self.fate.size
        head = f"fates of {total} states in {self.periods} periods at {described(self.parameters)}"
        rows = [f"  {name:<12} {k:>9}  {k / total:7.2%}" for name, k in self.counts.items()]
        lost = int((self.fate == LOST).sum())
        return [head, *rows, *([f"  lost or not done {lost}"] if lost else [])]


def fate(  # noqa: PLR0913 (the options of the command, and one more)
    p: Parameters,
    *,
    orbit: State | None = None,
    box: Box | None = None,
    points: int = 300,
    periods: int = 25,
    runner: Runner | None = None,
    briefly: bool = False,
) -> Fate:
    """Follow the states of a box, or around the fixed point near ``orbit``, or of all the plane.

    ``briefly``: each until it first stops; the kind of that is then its fate.
    """
    runner = runner or Runner()
    box, centre = region(p, orbit, box, REACH)
    cells = grid(p, box, points)
    require_followed(p, cells.sample())
    fates = np.full(cells.count, LOST, dtype=np.int8)
    times = np.full((3, cells.count), np.nan)

    def first_stop(part: slice) -> None:
        found = stops(p, cells.states(part), periods)
        kinds = np.nan_to_num(found.first, nan=np.inf).argmin(axis=0) + 1
        fates[part] = np.where(found.lost, LOST, np.where(found.never, 0, kinds))
        times[:, part] = found.first

    def follow(part: slice) -> None:
        found = swarm.follow(p, cells.states(part), periods)
        happened = found.turned, found.stuck, found.captured
        fates[part] = np.max([k * each for k, each in enumerate(happened, 1)], axis=0)
        fates[part][found.lost] = LOST
        for k, kind in enumerate(KINDS):
            times[k, part] = found.first_time(kind)

    in_pieces(runner, cells.count, first_stop if briefly else follow, "basin", periods)
    turn, stick, capture = times.reshape(3, *cells.shape)
    return Fate(
        parameters=p,
        complete=not runner.interrupted,
        periods=periods,
        x=cells.x,
        v=cells.v,
        fate=fates.reshape(cells.shape),
        turn=turn,
        stick=stick,
        capture=capture,
        centre=centre,
    )
