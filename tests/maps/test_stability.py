"""Types and multipliers of planar maps, against numpy; what is not certain is refused."""

from fractions import Fraction

import numpy as np
import pytest
from support import holds, rounds, seeded

from cap.errors import NotProved
from cap.maps.stability import SINKS, multipliers, stability
from cap.sets import interval
from cap.sets.interval import Ball


def expected(values, det):
    """Return the type of a matrix with these eigenvalues."""
    first, second = values
    if max(abs(values)) > 1 + 1e-9:
        outside = max(values.real, key=abs)
        return "saddle" if outside > 0 else "flip saddle"
    if det == 1:
        return "elliptic"
    if det == 0:
        return "superstable"
    return "sink node" if first.imag == second.imag == 0 else "sink focus"


def exact(trace, det):
    """Return the balls of two rationals."""
    return interval.ball(Fraction(trace)), interval.ball(Fraction(det))


@pytest.mark.parametrize("det", ["0", "1", "random"])
def test_against_numpy(det):
    """Random traces and determinants in [0, 1]: the eigenvalues of the companion matrix."""
    random, seen = seeded(3), set()
    for _ in range(rounds(400)):
        d = Fraction(random.randint(1, 999), 1000) if det == "random" else Fraction(det)
        t = Fraction(random.randint(-3999, 3999), 1000) * random.choice([1, 1, Fraction(1, 3)])
        if abs(t) == 1 + d or t * t == 4 * d:
            continue
        values = np.linalg.eigvals(np.array([[float(t), -float(d)], [1.0, 0.0]]))
        kind, found = stability(*exact(t, d)), multipliers(*exact(t, d))
        seen.add(kind)
        assert kind == expected(values, d)
        if isinstance(found[0], tuple):
            ordered = sorted(values, key=lambda z: -z.imag)
            for (re, im), z in zip(found, ordered, strict=True):
                assert holds(re, z.real, 1e-6)
                assert holds(im, z.imag, 1e-6)
            assert found[0][1] > 0
        else:
            ordered = sorted(values.real, key=lambda z: -abs(z))
            for ball, value in zip(found, ordered, strict=True):
                assert holds(ball, value, 1e-6)
    both = {"saddle", "flip saddle"}
    kinds = {"0": {"superstable"}, "1": {"elliptic"}, "random": {"sink focus", "sink node"}}[det]
    assert seen == both | kinds
    assert (kinds <= set(SINKS)) == (det != "1")


def test_exact_determinants():
    """With a determinant 0 the smaller multiplier is 0 exactly; with 1 the product is 1."""
    large, small = multipliers(*exact("1/3", 0))
    assert small.is_zero()
    assert holds(large, Fraction(1, 3), 0)
    assert multipliers(*exact("-7/2", 0))[1].is_zero()
    large, small = multipliers(*exact("-5/2", 1))
    assert holds(large, -2, 0)
    assert holds(small, Fraction(-1, 2), 0)


def test_multipliers_of_sets():
    """Those of all traces and determinants of the balls lie in the balls."""
    random = seeded(4)
    for _ in range(rounds(100)):
        t, d = Fraction(random.randint(-300, 300), 100), Fraction(random.randint(1, 99), 100)
        r = Fraction(1, random.choice([100, 10**6, 10**12]))
        try:
            found = multipliers(interval.around(t, r), interval.around(d, r))
        except NotProved:
            assert abs(t * t - 4 * d) <= 16 * r
            continue
        for a, b in ((0, 0), (1, 1), (1, -1), (-1, 1), (-1, -1), (0, 1)):
            sharp = multipliers(*exact(t + a * r, d + b * r))
            flat = [q if isinstance(q, tuple) else (q,) for q in found]
            inner = [q if isinstance(q, tuple) else (q,) for q in sharp]
            for whole, one in zip(flat, inner, strict=True):
                for p, q in zip(whole, one, strict=True):
                    assert p.overlaps(q)
                    assert q.rad() < 1e-7


@pytest.mark.parametrize(
    ("trace", "det"),
    [
        (Ball(2), Ball(1)),
        (Ball(-2), Ball(1)),
        (Ball(2, 1e-9), Ball(1)),
        (Ball(0.5), Ball(1, 1e-9)),
        (Ball(0.5), Ball(0, 1e-9)),
        (Ball(0.5), Ball(0.5, 0.6)),
        (Ball(1), Ball(0)),
        (Ball(-1), Ball(0)),
        (Ball(1.5, 1e-9), Ball(0.5)),
        (Ball(-1.5, 1e-9), Ball(0.5)),
        (Ball(1), Ball(0.25)),
        (Ball(1, 1e-3), Ball(0.25)),
        (Ball(0), Ball(1.5)),
        (Ball(2.9), Ball(2)),
        (Ball(0), Ball(-0.5)),
        (Ball("nan"), Ball(0.5)),
        (Ball(0.5), Ball("nan")),
        (Ball(0, "inf"), Ball(1)),
        (Ball(0.5), Ball(0.999, 0.001)),
        (Ball(0.5), Ball(0.001, 0.001)),
    ],
    ids=str,
)
def test_types_that_are_not_certain(trace, det):
    """On a border, over one, or not finite."""
    with pytest.raises(NotProved) as caught:
        stability(trace, det)
    assert caught.value.step == "stability"
    assert set(caught.value.sets) == {"trace", "determinant"}


@pytest.mark.parametrize(
    ("trace", "det"),
    [
        (Ball(2), Ball(1)),
        (Ball(-2), Ball(1)),
        (Ball(1), Ball(0.25)),
        (Ball(1, 1e-9), Ball(0.25)),
        (Ball(1), Ball(0.25, 1e-9)),
        (Ball(3), Ball("nan")),
    ],
    ids=str,
)
def test_multipliers_that_may_be_double(trace, det):
    """Neither real nor a pair."""
    with pytest.raises(NotProved):
        multipliers(trace, det)


@pytest.mark.parametrize(
    ("trace", "det", "kind"),
    [
        (Ball(2.1, 0.05), Ball(1), "saddle"),
        (Ball(-2.1, 0.05), Ball(1), "flip saddle"),
        (Ball(0, 1.9), Ball(1), "elliptic"),
        (Ball(0, 0.9), Ball(0), "superstable"),
        (Ball(0, 0.1), Ball(0.5, 0.4), "sink focus"),
        (Ball(1.1, 0.01), Ball(0.2, 0.05), "sink node"),
        (Ball(-1.1, 0.01), Ball(0.2, 0.05), "sink node"),
        (Ball(3, 0.5), Ball(0.5, 0.7), "saddle"),
    ],
    ids=str,
)
def test_types_of_sets(trace, det, kind):
    """One type for all of the balls."""
    assert stability(trace, det) == kind
