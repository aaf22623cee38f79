"""The parameters on the page: for each a slider, and beside it the exact number as text.

The text is what counts; a slider writes into it.  Both have the same limits: at any parameters
within them the portrait can be followed.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from bokeh.layouts import column, row
from bokeh.models import Slider, TextInput, UIElement

from cap.errors import BadInput
from cap.floats.models.subject import Subject
from cap.parameters import Parameters, exact
from cap.system.files import load

STEP = Fraction(1, 1000)
LIMITS = {  # of each parameter, and how it is called
    "F": ("0.05", "6", "forcing F"),
    "omega": ("0.2", "5", "frequency ω"),
    "f": ("0", "6", "friction f"),
    "l": ("-3", "-0.05", "left wall l"),
    "r": ("0.05", "3", "right wall r"),
    "e": ("0.3", "1", "restitution e"),
    "mu": ("0", "1", "viscosity μ"),
}


class Control:
    """One parameter: a slider in steps of 1/1000, and a text, which may be any exact number."""

    def __init__(
        self,
        name: str,
        value: Fraction,
        limits: tuple[Fraction, Fraction],
        title: str,
        changed: Callable[[], None],
    ) -> None:
        low, high = limits
        self.name, self._changed, self._quiet = name, changed, False
        self.limits = limits
        self.text = TextInput(value=str(value), title="exactly", width=90, name=f"{name}-text")
        self.slider = Slider(
            start=float(low),
            end=float(high),
            step=float(STEP),
            value=float(value),
            title=title,
            format="0.000",
            width=210,
            name=f"{name}-slider",
        )
        self.slider.on_change("value", self._slid)
        self.text.on_change("value", self._typed)

    def read(self) -> Fraction:
        """Return the number in the text; raise `BadInput` if it is none, or past the limits."""
        value, (low, high) = exact(self.text.value), self.limits
        if not low <= value <= high:
            raise BadInput(f"on this page {self.name} is from {low} to {high}: {value}")
        return value

    def _slid(self, _name: str, _old: Any, value: float) -> None:
        """Write the multiple of the step that the slider shows into the text."""
        if not self._quiet:
            self._quietly(lambda: setattr(self.text, "value", _decimal(value)))
            self._changed()

    def _typed(self, _name: str, _old: Any, _new: str) -> None:
        """Let the slider show what was typed, as near as it can."""
        if self._quiet:
            return
        try:
            value = self.read()
        except BadInput:
            pass
        else:
            self._quietly(lambda: setattr(self.slider, "value", float(value)))
        self._changed()

    def _quietly(self, change: Callable[[], None]) -> None:
        self._quiet = True
        try:
            change()
        finally:
            self._quiet = False


def _decimal(value: float) -> str:
    """Return the multiple of the step that is next to a double, as a decimal."""
    return f"{float(round(value / float(STEP)) * STEP):.3f}".rstrip("0").rstrip(".")


class Controls:
    """All parameters of the oscillator.  ``changed`` is called when one has changed."""

    def __init__(self, p: Parameters, changed: Callable[[], None]) -> None:
        given = {name: Fraction(q) for name, q in p.strings().items()}
        self._each = [
            Control(name, given[name], (Fraction(low), Fraction(high)), title, changed)
            for name, (low, high, title) in LIMITS.items()
        ]

    def read(self) -> Parameters:
        """Return the parameters; raise `BadInput` if they are none of an oscillator."""
        return Parameters(**{control.name: control.read() for control in self._each})

    def shown(self) -> UIElement:
        """Return what is shown of them."""
        return listed(self._each)


class OwnControls:
    """All parameters of a model: from 0 to three times the value at first, or around 0."""

    def __init__(self, subject: Subject, changed: Callable[[], None]) -> None:
        self._path, self._last = subject.loaded.path, subject
        self._each = [
            Control(name, value, _around(value), name, changed)
            for name, value in subject.loaded.values.items()
        ]

    def read(self) -> Subject:
        """Return the model at the parameters; raise `BadInput` if it has no system there."""
        values = {control.name: control.read() for control in self._each}
        if values != dict(self._last.loaded.values):
            self._last = Subject(load(self._path, values))
        return self._last

    def shown(self) -> UIElement:
        """Return what is shown of them."""
        return listed(self._each)


def listed(controls: Sequence[Control]) -> UIElement:
    """Return sliders with their texts, below each other."""
    return column([row([control.slider, control.text]) for control in controls])


def _around(value: Fraction) -> tuple[Fraction, Fraction]:
    """Return the limits of a parameter of which only a value is known."""
    far = 3 * abs(value) or Fraction(1)
    return (Fraction(0), far) if value > 0 else (-far, far)
