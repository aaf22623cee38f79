"""Compiled: one flight in doubles, and the roots on it.

Units of 1/ω for time and F/ω² for length, so that v' = cos θ - α sgn v - m v with θ = ωt + phase.
A flight of sign s has the speed u = s v.

These functions, and those of `cap.floats.engine.events`, are compiled into `events.follow`.
"""

import math
from typing import NamedTuple

from numba import njit

FULL_TURN = 2 * math.pi
NONE = -1  # no event
SHORT = 0.35  # phase: below, the series of `_small` are exact to rounding
CHATTER = 1e-9 * FULL_TURN  # a mass captured within this time is taken to be at rest after it

Four = tuple[float, float, float, float]


class Constants(NamedTuple):
    """The constants: α = f/F, m = μ/ω, e, R ω²/F; θ at time 0; slow and fast times in [0, 2π)."""

    alpha: float
    m: float
    e: float
    width: float
    phase: float
    slow_right: float
    slow_left: float
    fast_right: float
    fast_left: float


class Motion(NamedTuple):
    """Where the mass is: time in [0, 2π], sign of v (0: at rest), speed, sin θ, cos θ.

    The position is the distance ``depth`` >= 0 from the nearer ``wall`` (1 is r, -1 is l): small
    bounces keep their relative precision.  ``word`` is the event that has just happened, a place in
    `cap.flow.words.WORDS` or `NONE`; ``grazing``, whether rounding may have chosen it.
    """

    time: float
    sign: float
    speed: float
    wall: float
    depth: float
    sin: float
    cos: float
    word: int
    grazing: bool


@njit(error_model="numpy", forceinline=True)
def _small(d: float) -> tuple[float, float, float]:
    """Return sin d, 1 - cos d and d - sin d for 0 <= d <= `SHORT`, by their series."""
    q = d * d
    third = d * q * (1 / 6 - q * (1 / 120 - q * (1 / 5040 - q * (1 / 362880 - q / 39916800))))
    tail = q * (1 / 40320 - q * (1 / 3628800 - q / 479001600))
    return d - third, q * (1 / 2 - q * (1 / 24 - q * (1 / 720 - tail))), third


@njit(error_model="numpy", forceinline=True)
def decay(m: float, d: float) -> tuple[float, float, float]:
    """Return D = exp(-m d), h = (1 - D)/m and k = (d - h)/m; 1, d and d²/2 at m = 0."""
    if m == 0:
        return 1.0, d, d * d / 2
    x = m * d
    h = -math.expm1(-x) / m
    if x > 0.1:
        return math.exp(-x), h, (d - h) / m
    tail = 1 / 5040 - x * (1 / 40320 - x * (1 / 362880 - x * (1 / 3628800 - x / 39916800)))
    series = 1 / 24 - x * (1 / 120 - x * (1 / 720 - x * tail))
    return math.exp(-x), h, d * d * (1 / 2 - x * (1 / 6 - x * series))


@njit(error_model="numpy", forceinline=True)
def flown(y: Constants, n: Motion, d: float, sin: float, cos: float) -> Four:
    """Return speed and distance flown after the time d, and sin θ, cos θ (given for d > SHORT).

    Written in differences, so that nothing cancels when d is small: with s cos(θ + d) expanded,
    u = u0 D - α h + c A - s B and distance = u0 h - α k + c B - s G.
    """
    if d > SHORT:
        sd, cd = sin * n.cos - cos * n.sin, cos * n.cos + sin * n.sin
        versine, third = 1 - cd, d - sd
    else:
        sd, versine, third = _small(d)
        sin, cos = n.sin + (n.cos * sd - n.sin * versine), n.cos - (n.sin * sd + n.cos * versine)
    c, s = n.sign * n.cos, n.sign * n.sin
    if y.m == 0:
        u = n.speed + (c * sd - s * versine - y.alpha * d)
        return u, n.speed * d + (c * versine - s * third - y.alpha * (d * d / 2)), sin, cos
    D, h, k = decay(y.m, d)
    q = 1 / (1 + y.m * y.m)
    A = q * (sd - y.m * versine + y.m * (y.m * h))
    B = q * (versine - y.m * third + y.m * (y.m * k))
    G = q * (third + y.m * (versine - k))
    u = n.speed * D + (c * A - s * B - y.alpha * h)
    return u, n.speed * h + (c * B - s * G - y.alpha * k), sin, cos


@njit(error_model="numpy", forceinline=True)
def fly(y: Constants, n: Motion, d: float) -> Four:
    """Return speed, distance, sin θ and cos θ after the time d."""
    if d > SHORT:
        theta = y.phase + (n.time + d)
        return flown(y, n, d, math.sin(theta), math.cos(theta))
    return flown(y, n, d, 0.0, 0.0)


