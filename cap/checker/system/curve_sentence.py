"""What the theorem about a curve of periodic orbits over a parameter says, in words."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from math import ceil, floor
from typing import Any

from cap.checker.kernel.shapes import Enclosure
from cap.checker.system.curve import Line
from cap.checker.system.given import told
from cap.checker.system.model import Model

PLACES = 12  # decimals of what is printed of the parameter
KINDS = {
    "flip": "a multiplier is -1",
    "pair": "two multipliers that are not real are on the unit circle",
    "fold": "the curve turns back, and a multiplier is 1",
}


class Sentence:
    """The theorem about the system of a model, whose last variable is the parameter, by claims."""

    def __init__(self, model: Model, claims: Mapping[str, Any]) -> None:
        self.model, self.claims = model, claims

    def whole(self) -> str:
        """Return the theorem in one line."""
        claims, p = self.claims, self.model.state[-1]
        names = ", ".join(f"'{c['guard']}' of '{c['mode']}', then '{c['to']}'"
                          for c in claims["contacts"])  # fmt: skip
        alone = self.model.autonomous
        period = "an unknown period" if alone else f"period {claims['periods']} x 2 pi/omega"
        low, high = claims["range"]
        between = f"[{_decimal(low, ceil)}, {_decimal(high, floor)}]"
        return (
            f"the system with the {told(self.model)}; its variable {p} is a parameter, which "
            f"nothing moves; there is a connected curve of {self.orbits()} of {period}, "
            f"{len(claims['cells'])} analytic pieces, each with these contacts in {self.part()}, "
            f"at each of which the guard falls through 0, and no others{self.mirrored()}: {names}; "
            f"{p} takes on it all values in {between}; on each piece, in a box around a line, "
            f"there is for each value of one unknown no other {self.orbits()[:-1]} with these "
            f"contacts{self.squares()}{''.join(self.counts())}"
            f"{''.join(self.told_points())}{''.join(self.told_grazes())}"
            f"{''.join(self.told_lost())}"
        )

    def orbits(self) -> str:
        """Return what the orbits are called."""
        return "symmetric orbits" if "symmetry" in self.claims else "orbits"

    def part(self) -> str:
        """Return of what the contacts are."""
        return "half a round" if "symmetry" in self.claims else "one round"

    def mirrored(self) -> str:
        """Return in words what is symmetric of the orbits."""
        if "symmetry" not in self.claims:
            return ""
        given, names = self.claims["symmetry"], self.model.state
        signs = [("-" if s < 0 else "") + z for s, z in zip(given["signs"], names, strict=True)]
        modes = ", ".join(f"'{m}' to '{k}'" for m, k in given["modes"].items())
        half = Fraction(self.claims["periods"], 2)
        return (
            f", with their images in the other half: {half} x 2 pi/omega later the state is "
            f"({', '.join(signs)}) of what it was, its mode the image under {modes}, a symmetry "
            f"of the system"
        )

    def squares(self) -> str:
        """Return in words what the multipliers are."""
        if "symmetry" not in self.claims:
            return ""
        return (
            "; multipliers are here those of the map to the state half a round later, as the "
            "symmetry takes it back: those of the orbit are their squares"
        )

    def counts(self) -> Iterator[str]:
        """Give, for pieces of the curve, how many multipliers are outside the unit circle."""
        p, cells, n = self.model.state[-1], self.claims["cells"], len(self.model.state) - 1
        k = 0
        while k < len(cells):
            count, first = cells[k].get("outside"), k
            while k < len(cells) and cells[k].get("outside") == count:
                k += 1
            if count is not None:
                pieces = f"piece {first}" if k - first == 1 else f"pieces {first} to {k - 1}"
                yield (
                    f"; on {pieces}, where {p} lies in {self.values(first, k)}, {count} of the {n} "
                    "multipliers are outside the unit circle and none on it"
                )

    def values(self, first: int, after: int) -> str:
        """Return an interval that contains the parameter on some pieces."""
        found = [_values(Line.of(cell)) for cell in self.claims["cells"][first:after]]
        low, high = min(a for a, _ in found), max(b for _, b in found)
        return f"[{_decimal(low, floor)}, {_decimal(high, ceil)}]"

    def told_points(self) -> Iterator[str]:
        """Give what happens at the points."""
        p = self.model.state[-1]
        for point in self.claims["points"]:
            at: Enclosure = point["at"]
            counts = ""
            if "outside" in point:
                before, after = point["outside"]
                counts = f": {before} outside the unit circle on one side, {after} on the other"
            squared = "symmetry" in self.claims and point["kind"] == "flip"
            yield (
                f"; for an orbit on piece {point['cell']} with {p} in {at} "
                f"{KINDS[point['kind']]}{', of the orbit 1' * squared}{counts}"
            )

    def told_grazes(self) -> Iterator[str]:
        """Give where orbits graze."""
        p, contacts = self.model.state[-1], self.claims["contacts"]
        for graze in self.claims["grazes"]:
            leg = graze["leg"]
            mode, where = contacts[leg - 1]["to"], f"after contact {leg}"
            symmetric = "symmetry" in self.claims
            if symmetric and leg == len(contacts):  # it is seen half a round before
                mode = self.claims["symmetry"]["modes"][mode]
                where = f"before contact 1, after the image of contact {leg}"
            yield (
                f"; from piece {graze['cell']} on the curve goes on, by one more piece, to exactly "
                f"one graze on it, with {p} in {graze['at']}: there, at t in {graze['time']}, "
                f"{where}, '{graze['guard']}' of '{mode}' touches 0, its "
                f"first derivative along the flight 0 and its second positive, and no guard "
                f"vanishes elsewhere but at the contacts{', and at the image' * symmetric}; until "
                f"there it is one of such orbits, just beyond it the guard is negative in between"
            )

    def told_lost(self) -> Iterator[str]:
        """Give where contacts are lost."""
        p = self.model.state[-1]
        for end in self.claims.get("lost", ()):
            contact = self.claims["contacts"][end["contact"] - 1]
            yield (
                f"; from piece {end['cell']} on the curve goes on, by one more piece, to exactly "
                f"one zero of its equations on it at which the speed of contact {end['contact']} "
                f"is 0, with {p} in {end['at']}: there, at t in {end['time']}, "
                f"'{contact['guard']}' of '{contact['mode']}' touches 0, its first derivative "
                f"along the flight 0 and its second positive, the contact leaves the state as it "
                f"is, and no guard vanishes elsewhere but at the contacts; until there it is one "
                f"of such orbits, just beyond it the guard would rise through 0 at this contact"
            )


def _values(line: Line) -> tuple[Fraction, Fraction]:
    """Return what the last unknown lies between on a cell."""
    if line.along == len(line.centre) - 1:
        return line.ends
    low, high = (line.slope[-1] * (s - line.middle) for s in line.ends)
    c, r = line.centre[-1], line.reach[-1]
    return c - r + min(low, high), c + r + max(low, high)


def _decimal(q: Fraction, towards: Callable[[Fraction], int]) -> str:
    """Return a number as a decimal, rounded to this side."""
    units = towards(q * 10**PLACES)
    whole, part = divmod(abs(units), 10**PLACES)
    digits = f"{part:0{PLACES}d}".rstrip("0")
    return f"{'-' if units < 0 else ''}{whole}{'.' if digits else ''}{digits}"
