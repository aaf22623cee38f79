"""What a page can be about: the oscillator, or a model of two variables."""

from __future__ import annotations

import html
from collections.abc import Callable
from typing import Any

from cap.explore.play.controls import Controls, OwnControls
from cap.explore.play.mass import Mass
from cap.explore.play.own_orbit import OwnOrbit
from cap.explore.play.own_sea import OwnSea, confirm
from cap.explore.play.own_theorem import OwnTheorem
from cap.explore.play.page import World
from cap.explore.play.sea import Sea
from cap.explore.play.theorem import Ask, Theorem
from cap.floats.diagnostics.grid import Box
from cap.floats.models.subject import Subject
from cap.parameters import Parameters


class Oscillator:
    """The oscillator with walls, at parameters."""

    head = "<b>A mass between two walls</b>, x'' = F cos(ωt) - f sgn(x') - μx', v → -ev at l and r."
    labels = ("position x  [length]", "velocity x'  [length / time]  at t = 0 mod T")

    def __init__(self, p: Parameters) -> None:
        self.begin = p

    def controls(self, changed: Callable[[], None]) -> Controls:
        """Return the parameters."""
        return Controls(self.begin, changed)

    def sea(self, p: Parameters, box: Box | None = None) -> Sea:
        """Return the portrait."""
        return Sea(p, box)

    def orbit(self) -> Mass:
        """Return the panel of one orbit."""
        return Mass()

    def theorem(self, ask: Ask) -> Theorem:
        """Return the panel of proofs."""
        return Theorem(ask)


class Own:
    """A model of two variables, from a file."""

    def __init__(self, subject: Subject) -> None:
        confirm(subject)
        self.begin = subject
        position, velocity = subject.plane()
        self.labels = position, f"{velocity}  at t = 0 mod T"
        modes = (
            f"{name}: " + ", ".join(f"{z}' = {q}" for z, q in mode.field.items())
            + "".join(f"; {g}: {guard.value} > 0" for g, guard in mode.guards.items())
            for name, mode in subject.system.modes.items()
        )  # fmt: skip
        listed = "<br>".join(html.escape(line) for line in modes)
        self.head = f"<b>{html.escape(subject.loaded.path)}</b>, as it begins:<br>{listed}"

    def controls(self, changed: Callable[[], None]) -> OwnControls:
        """Return the parameters."""
        return OwnControls(self.begin, changed)

    def sea(self, p: Subject, box: Box | None = None) -> OwnSea:
        """Return the portrait."""
        return OwnSea(p, box)

    def orbit(self) -> OwnOrbit:
        """Return the panel of one orbit."""
        return OwnOrbit(self.begin)

    def theorem(self, ask: Ask) -> OwnTheorem:
        """Return the panel of proofs."""
        return OwnTheorem(ask)


def world(about: Any) -> World:
    """Return what a page about the oscillator's parameters, or about a model, is made of."""
    return Own(about) if isinstance(about, Subject) else Oscillator(about)
