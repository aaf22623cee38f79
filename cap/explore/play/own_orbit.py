"""The orbit of a state of a model: its position in time, its events, and walls that may move."""

from typing import Any

import numpy as np
from bokeh.models import ColumnDataSource
from bokeh.plotting import figure

from cap.errors import BadInput
from cap.explore.play.mass import LASTS, PERIODS, Moving, over_time
from cap.explore.play.own_sea import own_state
from cap.floats.findings import State
from cap.floats.models.subject import Subject
from cap.floats.models.trajectory import ModelOrbit, orbit
from cap.pictures.style import BLACK, CYCLE

MARKERS = "circle", "triangle", "square", "diamond", "star", "hex"


class OwnOrbit(Moving):
    """The panel of one orbit of a model."""

    def __init__(self, subject: Subject) -> None:
        super().__init__()
        self._orbit: ModelOrbit | None = None
        self._at = subject.system.state.index(subject.plane()[0])
        self._line = ColumnDataSource({"t": [], "z": []})
        self._walls = ColumnDataSource({"t": [], "z": []})
        self._now = ColumnDataSource({"t": [0.0], "z": [0.0]}, name="mass")
        self._beside = ColumnDataSource({"z": []})
        self._events = ColumnDataSource({"t": [], "z": [], "marker": [], "colour": [], "word": []})
        self._drawn(self._time(subject), self._now, "z", space=self._space(subject))

    def show(self, subject: Subject, state: State) -> None:
        """Show the orbit of a state."""
        try:
            given = own_state(subject, state)
            found = orbit(subject, state=given, exactly=True, periods=PERIODS)
        except BadInput as error:
            self.told.text = str(error)
            return
        self._orbit, self._phase = found, 0.0
        T = found.period
        self._line.data = {"t": found.t / T, "z": found.states[:, self._at]}
        walls = [wall for wall in found.walls if wall.variable == found.state[self._at]]
        self._walls.data = {
            "t": [found.t / T for _ in walls],
            "z": [wall.place for wall in walls],
        }
        look = {
            word: (MARKERS[k % len(MARKERS)], CYCLE[k % len(CYCLE)])
            for k, word in enumerate(subject.engine.words)
        }
        self._events.data = {
            "t": found.times / T,
            "z": found.before[:, self._at],
            "marker": [look[str(word)][0] for word in found.words],
            "colour": [look[str(word)][1] for word in found.words],
            "word": [str(word) for word in found.words],
        }
        met = [found.states[:, self._at], *self._walls.data["z"]]
        low, high = min(map(np.min, met)), max(map(np.max, met))
        rim = 0.08 * (high - low) + 1e-9
        shown = self._in_space.x_range
        shown.start, shown.end = float(low - rim), float(high + rim)
        self.told.text = "\n".join(found.lines())
        self.move(0.0)

    def move(self, seconds: float) -> None:
        """Let it move on, by so much of the time of the one who looks."""
        found = self._orbit
        if found is None or not self.moves.active:
            return
        self._phase = (self._phase + seconds / LASTS) % PERIODS
        now = self._phase * found.period
        z = float(np.interp(now, found.t, found.states[:, self._at]))
        self._now.data = {"t": [self._phase], "z": [z]}
        places = [float(np.interp(self._phase, t, wall)) for t, wall in
                  zip(self._walls.data["t"], self._walls.data["z"], strict=True)]  # fmt: skip
        self._beside.data = {"z": places}

    def _time(self, subject: Subject) -> Any:
        shown = over_time(
            250,
            "time t/T  [periods of the clock]",
            subject.plane()[0],
            "In time, with its events and what it can meet",
        )
        shown.multi_line("t", "z", source=self._walls, color="#777777", width=1.5)
        shown.line("t", "z", source=self._line, color=BLACK, width=1.2)
        shown.scatter("t", "z", source=self._events, marker="marker", color="colour", size=8,
                      legend_field="word")  # fmt: skip
        return shown

    def _space(self, subject: Subject) -> Any:
        shown = figure(height=100, width=480, x_range=(-1, 1), y_range=(-1, 1), tools="",
                       title=f"{subject.plane()[0]} now, and what it can meet")  # fmt: skip
        shown.rect(x="z", y=0.0, width=8, height=1.6, width_units="screen",
                   source=self._beside, color="#777777")  # fmt: skip
        return shown
