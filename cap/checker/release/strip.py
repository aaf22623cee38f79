"""A strip of values of f, for which the release map is unimodal, and its pieces (``entropies``)."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from cap.checker.flow.mechanics import Ends
from cap.checker.kernel.exponential import phi
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred
from cap.checker.kernel.rejection import need
from cap.checker.release.driven import phases
from cap.checker.release.kneading import doubling, extreme, order, tent
from cap.checker.release.sheared import Line, Near, Passage, Sheared
from cap.checker.system.walls import Parameters

MOST_ENTROPY = Fraction(693148, 10**6)  # above log 2: no unimodal map has more


class Cell(NamedTuple):
    """A cell of y, its events, and the signs of H' and H'' on it, or 0."""

    lower: Fraction
    upper: Fraction
    passage: Passage
    slope: int
    curve: int


class Strip:
    """A strip, with what is claimed of it and how to prove that."""

    def __init__(
        self,
        p: Parameters,
        bits: int,
        turn: int,
        half_periods: int,
        claim: dict[str, Any],
        hint: dict[str, Any],
    ) -> None:
        self.p, self.turn, self.claim, self.hint, self.bits = p, turn, claim, hint, bits
        low, high = pieces_ends(claim)
        middle = (low + high) / 2
        theta, origin = phases(p, (low, high), bits), phases(p, (middle, middle), bits)
        self.H = Sheared(p, theta, claim["shear"], origin, half_periods)
        self.a, self.b = claim["interval"][:2]

    def prove(self) -> None:
        """Prove all that is claimed of the strip."""
        self.cells = list(self.covered())
        self.unimodal()
        self.boundary()
        for claim, hint in zip(self.claim["pieces"], self.hint["pieces"], strict=True):
            self.piece(claim, hint)

    def number(self, q: Fraction) -> Interval:
        """Return an enclosure of a rational number."""
        return Interval.enclosing(q, q, self.bits)

    def stays(self, y: Interval) -> None:
        """Check that an image lies in (a, b)."""
        need(y.lies_inside(self.a, self.b), "the release map may not take I into its interior")

    def covered(self) -> Iterator[Cell]:
        """Yield the cells, which follow each other from a to b."""
        here = self.a
        for hint in self.hint["cells"]:
            lower, upper = here, hint["to"]
            need(lower < upper <= self.b, "the cells are not in order, or leave the interval")
            yield self.cell(lower, upper, Passage(hint["words"], [w[:2] for w in hint["events"]]))
            here = upper
        need(here == self.b, "the cells do not cover the interval")

    def cell(self, lower: Fraction, upper: Fraction, passage: Passage) -> Cell:
        """Prove the events of all releases from a cell; return it with its signs."""
        H = self.H.over(Interval.enclosing(lower, upper, self.bits), passage)
        curve = sign(H[(2, 0)]) if H.box.order > 1 else 0
        return Cell(lower, upper, passage, sign(H[(1, 0)]), curve)

    def unimodal(self) -> None:
        """Prove that H' has one sign on the first cells, then H'' the other, then H' that."""
        flat = [n for n, c in enumerate(self.cells) if not c.slope]
        need(bool(flat), "no cell has a critical point")
        before, after = self.cells[: flat[0]], self.cells[flat[-1] + 1 :]
        need(bool(before) and bool(after), "the release map may be monotone")
        rest = [c.slope == -self.turn for c in before] + [c.slope == self.turn for c in after]
        need(all(rest), "the release map may turn elsewhere")
        inner = all(c.curve == self.turn for c in self.cells[flat[0] : flat[-1] + 1])
        need(inner, "the derivative of the release map may not be monotone where it vanishes")

    def boundary(self) -> None:
        """Prove that the ends of I are mapped into its interior."""
        for end in (self.a, self.b):
            y = self.number(end)
            self.stays(self.H.over(y, self.passage(y)).value)

    def passage(self, y: Interval) -> Passage:
        """Return events for an interval, from the cells that meet it."""
        met = [c.passage for c in self.cells if c.lower <= y.upper and y.lower <= c.upper]
        need(bool(met), "an image of the critical point is not in I")
        halts = [q.words for q in met if q.words[-2].startswith("halt")]
        words = halts[0] if halts else met[0].words
        lists = [fitted(q, words) for q in met]
        hulls = [(min(w[0] for w in z), max(w[1] for w in z)) for z in zip(*lists, strict=True)]
        return Passage(words, hulls)

    def piece(self, claim: dict[str, Any], hint: dict[str, Any]) -> None:
        """Prove what is claimed of a piece."""
        H = self.on(claim["f"][:2])
        c, value = self.critical(H, Line(hint["at"], hint["rate"]), hint["reach"])
        images = list(self.images(H, claim["kneading"], c, value))
        self.entropy(claim["kneading"], *claim["entropy"][:2])
        if claim["cycle"]:
            self.cycle(H, claim["cycle"], images)

    def on(self, f: Ends) -> Sheared:
        """Return H for some f of the strip."""
        return self.H._replace(theta=phases(self.p, f, self.bits))

    def critical(self, H: Sheared, line: Line, reach: Fraction) -> tuple[Interval, Near]:
        """Return an enclosure of the critical points, and of their values, near a line."""
        need(reach > 0, "the reach is not positive")
        u = Interval.enclosing(-reach, reach, self.bits)
        places = H.places(line)
        passage = self.passage(places + u)
        curve = H.near(line, u, passage)[(2, 0)] * (2 * self.turn)
        need(curve.is_positive(), "the second derivative may vanish near c")
        value = H.near(line, u.integer(0), passage)
        slope = value[(1, 0)].magnitude()
        away = Interval(0, (slope / Interval(curve.lo, curve.lo, self.bits)).hi, self.bits)
        need(away.lies_in(Fraction(0), reach), "the critical point may not be near the line")
        c = places + Interval(-away.hi, away.hi, self.bits)
        need(c.lies_inside(self.a, self.b), "the critical point is not in I")
        least = Interval(-(slope * away).hi, 0, self.bits)
        near, rest = H.straightened(value)
        rest = rest + (least if self.turn > 0 else -least)
        self.stays(H.places(near) + rest)
        return c, Near(near, rest)

    def images(self, H: Sheared, symbols: str, c: Interval, value: Near) -> Iterator[Near]:
        """Yield H(c), H^2(c), ..., on the branches claimed."""
        left = "R" if self.turn > 0 else "L"  # the branch to the left of c
        here = value
        for n, symbol in enumerate(symbols, 1):
            if n > 1:
                here = H.straightened(self.image(H, here))
            y = H.places(here.line) + here.rest
            before, after = y.is_before(c), c.is_before(y)
            holds = symbol == "?" or (before if symbol == left else after)
            need(holds, f"symbol {n} of a kneading sequence may be another one")
            yield here

    def image(self, H: Sheared, here: Near) -> Centred:
        """Return H near a line."""
        return H.near(here.line, here.rest, self.passage(H.places(here.line) + here.rest))

    def entropy(self, symbols: str, lower: Fraction, upper: Fraction) -> None:
        """Prove bounds of the entropy."""
        need(lower >= 0, "an entropy claimed is negative")
        if lower > 0:
            larger = order(extreme(symbols, least=True), self.tent(lower)) > 0
            need(larger, "the entropy may be below its lower bound")
        most = extreme(symbols, least=False)
        if upper == 0:
            need(order(most, doubling()) < 0, "the entropy may be positive")
        elif upper < MOST_ENTROPY:
            need(order(most, self.tent(upper)) < 0, "the entropy may be above its upper bound")

    def tent(self, logarithm: Fraction) -> Iterator[str]:
        """Return the kneading sequence of the tent maps of the slope with this logarithm."""
        return tent(phi(0, self.number(logarithm)))

    def cycle(self, H: Sheared, claim: dict[str, Any], images: list[Near]) -> None:
        """Prove that a cycle attracts J, and that an image of c lies there."""
        reach, line = claim["reach"], Line(claim["at"], claim["rate"])
        need(reach > 0, "J has no interior")
        need(claim["image"] <= len(images), "the image of c is beyond the kneading sequence")
        arrived = H.distance(images[claim["image"] - 1], line).lies_in(-reach, reach)
        need(arrived, "the image of the critical point may not lie in J")
        here = Near(line, Interval.enclosing(-reach, reach, self.bits))
        slope = here.rest.integer(1)
        for n in range(claim["period"]):
            if n:
                y = H.distance(here, line)
                apart = y.lower > reach or y.upper < -reach
                need(apart, "the period of a cycle may be smaller")
            image = self.image(H, here)
            here, slope = H.straightened(image), slope * image[(1, 0)]
        inside = H.distance(here, line).lies_inside(-reach, reach)
        need(inside, "an iterate may not take J into its interior")
        need(slope.magnitude().is_before(slope.integer(1)), "an iterate may not contract J")


def pieces_ends(claim: dict[str, Any]) -> Ends:
    """Return the ends of a strip: all f of its pieces."""
    return claim["pieces"][0]["f"].lower, claim["pieces"][-1]["f"].upper


def fitted(passage: Passage, words: Any) -> list[Ends]:
    """Return windows for these words, which may have a halt in the place of a turn and a stick."""
    if list(passage.words) == list(words):
        return list(passage.windows)
    halts = words[-2].startswith("halt")
    rest = passage.words[-2:] == ["stick", words[-1]]
    if halts and rest and len(passage.words) == len(words) + 1:
        side = words[-2].partition(" ")[2]
        turns = passage.words[:-2] == [*words[:-2], f"turn {side}"]
        need(turns, "an image has releases with several itineraries")
        return [*passage.windows[:-2], passage.windows[-1]]
    same = halts and rest and passage.words[:-2] == words[:-2]
    need(same, "an image has releases with several itineraries")
    return list(passage.windows)


def sign(x: Interval) -> int:
    """Return the sign of all numbers in an interval, or 0."""
    return int(x.is_positive()) - int((-x).is_positive())
