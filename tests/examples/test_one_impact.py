"""The orbits of the linear impact oscillator with one impact in a period, in closed form.

Between impacts x = P + y: P the response to the force without a wall, of the amplitude R, and y the
free motion. With E the matrix of free motions over a period and u the velocity before the impact,
(1 - E) (y, y') = -(1 + e) u (0, 1) just after it, so that P = gap + a u and P' = b u there, with
numbers a, b that know no gap, and P² + (P'/ω)² = R². The trace of the return map is
-e tr E + E₁₂ (1 + e) (cos ωt - gap)/u.
"""

from fractions import Fraction
from json import loads

import mpmath
import pytest

from cap.command.prover import main
from cap.errors import NotProved
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.periodic import prove
from cap.system.files import read

MODEL = "examples/impact_oscillator.py"
HIT = (Contact("free", "wall", "free"),)
ELASTIC = {"omega": "3/2", "e": "1", "d": "0"}


@pytest.fixture(autouse=True)
def _digits():
    """Compute closed forms to 40 digits."""
    with mpmath.workdps(40):
        yield


class OneImpact:
    """The closed forms at omega, e, d."""

    def __init__(self, omega, e="0.8", d="0.05"):
        """Compute E, a, b and R."""
        w, e, d = map(mpmath.mpf, (omega, e, d))
        T = 2 * mpmath.pi / w
        own = mpmath.sqrt(1 - d * d)
        c, s = (
            mpmath.exp(-d * T) * mpmath.cos(own * T),
            mpmath.exp(-d * T) * mpmath.sin(own * T) / own,
        )
        self.E = mpmath.matrix([[c + d * s, s], [-s, c - d * s]])
        one = mpmath.lu_solve(mpmath.eye(2) - self.E, mpmath.matrix([0, 1]))
        self.a, self.b = (1 + e) * one[0], (1 + e) * one[1] - e
        self.R = 1 / mpmath.sqrt((1 - w * w) ** 2 + (2 * d * w) ** 2)
        self.w, self.e, self.d = w, e, d

    def velocities(self, gap):
        """Return the positive u."""
        A = self.a**2 + (self.b / self.w) ** 2
        root = mpmath.sqrt((gap * self.a) ** 2 - A * (gap**2 - self.R**2))
        return [u for u in ((-gap * self.a + s * root) / A for s in (1, -1)) if u > 0]

    def symmetric(self, gap, u):
        """Return trace and determinant of the return map."""
        cos = (1 - self.w**2) * (gap + self.a * u) + 2 * self.d * self.b * u
        trace = -self.e * (self.E[0, 0] + self.E[1, 1])
        trace += self.E[0, 1] * (1 + self.e) * (cos - gap) / u
        return trace, self.e**2 * mpmath.det(self.E)

    def flip(self):
        """Return the positive gap, u/gap = c, at which 1 + trace + determinant is 0."""
        one, det = self.E[0, 0] + self.E[1, 1], mpmath.det(self.E)
        K = (self.e * one - 1 - self.e**2 * det) / self.E[0, 1]
        per_u = (1 + self.e) * ((1 - self.w**2) * self.a + 2 * self.d * self.b) - K
        c = (1 + self.e) * self.w**2 / per_u
        return self.R / mpmath.sqrt((1 + c * self.a) ** 2 + (c * self.b / self.w) ** 2)


def between(pair, number):
    """Whether a number of 40 digits lies in a proved interval."""
    low, high = (mpmath.mpf(q.numerator) / q.denominator for q in map(Fraction, pair))
    return low < number < high


def proved(arguments, out):
    """Return the claims that a command of the package proves."""
    assert main([*arguments, "--out", str(out)]) == 0
    return loads(out.read_bytes())["claims"]


def test_shaw_and_holmes(tmp_path):
    """At omega = 2 the certificate has the velocity, trace and determinant of the closed form."""
    claims = proved(["periodic", "--model", MODEL], tmp_path / "one.json")
    form = OneImpact(2)
    (u,) = form.velocities(mpmath.mpf(1) / 10)
    assert between(claims["states"][0][1], u)
    for pair, number in zip(
        claims["symmetric"], form.symmetric(mpmath.mpf(1) / 10, u), strict=True
    ):
        assert between(pair, number)


def test_the_flip_of_shaw_and_holmes(tmp_path):
    """At omega = 5/2 the gap of the flip is that of the closed form, to 20 digits."""
    words = ["branch", "--model", MODEL, "--set", "omega=5/2,gap=0.08", "--parameter", "gap"]
    claims = proved([*words, "--range", "0.075", "0.085"], tmp_path / "flip.json")
    (point,) = claims["points"]
    assert point["kind"] == "flip"
    low, high = map(Fraction, point["short"]["ends"])
    assert high - low < Fraction(1, 10**19)
    assert between((low, high), OneImpact(2.5).flip())


def test_lamba(tmp_path):
    """At e = 1, d = 0: u = (P - gap) tan(T/2), P = 1/(1 - omega²), the trace is rational here."""
    words = ["periodic", "--model", MODEL, "--set", "omega=3/2,e=1,d=0,gap=1/2"]
    claims = proved(words, tmp_path / "elastic.json")
    assert between(claims["states"][0][1], mpmath.sqrt(3) * mpmath.mpf(13) / 10)
    assert between(claims["symmetric"][0], mpmath.mpf(8) / 13)
    form = OneImpact(1.5, 1, 0)
    u = mpmath.sqrt(3) * mpmath.mpf(13) / 10
    assert any(abs(u - other) < 1e-30 for other in form.velocities(mpmath.mpf(1) / 2))


def test_its_curve_ends_in_a_graze(tmp_path):
    """The closed form goes on to a flip at gap = -7/20; the orbits graze at -4/15."""
    words = [
        "branch",
        "--model",
        MODEL,
        "--set",
        "omega=3/2,e=1,d=0,gap=-6/25",
        "--parameter",
        "gap",
    ]
    claims = proved([*words, "--range", "-2/5", "-1/5"], tmp_path / "graze.json")
    assert not claims["points"]
    (graze,) = claims["grazes"]
    low, high = map(Fraction, graze["short"]["ends"])
    assert low < Fraction(-4, 15) < high


@pytest.mark.parametrize(("gap", "stands"), [("-13/50", True), ("-27/100", False)])
def test_a_root_with_an_impact_before_is_no_orbit(gap, stands):
    """The closed form solves the equations on both sides of -4/15; beyond, it meets the wall."""
    itinerary = Itinerary(read(MODEL, {**ELASTIC, "gap": gap}), HIT)
    wall = float(Fraction(gap))
    root = [4 * mpmath.pi / 3, wall, mpmath.sqrt(3) * (mpmath.mpf(4) / 5 + wall)]
    if stands:
        prove(itinerary, list(map(float, root)))
        return
    with pytest.raises(NotProved, match="wall"):
        prove(itinerary, list(map(float, root)))
