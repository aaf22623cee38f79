"""The derivation by machine: each identity is 0, and the lemma fails if one is not; claims."""

import random
from fractions import Fraction

import pytest
import sympy as sp
from conftest import STARTS
from mpmath import mp, workdps
from support import rational

from cap.errors import NotProved
from cap.one_one.closed_form import symmetric
from cap.parameters import Parameters
from cap.proofs import one_one
from cap.proofs.fixed_point import Setting
from cap.sets import interval
from cap.sets.interval import Ball

IDENTITIES = dict(one_one.identities())


def numerically(expression):
    """Return the value at random points, in 50 digits, and the size of what cancels there."""
    source = random.Random(str(expression))  # noqa: S311
    names = sorted(expression.free_symbols, key=str)
    values = {name: sp.Rational(source.randint(1, 999), 1000) for name in names}
    terms = sp.Add.make_args(expression)
    at = [abs(sp.N(term.subs(values), 60)) for term in terms]
    return abs(sp.N(expression.subs(values), 50, maxn=400)), max(at, default=1)


def test_each_identity_holds():
    """The lemma passes; the sentences are all different."""
    one_one.lemma_1_closed_form()
    assert len(IDENTITIES) == len(list(one_one.identities()))
    assert len(IDENTITIES) >= 17


@pytest.mark.parametrize("name", IDENTITIES)
def test_identities_at_random_points(name):
    """In numbers, without simplification."""
    value, size = numerically(IDENTITIES[name])
    assert value <= sp.Float("1e-45") * (1 + size)


@pytest.mark.parametrize("name", list(IDENTITIES)[::3])
def test_an_identity_that_is_wrong_is_refused(monkeypatch, name):
    """By a millionth of one of its symbols, or by a sign; the lemma says which it is."""
    wrong = IDENTITIES[name] + sp.Symbol("delta", real=True) / 10**6
    monkeypatch.setattr(one_one, "identities", lambda: iter([("so", sp.Integer(0)), (name, wrong)]))
    with pytest.raises(NotProved, match="was not confirmed") as caught:
        one_one.lemma_1_closed_form()
    assert name in caught.value.reason


@pytest.mark.parametrize("name", ["sin", "cos"])
def test_a_wrong_derivation_is_refused(monkeypatch, name):
    """With another forcing, sin for cos or twice as strong, the steps do not lead there."""
    original = getattr(sp, name)
    monkeypatch.setattr(sp, name, lambda x: original(x) * sp.Rational(999, 1000))
    with pytest.raises(NotProved, match="was not confirmed"):
        one_one.lemma_1_closed_form()


SETTINGS = [
    ("1", "1", "2/5", "-1", "1"),
    ("3", "1/2", "1/7", "5", "29"),
    ("1/1000", "40", "1/9000", "-2/3", "-2/3000000000"),
    ("1e20", "1e-3", "3e19", "0", "1e26"),
    ("1e-20", "1e-10", "3e-21", "1", "3"),
]


@pytest.mark.parametrize("words", SETTINGS, ids=range(len(SETTINGS)))
def test_states_and_units(words):
    """The state at t = 0 flies to the right wall in the time claimed, with the speed claimed."""
    p = Parameters(*map(Fraction, words))
    setting = Setting(p, STARTS["elliptic"], 25)
    with interval.workprec(setting.bits):
        scale = one_one.Scale(setting)
        for sign in (1, -1):
            orbit = symmetric(interval.ball(p.f / p.F), scale.rho, sign)
            claims = scale.state(orbit)
            for pair in (claims["x"], claims["v"], claims["hit_speed"], *claims["hit_times"]):
                assert Fraction(pair[0]) <= Fraction(pair[1])
            flown(p, claims)


def flown(p, claims):
    """Check the first flight in mpmath: right-going from t = 0 to the hit."""
    with workdps(80):
        F, w, f, _, r = (mp.mpf(q.numerator) / q.denominator for q in (p.F, p.omega, p.f, p.l, p.r))
        x, v, u, t = (
            sum(mp.mpf(Fraction(q).numerator) / Fraction(q).denominator for q in pair) / 2
            for pair in (claims["x"], claims["v"], claims["hit_speed"], claims["hit_times"][0])
        )
        speed = v + F / w * mp.sin(w * t) - f * t
        place = x + v * t + F / w**2 * (1 - mp.cos(w * t)) - f * t**2 / 2
        R = mp.mpf(p.R.numerator) / p.R.denominator
        size = max(abs(v), F / w, R * w)
        assert abs(speed - u) < size * mp.mpf(10) ** -23
        assert abs(place - r) < max(R, F / w**2) * mp.mpf(10) ** -23
        second = sum(map(Fraction, claims["hit_times"][1])) / 2
        assert abs(mp.mpf(second.numerator) / second.denominator - t - mp.pi / w) < 1 / w / 10**23


def test_claims_are_wider_than_the_ball():
    """A looser arithmetic agrees; exact values too get room."""
    setting = Setting(Parameters(*map(Fraction, SETTINGS[0])), STARTS["elliptic"], 10)
    with interval.workprec(setting.bits):
        scale = one_one.Scale(setting)
        for value in (Ball(1), Ball(-2), Ball(0), interval.pi()):
            low, high = map(Fraction, scale.number(value))
            a, b = interval.ends(value)
            assert low <= a <= b <= high
            assert high - low <= Fraction(4, 10**10)
            assert value.contains(0) or low < a <= b < high


@pytest.mark.parametrize("bits", [40, 60, 100, 300])
def test_the_asymmetry_at_hardly_any_friction(bits):
    """Where S is nearly 1 the bits may not tell whether there is an orbit: that is no bracket."""

    def excess(d):
        """Return α² - 10^-18."""
        G = mp.pi**2 / 2 * mp.sinc(d) - 2 * mp.cos(d) - 2 * d * mp.sin(d)
        return (2 / mp.pi * mp.cos(d)) ** 2 * (1 - (2 / G) ** 2) - mp.mpf(10) ** -18

    with workdps(50):
        delta = rational(mp.findroot(excess, 0.75))
    with interval.workprec(bits):
        alpha, rho = interval.ball(Fraction(1, 10**9)), Ball(2)
        if bits < 60:
            with pytest.raises(NotProved, match="a sign is not certain"):
                one_one.asymmetry(alpha, rho, 15)
        else:
            low, high = one_one.asymmetry(alpha, rho, 15)
            assert low < delta < high == low + Fraction(1, 10**15)
