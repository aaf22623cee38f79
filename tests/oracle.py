"""What the theorems claim, computed again in mpmath; and how to compare."""

from fractions import Fraction

import reference
from conftest import ORBITS
from mpmath import mp, mpf
from support import rational

from cap.parameters import PAPER


def oracle(name):
    """Return {claim: value} for everything that a theorem claims and the oracle can compute."""
    system = reference.System.of(PAPER)
    x, v, _ = reference.periodic_orbit(system, ORBITS[name][2])
    orbit = reference.flow(system, x, v)
    (a, _), (c, d) = jacobian = reference.jacobian(system, x, v)
    half = (a + d) / 2
    values = {
        "x": x,
        "v": v,
        "hit_times": orbit.hits,
        "hit_speeds": [abs(v) for v in orbit.velocities],
        "hit_forcing": [abs(system.F * mp.cos(t)) - system.f for t in orbit.hits],
        "least_speed": orbit.least,
        "jacobian": jacobian,
        "trace": a + d,
        "determinant": mpf(1),
    }
    if abs(half) > 1:
        larger = half + mp.sign(half) * mp.sqrt(half**2 - 1)
        return values | {"multipliers": [larger, 1 / larger]}
    theta = mp.sign(c) * mp.acos(half)
    turns = abs(theta) / (2 * mp.pi)
    points = {"0": 0, "1/4": mpf(1) / 4, "1/3": mpf(1) / 3, "1/2": mpf(1) / 2}
    table = reference.derivatives(system, x, v, 3)
    return values | {
        "rotation_angle": theta,
        "rotation_number": turns,
        "resonance_distances": {name: abs(turns - point) for name, point in points.items()},
        "taylor": {
            key: {f"{i},{j}": both[n] for (i, j), both in table.items() if i + j >= 2}
            for n, key in enumerate("xv")
        },
    }


def compared(claim, value, error, where):
    """Check that a claim, of any nesting, contains the oracle's value; count the intervals."""
    if isinstance(value, dict):
        assert set(claim) == set(value), where
        return sum(compared(claim[k], value[k], error, f"{where}.{k}") for k in value)
    if isinstance(value, list):
        assert len(claim) == len(value), where
        parts = zip(claim, value, strict=True)
        return sum(compared(c, v, error, f"{where}[{n}]") for n, (c, v) in enumerate(parts))
    lower, upper = map(exact_decimal, claim)
    slack = error * max(1, int(abs(value)) ** 2)
    assert lower - slack <= rational(value) <= upper + slack, where
    return 1


def exact_decimal(text):
    """Return the exact value of a decimal string of digits, point and sign only."""
    assert set(text) <= set("-.0123456789")
    return Fraction(text)
