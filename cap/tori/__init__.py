"""Invariant curves: an approximate one, and the theorem that there is a true one beside it."""
