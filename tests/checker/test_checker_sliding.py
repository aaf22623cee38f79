"""The theorem ``sliding``: against the equations of motion, and certificates that lie."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
from mpmath import mp, mpf

from cap.certificate.latex import macros
from cap.checker.kernel.certificate import read
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.tampered import accepted, malformed, survivors

STORED = Path(__file__).parents[2] / "certificates"


@pytest.fixture(scope="module", params=["sliding.json", "sliding-2.json"])
def sliding(request):
    """Return a stored certificate: the second mass is the lighter one, or the heavier one."""
    return json.loads((STORED / request.param).read_text("utf-8"))


def exact(text):
    """Return the number that a fraction stands for."""
    q = Fraction(text)
    return mpf(q.numerator) / q.denominator


def test_against_the_motion(sliding):
    """Velocities, strokes, sides and volumes agree with the motion, followed in small pieces."""
    p, claims = sliding["parameters"], sliding["claims"]
    with mp.workdps(25):
        F, omega, f, l, r = (exact(p[k]) for k in ("F", "omega", "f", "l", "r"))
        m = [exact(text) for text in p["masses"]]
        start = -mp.asin(mp.pi * f / (2 * F)) / omega
        half = mp.pi / omega

        def momentum(t):
            return F / omega * (mp.sin(omega * t) - mp.sin(omega * start)) - f * (t - start)

        below, stroke = (mp.quad(momentum, [start, end]) for end in (0, start + half))
        places = [0.0, 0.0, 0.0]
        way = [mp.quad(momentum, [0, start + half * k / 40]) for k in range(41)]
        places[0] = l + below / m[0]
        places[1] = max(0, *(x / m[0] - x / m[1] for x in (way[0], way[40])))
        places[2] = r - (stroke - below) / m[1]
        values = {
            ("v", 0): momentum(0) / m[0],
            ("v", 1): momentum(0) / m[1],
            ("strokes", 0): stroke / m[0],
            ("strokes", 1): stroke / m[1],
            ("places", "left"): places[0],
            ("places", "gap"): places[1],
            ("places", "right"): places[2],
        }
        assert all(x / m[0] - x / m[1] <= places[1] + mpf(10) ** -18 for x in way)
        side = places[2] - places[1] - places[0]
        values["places_area",] = side**2 / 2
        d, (a, b) = exact(claims["basin"]["speed"]), map(exact, claims["basin"]["drift"])

        def area(u_1, u_2):
            return (
                side - sum((a * u + b * u**2) / q for u, q in zip((u_1, u_2), m, strict=True))
            ) ** 2

        values["basin_volume",] = 2 * mp.quad(area, [0, d], [0, d]) / (m[0] * m[1])
        for path, value in values.items():
            pair = claims
            for key in path:
                pair = pair[key]
            assert abs(mpf(pair[0]) - value) < mpf(10) ** -15, path


def test_it_is_verified(sliding):
    """In five steps; the schema describes it; the line says what was proved."""
    assert len(verify(sliding)) == 5
    fits_the_schema(sliding)
    certificate = read(encode(sliding))
    line = words(certificate)
    for part in ("neither a wall nor each other", "not isolated", "an open set with a volume in"):
        assert part in line
    assert any("capABasinVolume" in macro for macro in macros(certificate, "a", 6))


def test_every_number(sliding):
    """No enclosure can be moved or widened."""
    assert survivors(sliding, {("basin", "drift")}) == []


def test_every_parameter(sliding):
    """The claims hold at no other parameters."""
    for name, value in sliding["parameters"].items():
        if name != "masses":
            other = str(Fraction(value) + Fraction(1, 10**12))
            assert not accepted(changed(sliding, "parameters", name, other)), name
    for k in range(2):
        mass = Fraction(sliding["parameters"]["masses"][k])
        for other in (mass + Fraction(1, 10**12), 0, -mass):
            assert not accepted(changed(sliding, "parameters", "masses", k, str(other)))


def test_what_is_malformed(sliding):
    """Fields missing, added, of another type are noticed."""
    bad = [altered for _, altered in malformed(sliding)]
    assert len(bad) > 200
    assert not any(accepted(altered) for altered in bad)


def test_the_basin(sliding):
    """No larger speed, no smaller drift, no basin without interior."""
    path = "claims", "basin"
    speed = Fraction(sliding["claims"]["basin"]["speed"])
    first, second = map(Fraction, sliding["claims"]["basin"]["drift"])
    small = Fraction(1, 10**6)

    def lie(speed, first, second, why):
        basin = {"speed": str(speed), "drift": [str(first), str(second)]}
        rejected(changed(sliding, *path, basin), why)

    lie(speed + small, first, second, "may bring the masses")
    lie(speed, first - small, second, "to first order")
    lie(speed, first, second - small, "larger than claimed$")
    lie(0, first, second, "no interior")
    lie(100, first, second, "too fast for a period")
    lie(speed / 2, first, second, "basin_volume")


def test_what_is_not_so(sliding, monkeypatch):
    """Masses that stick or do not fit, whatever is claimed."""
    monkeypatch.setattr("cap.checker.kernel.theorem.Theorem.compare", lambda *_: None)
    rejected(changed(sliding, "parameters", "f", "54/100"), "may stick")
    rejected(changed(sliding, "parameters", "f", "0"), "0 < f")
    rejected(changed(sliding, "parameters", "masses", 0, "1/10"), "no room")
    rejected(changed(sliding, "claims", "places_area", ["0", "1"]), "area of the places")
    rejected(changed(sliding, "claims", "multiplier", ["0", "1/2"]), r"not in \(0, 1\)")
    rejected(changed(sliding, "claims", "multiplier", ["1/2", "1"]), r"not in \(0, 1\)")
    rejected(changed(sliding, "claims", "basin_volume", ["0", "1"]), "not positive")
    rejected(changed(sliding, "claims", "turning_times", 0, ["1/100", "1/100"]), "first turn")
