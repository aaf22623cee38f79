"""Nothing false is proved where a hypothesis of the theorem just fails.

The symmetric orbit at F = ω = 1, R = 2 has trace (2 - k)² - 2 with k = π² c/(1 + c) and
c = sqrt(1 - (πf/2)²), so f can be chosen, to 150 digits, for a resonance or a parabolic orbit.
The theorem may hold there, but thirty digits cannot tell: the prover must say where it gave up.
"""

import math
from dataclasses import replace

import mpmath
import pytest
from support import certified

from cap import prove
from cap.errors import NotProved
from cap.maps.fixed_point import Start
from cap.parameters import PAPER, exact
from cap.proofs import elliptic, saddle
from cap.proofs.fixed_point import Setting


def friction(k):
    """Return the friction, to 150 digits, at which the symmetric orbit has this k."""
    with mpmath.workdps(200):
        k = k()
        c = k / (mpmath.pi**2 - k)
        return mpmath.nstr(2 / mpmath.pi * mpmath.sqrt(1 - c**2), 150)


@pytest.mark.parametrize(
    ("name", "k", "step"),
    [
        ("1/4", lambda: 2 + mpmath.sqrt(2), "Lemma 3"),
        ("1/4", lambda: 2 - mpmath.sqrt(2), "Lemma 3"),
        ("1/3", lambda: mpmath.mpf(3), "Lemma 3"),
        ("1/3", lambda: mpmath.mpf(1), "Lemma 3"),
    ],
)
def test_resonances(capsys, tmp_path, name, k, step):
    """Rotation number within 1e-149 of 1/3 or 1/4: elliptic, but not proved; the step is named."""
    status = prove.main(["elliptic", "--f", friction(k), "--out", str(tmp_path)])
    captured = capsys.readouterr()
    assert status == 1
    assert step in captured.err
    assert name in captured.err
    assert list(tmp_path.iterdir()) == []


def symmetric_start(f):
    """Return the symmetric orbit in floats: cos t1 = c, speed (R + 2c)/π at the hits."""
    c = math.sqrt(1 - (math.pi * f / 2) ** 2)
    t = math.acos(c)
    v = (2 + 2 * c) / math.pi - math.sin(t) + f * t
    x = 1 - v * t + c + f * t * t / 2 - 1
    return Start.non_sticking(x, v, (t, t + math.pi))


@pytest.mark.parametrize(
    "theorem",
    [elliptic, saddle],
    ids=["elliptic", "saddle"],
)
@pytest.mark.parametrize("k", [2, 4], ids=["trace -2", "trace 2"])
def test_parabolic(theorem, k):
    """Trace within 1e-149 of ±2: neither theorem is proved of this orbit."""
    f = friction(lambda: mpmath.mpf(k))
    parameters = replace(PAPER, f=exact(f))
    with pytest.raises(NotProved) as failure:
        certified(theorem, Setting(parameters, symmetric_start(float(f)), 30))
    assert failure.value.step in ("ellipticity", "Lemma 3", "Krawczyk")


def test_a_little_off_resonance_is_proved(capsys, tmp_path):
    """A distance of 1e-12 from 1/4 is enough: the theorem holds, and the distance is certified."""
    with mpmath.workdps(90):
        f = mpmath.mpf(friction(lambda: 2 + mpmath.sqrt(2))) + mpmath.mpf(10) ** -12
        text = mpmath.nstr(f, 60)
    assert prove.main(["elliptic", "--f", text, "--out", str(tmp_path)]) == 0
    assert "distance to 1/4" in capsys.readouterr().out
