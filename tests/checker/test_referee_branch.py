"""The branch against orbits integrated here; and what a referee found."""

import json
import math
from fractions import Fraction

import pytest
from closed_forms import claims_of, setting, within
from mpmath import mp, mpf, workdps
from support import only, over

from cap.errors import BadInput
from cap.proofs import branch
from cap.runner import Runner
from cap.subdivision import cells_between, subdivide

RHO = 2  # with F = ω = 1


def flight(t, u, s, f):
    """Return time and speed at the next hit; s = -1 to the left, 1 to the right."""
    base, cos, d = u - s * mp.sin(t), mp.cos(t), mp.pi
    for _ in range(60):
        speed = base + s * mp.sin(t + d) - f * d
        step = (base * d - s * (mp.cos(t + d) - cos) - f * d * d / 2 - RHO) / speed
        d -= step
        if abs(step) < mpf(10) ** (3 - mp.dps):
            break
    return t + d, base + s * mp.sin(t + d) - f * d


def period(z, f):
    """Return time and energy a period after a right hit."""
    t, u = flight(*flight(z[0], mp.sqrt(2 * z[1]), -1, f), 1, f)
    return t - 2 * mp.pi, u * u / 2


def jacobian(z, f):
    """Return the divided differences of E and t by E and t."""
    h = mpf(10) ** (-mp.dps // 3)
    columns = []
    for dt, dE in ((0, h), (h, 0)):
        (t1, E1), (t0, E0) = (period((z[0] + s * dt, z[1] + s * dE), f) for s in (1, -1))
        columns.append(((E1 - E0) / (2 * h), (t1 - t0) / (2 * h)))
    (a, c), (b, d) = columns
    return a, b, c, d


def fixed(f):
    """Return the orbit of the pair at f, by Newton's method from that at f = 0.4."""
    z = mpf("1.0991729"), mpf("0.993106") ** 2 / 2
    for k in range(13):
        g = mpf("0.4") + (f - mpf("0.4")) * k / 12
        for _ in range(12):
            (t, E), (a, b, c, d) = period(z, g), jacobian(z, g)
            r, q, det = E - z[1], t - z[0], (a - 1) * (d - 1) - b * c
            step = (a - 1) * q - c * r, (d - 1) * r - b * q
            z = z[0] - step[0] / det, z[1] - step[1] / det
    return z


def twist(z, f, matrix, steps=400):
    """Return how the mean angle grows with |z|², by weighted means along two orbits near z."""
    a, _, c, d = matrix
    cos = (a + d) / 2
    sin = mp.sqrt(1 - cos * cos) * mp.sign(c)
    lean, size = (cos - a) / c, sin / c
    angle = mp.atan2(sin, cos)

    def mean(radius):
        w, total, weights, before = (z[0], z[1] + radius * mp.sqrt(size)), mpf(0), mpf(0), None
        for n in range(steps + 1):
            X, Y = w[1] - z[1], w[0] - z[0]
            now = mp.atan2(size * Y, X + lean * Y)
            if before is not None:
                turn = now - before
                turn -= 2 * mp.pi * mp.nint((turn - angle) / (2 * mp.pi))
                x = mpf(2 * n - 1) / (2 * steps)
                weight = mp.exp(-1 / (x * (1 - x)))
                total, weights = total + weight * turn, weights + weight
            before, w = now, period(w, f)
        return (total / weights - angle) / radius**2

    small, large = mean(mpf("5e-5")), mean(mpf("1e-4"))
    return (4 * small - large) / 3


@pytest.mark.slow
@pytest.mark.parametrize("f", only(["0.37", "0.4", "0.40002", "0.40004", "0.43"], "0.40002"))
def test_trace_and_twist_from_orbits_alone(f):
    """Trace, and sign of the twist on both sides of its zero and of the resonance 1/3."""
    claims = claims_of(branch, digits=30)
    q = Fraction(f)
    (cell,) = (c for c in claims["cells"] if within(c["f"], q))
    with workdps(34):
        g = mpf(f)
        z = fixed(g)
        matrix = jacobian(z, g)
        trace = matrix[0] + matrix[3]
        assert within(cell["trace"], Fraction(str(trace)), Fraction(1, 10**9))
        N = (1 + trace) * twist(z, g, matrix)
    assert cell["twist"] == ("+" if N > 0 else "-")


def test_a_journal_with_a_verdict_that_is_none(tmp_path):
    """A verdict that no cell can have is refused in one line, like other damage."""
    journal = tmp_path / "journal"
    header, first = {"journal of": branch.journal_key(RHO)}, ["1/1000 3/2500", "zzz"]
    journal.write_text(json.dumps(header) + "\n" + json.dumps(first) + "\n")
    with pytest.raises(BadInput, match="damaged"):
        branch.prove(setting(options=over(Fraction("0.46")), runner=Runner(journal=journal)))


def test_progress_moves_with_each_verdict():
    """No two messages of a round are the same; the first comes before any verdict."""
    told = []
    cells = cells_between([Fraction(k) for k in range(6)])
    subdivide(
        lambda _: "+", cells, Fraction(1, 10), Runner(tell=lambda words, _: told.append(words)), ""
    )
    assert len(set(told)) == len(told) == 6


def test_below_which_gap_nothing_is_born():
    """At the pitchfork the symmetric orbit exists only if ρ > 0.70406; at 2F/π if ρ > 0.66134."""

    def at_birth(rho):
        S = 2 * rho / (mp.pi**2 - 4)
        alpha = 2 / mp.pi * mp.sqrt(1 - S * S)
        lost = mp.sqrt(1 - alpha * alpha) + alpha * (mp.asin(alpha) + mp.asin(S))
        return (rho + 2 * S) / mp.pi + mp.pi * alpha / 2 - lost

    assert math.isclose(mp.findroot(at_birth, 0.7), 0.7040606065, abs_tol=1e-9)
    alpha = 2 / mp.pi
    least = mp.pi * (mp.sqrt(1 - alpha**2) + alpha * mp.asin(alpha) - 1)
    assert math.isclose(least, 0.6613481751, abs_tol=1e-9)
