"""Periodic orbits of any system by their contacts: search, proof, multipliers (`periodic`)."""
