"""States in basins, compiled: as the checker says, and as their extreme states do."""

import numpy as np

from cap.areas.folded.basins import compiled_basins, fate_of, fate_of_lines
from cap.checker.attracting.segment import Strip
from cap.checker.attracting.sinks import Ellipse
from cap.checker.folded.basins import Basins, Row, bounds_of
from cap.checker.folded.table import ATTRACTOR, NONE, SEGMENT
from cap.checker.kernel import line
from cap.checker.kernel import polynomials as q


def drawn(rng):
    """Return a strip and an ellipse around (-1, 1), and states next to these borders."""
    low, high = -rng.uniform(0.05, 0.3, 3), rng.uniform(0.05, 0.3, 3)
    k = rng.uniform(0, 2)
    forms = (1.0, 0.0), (0.0, 1.0), (1.0, k)
    rows = (
        Row(a, b, b - a + below, b - a + above)
        for (a, b), below, above in zip(forms, low.tolist(), high.tolist(), strict=True)
    )
    W = rng.normal(size=(2, 2)) * 5
    round_ = (Row(a, b, b - a - 1, b - a + 1) for a, b in W.tolist())
    states = np.array([-1.0, 1.0]) + rng.normal(size=2) * 0.1, rng.normal(size=(2, 2)) * 0.05
    return Strip(tuple(rows)), Ellipse(tuple(round_)), states


def test_states_in_basins():
    """What is in, by the checker, has all its corners there; what is compiled says hardly less."""
    rng, agreed = np.random.default_rng(9), {NONE: 0, SEGMENT: 0, ATTRACTOR: 0}
    for _ in range(1500):
        strip, ellipse, (middle, sides) = drawn(rng)
        corners = [middle + sides @ np.array([x, y]) for x in (-1, 1) for y in (-1, 1)]
        p, s = (
            q.model(one=a, X=b, Y=c)
            for a, (b, c) in zip(middle.tolist(), sides.tolist(), strict=True)
        )
        for basins, fate, k in (
            (Basins((strip,)), SEGMENT, 0),
            (Basins(ellipses=(ellipse,)), ATTRACTOR, 2),
            (Basins(odd=(ellipse,)), ATTRACTOR, 3),
        ):
            found, known = basins.fate(k, bounds_of(q, p, s)), compiled_basins(basins)
            assert not basins.fate(k + 1, bounds_of(q, p, s))
            if found:
                assert found == fate
                assert all(inside(basins, corner) for corner in corners)
            quick = fate_of(known, k, True, p, s)
            assert quick in (NONE, found)
            assert fate_of(known, k, False, p, s) == (NONE if fate == SEGMENT else quick)
            agreed[found] += found == quick
    assert min(agreed.values()) > 100


def test_lines_in_basins():
    """The same, where places are known in one variable."""
    rng, agreed = np.random.default_rng(7), 0
    for _ in range(800):
        strip, ellipse, (middle, sides) = drawn(rng)
        p, s = (
            ((a, b, *(line.DEGREE - 1) * (0.0,)), 1e-9)
            for a, b in zip(middle.tolist(), sides[:, 0].tolist(), strict=True)
        )
        both = Basins((strip,), (ellipse,))
        found = both.fate(0, bounds_of(line, p, s))
        quick = fate_of_lines(compiled_basins(both), 0, (*p[0], p[1]), (*s[0], s[1]))
        assert quick == found or quick in (NONE, ATTRACTOR)
        agreed += quick == found
        if found:
            assert all(inside(both, middle + x * sides[:, 0], found) for x in (-1, 1))
    assert agreed > 780


def inside(basins, state, fate=None):
    """Return whether a state is in a basin."""
    for strip in basins.strips if fate != ATTRACTOR else ():
        return all(row.low < np.dot(row[:2], state) < row.high for row in strip.rows)
    for ellipse in basins.ellipses + basins.odd:
        u = [np.dot(row[:2], state) - (row.low + row.high) / 2 for row in ellipse.rows]
        return np.hypot(*u) < 1
    return False
