"""The theorem on stable and unstable manifolds, with its reference: of a hyperbolic fixed point."""

from __future__ import annotations

HADAMARD_PERRON = (
    "Hadamard-Perron",
    "Katok and Hasselblatt, Introduction to the Modern Theory of Dynamical Systems, 1995, "
    "Theorem 6.2.8",
)
