"""Speed of the proof's core, and of two peers: straightforward python-flint, and mpmath.iv.

    python -m pytest -n0 benchmarks/bench_elliptic.py --benchmark-columns=min,median

From hints and a box of half-width 1e-9: *existence* is the itinerary, Krawczyk, trace and rotation
number over the box; *second pass* adds the orbits from K; *jet* is the jet of order 3.  For ratios
on a machine that is busy use `ratios.py`, which takes turns.
"""

from fractions import Fraction
from pathlib import Path

import peer
import peer_mpmath
import pytest
from mpmath import iv

from cap.checker.verdict import check
from cap.flow.event import BALLS, TAYLOR_MODELS
from cap.flow.jet_transport import strobe_jet
from cap.flow.strobe import oscillator, strobe
from cap.flow.windows import find_windows
from cap.maps import fixed_point
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.sets import interval, matrix
from cap.sets.taylor_model import Domain

TIMES = 1.0991729107, 3.5160904414
START = Start.non_sticking(0.1002798898441954, 0.5419433067664584, TIMES)
REACH = Fraction(1, 10**9), Fraction(1, 10**9)
BITS = pytest.mark.parametrize("bits", [53, 200])


class Hints:
    """The hints of one proof at the current precision."""

    def __init__(self):
        self.osc = oscillator(PAPER)
        with interval.workprec(240):
            self.hint = fixed_point.prove(oscillator(PAPER), START, 55).hint
        self.box = self.hint.box(REACH)
        self.expected, _ = find_windows(self.osc, self.box, START.expected(), BALLS)

    def existence(self):
        """Prove existence over the box; return it with the trace and rotation number."""
        _, orbit, _ = found = fixed_point.existence(self.osc, self.hint, REACH, self.expected)
        return found, rotation(orbit)

    def second_pass(self):
        """The same, then the trace and rotation number over K."""
        (box, orbit, _), _ = self.existence()
        tight = fixed_point.tightened(orbit, self.expected)
        return rotation(strobe(self.osc, box, tight, BALLS))


def rotation(orbit):
    """Return the trace and the rotation number."""
    trace = matrix.trace(orbit.monodromy)
    return trace, (trace / 2).acos() / (2 * interval.pi())


@BITS
def test_existence(benchmark, bits):
    with interval.workprec(bits):
        benchmark(Hints().existence)


@BITS
def test_second_pass(benchmark, bits):
    with interval.workprec(bits):
        trace, _ = benchmark(Hints().second_pass)
    assert 2 * trace.rad() < (1e-10 if bits == 53 else 1e-12)


@BITS
def test_jet(benchmark, bits):
    with interval.workprec(bits):
        h = Hints()
        orbit = strobe(h.osc, h.box, h.expected, BALLS)
        benchmark(strobe_jet, h.osc, h.box, orbit, 3)


@pytest.mark.parametrize("order", [1, 2])
def test_taylor_model_over_the_box(benchmark, order):
    """The tight form for thick boxes: the trace over the box is 5.6e-8 wide, like the truth."""
    with interval.workprec(53):
        h = Hints()
        reach = interval.ball(REACH[0]), interval.ball(REACH[1])

        def tight():
            state = Domain(reach, order).variables(h.hint.point)
            return strobe(h.osc, state, h.expected, TAYLOR_MODELS)

        trace = matrix.trace(benchmark(tight).monodromy).bound()
    assert 2 * trace.rad() < 1.5e-7


@BITS
def test_peer_existence(benchmark, bits):
    with interval.workprec(bits):
        benchmark(peer.existence, peer.Hints())


@BITS
def test_peer_second_pass(benchmark, bits):
    with interval.workprec(bits):
        benchmark(peer.second_pass, peer.Hints())


@BITS
def test_peer_jet(benchmark, bits):
    with interval.workprec(bits):
        hints = peer.Hints()
        benchmark(peer.jet, hints, peer.existence(hints)[-1])


@BITS
def test_peer_mpmath_existence(benchmark, bits):
    iv.prec = bits
    benchmark(peer_mpmath.existence)


def test_checker(benchmark):
    data = Path("certificates/elliptic.json").read_bytes()
    benchmark.pedantic(check, (data, lambda _step: None), rounds=5)
