"""Periodic orbits as zeros of equations for their hit times: multiple shooting, explicit.

Units here: time 1/ω, length F/ω², so only α = f/F and ρ = R ω²/F matter, and the period is 2π.
A row ``times`` of an array of shape (M, N) holds the hits t_0 < ... < t_{N-1} < t_0 + 2π of one
candidate, of the right and the left wall in turn, the first a hit of the right wall.  Flight k goes
from t_k to t_{k+1} with sign s_k = -1, 1, -1, ...  In lifted form its speed u = s v obeys
u' = s cos t - α, and it covers exactly ρ, so with d = t_{k+1} - t_k

    u just after t_k      =  (ρ + s (cos t_{k+1} - cos t_k)) / d + s sin t_k + α d/2,
    u just before t_{k+1} =  (ρ + s (cos t_{k+1} - cos t_k)) / d + s sin t_{k+1} - α d/2.

The orbit is periodic when u is continuous at all N hits.  The sum of the N jumps is free of ρ:

    2 Σ s_k sin t_k + 2 π α = 0                                       (the impulse balance);

it takes the place of the jump at t_0, whose rounding would hide it when ρ is large.
Unlike (x, v) -> Φ(x, v) - (x, v), these equations stay well conditioned for strong saddles.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cap.flow.flight import place, velocity

Array = NDArray[np.float64]

PERIOD = 2 * math.pi
MOST_STEPS = 50  # of Newton's method; from a good seed it needs about 10
LAST_STEP = 1e-10  # Newton's method is quadratic: after such a step the error is rounding


class Ratios(NamedTuple):
    """The two numbers that matter, α = f/F and ρ = R ω²/F."""

    alpha: float
    rho: float


class Flights(NamedTuple):
    """Sign (shape (N,)), duration, speed after the first and before the second hit ((M, N))."""

    sign: Array
    duration: Array
    start: Array
    end: Array


def flights(times: Array, ratios: Ratios) -> Flights:
    """Return the N flights of each candidate."""
    s = np.where(np.arange(times.shape[1]) % 2, 1.0, -1.0)
    after = np.roll(times, -1, axis=1)
    after[:, -1] += PERIOD
    d = after - times
    ends = s * np.cos(times), s * np.cos(after)
    V = (ratios.rho - place(ends[0], 0.0, d, ratios.alpha / 2, ends[1])) / d
    start, end = V + s * np.sin(times), velocity(V, d, ratios.alpha, s * np.sin(after))
    return Flights(s, d, start, end)


def equations(times: Array, ratios: Ratios) -> tuple[Array, Array]:
    """Return the impulse balance and the jumps at t_1, t_2, ..., with their Jacobians.

    Shapes (M, N) and (M, N, N).  The jump at t_k depends on t_{k-1}, t_k, t_{k+1} only; for N = 2
    both neighbours are the same hit, hence the sums.
    """
    s, d, start, end = flights(times, ratios)
    value = np.roll(end, 1, axis=1) - start
    k = np.arange(times.shape[1])
    jacobian = np.zeros((*times.shape, len(k)))
    jacobian[:, k, k] = -np.roll(end / d, 1, axis=1) - start / d - 2 * s * np.cos(times)
    jacobian[:, k, k - 1] += np.roll(start / d, 1, axis=1)
    jacobian[:, k, (k + 1) % len(k)] += end / d
    gains = velocity(-s * np.sin(times), d, ratios.alpha, s * np.sin(times + d))
    value[:, 0] = gains.sum(axis=1)
    jacobian[:, 0, :] = -2 * s * np.cos(times)
    return value, jacobian


def newton(times: Array, ratios: Ratios) -> Array:
    """Return the rows to which damped Newton's method converges, from each row of ``times``."""
    found = []
    with np.errstate(all="ignore"):  # rows that run away become nan or 0, and are dropped
        for _ in range(MOST_STEPS):
            step = _newton_step(times, ratios)
            times = times + step
            last = np.abs(step).max(axis=1) < LAST_STEP
            ordered = flights(times, ratios).duration.min(axis=1) > 0
            found.append(times[last & ordered])
            times = times[~last & ordered]
            if not len(times):
                break
    return np.concatenate(found)


