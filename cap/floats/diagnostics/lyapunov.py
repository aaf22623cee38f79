"""Lyapunov exponents by Benettin's method, with the way in which they converge."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from cap.floats.diagnostics.grid import PROBES, require_followed
from cap.floats.engine import swarm
from cap.floats.engine.pieces import PIECE
from cap.floats.findings import Findings, Floats, State
from cap.floats.search.fixed_point import elliptic_point
from cap.floats.words import described, with_error
from cap.parameters import Parameters
from cap.runner import Runner

STRETCH = 200  # periods at a time


@dataclass(frozen=True, kw_only=True)
class Lyapunov(Findings):
    """Exponents (N, K, 2) per time of N orbits, after ``after`` (K,) periods.

    The larger first.  The second is -inf after a stick or a capture, which take areas to 0.
    ``turned`` (N,) says which orbits turned, stuck or were captured.
    """

    starts: Floats
    after: Floats
    exponents: Floats
    turned: NDArray[np.bool_]
    period: float

    def columns(self) -> dict[str, object]:  # type: ignore[override]
        """Return one row for each orbit and time."""
        return {
            "x": self.starts[:, None, 0],
            "v": self.starts[:, None, 1],
            "periods": self.after[None, :],
            "lambda1": self.exponents[..., 0],
            "lambda2": self.exponents[..., 1],
        }

    def lines(self) -> list[str]:
        """Return the last exponents, and by how much they changed in the last half."""
        head = (
            f"Lyapunov exponents per time at {described(self.parameters)}, "
            "+- their change since half of the periods"
        )
        rows = []
        for start, values, turned in zip(self.starts, self.exponents, self.turned, strict=True):
            known = np.flatnonzero(~np.isnan(values[:, 0]))
            shown, after = _last(values[known], self.after[known])
            rows.append(
                f"  from ({start[0]:.8g}, {start[1]:.8g}): {shown} after {after:.0f} periods"
                + (" (turns or sticks)" if turned else "")
            )
        return [head, *rows]


def _last(values: Floats, after: Floats) -> tuple[str, float]:
    """Return the last of exponents (K, 2) with their errors, and after how many periods."""
    if not len(after):
        return "nan, nan", 0.0
    half = values[np.searchsorted(after, after[-1] / 2)]
    with np.errstate(invalid="ignore"):  # inf - inf
        errors = np.abs(values[-1] - half)
    pairs = zip(values[-1].tolist(), errors.tolist(), strict=True)
    return ", ".join(with_error(*pair) for pair in pairs), float(after[-1])


def lyapunov(
    p: Parameters,
    *,
    orbit: State | None = None,
    orbits: int = 5,
    radius: float = 0.04,
    periods: int = 5000,
    runner: Runner | None = None,
) -> Lyapunov:
    """Return the exponents of ``orbit``; without one, of orbits on a ray from the elliptic point.

    The ray is ``radius`` R long.  Where no elliptic point is found, all over the plane.
    """
    runner = runner or Runner()
    starts = np.array([orbit]) if orbit is not None else _ray(p, orbits, radius)
    require_followed(p, starts[:: -(-len(starts) // PROBES)])
    return exponents(p, starts, periods, runner)


def exponents(
    p: Parameters, starts: Floats, periods: int, runner: Runner | None = None
) -> Lyapunov:
    """Return the exponents of the orbits of ``starts`` (N, 2)."""
    runner = runner or Runner()
    T = 2 * math.pi / float(p.omega)
    after = np.unique(np.geomspace(1, periods, min(periods, 400)).astype(int))
    sums = np.full((len(starts), len(after), 2), np.nan)
    total, turned = np.zeros((len(starts), 2)), np.zeros(len(starts), dtype=np.bool_)
    cuts = [slice(k, min(k + PIECE, len(starts))) for k in range(0, len(starts), PIECE)]
    states, frame = starts.astype(float), np.tile([0.6, 0.8], (len(starts), 1))

    def follow(begin: int) -> None:
        end = min(begin + STRETCH, periods)
        shown = np.flatnonzero((after > begin) & (after <= end))
        for part in cuts:
            found = swarm.follow(p, states[part], end - begin, every=True, derivative=True)
            growth, frame[part] = _growth(found.derivatives, frame[part])
            with np.errstate(invalid="ignore"):  # inf - inf, after a hit with speed 0
                own = total[part, None] + np.cumsum(growth, axis=1)
            sums[part, shown], total[part] = own[:, after[shown] - begin - 1], own[:, -1]
            states[part] = found.states[:, -1]
            turned[part] |= found.stopped

    sequence = replace(runner, jobs=1)  # one stretch after the other
    sequence.map(follow, range(0, periods, STRETCH), "lyapunov")
    return Lyapunov(
        parameters=p,
        complete=not sequence.interrupted,
        starts=starts,
        after=after.astype(float),
        exponents=np.sort(sums / (after[:, None] * T), axis=-1)[..., ::-1],
        turned=turned,
        period=T,
    )


def _growth(monodromy: Floats, frame: Floats) -> tuple[Floats, Floats]:
    """Return the logarithms (N, K, 2) of the stretch of a vector and of what is left of the area.

    The area is exact: the logarithm of |det|.  Also returns the last vectors (N, 2).
    """
    units, first = swarm.stretch(monodromy, frame[:, None, :])
    with np.errstate(divide="ignore", invalid="ignore"):
        area = np.log(np.abs(np.linalg.det(monodromy)))
        second = np.where(np.isneginf(area), -np.inf, area - first[..., 0])
    return np.stack([first[..., 0], second], axis=-1), units[:, -1, 0]


def _ray(p: Parameters, orbits: int, radius: float) -> Floats:
    centre = elliptic_point(p)
    part = (np.arange(orbits) + 0.5) / orbits
    if centre is None:
        x = float(p.l) + float(p.R) * part
        return np.stack([x, np.full(orbits, float(p.F / p.omega))], axis=-1)
    x = np.minimum(centre[0] + radius * float(p.R) * part, float(p.r))
    return np.stack([x, np.full(orbits, centre[1])], axis=-1)
