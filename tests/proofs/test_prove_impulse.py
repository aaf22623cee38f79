"""The theorem ``impulse``: its numbers, the motions that it is about, and where it is refused."""

import json
import math
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import mpmath
import pytest
from support import among, certified, proving, rounds, seeded

from cap.errors import BadInput, TooFewDigits
from cap.flow.itinerary import itinerary
from cap.maps.fixed_point import Start
from cap.parameters import PAPER, Parameters
from cap.proofs import impulse
from cap.proofs.fixed_point import Setting

SYSTEMS = [
    Parameters(*map(Fraction, words.split()))
    for words in (
        "1 1 7/10 -1 1",
        "1 1 13/20 -1/10 1/10",
        "3 2 5/2 0 9",
        "1/3 5 1/4 -2 3 9/10 1/5",
        "2 1/7 19/10 -1 1 1/2 3",
    )
]


def proved(p, digits=30):
    """Return the claims of the theorem."""
    return certified(impulse, Setting(p, Start(0.0, 0.0, ()), digits))["claims"]


@pytest.mark.parametrize("p", SYSTEMS, ids=str)
def test_thirty_digits(p):
    """They enclose what quadrature gives for the largest integral of |cos| - 2/pi."""
    with mpmath.workdps(50):
        bound, F, omega = 2 / mpmath.pi, mpmath.mpf(p.F.numerator) / p.F.denominator, p.omega
        turn = mpmath.findroot(lambda t: mpmath.cos(t) - bound, 0.9)
        most = mpmath.quad(lambda t: mpmath.cos(t) - bound, [-turn, turn])
        margin = mpmath.mpf(p.f.numerator) / p.f.denominator - F * bound
        w = mpmath.mpf(omega.numerator) / omega.denominator
        claims = proved(p)
        assert among(claims["margin"], margin)
        assert among(claims["delay"], most * F / w / margin)
        assert among(claims["delay_per_speed"], 1 / margin)
        assert among(claims["gap"], mpmath.pi * most / 2 * F / w**2)


def test_no_interval_has_a_larger_integral():
    """The integral of |cos| - 2/pi over an interval is at most (2/pi) h, nearly so over one."""
    theta = [k * math.pi / 500 for k in range(1001)]
    H = [0.0]
    for a, b in pairwise(theta):
        H.append(
            H[-1] + (abs(math.cos(a)) + abs(math.cos(b))) / 2 * (b - a) - 2 / math.pi * (b - a)
        )
    largest = max(max(H[k:]) - value for k, value in enumerate(H))
    h = float(Fraction(proved(SYSTEMS[0])["gap"][1]))
    assert 2 / math.pi * h - 1e-4 < largest < 2 / math.pi * h + 1e-6


@pytest.mark.parametrize("p", SYSTEMS, ids=str)
def test_motions_come_to_rest_in_time(p):
    """From random states at random times, a stick or capture comes within D + B |v|."""
    random, claims = seeded(7), proved(p, 6)
    delay, per_speed = (float(Fraction(claims[k][1])) for k in ("delay", "delay_per_speed"))
    speed = float(p.F / p.omega)
    for _ in range(rounds(30)):
        x = float(p.l) + float(p.R) * (random.random() * 0.98 + 0.01)
        v, t = random.uniform(-3, 3) * speed, random.uniform(0, 7) / float(p.omega)
        end = t + delay + per_speed * abs(v)
        events = itinerary(p, x, v, end, start=t).events
        assert any(event.word.split()[0] in ("stick", "capture") for event in events)


def sharp(ratio):
    """Return the events in ten periods of the motion of (iii), R being ``ratio`` times the gap."""
    f = Fraction(2 / math.pi)
    half = Fraction(proved(SYSTEMS[0])["gap"][1]) * Fraction(ratio) / 2
    p = Parameters(Fraction(1), Fraction(1), f, -half, half)
    return itinerary(p, math.pi / 4 - 1, float(p.R) / math.pi, 20 * math.pi).events


def test_the_bound_is_sharp():
    """At f = 2F/pi and walls a little farther apart than the gap the velocity never vanishes."""
    events = sharp("1.02")
    assert len(events) == 20
    for k, event in enumerate(events):
        assert event.word == ("hit r", "hit l")[k % 2]
        assert event.time == pytest.approx(math.pi / 2 + k * math.pi, abs=1e-6)


def test_the_gap_is_sharp():
    """Walls a little nearer: the velocity of that motion vanishes on the way to the second hit."""
    assert not sharp("0.98")[1].word.startswith("hit")


@pytest.mark.parametrize(
    ("words", "status", "reason"),
    [
        (("--f", "3/5"), 2, "error: the theorem impulse is about f/F > 2/pi"),
        (("--f", "0.6366197723675813430755350534900574481378"), 2, "error: the theorem impulse is"),
        (("--f", "0.6366197723675813430755350534900574481379"), 1, "NOT PROVED (impulse"),
        ((), 2, "error: the theorem impulse is about f/F > 2/pi = 0.636619..: f/F = 2/5"),
    ],
)
def test_at_most_the_bound(capsys, tmp_path, words, status, reason):
    """Below 2F/pi: a bad request; so near that the digits do not tell: not proved.  In a line."""
    found, _, err = proving(capsys, "impulse", *words, "--out", str(tmp_path))
    assert found == status
    assert err.startswith(reason)
    assert ("claim more" in err) == (status == 1)
    assert list(tmp_path.iterdir()) == []


def test_near_the_bound(capsys, tmp_path):
    """With enough digits f is told from 2F/pi."""
    f, path = "0.6366197723675813430755350534900574481379", tmp_path / "near.json"
    words = ("impulse", "--f", f, "--digits", "60", "--out", str(path))
    assert proving(capsys, *words)[0] == 0
    with mpmath.workdps(110):
        margin = mpmath.mpf(f) - 2 / mpmath.pi
        claims = json.loads(path.read_text("utf-8"))["claims"]
        assert among(claims["margin"], margin, Fraction(1, 10**70))
        assert among(claims["delay_per_speed"], 1 / margin, Fraction(1, 10**20))


@pytest.mark.parametrize("words", [("--orbit", "0", "1"), ("--all",), ("--f", "1")])
def test_bad_input(capsys, tmp_path, monkeypatch, words):
    """No orbit is needed, and f < F is."""
    monkeypatch.chdir(tmp_path)
    status, _, err = proving(capsys, "impulse", *words)
    assert status == 2
    assert err.count("\n") == 1


def test_losses_change_nothing():
    """With inelastic walls and viscous friction the same numbers are claimed."""
    lossless, lossy = (
        proved(Parameters(*PAPER_AT, *losses)) for losses in ((), (Fraction(1, 2), Fraction(3)))
    )
    assert lossless == lossy


PAPER_AT = PAPER.F, PAPER.omega, Fraction(7, 10), PAPER.l, PAPER.r


def test_lemma_1_names_both_numbers():
    """The hypothesis fails, or is undecided: what is known is named."""
    with pytest.raises(BadInput, match=r"f/F > 2/pi = 0.636619\.\.: f/F = 2/5$"):
        proved(PAPER)
    with mpmath.workdps(120):
        near = Fraction(mpmath.nstr(2 / mpmath.pi, 100))
    with pytest.raises(TooFewDigits) as caught:
        impulse.prove(Setting(replace(PAPER, f=near), Start(0.0, 0.0, ()), 6))
    assert caught.value.step == "Lemma 1"
    assert set(caught.value.sets) == {"f/F", "2/pi"}
    assert len(str(caught.value)) < 150
