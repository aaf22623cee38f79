"""An invariant curve around a cylinder, and orbits of the map on both sides."""

import numpy as np
from matplotlib.figure import Figure

from cap.checker.system.model import COS
from cap.checker.theorems.map_curve import MapCurve
from cap.checker.tori.kicked import Kicked
from cap.checker.tori.told import turns
from cap.checker.tori.written import coefficients
from cap.floats.search import spanning
from cap.pictures.style import BLUE, GREY, ORANGE

TURN = np.linspace(0, 2 * np.pi, 2001)
ORBITS, STEPS = 40, 1200
FAR = 1.2  # of a turn above and below


def map_curve(theorem: MapCurve, figure: Figure) -> None:
    """Draw the curve, the bounds of its second coordinate, and orbits in floats."""
    claims, hints = theorem.claims, theorem.hints
    x, y = (_values(claims["curve"][k], hints["places"]) for k in ("first", "second"))
    axes = figure.subplots()
    for k, (a, b) in enumerate(zip(*_orbits(theorem, float(y.mean())), strict=True)):
        axes.plot(a, b, ".", ms=0.8, mew=0, color=GREY, zorder=1,
                  label="orbits (floats)" if k == 0 else None)  # fmt: skip
    angle = (TURN + x) % (2 * np.pi)
    order = np.argsort(angle)
    axes.plot(
        angle[order], y[order], color=BLUE, lw=1.4, zorder=3, label="invariant curve (proved)"
    )
    for k, bound in enumerate((claims["bounds"].lower, claims["bounds"].upper)):
        words = "no orbit goes from below both lines to above both, or back (proved)"
        axes.axhline(float(bound), color=ORANGE, lw=0.9, ls="--", zorder=2,
                     label=words if k == 0 else None)  # fmt: skip
    first, second = theorem.p.state
    axes.set(xlabel=f"{first}, modulo $2\\pi$", ylabel=second, xlim=(0, 2 * np.pi))
    axes.set_ylim(y.mean() - FAR * np.pi, y.mean() + FAR * np.pi)
    figure.legend(loc="outside lower center", ncols=2, fontsize=7.5)
    figure.suptitle(
        f"An invariant curve: rotation number {turns(claims)}  (the certificate is VERIFIED)\n"
        + str(theorem.p._replace(torus=False)).replace("of the plane", "of the cylinder"),
        fontsize=10,
    )


def _values(words: str, places: int) -> spanning.Array:
    """Return the values of a function."""
    parts = [complex(float(f"{a}e-{places}"), float(f"{b}e-{places}"))
             for a, b in coefficients(words)]  # fmt: skip
    weights = np.array([parts[0], *(2 * part for part in parts[1:])])
    k = np.arange(len(weights))
    return np.asarray((np.exp(1j * np.outer(TURN, k)) @ weights).real)


def _orbits(theorem: MapCurve, level: float) -> tuple[spanning.Array, spanning.Array]:
    """Return orbits from states one above the other: rows of angles and of second coordinates."""
    given = Kicked.of(theorem.p)
    terms = [(float(c), m.count(COS), len(m) - m.count(COS)) for m, c in given.q.terms.items()]
    at = spanning.Kicked(float(given.b), float(given.c), terms)
    y = level + FAR * np.pi * np.linspace(-1, 1, ORBITS)
    x = np.full(ORBITS, 0.1)
    xs, ys = [x], [y]
    for _ in range(STEPS):
        y = y + at.kick(x)[0]
        x = (x + at.b * y + at.c) % (2 * np.pi)
        xs.append(x)
        ys.append(y)
    return np.array(xs).T, np.array(ys).T
