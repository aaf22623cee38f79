"""Invariant curves: continued fractions, half periods of functions and of boxes, the theorem."""
