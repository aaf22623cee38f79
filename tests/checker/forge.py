"""A test tool: makes valid certificates in mpmath, apart from the prover.  Nothing here is
rigorous.

Flights are launched from (t0, x0, v0), hit times are found by Newton's method on truncated series.
"""

from __future__ import annotations

import json
from fractions import Fraction

from mpmath import mp, mpf

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Jet
from cap.checker.maps.normal_form import elliptic_frame, in_complex_coordinate, twists
from cap.checker.theorems import load

ORBITS = {
    "elliptic": ("0.10027988984419", "0.54194333067646"),
    "mirror": ("0.55916325", "1.06697003"),
    "saddle": ("0.34352606", "0.7753195"),
}
PARAMETERS = {"F": "1", "omega": "1", "f": "2/5", "l": "-1", "r": "1"}


def _mp(q):
    q = Fraction(q)
    return mpf(q.numerator) / q.denominator


def _constant(order, c):
    return Jet(order, {(0, 0): mpf(c)})


def _cos_sin(jet):
    c0 = jet.coefficients[0, 0]
    h = jet - _constant(jet.order, c0)
    h.coefficients.pop((0, 0), None)
    cos, sin, term = _constant(jet.order, mp.cos(c0)), _constant(jet.order, mp.sin(c0)), None
    term = _constant(jet.order, 1)
    for k in range(1, jet.order + 1):
        term = term * h * (mpf(1) / k)
        cos = cos + term * mp.cos(c0 + k * mp.pi / 2)
        sin = sin + term * mp.sin(c0 + k * mp.pi / 2)
    return cos, sin


class Flow:
    """The period map as a jet, from the parameters as strings."""

    def __init__(self, parameters):
        self.F, self.w, self.f, self.l, self.r = (_mp(parameters[k]) for k in PARAMETERS)
        self.T = 2 * mp.pi / self.w

    def state(self, t0, x0, v0, s, t):
        """Return position and velocity at the time t of the flight launched at t0."""
        d, (c, n), (c0, n0) = t - t0, _cos_sin(t * self.w), _cos_sin(t0 * self.w)
        v = v0 + (n - n0) * (self.F / self.w) - d * (s * self.f)
        x = (
            x0
            + (v0 - n0 * (self.F / self.w)) * d
            - (c - c0) * (self.F / self.w**2)
            - d * d * (s * self.f / 2)
        )
        return x, v

    def hit(self, t0, x0, v0, s):
        """Return the first hit: a coarse scan, bisection, then Newton on jets."""
        order, wall = x0.order, self.r if s > 0 else self.l
        low = [q.truncated(0) for q in (t0, x0, v0)]

        def gap(t):
            return s * (self.state(*low, s, _constant(0, t))[0].coefficients[0, 0] - wall)

        step, a = self.T / 400, t0.coefficients[0, 0] + self.T / 4000
        while gap(a + step) < 0:
            a += step
            if a > self.T:
                return None
        b = a + step
        for _ in range(60):
            a, b = ((a + b) / 2, b) if gap((a + b) / 2) < 0 else (a, (a + b) / 2)
        t = _constant(order, (a + b) / 2)
        for _ in range(order + 7):
            x, v = self.state(t0, x0, v0, s, t)
            t = t - (x - _constant(order, wall)) * (1 / v.coefficients[0, 0])
        return t

    def period_map(self, x, v, order):
        """Return the jets of the hit times, the speeds at the hits, and the jets of Phi."""
        x0, v0 = (Jet(order, {(0, 0): mpf(q), d: mpf(1)}) for q, d in ((x, (1, 0)), (v, (0, 1))))
        t0, s, hits, speeds = _constant(order, 0), 1 if v > 0 else -1, [], []
        self.slowest = abs(v)
        while True:
            t = self.hit(t0, x0, v0, s)
            end = _constant(order, self.T) if t is None or t.coefficients[0, 0] > self.T else t
            self._sample(t0, x0, v0, s, end)
            x1, v1 = self.state(t0, x0, v0, s, end)
            if end is not t:
                return hits, speeds, (x1, v1)
            hits.append(t)
            speeds.append(abs(v1.coefficients[0, 0]))
            t0, x0, v0, s = t, _constant(order, self.r if s > 0 else self.l), -v1, -s

    def _sample(self, t0, x0, v0, s, end):
        """Note the least speed of a flight."""
        theta = mp.acos(s * self.f / self.F)
        low = [q.truncated(0) for q in (t0, x0, v0)]
        inner = [q / self.w for q in (theta, 2 * mp.pi - theta)]
        for t in (*inner, end.coefficients[0, 0]):
            if t0.coefficients[0, 0] <= t <= end.coefficients[0, 0]:
                speed = self.state(*low, s, _constant(0, t))[1].coefficients[0, 0] * s
                self.slowest = min(self.slowest, speed)


def _fixed_point(flow, x, v):
    x, v = mpf(x), mpf(v)
    for _ in range(12):
        _, _, (X, V) = flow.period_map(x, v, 1)
        (a, b), (c, d) = ([w.coefficients[1, 0], w.coefficients[0, 1]] for w in (X, V))
        e, g = X.coefficients[0, 0] - x, V.coefficients[0, 0] - v
        det = (a - 1) * (d - 1) - b * c
        dx, dv = ((d - 1) * e - b * g) / det, (-c * e + (a - 1) * g) / det
        x, v = x - dx, v - dv
        if abs(dx) + abs(dv) < mpf(10) ** (8 - mp.dps):
            break
    return x, v


