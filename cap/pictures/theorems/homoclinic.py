"""The homoclinic orbits of a certificate, on the curves of the saddle.

The points drawn are proved, each in a box that is smaller than a pixel.  Near the saddle the curves
are proved, too: polynomials with an error below `WIDTH` (`cap.maps.parameterization`); farther out
they are floats.
"""

from fractions import Fraction
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cap.checker.maps.cones import Cones
from cap.checker.maps.homoclinic import Orbit
from cap.checker.theorems.homoclinic import Homoclinic
from cap.errors import NotProved
from cap.floats.diagnostics.manifold import manifolds
from cap.flow.strobe import oscillator
from cap.maps import fixed_point
from cap.maps.cones import directions
from cap.maps.fixed_point import Start
from cap.maps.parameterization import Curve, curve
from cap.maps.stability import real_multipliers
from cap.parameters import Parameters
from cap.pictures.style import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    YELLOW,
    framed,
    stroboscopic,
)
from cap.pictures.theorems.parts import heading, middle, system
from cap.sets import interval, matrix
from cap.sets.interval import Ball

LENGTH = 2.5  # of each branch of the curves, in natural units
SPACING = 0.01
PROVED = Fraction(1, 20)  # the length, in natural units, that is drawn of a curve that is proved
DEGREE, BITS, PLACES = 10, 200, 40  # of its polynomial; of enclosures; digits of the saddle
STEPS = 20  # on each side of the saddle
WIDTH = 1e-5  # in natural units: less than a line is wide
COLOURS = (YELLOW, GREEN, PURPLE, SKY)  # of the orbits, again and again

Points = NDArray[np.float64]


class Proof(Homoclinic):
    """The proof of the checker, as it is; the orbits are kept for the picture."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.orbits: list[Orbit] = []

    def followed(self, cones: Cones, hint: dict[str, Any]) -> Orbit:
        """Return an orbit, with its hits proved."""
        self.orbits.append(super().followed(cones, hint))
        return self.orbits[-1]


def draw(theorem: Proof, figure: Figure) -> None:
    """Draw the homoclinic orbits on the curves of the saddle."""
    p = system(theorem)
    saddle = middle(theorem.claims["x"]), middle(theorem.claims["v"])
    curves = manifolds(p, orbit=saddle, length=LENGTH, spacing=SPACING)
    axes = figure.subplots()
    for points, colour, name in (
        (curves.stable, BLUE, "$W^s$ (floats)"),
        (curves.unstable, RED, "$W^u$ (floats)"),
    ):
        axes.plot(*points.T, color=colour, lw=0.5, alpha=0.7, label=name)
    for points, colour, name in zip(near(theorem, p), (RED, BLUE), ("u", "s"), strict=False):
        axes.plot(*points.T, color=colour, lw=2.2, label=f"$W^{name}$ near $P^*$ (proved)")
    for n, orbit in enumerate(theorem.orbits):
        colour, claim = COLOURS[n % len(COLOURS)], theorem.claims["points"][n]
        axes.plot(*states(orbit).T, "o", ms=4.5, mfc=colour, mec=BLACK, mew=0.5, ls="none")
        q = middle(claim["x"]), middle(claim["v"])
        name = f"orbit of $q_{n + 1}$ (proved): {middle(claim['angle']):.4g} degrees"
        axes.plot(*q, "D", ms=7, mfc=colour, mec=BLACK, mew=0.9, ls="none", label=name)
    name = "saddle $P^*$ (proved)"
    axes.plot(*saddle, "s", ms=6, mfc=ORANGE, mec=BLACK, mew=0.8, ls="none", label=name)
    known = curves.unstable[np.isfinite(curves.unstable).all(axis=1)]
    framed(axes, known.min(axis=0), known.max(axis=0), 0.05)  # the stable one goes far
    stroboscopic(axes)
    figure.legend(loc="outside lower center", ncols=2, handlelength=1.4)
    heading(figure, theorem, "Homoclinic orbits of a saddle")


def near(theorem: Proof, p: Parameters) -> list[Points]:
    """Return the unstable and the stable curve around P*, or neither where it is not proved."""
    size = p.R, p.R * p.omega
    with interval.workprec(BITS):
        try:
            both = [
                [W.at(interval.ball(Fraction(k, STEPS))) for k in range(-STEPS, STEPS + 1)]
                for W in curves(theorem, p, size)
            ]
        except NotProved:
            return []
        units = tuple(map(interval.ball, size))
        if not all(
            z.rad() < WIDTH * u
            for row in both
            for box in row
            for z, u in zip(box, units, strict=True)
        ):
            return []
        return [np.array([(float(x.mid()), float(v.mid())) for x, v in row]) for row in both]


def curves(theorem: Proof, p: Parameters, size: tuple[Fraction, Fraction]) -> list[Curve]:
    """Prove both curves as far as `PROVED`; raises `NotProved` where that fails.

    Φ preserves area, so the product of the multipliers is 1.
    """
    x, v = (middle(theorem.claims[z]) for z in ("x", "v"))
    start = Start.non_sticking(x, v, [middle(window) for window in theorem.hints["hit_times"]])
    osc = oscillator(p)
    saddle = fixed_point.prove(osc, start, PLACES, size)
    jacobian = saddle.orbit.monodromy
    multipliers = real_multipliers(matrix.trace(jacobian), Ball(1))
    (a, b), (c, d) = directions(jacobian, multipliers, size)
    r = interval.ball(PROVED)
    frame = (a * r, b * r), (c * r, d * r)
    return [curve(osc, saddle, frame, multipliers, which, DEGREE) for which in (0, 1)]


def states(orbit: Orbit) -> Points:
    """Return the points of an orbit that is proved, each of which lies in a tiny box."""
    return np.array([[float(z.lower) for z in place.point] for place in orbit.places])
