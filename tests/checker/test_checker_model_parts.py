"""The part of a square in which a model is small: it does not depend on what is added to both."""

from __future__ import annotations

import numpy as np
import pytest

from cap.checker.kernel import polynomials as q


def truth(a, b, v):
    """Return the part of [-1, 1]^2 in which a X + b Y < v."""
    u, w = max(abs(a), abs(b)), min(abs(a), abs(b))
    low = np.clip((v + np.linspace(-1, 1, 20001) * w + u) / (2 * u), 0, 1)
    return float(np.mean(low))


@pytest.mark.parametrize("more", [-3.0, 0.0, 3.0])
@pytest.mark.parametrize(("a", "b"), [(0.3, 0.2), (-0.2, 0.7), (0.5, -0.01), (1.0, 1.0)])
def test_a_constant_is_added(a, b, more):
    """It is what it is for a half plane, and not more."""
    for v in np.linspace(-1.1, 1.1, 23):
        found = q.part_below(q.model(X=a, Y=b, one=more), v + more)
        assert found <= truth(a, b, v) + 1e-4
        assert found == pytest.approx(truth(a, b, v), abs=1e-3)
