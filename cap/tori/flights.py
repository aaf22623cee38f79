"""The flights of half a period with one hit, for any scalar; see `cap.tori.half_period`.

Units F = ω = 1: on a flight to the right x'' = cos t - α, on that back x'' = cos t + α.
"""

from typing import Any


def speed(alpha: Any, v: Any, t: Any, sin: Any) -> Any:
    """Return the velocity at the time t, of the flight to the right that has v at the time 0."""
    return v + sin - alpha * t


def beyond(alpha: Any, a: Any, start: tuple[Any, Any], t: Any, cos: Any) -> Any:
    """Return x(t) - a, of the flight to the right from (x, v) at the time 0."""
    x, v = start
    return x + v * t + 1 - cos - alpha / 2 * (t * t) - a


def landing(alpha: Any, a: Any, u: Any, clock: tuple[Any, Any], d: Any) -> Any:
    """Return -x(t + d) where t + d = π, of the flight from the hit of a with the speed u at t.

    ``clock`` is (sin t, cos t).
    """
    sin, cos = clock
    return (u + sin) * d - 1 - cos - alpha / 2 * (d * d) - a
