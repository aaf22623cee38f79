"""The homoclinic orbits of a certificate, on the curves of the saddle as floats have them.

The points drawn are proved, each in a box that is smaller than a pixel; the curves are floats.
"""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cap.checker.maps.cones import Cones
from cap.checker.maps.homoclinic import Orbit
from cap.checker.theorems.homoclinic import Homoclinic
from cap.floats.diagnostics.manifold import Manifolds, manifolds
from cap.pictures.style import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    YELLOW,
    stroboscopic,
)
from cap.pictures.theorems.parts import heading, middle, system

LENGTH = 2.5  # of each branch of the curves, in natural units
SPACING = 0.01
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
    for n, orbit in enumerate(theorem.orbits):
        colour, claim = COLOURS[n % len(COLOURS)], theorem.claims["points"][n]
        axes.plot(*states(orbit).T, "o", ms=4.5, mfc=colour, mec=BLACK, mew=0.5, ls="none")
        q = middle(claim["x"]), middle(claim["v"])
        name = f"orbit of $q_{n + 1}$ (proved): {middle(claim['angle']):.4g} degrees"
        axes.plot(*q, "D", ms=7, mfc=colour, mec=BLACK, mew=0.9, ls="none", label=name)
    name = "saddle $P^*$ (proved)"
    axes.plot(*saddle, "s", ms=6, mfc=ORANGE, mec=BLACK, mew=0.8, ls="none", label=name)
    frame(axes, curves)
    stroboscopic(axes)
    figure.legend(loc="outside lower center", ncols=2, handlelength=1.4)
    heading(figure, theorem, "Homoclinic orbits of a saddle")


def states(orbit: Orbit) -> Points:
    """Return the points of an orbit that is proved, each of which lies in a tiny box."""
    return np.array([[float(z.lower) for z in place.point] for place in orbit.places])


def frame(axes: Axes, curves: Manifolds) -> None:
    """Show the unstable curve: the stable one goes far, through orbits that turn."""
    known = curves.unstable[np.isfinite(curves.unstable).all(axis=1)]
    rim = 0.05 * np.ptp(known, axis=0)
    low, high = known.min(axis=0) - rim, known.max(axis=0) + rim
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
