"""The theorem about the entropy of the release map for a whole range of f.

For f of the range let G be the release map (``attractor``).  The range is cut into strips, between
which there may be gaps.  On a strip let theta = arccos(f/F), theta_0 that of the middle of the
strip, and y = x - s (theta - theta_0), s the ``shear`` claimed (``sheared``): so G becomes H, a
translate of G, and I = [a, b] + s (theta - theta_0) the fixed interval [a, b] of y.

*Unimodal.*  On the cells of [a, b], for all f of the strip, the releases have events that end with
the next release, n half-periods later; these may differ from cell to cell, and by a turn from f to
f and from place to place in one cell (``halts``): H is continuously differentiable all the same, as
neighbouring cells share a point.  As in ``attractor``, H has one critical point c in [a, b].  H(a)
and H(b) lie in (a, b), and so does H(c).

*Pieces.*  A strip is cut into pieces.  Let q(theta) = at + rate (theta - theta_0), and for all f of
a piece |H'(q)| <= s, and |H''| >= k within a distance of ``reach``, which is at least s/k: so |c -
q| <= s/k, and as H' is monotone between, H(c) lies between H(q) and H(q) - s^2/k, for a minimum.
So H(c) is an affine function of theta, plus a number of a short interval; its images are computed
as such, with that number for a further variable of the jets.  A symbol R or L of ``kneading`` is
the branch of an image for all f of the piece; where it is ?, the branch may depend on f, or the
image be c.

*Entropy.*  Of all sequences with R or L in the places of ?, the least has at each ? the symbol that
makes it less, that is L if an even number of R comes before, else R; the greatest the other one.
An image that is c counts between both.  So with the order of ``kneading``: if the least sequence is
larger than that of the tent map of slope e^h, the entropy is at least h for all f of the piece; if
the greatest is smaller, at most h.

*Cycles.*  Let J be the interval of the numbers at most ``reach`` from at + rate (theta - theta_0).
For all f of the piece H^p, p the period claimed, takes J into its interior, with a derivative in
(-1, 1), so it has one fixed point there, which attracts J; and the image of c with the number
claimed lies in J.  H(J), .., H^(p-1)(J) are disjoint from J: so p is the least period.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.flow.events import WORDS
from cap.checker.kernel.choices import OrNone
from cap.checker.kernel.citation import cite
from cap.checker.kernel.letters import Letters
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import (
    Enclosure,
    Field,
    Many,
    Table,
    Whole,
    Word,
    enclosure,
    region,
)
from cap.checker.kernel.theorem import BITS, MAX_BITS
from cap.checker.release.halts import HALTS
from cap.checker.release.strip import Strip, pieces_ends
from cap.checker.system.all_f import ForAllF, without_f
from cap.checker.system.lossy import WITH_LOSSES, WithLosses

_MAX_STRIPS, _MAX_PIECES, _MAX_CELLS, _MAX_SYMBOLS, _MAX_EVENTS = 256, 64, 256, 64, 32
_MAX_PERIOD = 16
_SHARES = ("positive", "periodic", "undecided")
_MAX_WORK = 1 << 26  # about five minutes
CYCLE = {
    "period": Whole(1, _MAX_PERIOD),
    "at": number,
    "rate": number,
    "reach": number,
    "image": Whole(1, _MAX_SYMBOLS),
}
PIECE = {
    "f": region,
    "kneading": Letters("RL?", _MAX_SYMBOLS),
    "entropy": region,
    "cycle": OrNone(CYCLE),
}
CELL = {
    "to": number,
    "words": Many(Word((*WORDS, *HALTS)), 2, _MAX_EVENTS),
    "events": Many(enclosure, 2, _MAX_EVENTS),
}


class Entropies(ForAllF, WithLosses):
    """The strips, their pieces, and the share of the range with positive entropy."""

    PARAMETERS = without_f(WITH_LOSSES)
    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS._replace(shape=Whole(64, MAX_BITS // 4)),
        Field("strips", Many({"cells": Many(CELL, 1, _MAX_CELLS),
                              "pieces": Many({"at": number, "rate": number, "reach": number},
                                             1, _MAX_PIECES)}, 1, _MAX_STRIPS), "", "",
              "for each strip its cells, which follow each other from a to b; and for each piece: "
              "the critical point y is near at + rate (theta - theta_0), within the reach"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("range", region, "", "", "of f"),
        Field("half_periods", Whole(1, 32), "", "", "n: the time that G takes, in T/2"),
        Field("turn", Word(("minimum", "maximum")), "", "", "what G has at its critical point"),
        Field("strips", Many({"interval": region, "shear": number,
                              "pieces": Many(PIECE, 1, _MAX_PIECES)}, 1, _MAX_STRIPS), "", "",
              "ascending: [a, b] and the shear s, I = [a, b] + s (theta - theta_0), theta = "
              "arccos(f/F), theta_0 that of the middle of the strip; its pieces, from one end to "
              'the other: f; the branches of G(c), G^2(c), .., "?" where it depends on f; bounds '
              "of the entropy of G on I; a cycle that attracts all within the reach of at + (rate "
              '+ s) (theta - theta_0), where the image of c with this number lies, or "none"'),
        Field("positive", number, "", "", "the share of the range with a positive lower bound"),
        Field("periodic", number, "", "", "the share of the range with a cycle that attracts c"),
        Field("undecided", number, "", "", "the share of the range that is in no strip"),
    )
    CITES = (
        cite(
            "Milnor-Thurston",
            "Milnor and Thurston, On iterated maps of the interval, Springer LNM 1342, 1988",
            ("unimodal", "for each f of a strip G is continuous on the interval, maps it into "
             "itself, and has one critical point there, on both sides of which it is strictly "
             "monotone", "strips"),
            ("order", "for each f of a piece the kneading sequence of G lies between those of the "
             "tent maps with the slopes exp(lower) and exp(upper), lower and upper the ends of its "
             "entropy, where that is not 0", "strips"),
        ),
    )
    # fmt: on

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time: cells and images, times their events, times bits and what all cost."""
        work = 0
        need(len(hints["strips"]) == len(claims["strips"]), "hints and claims are not as many")
        for hint, claim in zip(hints["strips"], claims["strips"], strict=True):
            pieces = claim["pieces"]
            need(len(hint["pieces"]) == len(pieces), "pieces are not as many in hints and claims")
            lengths = [len(cell["words"]) for cell in hint["cells"]]
            same = all(len(c["events"]) == n for c, n in zip(hint["cells"], lengths, strict=True))
            need(same, "windows of a cell are not as many as its words")
            images = sum(len(q["kneading"]) + 12 for q in pieces)
            images += sum(q["cycle"]["period"] * 8 for q in pieces if q["cycle"])
            work += (hints["bits"] + 256) * (max(lengths) + 3) * (len(lengths) + images)
        need(work <= _MAX_WORK, f"bits, cells and symbols are too much: {work} > {_MAX_WORK}")

    def prove(self) -> None:
        """Prove the theorem."""
        self.in_order()
        self.step("the strips and their pieces are in order")
        pairs = zip(self.claims["strips"], self.hints["strips"], strict=True)
        for n, (claim, hint) in enumerate(pairs, 1):
            self.strip(claim, hint).prove()
            low, high = pieces_ends(claim)
            self.step(f"strip {n}, f in [{low}, {high}]: unimodal, {len(claim['pieces'])} pieces")
        self.shares()
        self.step("the shares are as claimed")

    def in_order(self) -> None:
        """Check that the strips lie in the range, one after the other, as their pieces do."""
        low, high = self.claims["range"][:2]
        need(0 < low < high < self.p.F, "the range is not in (0, F)")
        here = low
        for strip in self.claims["strips"]:
            first, _ = pieces_ends(strip)
            need(here <= first, "the strips are not in order")
            for piece in strip["pieces"]:
                a, b = piece["f"][:2]
                need(a == first and a < b, "the pieces of a strip do not follow each other")
                first = b
            here = first
        need(here <= high, "a strip leaves the range")

    def strip(self, claim: dict[str, Any], hint: dict[str, Any]) -> Strip:
        """Return a strip, of which nothing is proved yet."""
        turn, halves = 1 if self.claims["turn"] == "minimum" else -1, self.claims["half_periods"]
        return Strip(self.p, self.hints["bits"], turn, halves, claim, hint)

    def pieces(self) -> Iterator[dict[str, Any]]:
        """Yield all pieces."""
        for strip in self.claims["strips"]:
            yield from strip["pieces"]

    def shares(self) -> None:
        """Compare the shares of the range."""
        low, high = self.claims["range"][:2]
        width: Fraction = high - low

        def share(pieces: list[dict[str, Any]]) -> Fraction:
            return sum((q["f"].upper - q["f"].lower for q in pieces), Fraction(0)) / width

        found = list(self.pieces())
        positive = share([q for q in found if q["entropy"].lower > 0])
        need(self.claims["positive"] == positive, f"the share of positive entropy is {positive}")
        periodic = share([q for q in found if q["cycle"]])
        need(self.claims["periodic"] == periodic, f"the share with cycles is {periodic}")
        undecided = 1 - share(found)
        need(self.claims["undecided"] == undecided, f"the share undecided is {undecided}")

    def words(self) -> str:
        """Return the theorem in one line."""
        found = list(self.pieces())
        periods = sorted({q["cycle"]["period"] for q in found if q["cycle"]})
        shares = {name: percent(self.claims[name]) for name in _SHARES}
        listed = ", ".join(map(str, periods))
        text = _SYSTEM + _ENTROPIES + bounded([q["entropy"] for q in found])
        text += _NOT_CLAIMED + (_CYCLES if periods else "") + _PIECES + "; ".join(map(piece, found))
        return self.told(text, count=len(found), periods=listed, **shares)


