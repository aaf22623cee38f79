"""What attracts, in the theorem `mixed`: a file for each kind that a certificate may claim.

Most certificates claim few of them.  Their files are looked up by the names of the claims, and only
those of what is claimed are loaded, with all that they need.
"""

from __future__ import annotations

from cap.checker.attracting.part import Part
from cap.checker.kernel.later import loaded

NAMES = ("attractor", "segment", "cycles", "sinks")


def load(name: str) -> type[Part]:
    """Return the kind of what attracts that has one of these names."""
    part: type[Part] = loaded(f"{__name__}.{NAMES[NAMES.index(name)]}")
    return part
