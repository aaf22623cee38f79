"""The theorem about motions that are released, of the system that the certificate holds.

The parameters are the system: modes with linear fields, guards that are positive in their modes,
resets (``given``).  The contacts are those from one release to the next; a release is at a time t
that gives the state after it, F(t) is the time of the next release (``releases``), and

    G(t) = F(t) - n T,      T = 2 pi/omega.

The system is the same a period later: if G takes an interval I of times into itself, a motion that
is released at a time in I, or whole periods later, has these contacts for ever.

1. *Cells.*  I = [a, b] is cut into cells.  On each, F is defined, and G' in an interval S
   (``releases``); its contacts are in windows.  At a point that two cells share, both say which
   contacts are next: F is one function, and analytic on I.
2. *Images.*  G at the ends of a cell [c, d] is computed; G([c, d]) lies in the hull of G(c) and
   G(d) if S does not contain 0, and else in G(c) + S [0, d - c], and in G(d) - S [0, d - c].
   All images lie inside I.
3. *Rate.*  There are weights w > 0, one for each cell, such that |S| w_K <= lambda w_J for every
   cell K that the image of a cell J meets.  Along an orbit through the cells J_0, ..., J_m so

       |(G^m)'| <= lambda^m w_(J_0)/w_(J_m) <= C lambda^m.

   *If lambda < 1*, some G^m contracts I: G has exactly one fixed point in I, and all orbits tend to
   it.  It lies in [p, q] if G(p) > p and G(q) < q.
   *If lambda >= 1*, G^m has the Lipschitz constant C lambda^m, so the entropy of G on I is at most
   (log C)/m + log lambda [Katok, Hasselblatt], for all m: at most log lambda.  Directly: orbits of
   two times that are at most r/(C lambda^n) apart stay within r of each other up to G^n, so about
   |I| C lambda^n/r of them span all orbits of this length up to r.
4. *Growth.*  A cell J covers a cell K, if K lies between the images of its ends.  A is the matrix
   of the coverings; if A v >= s v for an integer vector v >= 0 that is not 0, its spectral radius
   is at least s (Lemma 4 of ``coverings.graph``), and the entropy is at least log s.
   *Proof.*  Let s > 1.  The spectral radius is that of a strong component, so there are a cell J
   and infinitely many m with k_m closed paths of m coverings at J, lim sup (log k_m)/m >= log s.
   For each path there is an interval in J that G^i takes into the i-th cell of it, for all i, and
   G^m onto J; choose it least, then inner points are taken to inner points.  So intervals of
   different paths have no inner point in common: when the paths part, it would be an inner point
   of two cells.  Every second one of these intervals, in their order on the line, is disjoint from
   the next: (k_m - 1)/2 or more disjoint intervals that G^m takes over all of them.  So G^m has at
   least the entropy log((k_m - 1)/2).
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, ClassVar, NamedTuple

from cap.checker.kernel.citation import cite
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.integers import Integer
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.named import name
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Table, Whole, enclosure, region
from cap.checker.kernel.theorem import BITS
from cap.checker.system.given import printed, told
from cap.checker.system.own import OwnSystem
from cap.checker.system.passage import Contact
from cap.checker.system.releases import Moment, Releases

MOST_CONTACTS, MOST_CELLS, MOST_BITS = 32, 4096, 256
WORK = 1 << 20  # pieces of flights
SHORT = 10**15  # denominators of claims
TERMS = 60  # of the series of an exponential

_WINDOWS = Many(enclosure, 1, MOST_CONTACTS)


class Cell(NamedTuple):
    """A cell, the windows of its contacts, S, and what contains its image."""

    lower: Fraction
    upper: Fraction
    windows: list[Interval]
    slope: Interval
    image: Interval


class ContactAttractor(OwnSystem):
    """An interval of releases that is taken into itself: one orbit that attracts, or entropy."""

    # fmt: off
    HINTS: ClassVar[Table] = (
        BITS,
        Field("cells", Many({"to": number, "windows": _WINDOWS}, 1, MOST_CELLS), "", "",
              "they follow each other from one end of I to the other; each ends at `to`; a time "
              "window for each contact after the release, the last of them the next release"),
        Field("weights", Many(Integer(60), 1, MOST_CELLS), "", "w", "one for each cell"),
        Field("vector", Maybe(Many(Integer(40), 1, MOST_CELLS)), "", "v",
              "integers v >= 0 with A v >= s v"),
    )
    CLAIMS: ClassVar[Table] = (
        Field("contacts", Many({"mode": name, "guard": name, "to": name}, 1, MOST_CONTACTS), "", "",
              "from a release, the first of them, to the next one"),
        Field("periods", Whole(1, 1000), "", "n", "the periods of the clock that G takes"),
        Field("interval", region, "I", "I", "times of releases; G maps it into its interior"),
        Field("rate", number, "", "lambda", "|(G^m)'| <= C lambda^m on I, for a C and all m"),
        Field("fixed", Maybe(region), "", "",
              "if lambda < 1: the time of the release of the orbit that attracts"),
        Field("growth", Maybe(number), "", "s",
              "if lambda >= 1: the spectral radius of A is at least s > 1"),
        Field("entropy", Maybe(region), "", "h",
              "if lambda >= 1: contains log s and log lambda; the entropy of G on I is in it"),
    )
    CITES = (
        cite("Katok-Hasselblatt",
             "Katok and Hasselblatt, Introduction to the Modern Theory of Dynamical Systems, 1995, "
             "Theorem 3.2.9",
             ("Lipschitz", "a map of a compact interval with a Lipschitz constant", "rate")),
    )
    # fmt: on
    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the work, and what is claimed in each case."""
        need(hints["bits"] <= MOST_BITS, f"bits is above {MOST_BITS}")
        need(claims["rate"] > 0, "claims.rate is not positive")
        numbers = [claims["rate"], *(claims[k] for k in ("growth",) if k in claims)]
        numbers += claims["entropy"][:2] if "entropy" in claims else ()
        need(all(SHORT % q.denominator == 0 for q in numbers),
             "the rate, the growth or the entropy has more than 15 places")  # fmt: skip
        one = claims["rate"] < 1
        need(("fixed" in claims) == one, "a fixed point is claimed if and only if lambda < 1")
        both = {"growth", "entropy"} & claims.keys()
        need(len(both) == (0 if one else 2), "entropy is claimed if and only if lambda >= 1")
        need(("vector" in hints) != one, "a vector is given if and only if lambda >= 1")
        count = len(hints["cells"])
        need(len(hints["weights"]) == count, "not one weight for each cell")
        need(one or len(hints["vector"]) == count, "not one entry of the vector for each cell")

    def prove(self) -> None:
        """Prove the theorem."""
        contacts = [Contact(**contact) for contact in self.claims["contacts"]]
        self.releases = Releases(self.p, contacts, self.hints["bits"], WORK)
        a, b, _, _ = self.claims["interval"]
        need(a < b, "the interval is empty")
        narrow = (self.releases.period - self.number(b - a)).is_positive()
        need(narrow, "the interval is not shorter than a period of the clock")
        self.ends = list[Interval]()  # G at the ends of the cells
        self.cells = list(self.covered(a, b))
        self.step("all motions released at times in I have these contacts up to the next release")
        need(all(c.image.lies_inside(a, b) for c in self.cells), "G may not take I into itself")
        self.step("G takes I into its interior")
        self.rate()
        if self.claims["rate"] < 1:
            self.fixed(a, b)
        else:
            self.entropy()

    def covered(self, a: Fraction, b: Fraction) -> Iterator[Cell]:
        """Prove for each cell that F is defined on it; yield the cells, from left to right."""
        for hint in self.hints["cells"]:
            c, d = a, hint["to"]
            need(c < d <= b, "the cells are not in order, or leave the interval")
            windows = [
                Interval.enclosing(w.lower, w.upper, self.hints["bits"]) for w in hint["windows"]
            ]
            over = self.releases.over(Interval.enclosing(c, d, self.hints["bits"]), windows)
            if not self.ends:
                self.ends.append(self.at(c, windows))
            self.ends.append(self.at(d, windows))
            image = self.image(self.ends[-2], self.ends[-1], over, self.number(d - c))
            yield Cell(c, d, windows, over.by[0], image)
            a = d
        need(a == b, "the cells do not cover the interval")

    def at(self, t: Fraction, windows: Sequence[Interval]) -> Interval:
        """Return G at a time in a cell with these windows."""
        periods: int = self.claims["periods"]
        return self.releases.at(self.number(t), windows).time - self.releases.period * periods

    def image(self, low: Interval, high: Interval, over: Moment, width: Interval) -> Interval:
        """Return an interval that contains the image of a cell, by 2."""
        S = over.by[0]
        if not S.contains_zero():
            return _hull(low, high)
        run = S * _hull(width.integer(0), width)
        return (low + run).intersection(high - run)

    def rate(self) -> None:
        """Prove that the derivatives of G^m grow at most like lambda^m."""
        weights, rate = self.hints["weights"], self.claims["rate"]
        need(min(weights) > 0, "a weight is not positive")
        lower, upper = [c.lower for c in self.cells], [c.upper for c in self.cells]
        for cell, w in zip(self.cells, weights, strict=True):
            first = bisect_left(upper, cell.image.lower)
            last = bisect_right(lower, cell.image.upper)
            need(first < last, "an image meets no cell")
            size = max(abs(cell.slope.lower), abs(cell.slope.upper))
            need(size * max(weights[first:last]) <= rate * w, "lambda may be larger than claimed")
        self.step("the derivative of G^m is at most C lambda^m in size")

    def fixed(self, a: Fraction, b: Fraction) -> None:
        """Prove that the fixed point lies where it is claimed."""
        low, high, _, _ = self.claims["fixed"]
        need(a <= low < high <= b, "the fixed point claimed is not in I")
        for t, sign in ((low, 1), (high, -1)):
            cell = next(c for c in self.cells if c.lower <= t <= c.upper)
            beyond = (self.at(t, cell.windows) - self.number(t)) * sign
            need(beyond.is_positive(), "the fixed point may lie elsewhere")
        self.step("G has one fixed point in I, where it is claimed; all orbits tend to it")

    def entropy(self) -> None:
        """Prove the bounds of the entropy."""
        growth, vector = self.claims["growth"], self.hints["vector"]
        need(growth > 1, "claims.growth is not above 1")
        need(min(vector) >= 0 and max(vector) > 0, "the vector is negative somewhere, or zero")
        sums = [0]
        for v in vector:
            sums.append(sums[-1] + v)
        lower, upper = [c.lower for c in self.cells], [c.upper for c in self.cells]
        for k, v in enumerate(vector):
            low, high = sorted((self.ends[k], self.ends[k + 1]), key=lambda x: x.lo)
            first, last = bisect_left(lower, low.upper), bisect_right(upper, high.lower)
            need(sums[max(first, last)] - sums[first] >= growth * v, "A may not grow as claimed")
        self.step("the matrix of coverings grows as claimed")
        low, high, _, _ = self.claims["entropy"]
        need(0 < low <= high < 64, "the entropy claimed is not between 0 and 64")
        need(_exp_above(low) <= growth, "the entropy may be below its lower bound")
        need(self.claims["rate"] <= _exp_below(high), "the entropy may be above its upper bound")
        self.step("the entropy lies between its bounds")

    def words(self) -> str:
        """Return the theorem in one line."""
        claims = self.claims
        first, *others = claims["contacts"]
        releases = Releases(self.p, [Contact(**c) for c in claims["contacts"]], self.hints["bits"])
        listed = ", ".join(f"'{c['guard']}' of '{c['mode']}', then '{c['to']}'" for c in others)
        between = f" with the contacts {listed}, in order" if others else ""
        end = _FIXED if claims["rate"] < 1 else _ENTROPY
        return (_ATTRACTOR + end).format(
            system=told(self.p), **first, between=between, x=releases.x,
            place=printed(releases.place),
            n=claims["periods"], interval=claims["interval"],
            rate=decimal(claims["rate"]), fixed=claims.get("fixed"), entropy=claims.get("entropy"),
            growth=decimal(claims.get("growth", claims["rate"])), cells=len(self.hints["cells"]),
        )  # fmt: skip


