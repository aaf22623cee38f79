"""Theorems on the motions near a fixed point, with their references, that proofs cite."""

from __future__ import annotations

MOSER = (
    "Moser twist theorem",
    "Siegel and Moser, Lectures on Celestial Mechanics, 1971, Chapter III; "
    "Theorem kam of the paper",
)
HADAMARD_PERRON = (
    "Hadamard-Perron",
    "Katok and Hasselblatt, Introduction to the Modern Theory of Dynamical Systems, 1995, "
    "Theorem 6.2.8",
)
