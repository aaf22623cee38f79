"""What the pictures of theorems share: headings, numbers, boxes, orbits with proved events."""

import re
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from cap.certificate.latex import latex
from cap.checker.kernel.shapes import Enclosure
from cap.checker.kernel.theorem import Theorem
from cap.floats.diagnostics.trajectory import trajectory
from cap.parameters import Parameters
from cap.pictures.style import BLACK, BLUE, GREY, UNITS, framed, parameters, star, walls
from cap.pictures.times import MARKS, mark
from cap.words import digits

PALE_BLUE = "#D5E8F3"
DIGITS = 8  # of a number in a picture, rounded outwards
CIRCLE = np.exp(2j * np.pi * np.linspace(0, 1, 241))
FAR = 3.0  # multipliers past it are shown on a logarithmic axis

Points = NDArray[np.float64]


def system(theorem: Theorem, **others: Any) -> Parameters:
    """Return the parameters of a theorem about a mass between two walls."""
    given = theorem.p._asdict() | others
    return Parameters(**{name: given[name] for name in given if name != "masses"})


def heading(figure: Figure, theorem: Theorem, words: str, *, but: tuple[str, ...] = ()) -> None:
    """Say what is proved, at which parameters; ``but`` those that are not given."""
    more = ""
    if "masses" in theorem.p._fields:
        more = f", masses {', '.join(map(str, theorem.p.masses))}"
    given = parameters(system(theorem), but=but)
    figure.suptitle(f"{words}  (the certificate is VERIFIED)\n{given}{more}", fontsize=10)


def middle(claim: Enclosure) -> float:
    """Return the middle of an enclosure, for a point that is drawn."""
    return float((claim.lower + claim.upper) / 2)


def number(claim: Enclosure | Fraction, count: int = DIGITS) -> str:
    """Return a number claimed with so many digits, rounded outwards: 0.1027[1..2]."""
    if isinstance(claim, Enclosure) and claim.lower == claim.upper and len(claim.text[0]) <= count:
        return f"${claim.text[0]}$"
    text = latex(claim, count)
    found = re.fullmatch(r"\[(\S+), (\S+)\](.*)", text)
    if not found:
        return f"${text}$"
    low, high, power = found.groups()
    common = digits(low, high) if "." in low and "." in high else f"[{low}, {high}]"
    return f"${common.replace('..', chr(92) + 'ldots ')}{power}$"


def box(axes: Axes, sides: Sequence[Enclosure], words: str | None, **look: Any) -> None:
    """Draw a box of two sides, and name it."""
    (a, b), (c, d) = ((float(side.lower), float(side.upper)) for side in sides)
    shown: dict[str, Any] = {"fc": PALE_BLUE, "ec": BLUE, "lw": 0.8, "zorder": 0.5} | look
    axes.add_patch(Rectangle((a, c), b - a, d - c, label=words, **shown))


def around(axes: Axes, sides: Sequence[Enclosure], part: float = 0.35) -> None:
    """Show a box and what is around it."""
    low, high = ([float(getattr(side, end)) for side in sides] for end in ("lower", "upper"))
    framed(axes, low, high, part, 0)


def in_time(
    axes: Axes,
    p: Parameters,
    state: tuple[float, float],
    events: Sequence[tuple[str, Enclosure]],
    periods: float,
) -> None:
    """Draw the orbit of a state as a curve in floats, and the proved times of its events on it."""
    found = trajectory(p, orbit=state, exactly=True, periods=periods)
    t = found.t / found.period
    axes.plot(t, found.x, color=BLACK, lw=0.9, label="orbit (floats)")
    walls(axes, p)
    named = set[str]()
    for word, time in events:
        kind = word if word in MARKS else word.split()[0]
        at = middle(time) / found.period
        place = {"hit r": float(p.r), "hit l": float(p.l)}.get(word)
        place = float(np.interp(at, t, found.x)) if place is None else place
        words = "_" if kind in named else f"{kind.replace('hit', 'hit of')} (time proved)"
        mark(axes, (np.array([at]), np.array([place])), MARKS[kind], words)
        named.add(kind)
    axes.set_xlim(0, periods)
    axes.set_xlabel(UNITS["t"])
    axes.set_ylabel(UNITS["x"])


def multipliers(axes: Axes, values: Sequence[complex], told: str) -> None:
    """Draw multipliers beside the unit circle, and tell them; far ones on a logarithmic axis."""
    axes.plot(CIRCLE.real, CIRCLE.imag, color=GREY, lw=0.8)
    axes.axhline(0, color=GREY, lw=0.5)
    z = np.array(values)
    axes.plot(z.real, z.imag, "o", ms=6, mfc=BLUE, mec=BLACK, mew=0.7, ls="none")
    far = max(1.6, 1.3 * float(np.abs(z).max()))
    if far > FAR:
        axes.set_xscale("symlog", linthresh=1)
    else:
        axes.set_aspect("equal")
    axes.set_xlim(-far if z.real.min() < -1 else -1.6, far if z.real.max() > 1 else 1.6)
    axes.set_ylim(-1.6, 1.6)
    axes.set_xlabel("real part")
    axes.set_ylabel("imaginary part")
    axes.set_title(f"multipliers (proved), and the unit circle\n{told}")


def plane(axes: Axes) -> None:
    """Label the axes of the plane of states at t = 0 mod T."""
    axes.set_xlabel(UNITS["x"])
    axes.set_ylabel(r"$\dot x$ at $t \equiv 0$ mod $T$  [length / time]")


def point(axes: Axes, claims: dict[str, Any], words: str | None = "fixed point (proved)") -> None:
    """Mark a state that is proved."""
    star(axes, (middle(claims["x"]), middle(claims["v"])), words)


def curve(coefficients: Sequence[tuple[int, int]], places: int, angles: Points) -> Points:
    """Return the values of a real Fourier series at angles, given from 0 on in 10^-places."""
    parts = [complex(float(f"{a}e-{places}"), float(f"{b}e-{places}")) for a, b in coefficients]
    weights = np.array([parts[0], *(2 * part for part in parts[1:])])
    return np.asarray((np.exp(1j * np.outer(angles, np.arange(len(weights)))) @ weights).real)
