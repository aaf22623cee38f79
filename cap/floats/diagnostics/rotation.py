"""Rotation numbers on the invariant curves around an elliptic fixed point, and their twist.

An invariant curve that encloses the area π|z|² turns by Θ + τ₁|z|² + τ₂|z|⁴ + … in a period, with
dx∧dv = (i/2) dz∧dz̄; so rotation number and area of curves give the Birkhoff coefficients, in no
coordinates.  Turns from x to v count positive: Θ < 0 has a rotation number above 1/2.  Means along
orbits are weighted by a bump (Das, Saiki, Sander, Yorke): they converge faster than any power of
the number of periods.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.findings import Findings, Floats, State
from cap.floats.search import cycles
from cap.floats.search.fixed_point import elliptic_point
from cap.floats.words import described
from cap.parameters import Parameters
from cap.runner import Runner

HARMONICS = 12  # of a curve, on either side
SHAKY = 1e-7  # difference of the rotation numbers of two halves of an orbit that is on no curve
LEAST = 1e-7  # of R: a distance at which rounding leaves something to be seen
DEGREE = 3  # in |z|², of the polynomial whose slope is the twist

Pair = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Rotation(Findings):
    """Rotation numbers (N,) of orbits at a ``distance`` (N,) along x from the fixed point.

    ``size`` (N,) is |z|², the area within the curve over π.  ``quality`` (N,): by how much the
    rotation numbers of both halves differ.  nan for orbits that turn.  ``twist``: τ₁, τ₂ from the
    polynomial through the curves that have ``used``; ``error``: what their quality leaves open.
    """

    centre: State
    distance: Floats
    size: Floats
    rotation: Floats
    quality: Floats
    used: NDArray[np.bool_]
    limit: float
    twist: tuple[float, float]
    error: tuple[float, float]

    def columns(self) -> dict[str, NDArray[np.generic]]:
        """Return one row for each orbit."""
        return {
            "distance": self.distance,
            "z2": self.size,
            "rotation": self.rotation,
            "quality": self.quality,
            "used": self.used,
        }

    def lines(self) -> list[str]:
        """Return the limit at the fixed point and the twist."""
        on = int((self.quality < SHAKY).sum())
        return [
            f"rotation numbers around ({self.centre[0]:.10g}, {self.centre[1]:.10g}) at "
            + described(self.parameters),
            f"  {on} of {len(self.distance)} orbits are on invariant curves (of islands, too), as "
            "far as one sees",
            f"  at the fixed point: rotation number {self.limit:.12g} (of its multipliers), from x "
            "to v, mod 1",
            f"  twist tau1 = {self.twist[0]:.6g} +- {self.error[0]:.2g}, tau2 = "
            f"{self.twist[1]:.6g} +- {self.error[1]:.2g}, from {int(self.used.sum())} curves",
        ]


def rotation(  # noqa: PLR0913 (the options of the command)
    p: Parameters,
    *,
    orbit: State | None = None,
    radius: float = 0.03,
    near: float = 0.001,
    orbits: int = 200,
    periods: int = 4000,
    runner: Runner | None = None,
) -> Rotation:
    """Follow orbits up to ``radius`` R from an elliptic fixed point, half of them up to ``near`` R.

    Those within ``near`` R give the twist.
    """
    runner = runner or Runner()
    centre = elliptic_point(p, orbit)
    if centre is None:
        raise BadInput("no elliptic fixed point was found: give a state near one with --orbit")
    turn, frame = linear(p, centre)
    if near < LEAST:
        raise BadInput(f"--near must be at least {LEAST:g}: nearer, all is rounding")
    half = max(4, orbits // 2)
    distance = np.concatenate(
        [near * np.sqrt((np.arange(half) + 1) / half),
         near + (radius - near) * (np.arange(max(0, orbits - half)) + 1) / max(1, orbits - half)]
    ) * float(p.R)  # fmt: skip
    distance = distance[centre[0] + distance < float(p.r)]
    found = np.full((len(distance), 3), np.nan)

    def follow(part: slice) -> None:
        starts = np.stack([centre[0] + distance[part], np.full_like(distance[part], centre[1])], -1)
        seen = swarm.follow(p, starts, periods, every=True)
        plane = (seen.states - np.array(centre)) @ np.linalg.inv(frame).T
        orbits = plane[..., 0] + 1j * plane[..., 1]
        orbits[seen.stopped] = np.nan
        found[part] = np.stack(_curves(orbits, turn), axis=-1)

    pieces = [slice(k, min(k + 50, len(distance))) for k in range(0, len(distance), 50)]
    runner.map(follow, pieces, "rotation")
    size, rotation_number, quality = found.T
    used = (quality < SHAKY) & (distance <= near * float(p.R) * (1 + 1e-9))
    twist, error = _twist(turn, size[used], rotation_number[used], quality[used])
    return Rotation(
        parameters=p,
        complete=not runner.interrupted,
        centre=centre,
        distance=distance,
        size=size,
        rotation=rotation_number,
        quality=quality,
        used=used,
        limit=turn,
        twist=twist,
        error=error,
    )


def linear(p: Parameters, centre: State) -> tuple[float, Floats]:
    """Return the rotation number at the fixed point and a frame of area 1 in which Φ' is a turn."""
    m = np.array(cycles.StroboscopicMap(p).path(centre).monodromy)
    cosine = np.trace(m) / 2
    if not abs(cosine) < 1:
        raise BadInput(f"the fixed point is not elliptic: its trace is {2 * cosine:.6g}")
    side = 1 if m[1, 0] > 0 else -1
    angle = side * math.acos(cosine)
    quarter = (m - cosine * np.eye(2)) / math.sin(angle)  # its square is -1
    frame = np.stack([np.array([1.0, 0.0]), quarter[:, 0]], axis=1)
    return (angle / (2 * math.pi)) % 1.0, frame / math.sqrt(np.linalg.det(frame))