@njit(error_model="numpy", forceinline=True)
def step_to(y: Constants, n: Motion, gap: float, at: Four) -> float:
    """Return the step to where u = 0, if gap < 0, or distance = gap, by the parabola there; or nan.

    ``at`` is (u, distance, sin, cos).  At the first u falls, at the second the distance rises.
    """
    u, distance, sin, cos = at
    force = n.sign * cos - y.alpha - y.m * u
    if gap < 0:
        jerk = -n.sign * sin - y.m * force
        return -2 * u / (force - math.sqrt(force * force - 2 * u * jerk))
    short = gap - distance
    return 2 * short / (u + math.sqrt(u * u + 2 * short * force))


@njit(error_model="numpy")
def event(
    y: Constants, n: Motion, gap: float, guess: float, low: float, high: float
) -> tuple[float, float, float, float, float]:
    """Return (d, u, distance, sin, cos) where u = 0, if gap < 0, or where distance = gap.

    Assumes one such d in [low, high].  Steps to the zero of the local parabola: the error is cubed.
    A step out of the bracket becomes a bisection.
    """
    hit, d = gap >= 0, guess
    if not low <= d <= high:
        d = low + (high - low) / 2
    for _ in range(100):
        u, distance, sin, cos = fly(y, n, d)
        force = n.sign * cos - y.alpha - y.m * u
        jerk = -n.sign * sin - y.m * force
        if (distance >= gap) if hit else (u <= 0):
            high = d
        else:
            low = d
        step = step_to(y, n, gap, (u, distance, sin, cos))
        # the parabola misses |step|^3 / 6 over the slope, at most: a relative error of 2e-16
        slope = u + force * step if hit else abs(force)
        last = abs(step) ** 3 <= 1e-15 * d * slope or abs(step) <= 1e-16 * d
        if not low <= d + step <= high:
            step = low + (high - low) / 2 - d
            last = abs(step) <= 2e-16 * d
        d += step
        if last:
            break
    turned = step - step**3 / 6, step * step / 2
    distance += step * (u + step * (force / 2 + step * jerk / 6))
    u += step * (force + step * jerk / 2)
    sin, cos = sin + cos * turned[0] - sin * turned[1], cos - sin * turned[0] - cos * turned[1]
    return d, u, distance, sin, cos


@njit(error_model="numpy", forceinline=True)
def knots(y: Constants, sign: float, time: float) -> tuple[float, float]:
    """Return the next slow and the next fast time; p rises now if the fast one is earlier."""
    slow, fast = (y.slow_right, y.fast_right) if sign > 0 else (y.slow_left, y.fast_left)
    return slow + (FULL_TURN if slow <= time else 0.0), fast + (FULL_TURN if fast <= time else 0.0)


@njit(error_model="numpy", forceinline=True)
def pushes(y: Constants, sign: float, time: float) -> bool:
    """Return whether the forcing exceeds friction in the direction of the sign: s cos θ > α.

    Decided by the known times, which count from the slow one on: a mass at rest, |cos θ| = α, moves
    if the forcing grows and stays if it falls.
    """
    slow, fast = knots(y, sign, time)
    return fast < slow


@njit(error_model="numpy", forceinline=True)
def moved(y: Constants, n: Motion, d: float, after: Four) -> Motion:
    """Return the motion after the time d, where `flown` gives ``after``."""
    u, distance, sin, cos = after
    wall, depth = n.wall, max(0.0, n.depth - n.sign * n.wall * distance)
    if depth > y.width / 2:
        wall, depth = -wall, max(0.0, y.width - depth)
    return Motion(n.time + d, n.sign, max(0.0, u), wall, depth, sin, cos, NONE, n.grazing)


@njit(error_model="numpy", forceinline=True)
def chatter(y: Constants, u: float, force: float) -> float:
    """Return the time in which bounces accumulate after one of speed u, or inf if not certain.

    ``force`` is that towards the wall.  Certain is the lemma in certificates/FORMAT.md with forces
    within twice the time: |d force| <= |dθ|.  The capture itself is then no approximation; its
    time has a relative error of the order of `CHATTER`, and the mass is at the wall up to an error
    of the order of CHATTER² meanwhile.
    """
    if u == 0:
        return 0.0
    if u > 2 * CHATTER or force <= y.alpha:  # the time exceeds u/(force + α) >= u/2
        return math.inf
    up, down = force + y.alpha, force - y.alpha
    time = u * (1 / up + 1 / math.sqrt(up * down)) / (1 - y.e * math.sqrt(down / up))
    window = 2 * time
    up, down, most = up - window, down - window - y.m * u, down + window
    if not (0 <= time <= CHATTER and down > 0 and y.e * y.e * most < up and u * u < up * y.width):
        return math.inf
    bound = u * (1 / up + 1 / math.sqrt(up * down)) / (1 - y.e * math.sqrt(most / up))
    return time if bound <= window else math.inf
