"""Planar maps given by formulas: polynomials in the coordinates, and in the cosine and the sine of
the first one.

    {"state": ["x", "y"], "image": {"x": [["1"], ["-7/5", "x", "x"], ["1", "y"]],
                                    "y": [["3/10", "x"]]}}

Polynomials are written as those of a system (`system.given`); cos and sin stand for cos x and sin
x.  *On a torus* both coordinates are taken modulo 2 pi: of a monomial with a coordinate there is
only this coordinate, times an integer, so the map does not depend on multiples of 2 pi.  The torus
is cut open: the map is looked at on the square |x|, |y| < pi, and is not defined where the image
has a coordinate that is pi modulo 2 pi.  An orbit that stays in the square is one of the map of the
torus, so a compact invariant set of the one is one of the other, with the same entropy.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from cap.checker.coverings.planar import Image, Planar
from cap.checker.coverings.sums import Sum
from cap.checker.kernel.doubles import PI, Double, cos_sin
from cap.checker.kernel.named import Named, name
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Word
from cap.checker.system.given import POLYNOMIAL, confirm_names, polynomial, printed
from cap.checker.system.model import COS, SIN
from cap.checker.system.model import PI as NUMBER
from cap.checker.system.polynomial import Polynomial, variable

FORMULAS: dict[str, Any] = {
    "state": [name, name],
    "image": Named(POLYNOMIAL, 2),
    "torus": Maybe(Word(("1",))),
}


class Formulas(NamedTuple):
    """The coordinates, their images, and whether they are those of a torus."""

    state: tuple[str, str]
    image: tuple[Polynomial, Polynomial]
    torus: bool

    def rows(self) -> list[tuple[Polynomial, Polynomial]]:
        """Return the rows of the derivative."""
        x, y = self.state
        cos, sin = variable(COS), variable(SIN)
        return [
            (q.derivative(x) - q.derivative(COS) * sin + q.derivative(SIN) * cos, q.derivative(y))
            for q in self.image
        ]

    def __str__(self) -> str:
        """Return the map as people write it."""
        images = (printed(q, self.state[0]) for q in self.image)
        where = "the torus, modulo 2 pi" if self.torus else "the plane"
        return f"({', '.join(self.state)}) -> ({', '.join(images)}) of {where}"


def formulas(given: dict[str, Any]) -> Formulas:
    """Return the map in fields of the shape above; what is no map rejects."""
    state, images = tuple(given["state"]), given["image"]
    confirm_names(state)
    need(images.keys() == {*state}, "not every coordinate has one image")
    image = tuple(polynomial(images[z], state, f"the image of {z}") for z in state)
    if torus := "torus" in given:
        for q in image:
            need(_turns(q, state), "the image depends on multiples of 2 pi: no map of a torus")
    return Formulas(state, image, torus)  # type: ignore[arg-type]


def _turns(q: Polynomial, state: Sequence[str]) -> bool:
    """Return whether coordinates occur alone, each with an integer."""
    with_one = {m: c for m, c in q.terms.items() if not {*m}.isdisjoint(state)}
    return all(len(m) == 1 and c.denominator == 1 for m, c in with_one.items())


class Map(Planar):
    """The map in doubles."""

    def __init__(self, formulas: Formulas) -> None:
        self.torus = formulas.torus
        self.names = *formulas.state, COS, SIN, NUMBER
        (a, b), (c, d) = formulas.rows()
        self.values = [Sum(q, self.names) for q in (*formulas.image, a, b, c, d)]
        self.periodic = any(q.variables & {COS, SIN} for q in formulas.image)

    def image(self, x: Double, y: Double) -> Image:
        """Enclose the map and its derivative; reject what may be at a cut."""
        if self.torus:
            need(_within(x) and _within(y), "a state that may be at a cut")
        cos, sin = cos_sin(x) if self.periodic else (x, x)
        known = x, y, cos, sin, PI
        u, v, a, b, c, d = (value.at(known) for value in self.values)
        if self.torus:
            u, v = _reduced(u), _reduced(v)
        return Image(u, v, ((a, b), (c, d)))


def _within(x: Double) -> bool:
    """Return whether -pi < x < pi is certain."""
    return (PI - x).is_positive() and (PI + x).is_positive()


def _reduced(x: Double) -> Double:
    """Return x modulo 2 pi, in (-pi, pi); reject what may be at a cut."""
    turns = float(math.floor(x.mid / (2 * math.pi) + 0.5))
    result = x - PI * (2.0 * turns)
    need(_within(result), "an image that may be at a cut")
    return result
