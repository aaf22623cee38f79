"""Moser's twist theorem, with its reference: of invariant curves near an elliptic fixed point."""

from __future__ import annotations

MOSER = (
    "Moser twist theorem",
    "Siegel and Moser, Lectures on Celestial Mechanics, 1971, Chapter III; "
    "Theorem kam of the paper",
)
