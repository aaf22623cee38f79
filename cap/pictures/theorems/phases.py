"""The map from the time of one release to that of the next, on the interval that it keeps."""

import math

from matplotlib.figure import Figure

from cap.checker.kernel.interval import Interval
from cap.checker.system.passage import Contact
from cap.checker.system.releases import Releases
from cap.checker.theorems.contact_attractor import ContactAttractor
from cap.pictures.style import BLACK, BLUE, GREY, RED

PLACES = 5  # of the entropy


def contact_attractor(theorem: ContactAttractor, figure: Figure) -> None:
    """Draw the map at the ends of its cells, and the fixed point if there is one that attracts."""
    claims, bits, axes = theorem.claims, theorem.hints["bits"], figure.subplots()
    releases = Releases(theorem.p, [Contact(**c) for c in claims["contacts"]], bits)
    low, high = (float(q) for q in claims["interval"][:2])
    points, shift = list[tuple[float, float]](), releases.period * claims["periods"]
    start = claims["interval"].lower
    for cell in theorem.hints["cells"]:
        windows = [Interval.enclosing(w.lower, w.upper, bits) for w in cell["windows"]]
        for t in (start, cell["to"]):
            image = releases.at(Interval.enclosing(t, t, bits), windows).time - shift
            points.append((float(t), float(image.midpoint().lower)))
        start = cell["to"]
    axes.plot(*zip(*points, strict=True), color=BLUE, marker=".", ms=3, lw=0.8,
              label="$G$ at the ends of cells (proved)")  # fmt: skip
    axes.plot([low, high], [low, high], color=GREY, lw=0.6, ls="--")
    if "fixed" in claims:
        at = float(claims["fixed"].lower)
        axes.plot(at, at, "o", ms=6, mfc=RED, mec=BLACK, mew=0.6, ls="none",
                  label="fixed point that attracts (proved)")  # fmt: skip
    axes.set(xlim=(low, high), ylim=(low, high), xlabel="$t$ of a release")
    axes.set_ylabel(f"$t$ of the next, less {claims['periods']} periods")
    figure.legend(loc="outside lower center", ncols=2)
    figure.suptitle(f"{_said(theorem)}\n(the certificate is VERIFIED)", fontsize=10)


def _said(theorem: ContactAttractor) -> str:
    """Return what is proved, in a line; bounds are rounded outwards."""
    claims, one = theorem.claims, 10**PLACES
    if "fixed" in claims:
        return "All orbits of the map of releases tend to one fixed point"
    low, high = claims["entropy"].lower, claims["entropy"].upper
    below, above = math.floor(low * one) / one, math.ceil(high * one) / one
    return f"The entropy of the map of releases is in [{below:.{PLACES}f}, {above:.{PLACES}f}]"
