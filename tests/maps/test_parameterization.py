"""Parameterized curves of a saddle: invariance, errors, crossings, and what is refused."""

import json
from fractions import Fraction
from pathlib import Path

import pytest
from conftest import STARTS
from curve_crossing import Pair

from cap.errors import NotProved
from cap.flow.event import BALLS
from cap.flow.windows import find_windows
from cap.maps import fixed_point
from cap.maps.cones import directions
from cap.maps.homoclinic import foreseen
from cap.maps.parameterization import curve
from cap.maps.stability import real_multipliers
from cap.parameters import PAPER
from cap.sets import interval, matrix
from cap.sets.interval import Ball

BITS = 200
CERTIFICATE = Path(__file__).parents[2] / "certificates/homoclinic.json"
MEETING = -0.4765, 0.0774  # parameters s, t of an orbit, after 7 periods


class Setting:
    """The paper's saddle, its multipliers, and frames of its eigenvectors."""

    def __init__(self, osc):
        self.osc = osc
        self.point = fixed_point.prove(osc, STARTS["saddle"], 45)
        jacobian = self.point.orbit.monodromy
        self.multipliers = real_multipliers(matrix.trace(jacobian), Ball(1))
        self.unit = directions(jacobian, self.multipliers, (PAPER.R, PAPER.R * PAPER.omega))

    def curve(self, which, length, degree):
        """Return a curve of this length, nearly."""
        scale = interval.ball(length)
        (a, b), (c, d) = self.unit
        frame = (a * scale, b * scale), (c * scale, d * scale)
        return curve(self.osc, self.point, frame, self.multipliers, which, degree)


@pytest.fixture
def saddle(paper):
    """The setting, at 200 bits."""
    with interval.workprec(BITS):
        yield Setting(paper)


@pytest.mark.parametrize("which", [0, 1])
def test_curves_are_invariant(saddle, which):
    """Φ(W(s)) and W(λ s) are enclosures of one point: they overlap, and are narrow."""
    W = saddle.curve(which, Fraction(1, 40), 10)
    reach = Fraction(3, 10) if which == 0 else Fraction(1)
    for n in range(-5, 6):
        s = interval.ball(reach * n / 5)
        state = W.at(s)
        _, orbit = find_windows(saddle.osc, state, foreseen(PAPER, state), BALLS)
        for z, w in zip(orbit.end, W.at(W.multiplier * s), strict=True):
            assert z.overlaps(w)
            assert z.rad() < 1e-6
            assert w.rad() < 1e-10


@pytest.mark.parametrize("which", [0, 1])
def test_tangents_are_derivatives(saddle, which):
    """Between two parameters the curve goes as far as a tangent between them says."""
    W, step = saddle.curve(which, Fraction(1, 40), 10), interval.ball(Fraction(1, 1000))
    s = interval.ball(Fraction(3, 4))
    slopes = W.tangent(interval.hull(s, s + step))
    for a, b, slope in zip(W.at(s), W.at(s + step), slopes, strict=True):
        assert (b - a).overlaps(slope * step)
        assert abs(b - a) > 0
        assert slope.rad() < 1e-2 * abs(slope)


@pytest.mark.slow
def test_errors_become_small(saddle):
    """A higher degree, or a shorter piece of the curve, has a smaller error."""
    low, high = (saddle.curve(1, Fraction(1, 40), degree) for degree in (6, 10))
    short = saddle.curve(1, Fraction(1, 400), 6)
    for k in (0, 1):
        assert high.error[k] < low.error[k] / 10**3
        assert short.error[k] < low.error[k] / 10**5


@pytest.mark.slow
@pytest.mark.parametrize("which", [0, 1])
def test_pieces_that_are_too_long(saddle, which):
    """They leave the states from which orbits never stop, or the map does not contract."""
    with pytest.raises(NotProved):
        saddle.curve(which, Fraction(1), 6)
    W = saddle.curve(which, Fraction(1, 40), 4)
    with pytest.raises(NotProved, match=r"outside of \[-1, 1\]"):
        W.at(Ball(2))


@pytest.mark.slow
def test_crossings_are_those_of_the_certificate(saddle):
    """Both proofs find the same orbit: from the certified point one arrives at this one."""
    curves = [saddle.curve(which, Fraction(1, 20), 12) for which in (0, 1)]
    pair = Pair(saddle.osc, PAPER, *curves)
    claim = json.loads(CERTIFICATE.read_text("utf-8"))["claims"]["points"][0]
    met = pair.meeting(MEETING, 7, Fraction(1, 10**9))
    assert met.angle > 20
    state = tuple(interval.ball(Fraction(claim[z][0])) for z in ("x", "v"))
    away = [1.0]
    for _ in range(8):
        away.append(max(float(abs(a - b).mid()) for a, b in zip(state, met.point, strict=True)))
        _, orbit = find_windows(saddle.osc, state, foreseen(PAPER, state), BALLS)
        state = orbit.end[0].mid(), orbit.end[1].mid()
    assert min(away) < 1e-9


def test_the_saddle_is_no_homoclinic_point(saddle):
    """There the curves cross, too."""
    curves = [saddle.curve(which, Fraction(1, 40), 6) for which in (0, 1)]
    with pytest.raises(NotProved, match="in the saddle only"):
        Pair(saddle.osc, PAPER, *curves).meeting((0.0, 0.0), 1, Fraction(1, 10**8))


@pytest.mark.slow
def test_where_the_curves_do_not_cross(saddle):
    """Newton's method leads nowhere, or the box holds no zero."""
    curves = [saddle.curve(which, Fraction(1, 40), 6) for which in (0, 1)]
    with pytest.raises(NotProved):
        Pair(saddle.osc, PAPER, *curves).meeting((0.9, 0.9), 1, Fraction(1, 10**8))
