"""The theorem about motions that are released, of the system that the certificate holds.

The parameters are the system: modes with linear fields, guards that are positive in their modes,
resets (``given``).  The contacts are those from one release to the next; a release is at a time t
that gives the state after it, F(t) is the time of the next release (``releases``), and

    G(t) = F(t) - n T,      T = 2 pi/omega.

If the release occurs k times among the contacts, they are those of k rounds: F(t) is the time of
the k-th release after t.

The system is the same a period later: if G takes an interval I of times into itself, a motion that
is released at a time in I, or whole periods later, has these contacts for ever.

1. *Cells.*  I = [a, b] is cut into cells.  On each, F is defined, and G' in an interval S
   (``release_cells``); its contacts are in windows.  At a point that two cells share, both say
   which contacts are next: F is one function, and analytic on I.
2. *Images.*  G at the ends of a cell is computed, and what contains its image.  All images lie
   inside I.
3. *One orbit attracts.*  There are weights w > 0, one for each cell, and lambda < 1 such that |S|
   w_K <= lambda w_J for every cell K that the image of a cell J meets.  Along an orbit through the
   cells J_0, ..., J_m so

       |(G^m)'| <= lambda^m w_(J_0)/w_(J_m) <= C lambda^m.

   Some G^m contracts I: G has exactly one fixed point in I, and all orbits tend to it.  It lies in
   [p, q] if G(p) > p and G(q) < q.
4. *Entropy.*  Each cell has one or two laps, on which G is monotone.  With the images and the
   coverings of cells ``laps`` has bounds of the entropy h of G on I, and periodic orbits.
   Sharkovsky's theorem has more of these.
5. *Entropy per period.*  Here k = 1.  I is shorter than T, so a motion that is released at t in I
   is not released again before b + j T, j = 0, ..., n - 1: F(t) > a + n T.  Let X_j be the set of
   the states just after these times; states before and after a contact count as one, so it is the
   image of I under a continuous map E_j (two contacts are never at once).  The state has all that
   follows, and F(t) is the first release that does: there is a continuous p_j from X_j to I, p_j
   E_j = G.  Let P take the state to that a period later.  Then P^n E_j = E_j G, so h(P^n on X_j) <=
   h; and p_j P^n = G p_j on X_j, and p_j is onto G(I), so h(P^n on X_j) >= h(G on G(I)) = h.  P^n
   takes each of these n closed sets into itself: the entropy of P on their union is h/n.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.kernel.citation import cite
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.growth import confirm_growth
from cap.checker.kernel.integers import Integer
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.named import name
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Table, Whole, enclosure, region
from cap.checker.kernel.theorem import BITS
from cap.checker.system.given import printed, told
from cap.checker.system.laps import (
    closed_paths,
    confirm_bound,
    confirm_logarithms,
    orbits,
    rank,
)
from cap.checker.system.own import OwnSystem
from cap.checker.system.passage import Contact
from cap.checker.system.release_cells import Cell, cell, confirm_laps, coverings, met
from cap.checker.system.releases import Releases

MOST_CONTACTS, MOST_CELLS, MOST_BITS = 32, 4096, 256
WORK = 1 << 20  # pieces of flights
SHORT = 10**15  # denominators of claims
LONGEST = 24  # of closed paths

ATTRACTS = "rate", "fixed"
CHAOTIC = "growth", "laps", "entropy", "entropy_per_period", "orbits", "period"

_WINDOWS = Many(enclosure, 1, MOST_CONTACTS)


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
        Field("rate", Maybe(number), "", "lambda",
              "|(G^m)'| <= C lambda^m on I, for a C and all m; lambda < 1"),
        Field("fixed", Maybe(region), "", "",
              "with the rate: the time of the release of the orbit that attracts"),
        Field("growth", Maybe(number), "", "s",
              "else: the spectral radius of A, the matrix of coverings, is at least s > 1"),
        Field("laps", Maybe(number), "", "S",
              "and that of B, the matrix of laps and the cells that they meet, at most S"),
        Field("entropy", Maybe(region), "", "h",
              "contains log s and log S; the topological entropy of G on I is in it"),
        Field("entropy_per_period", Maybe(region), "", "h_T", "contains that interval over n"),
        Field("orbits", Maybe(Many(Whole(0, 999_999), 1, LONGEST)), "", "",
              "for m = 1, 2, ..: G has at least so many orbits of the least period m in I"),
        Field("period", Maybe(Whole(1, LONGEST)), "", "m",
              "the first m in Sharkovsky's order of which there is one"),
    )
    CITES = (
        cite("Sharkovsky",
             "Sharkovsky, Coexistence of cycles of a continuous map of the line into itself, Ukr. "
             "Math. J. 16, 1964; Block and Coppel, Dynamics in One Dimension, Springer LNM 1513, "
             "1992",
             ("period", "only where a period is claimed: G is continuous, takes an interval into "
              "itself, and has an orbit of this least period", "interval, orbits, period")),
    )
    # fmt: on
    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the work, and what is claimed in each case."""
        need(hints["bits"] <= MOST_BITS, f"bits is above {MOST_BITS}")
        one, both = (tuple(k for k in keys if k in claims) for keys in (ATTRACTS, CHAOTIC))
        cases = (one, both) in ((ATTRACTS, ()), ((), CHAOTIC))
        need(cases, f"neither {', '.join(ATTRACTS)} nor {', '.join(CHAOTIC)} are claimed, alone")
        need(
            ("vector" in hints) == bool(both), "a vector is given if and only if entropy is claimed"
        )
        numbers = [claims[k] for k in ("rate", "growth", "laps") if k in claims]
        for key in ("entropy", "entropy_per_period"):
            numbers += claims[key][:2] if key in claims else ()
        need(all(SHORT % q.denominator == 0 for q in numbers), "a number has more than 15 places")
        once = not both or rounds(claims) == 1
        need(once, "entropy is claimed of one round alone, but the first contact comes again")
        count = len(hints["cells"])
        need(len(hints["weights"]) == count, "not one weight for each cell")
        if both:
            need(len(hints["vector"]) == count, "not one entry of the vector for each cell")

    def prove(self) -> None:
        """Prove the theorem."""
        contacts = [Contact(**contact) for contact in self.claims["contacts"]]
        self.releases = Releases(self.p, contacts, self.hints["bits"], WORK)
        a, b, _, _ = self.claims["interval"]
        narrow = (self.releases.period - self.number(b - a)).is_positive()
        need(narrow, "the interval is not shorter than a period of the clock")
        self.cells = list(self.covered(a, b))
        self.step("all motions released at times in I have these contacts up to the next release")
        need(all(c.image.lies_inside(a, b) for c in self.cells), "G may not take I into itself")
        self.step("G takes I into its interior")
        self.met = met(self.cells)
        if "rate" in self.claims:
            self.rate()
            self.fixed(a, b)
        else:
            self.covered_cells = coverings(self.cells)
            self.entropy()
            self.periodic()

    def covered(self, a: Fraction, b: Fraction) -> Iterator[Cell]:
        """Prove for each cell that F is defined on it; yield the cells, from left to right."""
        for hint in self.hints["cells"]:
            c, d = a, hint["to"]
            need(c < d <= b, "the cells are not in order, or leave the interval")
            windows = [
                Interval.enclosing(w.lower, w.upper, self.hints["bits"]) for w in hint["windows"]
            ]
            yield cell(self.releases, self.claims["periods"], (c, d), windows)
            a = d
        need(a == b, "the cells do not cover the interval")

    def at(self, t: Fraction, windows: Sequence[Interval]) -> Interval:
        """Return G at a time in a cell with these windows."""
        periods: int = self.claims["periods"]
        return self.releases.at(self.number(t), windows).time - self.releases.period * periods

    def rate(self) -> None:
        """Prove that the derivatives of G^m grow at most like lambda^m."""
        weights, rate = self.hints["weights"], self.claims["rate"]
        need(0 < rate < 1, "claims.rate is not between 0 and 1")
        need(min(weights) > 0, "a weight is not positive")
        for c, images, w in zip(self.cells, self.met, weights, strict=True):
            size = max(abs(c.slope.lower), abs(c.slope.upper))
            most = max(weights[images.start : images.stop])
            need(size * most <= rate * w, "lambda may be larger than claimed")
        self.step("the derivative of G^m is at most C lambda^m in size")

    def fixed(self, a: Fraction, b: Fraction) -> None:
        """Prove that the fixed point lies where it is claimed."""
        low, high, _, _ = self.claims["fixed"]
        need(a <= low < high <= b, "the fixed point claimed is not in I")
        for t, sign in ((low, 1), (high, -1)):
            there = next(c for c in self.cells if c.lower <= t <= c.upper)
            beyond = (self.at(t, there.windows) - self.number(t)) * sign
            need(beyond.is_positive(), "the fixed point may lie elsewhere")
        self.step("G has one fixed point in I, where it is claimed; all orbits tend to it")

    def entropy(self) -> None:
        """Prove the bounds of the entropy."""
        growth, laps = self.claims["growth"], self.claims["laps"]
        need(growth > 1, "claims.growth is not above 1")
        confirm_growth(self.covered_cells, self.hints["vector"], [growth] * len(self.cells))
        self.step("the matrix of coverings grows as claimed")
        confirm_bound(self.met, confirm_laps(self.cells), self.hints["weights"], laps)
        self.step("the matrix of laps grows no faster than claimed")
        low, high, _, _ = self.claims["entropy"]
        confirm_logarithms(low, high, growth, laps)
        least, most, _, _ = self.claims["entropy_per_period"]
        n: int = self.claims["periods"]
        need(n * least <= low and high <= n * most, "the entropy per period may be another one")
        self.step("the entropy lies between its bounds")

    def periodic(self) -> None:
        """Prove that there are the periodic orbits claimed."""
        counts, period = self.claims["orbits"], self.claims["period"]
        found = orbits(closed_paths(self.covered_cells, len(counts)))
        need(all(n <= m for n, m in zip(counts, found, strict=True)), "orbits may be fewer")
        known = [m for m, n in enumerate(counts, 1) if n]
        need(bool(known) and min(known, key=rank) == period, "no orbit of this period is first")
        self.step("there are the periodic orbits claimed")

    def words(self) -> str:
        """Return the theorem in one line."""
        claims = self.claims
        first, *others = claims["contacts"]
        releases = Releases(self.p, [Contact(**c) for c in claims["contacts"]], self.hints["bits"])
        listed = ", ".join(f"'{c['guard']}' of '{c['mode']}', then '{c['to']}'" for c in others)
        between = f" with the contacts {listed}, in order" if others else ""
        more = rounds(claims) - 1
        following = f"the next release but {more}" if more else "the next release"
        return (_ATTRACTOR + (_FIXED if "rate" in claims else self.chaos())).format(
            system=told(self.p), **first, between=between, following=following, x=releases.x,
            place=printed(releases.place),
            n=claims["periods"], interval=claims["interval"],
            rate=decimal(claims.get("rate", Fraction(0))), fixed=claims.get("fixed"),
        )  # fmt: skip

    def chaos(self) -> str:
        """Return what is said of entropy and periodic orbits."""
        claims = self.claims
        m, counts = claims["period"], claims["orbits"]
        n = claims["periods"]
        at = "time {}" if n == 1 else f"times {{}} + 2 pi j/omega, j = 0, .., {n - 1}"
        more = "" if m == 3 else f" that come after it in the order {_ORDER}"
        return _ENTROPY.format(
            **claims, cells=len(self.hints["cells"]), s=decimal(claims["growth"]),
            S=decimal(claims["laps"]), longest=len(counts), counts=", ".join(map(str, counts)),
            m=m, more=more, at=at.format(claims["interval"].text[1]),
        )  # fmt: skip


def rounds(claims: Mapping[str, Any]) -> int:
    """Return how many releases are among the contacts."""
    contacts: list[Any] = claims["contacts"]
    return contacts.count(contacts[0])


_ATTRACTOR = (
    "the system with the {system}; a release is where '{guard}' of '{mode}' falls through 0 and "
    "the system goes on in '{to}', with {x} = {place} just before; if after it {following} "
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
    "matrix of a spectral radius of at least {s}, and their laps meet each other with one of at "
    "most {S}; where the states before and after a contact count as one, the entropy of the map "
    "over one period 2 pi/omega lies in {entropy_per_period}, on the set of the states that "
    "motions released in {interval} have at the {at}; G has at least {counts} orbits of the least "
    "periods 1, .., {longest}, and (Sharkovsky) orbits of all least periods{more}, "
    "as it has one of the least period {m}; the motions released at the times of an "
    "orbit of the least period m repeat after m x {periods} x 2 pi/omega"
)
_ORDER = "3, 5, 7, .., 2 x 3, 2 x 5, .., 4 x 3, .., 8, 4, 2, 1"

THEOREM = ContactAttractor
