"""The orbit of a state: the mass between its walls, its position in time, and its events."""

from abc import abstractmethod
from typing import Any

import numpy as np
from bokeh.layouts import column
from bokeh.models import ColumnDataSource, PreText, Span, Toggle, UIElement
from bokeh.plotting import figure

from cap.errors import BadInput
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.findings import State
from cap.parameters import Parameters
from cap.pictures.style import BLACK, BLUE, GREEN, ORANGE, PURPLE, RED

PERIODS = 4
LASTS = 3.0  # seconds that the mass takes for a period
MARKS = {
    "hit": ("triangle", BLUE),
    "turn": ("circle", GREEN),
    "stick": ("square", RED),
    "release": ("diamond", ORANGE),
    "capture": ("star", PURPLE),
}
NO_EVENTS: dict[str, list[float]] = {"t": [], "x": []}


class Moving:
    """The panel of one orbit, on which something moves on with the time."""

    def __init__(self) -> None:
        self._phase = 0.0
        self.moves = Toggle(label="the mass moves", active=True, width=140, name="moves")
        self.told = PreText(text="", name="events")
        self.told.styles = {"max-height": "220px", "overflow": "auto", "font-size": "11px"}

    @abstractmethod
    def show(self, p: Any, state: State) -> None:
        """Show the orbit of a state."""

    @abstractmethod
    def move(self, seconds: float) -> None:
        """Let it move on, by so much of the time of the one who looks."""

    def shown(self) -> UIElement:
        """Return what is shown of it."""
        return column([self._in_space, self.moves, self._in_time, self.told])

    def _drawn(self, in_time: Any, now: ColumnDataSource, y: str, *, space: Any) -> None:
        """Keep both figures, with where it is now, and the legend above."""
        in_time.scatter("t", y, source=now, color=RED, size=10, alpha=0.6)
        in_time.legend.orientation, in_time.legend.label_text_font_size = "horizontal", "9px"
        in_time.legend.padding = in_time.legend.spacing = 2
        in_time.add_layout(in_time.legend[0], "above")
        space.toolbar.logo = None
        space.yaxis.visible = space.ygrid.visible = False
        space.scatter(y, 0.0, source=now, marker="square", size=22, color=BLUE)
        self._in_time, self._in_space = in_time, space


def over_time(height: int, x: str, y: str, title: str) -> Any:
    """Return a figure over the time."""
    return figure(
        height=height,
        width=480,
        x_axis_label=x,
        y_axis_label=y,
        tools="pan,wheel_zoom,box_zoom,reset,save",
        title=title,
        name="in-time",
    )


class Mass(Moving):
    """The panel of one orbit."""

    def __init__(self) -> None:
        super().__init__()
        self._orbit: Trajectory | None = None
        self._line = ColumnDataSource({"t": [], "x": []})
        self._now = ColumnDataSource({"t": [0.0], "x": [0.0]}, name="mass")
        self._events = {kind: ColumnDataSource(dict(NO_EVENTS)) for kind in MARKS}
        self._walls = ColumnDataSource({"x": [0.0, 0.0]})
        self._drawn(self._time(), self._now, "x", space=self._space())

    def show(self, p: Parameters, state: State) -> None:
        """Show the orbit of a state."""
        try:
            orbit = trajectory(p, orbit=state, exactly=True, periods=PERIODS)
        except BadInput as error:
            self.told.text = str(error)
            return
        self._orbit, self._phase = orbit, 0.0
        T, kinds = orbit.period, np.array([str(word).split()[0] for word in orbit.words])
        self._line.data = {"t": orbit.t / T, "x": orbit.x}
        for kind, source in self._events.items():
            own = kinds == kind
            source.data = {"t": orbit.times[own] / T, "x": orbit.places[own]}
        self._walls.data = {"x": [float(p.l), float(p.r)]}
        self.told.text = "\n".join(orbit.lines())
        self.move(0.0)

    def move(self, seconds: float) -> None:
        """Let the mass move on, by so much of the time of the one who looks."""
        orbit = self._orbit
        if orbit is None or not self.moves.active:
            return
        self._phase = (self._phase + seconds / LASTS) % PERIODS
        x = float(np.interp(self._phase * orbit.period, orbit.t, orbit.x))
        self._now.data = {"t": [self._phase], "x": [x]}

    def _time(self) -> Any:
        shown = over_time(
            210, "time t/T  [forcing periods]", "position x  [length]", "Position and events"
        )
        shown.line("t", "x", source=self._line, color=BLACK, width=1.2)
        for kind, (marker, colour) in MARKS.items():
            shown.scatter(
                "t", "x", source=self._events[kind], marker=marker, color=colour, size=8,
                legend_label=kind,
            )  # fmt: skip
        return shown

    def _space(self) -> Any:
        shown = figure(
            height=100, width=480, y_range=(-1, 1), tools="", title="The mass between its walls"
        )
        shown.add_layout(Span(location=-0.35, dimension="width", line_color="#777777"))
        shown.rect(x="x", y=0.2, width=8, height=1.4, width_units="screen", source=self._walls,
                   color="#777777")  # fmt: skip
        return shown
