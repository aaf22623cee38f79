"""A norm in which a matrix contracts, in doubles: a hint."""

from typing import Any

import numpy as np

from cap.errors import NotProved

ENOUGH, MOST = 1e-6, 10_000  # of the largest term; terms


def metric(D: Any, factor: float, step: str) -> Any:
    """Return W, upper triangular, with WᵀW = Σ (Dᵀ/c)ᵏ (D/c)ᵏ: so |W D z| <= c |W z|.

    c, the ``factor``, is above the spectral radius of D.  Raises `NotProved` with the ``step`` if
    the ellipses |W z| = 1 are too thin for doubles.
    """
    scaled = D / factor
    total, power = np.eye(len(D)), np.eye(len(D))
    for _ in range(MOST):
        power = scaled @ power
        term = power.T @ power
        total = total + term
        if np.abs(term).max() < ENOUGH * np.abs(total).max():
            break
    try:
        return np.linalg.cholesky(total).T
    except np.linalg.LinAlgError:
        raise NotProved(step, "its axes are too different for floats") from None
