"""What pictures show: no line, colour or mark says more, or other, than what was computed."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from matplotlib.colors import to_hex

from cap.explore.commands import COMMANDS
from cap.floats.diagnostics import alignment, attractor, fate, plane
from cap.floats.diagnostics.continuation import continuation
from cap.paper.figure import Run
from cap.paper.sketches import decomposition
from cap.parameters import PAPER
from cap.pictures import diagrams, states, style
from cap.pictures.paper import sketches
from cap.pictures.style import BLUE, blank
from cap.runner import Runner


class Half(Runner):
    """A runner that is interrupted when half of the pieces are done."""

    def map(self, function, tasks, words, *, processes=False):
        """Do half of the tasks, here."""
        del words, processes
        self.interrupted = True
        return [function(task) for task in tasks[: (len(tasks) + 1) // 2]]


@pytest.fixture(scope="module")
def branches():
    """Return the branches over f near the fold at 2F/pi."""
    state = (0.1664, 0.7347)  # of the symmetric orbit
    return continuation(
        replace(PAPER, f=PAPER.f + 1 / 5), orbit=state, range=(0.01, 0.66), points=60, branches=1
    )


def drawn(draw, findings):
    """Return the axes of a picture, and what its legends say."""
    figure = blank((6, 6), 50)
    draw(findings, figure)
    figure.draw_without_rendering()
    legends = [*figure.legends, *(a.get_legend() for a in figure.axes if a.get_legend())]
    return figure.axes, [text.get_text() for legend in legends for text in legend.get_texts()]


def test_the_stable_line_ends_at_the_fold(branches):
    """Solid up to trace 2, dashed from there on."""
    (fold,) = (s for s in branches.special if s.label == "fold")
    (_, traces), _ = drawn(diagrams.continuation, branches)
    lines = [line for line in traces.get_lines() if len(line.get_xdata()) > 2]
    solid = [line.get_ydata() for line in lines if line.get_linestyle() == "-"]
    dashed = [line.get_ydata() for line in lines if line.get_linestyle() == "--"]
    assert max(y.max() for y in solid) == pytest.approx(fold.trace, abs=1e-4)
    assert min(y.min() for y in dashed) == pytest.approx(fold.trace, abs=1e-4)
    assert max(y.max() for y in dashed) > 3


def test_where_the_budget_ends_nothing_else_does(branches):
    """An end has its reason; a branch that is followed no further is said to be just that."""
    _, legend = drawn(diagrams.continuation, branches)
    assert "followed no further" in legend
    assert "end" not in legend
    assert diagrams._mark("end: grazing") == "grazing"
    assert diagrams._mark("sticking border, fold") == "sticking border"
    assert diagrams._mark("end: Newton's method fails") == "end"


@pytest.mark.parametrize("what", ["orbits", "attractors"])
def test_a_map_that_is_interrupted(what):
    """What is not computed is hatched; it is neither none found, nor no oscillator."""
    axes = ("f", "R") if what == "orbits" else ("F", "f")
    findings = plane.plane(PAPER, axes=axes, points=3, what=what, runner=Half())
    assert (findings.code[2] == plane.UNDONE).all()
    assert (findings.code[:2] != plane.UNDONE).all()
    (map_,), legend = drawn(diagrams.plane, findings)
    assert "not computed" in legend
    assert map_.images[0].get_array().mask[2].all()
    assert map_.patch.get_hatch()
    done = replace(findings, complete=True, code=np.maximum(findings.code, 0))
    assert "not computed" not in drawn(diagrams.plane, done)[1]


def test_no_attractor_found():
    """That is not the same as no oscillator."""
    names = plane.ATTRACTORS
    findings = plane.plane(PAPER, axes=("F", "f"), points=2, what="attractors", runner=Half())
    none = np.full((2, 2), names.index("no attractor found"))
    none[0, 0] = plane.OUTSIDE
    _, legend = drawn(diagrams.plane, replace(findings, code=none))
    assert legend == ["no attractor found", "no oscillator"]


def test_both_kinds_are_named():
    """A legend names what it means by both."""
    findings = plane.plane(PAPER, points=2, first=(0.3, 0.4), second=(2.5, 3.0))
    assert drawn(diagrams.plane, findings)[1][0] == "elliptic and saddle"


def covered(axes, row, column):
    """Return whether any image of the axes has a colour at a cell."""
    arrays = [np.ma.masked_invalid(image.get_array()) for image in axes.images]
    return any(not np.ma.getmaskarray(array)[row, column] for array in arrays)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["basin", "attractor", "sali"])
def test_a_grid_that_is_interrupted(name):
    """States that nobody followed have no colour, in no panel: they are hatched."""
    compute, draw, options = {
        "basin": (fate.fate, states.fate, {"points": 40, "periods": 3}),
        "attractor": (attractor.attractors, states.attractors, {"points": 24, "transient": 1}),
        "sali": (alignment.sali, states.alignment, {"points": 40}),
    }[name]
    p = replace(PAPER, F=PAPER.F * 3) if name == "attractor" else PAPER
    findings = compute(p, runner=Half(), **options)
    axes, legend = drawn(draw, findings)
    panels = axes[:2] if name == "basin" else axes[:1]
    for panel in panels:
        assert panel.patch.get_hatch()
        assert not covered(panel, -1, -1)
        assert covered(panel, 0, 0)
    assert name == "sali" or "not computed" in legend
    whole = compute(p, **options)
    axes, legend = drawn(draw, whole)
    assert "not computed" not in legend
    assert all(covered(panel, -1, -1) for panel in axes[: len(panels)])


@pytest.mark.parametrize("name", ["sali", "gali"])
def test_the_colour_bar_is_not_clipped(name):
    """It reaches the largest index there can be, and says that some are below its lower end."""
    findings = getattr(alignment, name)(PAPER, points=40)
    axes, _ = drawn(states.alignment, findings)
    image = axes[0].images[-1]
    low, high = image.get_clim()
    largest = np.log10(np.nanmax(findings.index))
    assert largest <= high < largest + 0.2
    assert low == -16
    assert image.colorbar.extend == "min"
    assert COMMANDS[name].draw == "states:alignment"


def test_islands_have_the_colour_of_what_never_turns():
    """The orbits of an island never turn: the legend says what their colour is."""
    data = decomposition(Run(Runner(1), quick=True))
    figure = blank((6, 6), 50)
    sketches.decomposition(data, figure)
    (axes,) = figure.axes
    islands = {to_hex(c) for each in axes.collections for c in each.get_facecolors()}
    assert islands == {BLUE.lower()}
    (legend,) = figure.legends
    (handle,) = (
        handle
        for handle, text in zip(legend.legend_handles, legend.get_texts(), strict=True)
        if text.get_text().startswith("never turns")
    )
    assert to_hex(handle.get_facecolor()) == BLUE.lower()


def test_powers_of_ten_in_formulas():
    """An exponent is no subtraction."""
    shown = style.parameters(PAPER, varying={"f": [1.06819e-08, 0.5]})
    assert r"f = 1.06819 \cdot 10^{-8}\ldots 0.5" in shown
    shown = style.parameters(replace(PAPER, F=Fraction(10**7)))
    assert r"$F = 1 \cdot 10^{7},\ " in shown