def bounded(entropies: list[Enclosure]) -> str:
    """Return how large the entropies of all pieces are, in words."""
    positive = [q for q in entropies if q.lower > 0]
    least, most = min(positive, default=None), max(entropies, key=lambda q: q.upper)
    if least is not None:
        more_than_0 = f"it is positive, at least {least.text[0]}, on the share {{positive}} of the "
        return f"{more_than_0}range, and nowhere in these pieces above {most.text[1]}"
    if most.upper > 0:
        return f"it is shown to be positive in none of them, and nowhere there above {most.text[1]}"
    return "it is zero in all of them"


def piece(claim: dict[str, Any]) -> str:
    """Return what is claimed of a piece in words."""
    known = f"f in {claim['f']}: entropy in {claim['entropy']}, kneading {claim['kneading']}"
    return known + (f", a cycle of period {claim['cycle']['period']}" if claim["cycle"] else "")


def percent(share: Fraction) -> str:
    """Return a share in words; it is exact."""
    return f"{share} ({'about ' if share * 10000 % 1 else ''}{float(100 * share):.4g} %)"


_SYSTEM = (
    "x'' = F cos(omega t) - f sgn x' - mu x' with F = {F}, omega = {omega}, mu = {mu} and walls at "
    "l = {l} and r = {r}, where v becomes -e v with e = {e}, for f in {range}: "
)
_ENTROPIES = (
    "with T = 2 pi/omega, let G take the place x at which a mass that has stuck is released to the "
    "right to the place of its next release, a release to the left mirrored by x -> l + r - x with "
    "half a period; but for f in the share {undecided} of the range, G takes an interval I, given "
    "in the certificate for the middle of each strip of values of f and moving with f, into its "
    "interior, where it is unimodal, with a {turn}, and takes {half_periods} half-periods; on "
    "{count} pieces of the range the kneading sequence of its critical point is known as far as "
    "claimed, hence (Milnor-Thurston) bounds of the topological entropy of G on I; "
)
_NOT_CLAIMED = "; it is not claimed that it is monotone in f"
_CYCLES = (
    "; on the share {periodic} of the range a cycle of G, for which the certificate gives an "
    "interval and its period ({periods}), attracts the critical point"
)
_PIECES = (
    "; the pieces, with the first symbols, R where G decreases, L where it increases, ? where that "
    "may depend on f: "
)

THEOREM = Entropies
