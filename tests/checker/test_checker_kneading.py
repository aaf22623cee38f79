"""The lemmas of ``kneading``: words of preimages of the critical point, laps, and the limit D."""

from __future__ import annotations

from fractions import Fraction
from itertools import islice, product

import pytest

from cap.checker.release.kneading import doubling, order

SYMBOLS = {-1: "L", 0: "C", 1: "R"}


def tent(s):
    """Return a tent map of rational slope."""
    return lambda y: s * min(y, 1 - y)


def skew(y):
    """Return a unimodal map with other slopes: 5/4 and -5/2 around 2/3, with the value 5/6."""
    return Fraction(5, 4) * y if y < Fraction(2, 3) else Fraction(5, 2) * (1 - y)


def word(G, c, x, length):
    """Return the symbols of a point, up to C."""
    found = ""
    for _ in range(length):
        found += SYMBOLS[(x > c) - (x < c)]
        if x == c:
            return found
        x = G(x)
    return found


def less(first, other):
    """Return whether a word is less than another one: L < C < R, turned by each R before."""
    for n, (mine, its) in enumerate(zip(first, other, strict=False)):
        if mine != its:
            even = first[:n].count("R") % 2 == 0
            return ("LCR".index(mine) < "LCR".index(its)) is even
    raise AssertionError("the words do not differ")


CASES = [
    (tent(Fraction(7, 5)), Fraction(1, 2)),
    (tent(Fraction(17, 10)), Fraction(1, 2)),
    (tent(Fraction(199, 100)), Fraction(1, 2)),
    (skew, Fraction(2, 3)),
]


@pytest.mark.parametrize(("G", "c"), CASES)
def test_words_of_preimages(G, c):
    """Lemma 2: those of which all ends are less than the kneading sequence, and no others."""
    known = word(G, c, G(c), 30)
    inverse = {"L": lambda y: y * c / G(c), "R": lambda y: 1 - y * (1 - c) / G(c)}
    for length in range(8):
        for branches in product("LR", repeat=length):
            x, exists = c, True
            for branch in reversed(branches):
                exists = exists and x < G(c)
                x = inverse[branch](x)
            whole = "".join(branches) + "C"
            foretold = all(less(whole[k:], known) for k in range(1, length + 1))
            assert exists is foretold
            if exists:
                assert word(G, c, x, length + 1) == whole


@pytest.mark.parametrize(("G", "c"), CASES)
def test_points_are_in_the_order_of_their_words(G, c):
    """Lemma 1."""
    points = [Fraction(k, 211) for k in range(1, 211, 5)]
    words = [word(G, c, x, 60) for x in points]
    for (x, u), (y, w) in product(zip(points, words, strict=True), repeat=2):
        if x != y:
            assert less(u, w) is (x < y)


def test_the_limit_of_doubling():
    """Lemma 6: D = RD', and all tent maps have larger sequences, down to slopes close to 1."""
    limit = "".join(islice(doubling(), 400))
    flipped = limit.translate(str.maketrans("RL", "LR"))
    assert "".join("R" + symbol for symbol in flipped)[:400] == limit
    for s in (Fraction(51, 50), Fraction(6, 5), Fraction(7, 5), Fraction(17, 12), Fraction(19, 10)):
        G = tent(s)
        assert order(word(G, Fraction(1, 2), s / 2, 200), doubling()) == 1
