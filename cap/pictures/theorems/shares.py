"""The rectangle of a system of one's own whose states rest in time, or do not: its cells."""

from collections.abc import Iterator

from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from cap.checker.kernel.shapes import Enclosure
from cap.checker.resting.fates import FLIES, RESTS
from cap.checker.theorems.contact_basin import ContactBasin
from cap.pictures.style import BLUE, ORANGE


def basin(theorem: ContactBasin, figure: Figure) -> None:
    """Draw the cells, each with what is proved of all its motions; others are left white."""
    claims, axes = theorem.claims, figure.subplots()
    first, second = theorem.p.state
    until = f"t = {float(claims['until']):g}"
    shares = {kind: float(claims[kind]) for kind in ("resting", "flying")}
    kinds = (
        (RESTS, BLUE, f"at rest before {until} (proved): {shares['resting']:.4f} of the area"),
        (FLIES, ORANGE, f"in flight at {until} (proved): {shares['flying']:.4f}"),
    )
    for letter, colour, _ in kinds:
        found = list(cells(theorem, letter))
        axes.add_collection(PatchCollection(found, facecolor=colour, edgecolor=colour, lw=0.1))
    (a, b), (c, d) = ((float(q.lower), float(q.upper)) for q in _sides(theorem))
    axes.set(xlim=(a, b), ylim=(c, d), xlabel=first, ylabel=second)
    axes.set_title(f"states at $t = {float(claims['start']):g}$ in '{claims['mode']}'")
    handles = [Patch(color=colour, label=words) for _, colour, words in kinds]
    handles.append(Patch(facecolor="white", edgecolor="black", lw=0.5, label="nothing is claimed"))
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    figure.suptitle(
        f"Which states come to rest at '{claims['guard']}' in time  (the certificate is VERIFIED)",
        fontsize=10,
    )


def cells(theorem: ContactBasin, letter: str) -> Iterator[Rectangle]:
    """Give the cells of a kind, as they lie in the plane of the two variables."""
    names, claims = theorem.p.state, theorem.claims
    h = theorem.p.modes[claims["mode"]].guards[claims["guard"]].value
    of_height = [z for z in names if h.derivative(z).terms]
    (a, b), (c, d) = ((float(q.lower), float(q.upper)) for q in _sides(theorem))
    for kind, (p, q, r, s) in theorem.cells():
        if kind == letter:
            x, y = ((p, q), (r, s)) if of_height == [names[0]] else ((r, s), (p, q))
            corner = a + (b - a) * x[0], c + (d - c) * y[0]
            yield Rectangle(corner, (b - a) * (x[1] - x[0]), (d - c) * (y[1] - y[0]))


def _sides(theorem: ContactBasin) -> list[Enclosure]:
    """Return the sides of the rectangle."""
    return [theorem.claims["box"][z] for z in theorem.p.state]
