"""The rotation of an elliptic fixed point: its angle, and how far it is from low resonances."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity, Table
from cap.checker.maps.normal_form import EllipticFrame

RESONANCES = {name: Fraction(name) for name in ("0", "1/4", "1/3", "1/2")}

# fmt: off
ROTATION: Table = (
    Field("rotation_angle", Quantity(), "Theta, from x to v", r"\Theta",
          "with its sign, in (-pi, pi)"),
    Field("rotation_number", Quantity(), "rotation number |Theta|/2pi", r"|\Theta|/2\pi",
          "|Theta|/(2 pi), without sign, in (0, 1/2)"),
    Field("resonance_distances", dict.fromkeys(RESONANCES, Quantity()), "distance to", "",
          "|rotation_number - p/q| for all p/q in [0, 1/2] with q <= 4, positive"),
)
# fmt: on


def rotation(frame: EllipticFrame, pi: Interval) -> dict[str, Any]:
    """Return the enclosures of what `ROTATION` claims."""
    number = frame.angle.magnitude() / (pi * 2)
    levels = {name: Interval.enclosing(q, q, pi.bits) for name, q in RESONANCES.items()}
    far = {name: (number - level).magnitude() for name, level in levels.items()}
    return {"rotation_angle": frame.angle, "rotation_number": number, "resonance_distances": far}


def confirm_rotation(claims: Mapping[str, Any]) -> None:
    """Check that no resonance of order at most four is claimed to be possible."""
    distances = claims["resonance_distances"].values()
    need(all(d.lower > 0 for d in distances), "a resonance distance is not positive")


def confirm_twist(claims: Mapping[str, Any]) -> None:
    """Check that the twist claimed excludes 0."""
    twist = claims["twist"]
    need(twist.lower > 0 or twist.upper < 0, "twist does not exclude 0")
