"""Helpers of the tests: loop counts, exact containment, random sets."""

import json
import os
from fractions import Fraction
from random import Random

import mpmath
import pytest

from cap import prove
from cap.sets import interval


def seeded(seed):
    """Return a random generator, the same in every run."""
    return Random(seed)  # noqa: S311 (tests, not secrets)


def rounds(count):
    """Return how often a random test is to be repeated."""
    return max(1, round(count * float(os.environ.get("CAP_TEST_MULTIPLIER", "1"))))


def smallest_first(paths):
    """Return certificates for `parametrize`; all but the smallest of each theorem are slow."""
    known, cases = set(), []
    for path in sorted(paths, key=lambda path: (path.stat().st_size, path)):
        theorem = json.loads(path.read_bytes())["theorem"]
        marks = [pytest.mark.slow] * (theorem in known)
        cases.append(pytest.param(path, id=path.stem, marks=marks))
        known.add(theorem)
    return cases


def only(cases, *soon):
    """Return cases for `parametrize`; all but some are slow."""
    return [pytest.param(case, marks=[pytest.mark.slow] * (case not in soon)) for case in cases]


def proving(capsys, *words):
    """Return (status, standard output, standard error) of a command of `cap.prove`."""
    try:
        status = prove.main(words)
    except SystemExit as stop:
        status = stop.code
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def over(low=None, high=None):
    """Return the options for a range of f."""
    return {"from": low, "to": high}


def rational(value):
    """Return a number, also of mpmath, exactly."""
    if isinstance(value, mpmath.mpf):
        sign, man, exp, _ = value._mpf_
        return Fraction(int(-man if sign else man)) * Fraction(2) ** exp
    return Fraction(value)


def between(lower, upper):
    """Return a ball that contains the interval [lower, upper]."""
    return interval.hull(interval.ball(lower), interval.ball(upper))


def holds(ball, value, error=Fraction(1, 10**45)):
    """Return whether a finite ball contains a number that is known up to ``error``."""
    lower, upper = interval.ends(ball)
    return lower - error <= rational(value) <= upper + error


def width(ball):
    """Return the width of a finite ball as a float."""
    lower, upper = interval.ends(ball)
    return float(upper - lower)


def decimal_fraction(random: Random, size=1):
    """Return a random rational in [-size, size]: ends, zero and thirds are among them."""
    scale = random.choice([1, 2, 3, 10, 997, 10**12 + 39])
    return Fraction(size) * Fraction(random.randint(-scale, scale), scale)


def random_box(random: Random, size=1):
    """Return (centre, radius) of a random interval; radius zero is among them."""
    radius = random.choice([0, Fraction(1, 10**9), Fraction(1, 1000), Fraction(1, 7), 1])
    return decimal_fraction(random, size), Fraction(radius)


def inside(random: Random, centre, radius):
    """Return a random rational within ``radius`` of ``centre``; the ends are among them."""
    return centre + radius * decimal_fraction(random)


def number(q):
    """Return a rational at the precision of mpmath."""
    return mpmath.mpf(q.numerator) / q.denominator


def value_at(model, point):
    """Return the enclosure of a Taylor model's functions at one point of the domain."""
    total = model.remainder
    jet = model.polynomial
    for exponent, coefficient in zip(jet.space.exponents, jet.coefficients, strict=True):
        term = coefficient + interval.Ball(0)
        for x, power in zip(point, exponent, strict=True):
            term = term * interval.ball(x) ** power
        total = total + term
    return total


def certified(theorem, setting, part=Fraction(9, 10)):
    """Return the certificate of a theorem for a part of the largest box found."""
    return theorem.prove(setting)(part)


def among(pair, value, error=Fraction(1, 10**33)):
    """Return whether an enclosure, of two decimals, contains a number known up to ``error``."""
    low, high = map(Fraction, pair)
    return low - error <= rational(value) <= high + error
