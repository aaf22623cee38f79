"""An invariant curve around a cylinder, and orbits of the map on both sides."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cap.checker.kernel.shapes import Enclosure
from cap.checker.system.model import COS
from cap.checker.theorems.ball_curve import BallCurve
from cap.checker.theorems.map_curve import MapCurve
from cap.checker.tori.cylinder import AroundCylinder
from cap.checker.tori.kicked import Kicked
from cap.checker.tori.told import turns
from cap.checker.tori.written import coefficients
from cap.floats.search import spanning
from cap.floats.search.spanning import Array
from cap.pictures.style import BLUE, GREY, ORANGE
from cap.pictures.theorems.parts import curve

TURN = np.linspace(0, 2 * np.pi, 2001)
ORBITS, STEPS = 40, 1200
FAR = 1.2  # above and below, in units of half a turn, or g/ω


def map_curve(theorem: MapCurve, figure: Figure) -> None:
    """Draw the curve, the bounds of its second coordinate, and orbits in floats."""
    given = Kicked.of(theorem.p)
    terms = [(float(c), m.count(COS), len(m) - m.count(COS)) for m, c in given.q.terms.items()]
    at = spanning.Kicked(float(given.b), float(given.c), terms)
    first, second = theorem.p.state
    axes = figure.subplots()
    y = _values(theorem, "second")
    starts = float(y.mean()) + FAR * np.pi * np.linspace(-1, 1, ORBITS)
    _drawn(axes, _values(theorem, "first"), y, _orbits(at, starts))
    _bounded(axes, theorem.claims["bounds"])
    axes.set(xlabel=f"{first}, modulo $2\\pi$", ylabel=second, ylim=(starts[0], starts[-1]))
    map_ = str(theorem.p._replace(torus=False)).replace("of the plane", "of the cylinder")
    _finish(figure, theorem, map_)


def ball_curve(theorem: BallCurve, figure: Figure) -> None:
    """Draw the curve, the bounds of speeds on it, and motions in floats."""
    p = theorem.p
    scale = float(p.g / p.omega)
    axes = figure.subplots()
    v = np.sqrt(2 * _values(theorem, "second"))
    starts = np.linspace(max(0.05, v.min() - FAR), v.max() + FAR, ORBITS)
    angles, heights = _orbits(spanning.Ball(float(p.A * p.omega**2 / p.g)), starts**2 / 2)
    _drawn(axes, _values(theorem, "first"), scale * v, (angles, scale * np.sqrt(2 * heights)))
    _bounded(axes, theorem.claims["speeds"])
    axes.set(xlabel=r"phase $\omega t$ of an impact", ylabel="speed $v$ after it, from the table",
             ylim=(0, scale * starts[-1]))  # fmt: skip
    _finish(figure, theorem, f"a ball on a table: $A$ = {p.A}, $\\omega$ = {p.omega}, $g$ = {p.g}")


def _drawn(axes: Axes, x: Array, y: Array, orbits: tuple[Array, Array]) -> None:
    """Draw a curve (θ + x, y), and orbits."""
    for k, (a, b) in enumerate(zip(*orbits, strict=True)):
        axes.plot(a, b, ".", ms=0.8, mew=0, color=GREY, zorder=1,
                  label="orbits (floats)" if k == 0 else None)  # fmt: skip
    angle = (TURN + x) % (2 * np.pi)
    order = np.argsort(angle)
    words = "invariant curve (proved)"
    axes.plot(angle[order], y[order], color=BLUE, lw=1.4, zorder=3, label=words)
    axes.set_xlim(0, 2 * np.pi)


def _bounded(axes: Axes, claim: Enclosure) -> None:
    """Draw bounds."""
    for k, bound in enumerate((claim.lower, claim.upper)):
        words = "no orbit goes from below both lines to above both, or back (proved)"
        axes.axhline(float(bound), color=ORANGE, lw=0.9, ls="--", zorder=2,
                     label=words if k == 0 else None)  # fmt: skip


def _finish(figure: Figure, theorem: AroundCylinder, what: str) -> None:
    """Add the legend and the heading."""
    figure.legend(loc="outside lower center", ncols=3, fontsize=7.5)
    alpha = turns(theorem.claims)
    words = f"An invariant curve: rotation number {alpha}  (the certificate is VERIFIED)\n{what}"
    figure.suptitle(words, fontsize=10)


def _values(theorem: AroundCylinder, name: str) -> Array:
    """Return the values of a function."""
    return curve(coefficients(theorem.claims["curve"][name]), theorem.hints["places"], TURN)


def _orbits(at: spanning.Oscillating, y: Array) -> tuple[Array, Array]:
    """Return orbits from states one above the other: rows of angles and of second coordinates."""
    x = np.full(len(y), 0.1)
    xs, ys = [x], [y]
    for _ in range(STEPS):
        step = at.image(x, y)
        x, y = (x + step.move) % (2 * np.pi), step.y
        xs.append(x)
        ys.append(y)
    return np.array(xs).T, np.array(ys).T