def _hull(x: Interval, y: Interval) -> Interval:
    """Return the least interval that contains both."""
    return Interval(min(x.lo, y.lo), max(x.hi, y.hi), x.bits)


def _exp_below(x: Fraction) -> Fraction:
    """Return a number at most exp(x), x >= 0: the beginning of its series."""
    total = term = Fraction(1)
    for n in range(1, TERMS):
        term = term * x / n
        total += term
    return total


def _exp_above(x: Fraction) -> Fraction:
    """Return a number at least exp(x), 0 <= x < 64.

    For z = x/64 < 1 the terms from z^n/n! on sum up to less than twice it.
    """
    z = x / 64
    total = term = Fraction(1)
    for n in range(1, TERMS // 2):
        term = term * z / n
        total += term
    return (total + term) ** 64


_ATTRACTOR = (
    "the system with the {system}; a release is where '{guard}' of '{mode}' falls through 0 and "
    "the system goes on in '{to}', with {x} = {place} just before; if after it the next release "
    "follows{between}, a guard falling through 0 at each, and nothing else, G maps the time t of "
    "the one to that of the other less {n} x 2 pi/omega; G is defined for all t in {interval} and "
    "takes this interval into its interior: so all motions released then, or whole periods 2 "
    "pi/omega later, have these contacts for ever; "
)
_FIXED = (
    "for a C and all m the derivative of G^m is there at most C {rate}^m in size: G has exactly "
    "one fixed point there, in {fixed}, and all its orbits tend to it; the motion released then "
    "has the period {n} x 2 pi/omega, and the times of the releases of all those motions tend to "
    "its times, modulo 2 pi/omega"
)
_ENTROPY = (
    "the topological entropy of G on it lies in {entropy}: {cells} cells cover each other with a "
    "matrix of a spectral radius of at least {growth}, and for a C and all m the derivative of G^m "
    "is at most C {rate}^m in size"
)

THEOREM = ContactAttractor