def weights(count: int) -> Floats:
    """Return the weights of a mean: a bump that vanishes with all derivatives at both ends."""
    t = (np.arange(count) + 0.5) / count
    bump = np.exp(-1 / (t * (1 - t)))
    return np.asarray(bump / bump.sum())


def _curves(orbits: NDArray[np.complex128], guess: float) -> tuple[Floats, Floats, Floats]:
    """Return |z|², rotation number, and quality of orbits (N, K) around 0, near a guess."""
    # steps are within half a turn of the guess
    steps = orbits[:, 1:] * orbits[:, :-1].conj()
    turns = np.angle(steps * np.exp(-2j * np.pi * guess)) / (2 * np.pi)
    count = turns.shape[1]
    number = guess + turns @ weights(count)
    first, second = (part @ weights(count // 2) for part in
                     (turns[:, : count // 2], turns[:, count - count // 2 :]))  # fmt: skip
    k = np.arange(orbits.shape[1])
    weight, size = weights(len(k)), np.zeros(len(orbits))
    for m in range(-HARMONICS, HARMONICS + 1):  # area of Σ c_m exp(imθ) is π Σ m |c_m|²
        c = (orbits * np.exp(-2j * np.pi * m * number[:, None] * k)) @ weight
        size += m * np.abs(c) ** 2
    return size, number, np.abs(first - second)


def _twist(limit: float, size: Floats, number: Floats, quality: Floats) -> tuple[Pair, Pair]:
    """Return τ₁ and τ₂: slope and half the second derivative of 2π times the rotation number.

    And by how much they move, at most, if each number moves by its quality.
    """
    if len(size) < DEGREE + 2:
        return (math.nan, math.nan), (math.nan, math.nan)
    scale = size.max()
    powers = (size[:, None] / scale) ** np.arange(1, DEGREE + 1)
    shift = 2 * np.pi * (number - limit)
    inverse, units = np.linalg.pinv(powers)[:2], scale ** -np.arange(1.0, 3.0)
    fit, error = units * (inverse @ shift), units * (np.abs(inverse) @ (2 * np.pi * quality))
    return (float(fit[0]), float(fit[1])), (float(error[0]), float(error[1]))
