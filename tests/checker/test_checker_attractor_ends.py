"""The release map at the ends of I and of the critical point, where little is known of it."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.attractor import Attractor

STORED = Path(__file__).parents[2] / "certificates/attractor.json"
UNITS = {"good": (1, 3), "vague": (-1, 3), "bad": (-3, -1)}


def stored():
    """Return the checker of the stored certificate, which compares no claims."""
    proof = Attractor(read(STORED.read_bytes()), lambda _: None)
    proof.confirm = lambda **_: None
    proof.windows = lambda _: None
    return proof


@pytest.mark.parametrize("low", UNITS)
@pytest.mark.parametrize("high", UNITS)
def test_the_slope_at_the_ends_of_the_critical_point(low, high):
    """It has its sign certainly, at both; the middle of what is known does not do."""
    proof = stored()
    ends = {proof.hints["critical"].lower: (-1, low), proof.hints["critical"].upper: (1, high)}

    def image(x, *_):
        side, kind = next(s for end, s in ends.items() if x.lower <= end <= x.upper)
        return {(1,): Interval(*UNITS[kind], x.bits) * (side * proof.turn)}

    proof.image = image
    if low == high == "good":
        proof.critical_point()
    else:
        with pytest.raises(Rejected, match="the derivative may not change its sign at c"):
            proof.critical_point()


@pytest.mark.parametrize("beyond", ["a", "b", "c", None])
def test_the_ends_of_the_interval(beyond):
    """They and the critical point are mapped inside, each by itself."""
    proof = stored()
    interval, bits = proof.claims["interval"], proof.hints["bits"]
    at = {"a": interval.lower, "b": interval.upper, "c": Fraction(0)}
    inside, outside = (Interval.enclosing(z, z, bits) for z in (sum(interval[:2]) / 2, 7))
    proof.coarse = lambda low, high: low if low == high else pytest.fail("not a point")
    proof.image = lambda x, *_: SimpleNamespace(
        value=outside if beyond is not None and x == at[beyond] else inside
    )
    if beyond is None:
        proof.into_itself(at["c"])
    else:
        with pytest.raises(Rejected, match="the release map may not take I into its interior"):
            proof.into_itself(at["c"])
