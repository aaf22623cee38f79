"""Boxes of states by the million, followed in outward-rounded doubles; no theorem uses them yet."""
