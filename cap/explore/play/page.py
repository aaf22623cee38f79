"""The page of one tab: its parameters, its portrait, its orbit, its proof.

What it is about, the oscillator or a model, is a `World`: it makes the parts of the page.

Nothing that comes from the browser is run: numbers are read exactly, choices are looked up.
"""

import html
import time
from collections.abc import Callable
from typing import Any, Protocol

from bokeh.document import Document
from bokeh.events import PlotEvent, RangesUpdate, Tap
from bokeh.layouts import column, row
from bokeh.models import ColumnDataSource, Div, LinearColorMapper, UIElement
from bokeh.plotting import figure

from cap.errors import BadInput
from cap.explore.play.mass import Moving
from cap.explore.play.sea import PALETTE, Raster
from cap.explore.play.theorem import WRAPS, Panel
from cap.floats.diagnostics.grid import Box
from cap.floats.findings import State
from cap.pictures.style import RED

FILLS, MOVES, TELLS = 150, 50, 100  # milliseconds
FLOATS = (
    "The portrait and the orbits are floats, from which nothing is proved; what is proved says so."
)


class Controlled(Protocol):
    """The parameters on the page."""

    def read(self) -> Any:
        """Return what the portrait, orbits and proofs are about; raise `BadInput`."""

    def shown(self) -> UIElement:
        """Return what is shown of them."""


class World(Protocol):
    """What a page is about: it makes its parts.  ``begin`` is what is explored at first."""

    head: str
    labels: tuple[str, str]
    begin: Any

    def controls(self, changed: Callable[[], None]) -> Controlled:
        """Return the parameters."""

    def sea(self, p: Any, box: Box | None = None) -> Raster:
        """Return the portrait."""

    def orbit(self) -> Moving:
        """Return the panel of one orbit."""

    def theorem(self, ask: Callable[[], tuple[Any, State | None]]) -> Panel:
        """Return the panel of proofs."""


class Page:
    """What one tab shows, and what it does."""

    def __init__(self, world: World) -> None:
        self.world, self.p, self.state = world, world.begin, None
        self.sea = world.sea(self.p)
        self._changed = False
        self._box: Box | None = None
        self.controls = world.controls(self._noted)
        self.mass, self.theorem = world.orbit(), world.theorem(self._asked)
        self.wrong = Div(text="", styles={"color": RED}, name="wrong", width=310)
        self.ends = Div(text="", width=480, styles={"font-size": "11px"}, name="ends")
        self._image = ColumnDataSource({"image": [], "x": [], "y": [], "dw": [], "dh": []})
        self._marks = ColumnDataSource({"x": [], "v": [], "colour": []})
        self._clicked = ColumnDataSource({"x": [], "v": []})
        self.portrait = self._portrait()
        self._restart()

    state: State | None

    def show(self, document: Document) -> None:
        """Put the page into a document, and let it live."""
        head = Div(text=f"{self.world.head}<br>{FLOATS}", styles={"max-width": "800px"})
        left = column([self.controls.shown(), self.wrong])
        middle = column([self.portrait, self.ends])
        above = row([left, middle, self.mass.shown()], styles=WRAPS)  # below each other on a phone
        document.add_root(column([head, above, self.theorem.shown()]))
        document.title = "cap: play"
        document.add_periodic_callback(self._fill, FILLS)
        document.add_periodic_callback(self._move, MOVES)
        document.add_periodic_callback(self.theorem.look, TELLS)

    def close(self) -> None:
        """End what runs for it."""
        self.theorem.close()

    def _asked(self) -> tuple[Any, State | None]:
        """Return what a proof is about."""
        return self.controls.read(), self.state

    def _noted(self) -> None:
        """Note that a parameter has changed: the next tick begins a new portrait."""
        self._changed, self._box = True, None

    def _restart(self) -> None:
        """Begin the portrait again, at the parameters and in the box that are asked for."""
        self._changed = False
        try:
            p = self.controls.read()
            sea = self.world.sea(p, self._box)
        except BadInput as error:
            self.wrong.text = html.escape(str(error))
            return
        self.wrong.text = ""
        if p != self.p or self.state is None:
            self.state = None
            self._clicked.data = {"x": [], "v": []}
            self.mass.show(p, sea.first)
        self.p, self.sea = p, sea
        self._framed()
        x, v, colour = sea.marks()
        self._marks.data = {"x": x, "v": v, "colour": colour}
        dots = (f'<span style="color:{c}">&#9632;</span> {html.escape(w)}' for c, w in sea.lines())
        self.ends.text = "<br>".join(
            ["Where the orbits go that start here, as far as seen:", *dots]
        )

    def _framed(self) -> None:
        """Show the box of the portrait, unless it is the one that is looked at."""
        if self._box is None:
            left, right, low, high = self.sea.box
            shown = self.portrait
            shown.x_range.start, shown.x_range.end = left, right
            shown.y_range.start, shown.y_range.end = low, high

    def _fill(self) -> None:
        """Fill the portrait a little more."""
        if self._changed:
            self._restart()
        if self.sea.full:
            return
        self.sea.fill()
        left, right, low, high = self.sea.box
        self._image.data = {
            "image": [self.sea.raster.copy()],
            "x": [left],
            "y": [low],
            "dw": [right - left],
            "dh": [high - low],
        }

    def _move(self) -> None:
        """Let the mass move."""
        now = time.perf_counter()
        self.mass.move(min(0.2, now - self._moved))
        self._moved = now

    _moved = 0.0

    def _tapped(self, event: PlotEvent) -> None:
        """Show the orbit of a state that was clicked on."""
        x, v = getattr(event, "x", None), getattr(event, "y", None)
        if not (isinstance(x, int | float) and isinstance(v, int | float)):
            return
        self.state = float(x), float(v)
        self._clicked.data = {"x": [self.state[0]], "v": [self.state[1]]}
        self.mass.show(self.p, self.state)

    def _zoomed(self, event: PlotEvent) -> None:
        """Begin the portrait again in the part that is looked at."""
        ends = [getattr(event, name, None) for name in ("x0", "x1", "y0", "y1")]
        numbers = [float(z) for z in ends if isinstance(z, int | float)]
        if len(numbers) != len(ends) or not (numbers[0] < numbers[1] and numbers[2] < numbers[3]):
            return
        box = numbers[0], numbers[1], numbers[2], numbers[3]
        if max(abs(a - b) for a, b in zip(box, self.sea.box, strict=True)) > 0:
            self._box, self._changed = box, True

    def _portrait(self) -> Any:
        left, right, low, high = self.sea.box
        shown = figure(
            width=480,
            height=460,
            x_range=(left, right),
            y_range=(low, high),
            x_axis_label=self.world.labels[0],
            y_axis_label=self.world.labels[1],
            tools="box_zoom,wheel_zoom,pan,reset,save,tap",
            title="Portrait: click on a state; zoom in",
            name="portrait",
        )
        mapper = LinearColorMapper(palette=PALETTE, low=-0.5, high=len(PALETTE) - 0.5)
        shown.image(image="image", x="x", y="y", dw="dw", dh="dh", source=self._image,
                    color_mapper=mapper)  # fmt: skip
        shown.scatter("x", "v", source=self._marks, marker="circle", size=10,
                      fill_color="colour", line_color="black")  # fmt: skip
        shown.scatter("x", "v", source=self._clicked, marker="x", size=14, line_width=3, color=RED)
        shown.on_event(Tap, self._tapped)
        shown.on_event(RangesUpdate, self._zoomed)
        return shown