def _newton_step(times: Array, ratios: Ratios) -> Array:
    """Return Newton's steps, shortened so that no time between hits more than halves."""
    value, jacobian = equations(times, ratios)
    try:
        step = -np.linalg.solve(jacobian, value[..., None])[..., 0]
    except np.linalg.LinAlgError:  # one exactly singular matrix spoils the batch: least squares
        finite = np.nan_to_num(jacobian, posinf=0.0, neginf=0.0)
        step = -(np.linalg.pinv(finite) @ value[..., None])[..., 0]
    shrinking = (step - np.roll(step, -1, axis=1)) / flights(times, ratios).duration
    return np.asarray(step / np.maximum(1.0, 2 * shrinking.max(axis=1))[:, None])


def is_isolated(times: Array, ratios: Ratios) -> NDArray[np.bool_]:
    """Return a mask of the rows at which the equations determine the hit times to 1e-8 or so.

    For f = 0 and fast orbits of many hits they may not: every phase is a zero up to rounding.
    """
    _, jacobian = equations(times, ratios)
    rows = np.maximum(np.linalg.norm(jacobian, axis=2, keepdims=True), 1e-300)  # never 0/0
    least = np.linalg.svd(jacobian / rows, compute_uv=False)[:, -1]
    return np.asarray(least > 1e-7)


def seeds(hits: int, count: int = 1000) -> Array:
    """Return ``count`` rows that fill the candidates with ``hits`` hits evenly, always the same.

    A Kronecker sequence (powers of the root of z^(hits+1) = z + 1, Roberts 2018) in the unit cube:
    one coordinate for the first hit, the others cut the period.  A fifth of each gap is fixed, so
    that no two hits start together.
    """
    z = 1.0
    for _ in range(60):  # a contraction by less than 1/2
        z = (1 + z) ** (1 / (hits + 1))
    cube = (0.5 + np.outer(np.arange(1, count + 1), z ** -np.arange(1.0, hits + 1))) % 1
    cuts = np.sort(cube[:, 1:], axis=1)
    offsets = np.zeros((count, hits))
    offsets[:, 1:] = 0.8 * cuts + 0.2 * np.arange(1, hits) / hits
    return np.asarray(PERIOD * (cube[:, :1] + offsets))


def mirror(times: Array) -> Array:
    """Return the orbits l + r - x(t + π): right and left hits change places, half a period apart.

    They are orbits too, because cos(t + π) = -cos t.
    """
    image = np.roll(times, -1, axis=1) + PERIOD / 2
    image[:, -1] += PERIOD
    return image


def slowest(times: Array, ratios: Ratios) -> tuple[Array, Array]:
    """Return for each flight the time of its least speed, and that speed, both of shape (M, N).

    Within the flight u' = s cos t - α = 0 < u'' only where t = -arccos α (s > 0) or π - arccos α
    (s < 0), mod 2π; the other candidates are the two ends.
    """
    s, d, start, _ = flights(times, ratios)
    bottom = np.where(s > 0, 0.0, math.pi) - math.acos(ratios.alpha)
    wait = (bottom - times) % PERIOD
    after = np.stack([np.zeros_like(d), d, np.where(wait < d, wait, d)])
    speed = velocity(start - s * np.sin(times), after, ratios.alpha, s * np.sin(times + after))
    least = speed.argmin(axis=0)[None]
    time = times + np.take_along_axis(after, least, axis=0)[0]
    return time, np.take_along_axis(speed, least, axis=0)[0]


def states(times: Array, ratios: Ratios) -> Array:
    """Return the states at t = 0, shape (M, 2): the distance from the left wall, and the velocity.

    They lie on the flight that starts with the last hit of [0, 2π), at 2π - rest, say.
    """
    s, _, start, _ = flights(times, ratios)
    phases = times % PERIOD
    row, last = np.arange(len(times)), phases.argmax(axis=1)
    sign, speed, hit = s[last], start[row, last], phases[row, last]
    rest = PERIOD - hit
    V = speed - sign * np.sin(hit)
    covered = place(sign * np.cos(hit), V, rest, ratios.alpha / 2, sign)
    v = sign * velocity(V, rest, ratios.alpha, 0.0)
    return np.stack([np.where(sign > 0, covered, ratios.rho - covered), v], axis=1)
