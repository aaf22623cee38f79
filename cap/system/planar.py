"""A planar map as data: the images of both coordinates, polynomials in them and in cos and sin.

*The names* cos and sin stand for those of the first coordinate; pi is the number.  *On a torus*
both coordinates are taken modulo 2 pi, and occur in an image only alone and times an integer.

Wherever a polynomial is asked for, an int, a `Fraction` or an expression of sympy will do.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from cap.errors import BadInput
from cap.system.polynomial import COS, PI, SIN, Polynomial, variable

_NAME = re.compile("[A-Za-z][A-Za-z_0-9]{0,19}", re.ASCII)
_TAKEN = COS, SIN, PI, "t", "omega"


@dataclass(frozen=True)
class Map:
    """A map of the plane, or of a torus; the names of the state are a tuple, or one string.

    Raises `BadInput` unless all parts fit together.
    """

    state: tuple[str, ...]
    image: Mapping[str, Polynomial]
    torus: bool = False

    def __post_init__(self) -> None:
        names = self.state.split() if isinstance(self.state, str) else self.state
        object.__setattr__(self, "state", tuple(names))
        if len({*self.state}) != 2:
            raise BadInput(f"a planar map has two coordinates: {', '.join(self.state)}")
        for z in self.state:
            if not _NAME.fullmatch(z) or z in _TAKEN:
                raise BadInput(f"not a name of a coordinate: {z!r}")
        if not isinstance(self.image, Mapping) or self.image.keys() != {*self.state}:
            raise BadInput(f"give the images of {' and '.join(self.state)}, by their names")
        image = {z: Polynomial.of(self.image[z]) for z in self.state}
        object.__setattr__(self, "image", image)
        for z, q in image.items():
            self._fits(z, q)

    @property
    def derivative(self) -> tuple[tuple[Polynomial, Polynomial], ...]:
        """The rows of the derivative."""
        x, y = self.state
        cos, sin = variable(COS), variable(SIN)
        return tuple(
            (q.derivative(x) - q.derivative(COS) * sin + q.derivative(SIN) * cos, q.derivative(y))
            for q in (self.image[z] for z in self.state)
        )

    def _fits(self, z: str, q: Polynomial) -> None:
        if unknown := sorted(q.variables - {*self.state, COS, SIN}):
            raise BadInput(f"the image of {z} has the unknown {unknown[0]}")
        for monomial, c in q.terms.items():
            powers = {name: k for name, k in monomial if name in self.state}
            alone = len(monomial) == 1 and sum(powers.values()) == 1 and c.denominator == 1
            if self.torus and powers and not alone:
                raise BadInput(f"the image of {z} is none on a torus: it depends on turns")
            if any(k < 0 for name, k in monomial if name == PI):
                raise BadInput(f"the image of {z} is divided by pi: a certificate cannot hold it")
