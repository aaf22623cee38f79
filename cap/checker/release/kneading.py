"""Kneading sequences of unimodal maps of an interval, and their order.

Let G be a unimodal map of an interval, R the branch on which it decreases, L that on which it
increases, and c between them a maximum (else take x -> -G(-x)).  The *word* of a point x has the
branches R or L on which x, G(x), ... lie; it ends with C at the first of them that is c, if one
is.  The kneading sequence is the word of G(c).  Two words are *compared* at their first difference:
L < C < R if an even number of R comes before it, R < C < L if an odd one.

*Lemma 1.*  If the word of x is less than that of y, then x < y.  Let them differ at first after i
symbols.  The images of x and y before lie on the same branch, so between x and y G^i is monotone,
increasing if i symbols have an even number of R; and G^i(x) < G^i(y) if L or C is less than C or R.

*Lemma 2.*  Let G take both ends of its interval to the lower one, e.  There is a point with the
word w_1 .. w_i C, and one only, if and only if all of w_2 .. w_i C, ..., w_i C, C (none, if i = 0)
are less than the kneading sequence.  For G takes each branch, without c, one to one onto the
numbers from e on that are less than G(c).  So a point y has a preimage on a branch if and only if y
< G(c).  If its word ends with C, this is so if and only if it is less than that of G(c): if they
are equal, y = G(c), as G is one to one on the branches; if it is larger, y > G(c).

*Lemma 3.*  Let F and G be as in Lemma 2, and the kneading sequence of F not larger than that of G.
Then the topological entropy h(F) <= h(G).  For the turning points of G^m are the points with words
of at most m symbols that end with C.  By Lemma 2 those words of F are words of G, so G^m has at
least as many laps, intervals on which it is monotone, as F^m.  The entropy of a piecewise monotone
map is the limit of (1/m) log(the number of laps of its m-th iterate) [Misiurewicz, Szlenk, Entropy
of piecewise monotone mappings, Studia Math. 67, 1980; Milnor, Thurston].

*Lemma 4.*  T_s(y) = s min(y, 1 - y) on [0, 1], 1 < s <= 2, has the entropy log s.  The m-th iterate
has the slopes s^m and -s^m and laps with images of length at most 1, so s^m laps at least; and T_s
stretches no distance more than s times.

*Lemma 5.*  Let G be a unimodal map of I into its interior.  If its kneading sequence is larger than
that of T_s, h(G) >= log s; if it is smaller, h(G) <= log s.  By Lemmas 3 and 4, if G is as in Lemma
2.  Else let J be a larger interval, and continue G linearly to J so that both ends of J go to the
lower one, e.  As G(I) lies inside I, points outside of I, but for e, move into I sooner or later:
for x below I, x < G(x) < the maximum of G on I, and points above I go below it or into it.  So the
continuation has the invariant measures of G on I and that of e, and no more entropy than G.

*Lemma 6.*  Let D = RLRRRLRL.. begin with K, s, K if it begins with K, 2^n - 1 symbols, where s is L
if R is in K an odd number of times, else R.  If the kneading sequence of G is smaller than D, h(G)
= 0: those of all T_s, s > 1, are larger.  Let w' be w with R and L exchanged, and write Rw' for
R w'_1 R w'_2 ..  Then D = RD', by induction; and u < w if and only if Ru' < Rw', as the numbers of
R before the first difference have opposite parities.  If s <= sqrt 2, T_s(c), T_s^3(c), ... lie on
R; T_s^2 takes the interval of the numbers between s/(1 + s), fixed by T_s, and 1/(1 + s) into
itself, and is there, upside down, a tent map of slope s^2: so the sequence of T_s is Rw', w that of
T_(s^2).  So it is enough to show it for s > sqrt 2.  Then the sequence begins with RL, and T_s^3(c)
= s^2(1 - s/2) < s/(1 + s), of which the word is RRR.., as (s - 1)(s^2 - 2) > 0: by Lemma 1 the
sequence is not less than RLRRRRR.., which is larger than D.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected, need

_HALF = Fraction(1, 2)


def order(symbols: Iterable[str], other: Iterator[str]) -> int:
    """Return 1 if a sequence that begins with the symbols is larger than the other one, else -1."""
    even = True
    for mine, its in zip(symbols, other, strict=False):
        if mine != its:
            return 1 if (mine == "R") == even else -1
        even = even if mine == "L" else not even
    raise Rejected("the kneading sequence is too short to be compared")


def doubling() -> Iterator[str]:
    """Yield the limit of the kneading sequences of period doubling."""
    known, n = "R", 0
    while True:
        if n == len(known):
            known += ("L" if known.count("R") % 2 else "R") + known
        yield known[n]
        n += 1


def tent(slope: Interval) -> Iterator[str]:
    """Yield the kneading sequence of all tent maps with slopes in an interval."""
    need(slope.lies_in(Fraction(1), Fraction(2)), "no tent map has such an entropy")
    y = slope / 2
    while True:
        left, right = y.upper < _HALF, y.lower > _HALF
        need(left or right, "the kneading sequence of a tent map is not decided")
        yield "L" if left else "R"
        y = slope * y if left else slope * (-y + 1)


def extreme(symbols: str, *, least: bool) -> Iterator[str]:
    """Yield the least or the greatest sequence with R or L in the place of each ?."""
    even = True
    for symbol in symbols:
        chosen = ("L" if even == least else "R") if symbol == "?" else symbol
        even = even if chosen == "L" else not even
        yield chosen