def _decimal(value, places):
    """Return a decimal string near value."""
    n = int(mp.nint(value * mpf(10) ** places))
    digits = str(abs(n)).zfill(places + 1)
    return ("-" if n < 0 else "") + digits[:-places] + "." + digits[-places:]


def _twists(jets, order, bits):
    """Return tau_1, ... by the checker's own normal form; its tests have another source."""

    def thin(q):
        n = int(mp.nint(mp.ldexp(q, bits)))
        return Interval(n - 2, n + 2, bits)

    x, v = (Jet(order, {p: thin(c) for p, c in w.coefficients.items()}) for w in jets)
    frame = elliptic_frame([[w.coefficients[1, 0], w.coefficients[0, 1]] for w in (x, v)])
    return [_mp((t.lower + t.upper) / 2) for t in twists(in_complex_coordinate(x, v, frame))]


def forge(  # noqa: PLR0913
    theorem="elliptic",
    *,
    orbit=None,
    digits=30,
    order=3,
    box_radius="0.002",
    parameters=PARAMETERS,
    remainder_radius="0.0001",
):
    """Return a valid certificate as an object for json.dumps."""
    with mp.workdps(2 * digits + 40):
        flow, n = Flow(parameters), order + 1 if theorem == "elliptic" else 1
        x, v = _fixed_point(flow, *(orbit or ORBITS[theorem]))
        hits, speeds, jets = flow.period_map(x, v, n)
        slowest = flow.slowest
        R, w = flow.r - flow.l, flow.w

        def claim(value, unit=1):
            size = max(abs(value), mpf(unit)) * mpf(10) ** -(digits + 1)
            places = digits + 8 + max(0, int(-mp.log10(max(abs(value), mpf(unit)))))
            return [_decimal(value - 3 * size, places), _decimal(value + 3 * size, places)]

        (a, b), (c, d) = ([q.coefficients[1, 0], q.coefficients[0, 1]] for q in jets)
        rho = mpf(box_radius)
        reach = [rho * (abs(t.coefficients[1, 0]) + abs(t.coefficients[0, 1])) for t in hits]
        times = [t.coefficients[0, 0] for t in hits]
        claims = {
            "box": {
                k: [_decimal(q - rho, 25), _decimal(q + rho, 25)] for k, q in (("x", x), ("v", v))
            },
            "x": claim(x, R),
            "v": claim(v, R * w),
            "hit_times": [claim(t, 1 / w) for t in times],
            "hit_speeds": [claim(u, R * w) for u in speeds],
            "hit_forcing": [claim(abs(flow.F * mp.cos(w * t)) - flow.f, flow.F) for t in times],
            "least_speed": claim(slowest, R * w),
            "jacobian": [[claim(a), claim(b, 1 / w)], [claim(c, w), claim(d)]],
            "trace": claim(a + d),
            "determinant": claim(a * d - b * c),
        }
        det = (a - 1) * (d - 1) - b * c
        inverse = [[(d - 1) / det, -b / det], [-c / det, (a - 1) / det]]
        hints = {
            "bits": str(int(digits * 3.33) + 160),
            "centre": [_decimal(x, digits + 10), _decimal(v, digits + 10)],
            "radius": _decimal(mpf(10) ** -(digits // 2 + 10), digits + 20),
            "preconditioner": [[_decimal(q, digits // 2 + 20) for q in row] for row in inverse],
            "hit_times": [
                [_decimal(t - 1.5 * e - 1e-4, 12), _decimal(t + 1.5 * e + 1e-4, 12)]
                for t, e in zip(times, reach, strict=True)
            ],
        }
        if theorem == "saddle":
            outer = (a + d + mp.sign(a + d) * mp.sqrt((a + d) ** 2 - 4)) / 2
            claims["multipliers"] = [claim(outer), claim(1 / outer)]
        else:
            hints["order"] = str(order)
            angle = mp.acos((a + d) / 2) * mp.sign(c)
            turns = abs(angle) / (2 * mp.pi)
            tau = _twists([j.truncated(order) for j in jets], order, int(3.33 * mp.dps))
            units = {"x": R, "v": R * w}
            powers = [(i, m - i) for m in range(2, order + 1) for i in range(m + 1)]
            radius = mpf(remainder_radius)
            claims |= {
                "rotation_angle": claim(angle),
                "rotation_number": claim(turns),
                "resonance_distances": {
                    q: claim(abs(turns - _mp(q))) for q in ("0", "1/4", "1/3", "1/2")
                },
                "taylor": {
                    k: {
                        f"{i},{j}": claim(jet.coefficients[i, j], units[k] / R**i / (R * w) ** j)
                        for i, j in powers
                    }
                    for k, jet in zip("xv", jets, strict=True)
                },
                "twist": claim(tau[0], 1 / (R**2 * w)),
                "twist_action": claim(2 * tau[0], 1 / (R**2 * w)),
                "higher_twists": [claim(q, (R**2 * w) ** -(k + 2)) for k, q in enumerate(tau[1:])],
                "remainder": {"degree": str(order), "radius": remainder_radius}
                | {
                    k: _decimal(
                        2
                        * radius**n
                        * sum(abs(q) for p, q in jet.coefficients.items() if sum(p) == n),
                        60,
                    )
                    for k, jet in zip("xv", jets, strict=True)
                },
            }
    return {
        "format": "cap-certificate/1",
        "theorem": theorem,
        "parameters": dict(parameters),
        "digits": str(digits),
        "claims": claims,
        "hints": hints,
        "cites": list(load(theorem).CITES),
        "provenance": {"tool": "forge"},
    }


if __name__ == "__main__":
    import sys

    print(json.dumps(forge(*sys.argv[1:2]), indent=1))
