"""Computer-assisted proofs for x'' = F cos(ωt) - f sgn(x') between two walls.

    import cap

    proved = cap.prove_theorem("elliptic", f="2/5")
    proved.claims["x"].lower, proved.floats["x"], print(proved)
    cap.verify_certificate("certificates/saddle.json")

Nothing is imported before it is asked for, so that the checker can be loaded alone.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from cap.interface import (
        BadInput,
        Enclosure,
        NotProved,
        Verified,
        prove_theorem,
        verify_certificate,
    )

__version__ = "0.1.0"
__all__ = [
    "BadInput",
    "Enclosure",
    "NotProved",
    "Verified",
    "prove_theorem",
    "verify_certificate",
]


def __getattr__(name: str) -> object:
    """Load the Python interface when something of it is asked for."""
    if name not in __all__:
        raise AttributeError(f"module 'cap' has no attribute {name!r}")
    from importlib import import_module  # noqa: PLC0415

    return getattr(import_module("cap.interface"), name)
