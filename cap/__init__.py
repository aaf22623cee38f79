"""Computer-assisted proofs for x'' = F cos(ωt) - f sgn(x') between two walls.

This package imports nothing here, so that the checker can be loaded alone.
"""

__version__ = "0.1.0"
