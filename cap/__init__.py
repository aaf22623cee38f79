"""Computer-assisted proofs for x'' = F cos(ωt) - f sgn(x') between two walls.

    import cap

    proved = cap.prove_theorem("elliptic", f="2/5")
    proved.claims["x"].lower, proved.floats["x"], print(proved)
    cap.verify_certificate("certificates/saddle.json")

A system of one's own is a `cap.System` of `cap.Mode` with `cap.Guard` and `cap.Bounce`, written
with `cap.variables` (docs/own-system.md); `cap.prove_orbit` proves a periodic orbit of it.

Nothing is imported before it is asked for, so that the checker can be loaded alone.
"""

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cap import figures
    from cap.interface import (
        BadInput,
        Enclosure,
        NotProved,
        Verified,
        prove_theorem,
        verify_certificate,
    )
    from cap.own import prove_orbit
    from cap.system.model import Bounce, Guard, Mode, System
    from cap.system.planar import Map
    from cap.system.polynomial import variables

__version__ = "0.2.0.dev0"
__all__ = [
    "BadInput",
    "Bounce",
    "Enclosure",
    "Guard",
    "Map",
    "Mode",
    "NotProved",
    "System",
    "Verified",
    "figures",
    "prove_orbit",
    "prove_theorem",
    "variables",
    "verify_certificate",
]
if not os.path.isdir(os.path.join(__path__[0], "proofs")):  # noqa: PTH112, PTH118 (pathlib is slow)
    __path__.append(os.path.dirname(__path__[0]))  # noqa: PTH120 (a checkout without links)
_MODULES = ("figures",)
_ELSEWHERE = {
    **dict.fromkeys(("Bounce", "Guard", "Mode", "System"), "cap.system.model"),
    "Map": "cap.system.planar",
    "prove_orbit": "cap.own",
    "variables": "cap.system.polynomial",
}


def __dir__() -> list[str]:
    """Return the names that there are to use."""
    return sorted([*__all__, "__version__", "__doc__"])


def __getattr__(name: str) -> object:
    """Load what is asked for, and no more: a name of the Python interface, or of the model."""
    if name not in __all__:
        raise AttributeError(f"module 'cap' has no attribute {name!r}")
    from importlib import import_module  # noqa: PLC0415

    if name in _MODULES:
        return import_module(f"cap.{name}")
    return getattr(import_module(_ELSEWHERE.get(name, "cap.interface")), name)
