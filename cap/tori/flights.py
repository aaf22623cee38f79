"""The flights of half a period with one hit, for any scalar; see `cap.tori.half_period`.

Units F = ω = 1: on a flight to the right x'' = cos t - α, on that back x'' = cos t + α.
"""

from typing import Any

from cap.flow.flight import place, velocity


def speed(alpha: Any, v: Any, t: Any, sin: Any) -> Any:
    """Return the velocity at the time t, of the flight to the right that has v at the time 0."""
    return velocity(v, t, alpha, sin)


def beyond(alpha: Any, a: Any, start: tuple[Any, Any], t: Any, cos: Any) -> Any:
    """Return x(t) - a, of the flight to the right from (x, v) at the time 0."""
    x, v = start
    return place(x + 1, v, t, alpha / 2, cos) - a


def landing(alpha: Any, a: Any, u: Any, clock: tuple[Any, Any], d: Any) -> Any:
    """Return -x(t + d) where t + d = π, of the flight from the hit of a with the speed u at t.

    ``clock`` is (sin t, cos t).
    """
    sin, cos = clock
    return place(-cos - a, u + sin, d, alpha / 2, 1)
