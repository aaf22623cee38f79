"""What the proofs about one mass read from its model, and how another model is refused."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.flow import laws
from cap.checker.flow.mechanics import Mechanics
from cap.checker.flow.one_mass import one_mass
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.friction import LEFT, REST, RIGHT, STOP, WALL, friction
from cap.checker.system.lemmas import clock_rate
from cap.checker.system.model import COS, SIN, Guard, Mode
from cap.checker.system.polynomial import ONE, ZERO, Polynomial, variable
from checker.altered import rejected, verify
from checker.oscillator import CONSTANTS, oscillator

STORED = Path(__file__).parents[2] / "certificates"
X, V, C, S = map(variable, ("x", "v", COS, SIN))


def test_the_constants_are_read():
    """As numbers, or as parameters."""
    for changes in ({}, {"e": variable("e"), "mu": variable("mu"), "f": variable("f")}):
        all_of_them = CONSTANTS | changes
        mass = one_mass(oscillator(**changes))
        walls = {1: Polynomial.of(3), -1: Polynomial.of(-1)}
        assert mass.F == 2
        assert mass.walls == walls
        for name in ("f", "e", "mu"):
            assert getattr(mass, name) == Polynomial.of(all_of_them[name])


def with_guard(mode, name, **parts):
    """Return the oscillator with a part of a guard changed, by a function or to a value."""
    model = oscillator(mu=Fraction(0)) if parts.pop("inviscid", False) else oscillator()
    guards = dict(model.modes[mode].guards)
    old = guards[name]
    new = {k: q(getattr(old, k)) if callable(q) else q for k, q in parts.items()}
    guards[name] = old._replace(**new)
    return with_mode(model, mode, guards=guards)


def with_mode(model, mode, **parts):
    """Return a model with a part of a mode changed."""
    return replace(model, modes={**model.modes, mode: model.modes[mode]._replace(**parts)})


def with_field(mode, **field):
    """Return the oscillator with another rate of x or v in a mode."""
    model = oscillator()
    return with_mode(model, mode, field={**model.modes[mode].field, **field})


def with_more(mode):
    """Return the oscillator with a further guard in a mode."""
    model = oscillator()
    more = Guard(2 - X, {}, (REST,))
    return with_mode(model, mode, guards={**model.modes[mode].guards, "more": more})


F, f, e, mu = (Polynomial.of(CONSTANTS[name]) for name in ("F", "f", "e", "mu"))
SMALL = Fraction(1, 10**9)
REFUSED = {
    "other state": (replace(oscillator(), state=("v", "x")), "not that of one mass"),
    "another mode": (
        replace(oscillator(), modes=oscillator().modes | {"more": Mode({}, {})}),
        "not that of one mass",
    ),
    "rest moves": (with_field(REST, x=ONE), "a mass at rest moves"),
    "rest accelerates": (with_field(REST, v=C), "a mass at rest moves"),
    "sine in the force": (
        with_guard(REST, RIGHT, value=lambda q: q + S * SMALL),
        "the force is not F cos wt",
    ),
    "square in the force": (
        with_guard(REST, RIGHT, value=lambda q: q + C * C),
        "the force is not F cos wt",
    ),
    "a larger hold": (with_guard(REST, RIGHT, value=lambda q: q + SMALL), "not F cos wt"),
    "friction of x": (
        with_mode(
            oscillator(),
            REST,
            guards={
                RIGHT: Guard(f + X - F * C, {}, (RIGHT,)),
                LEFT: Guard(f + X + F * C, {}, (LEFT,)),
            },
        ),
        "the friction is not constant",
    ),
    "release jumps": (with_guard(REST, LEFT, reset={"x": X + 1}), "not to its own side"),
    "release to the other side": (with_guard(REST, LEFT, to=(RIGHT,)), "not to its own side"),
    "another release": (with_more(REST), "not to its own side"),
    "another guard": (with_more(RIGHT), "otherwise than with a hit or a stop"),
    "spurious factor in a stop": (
        with_guard(LEFT, STOP, value=lambda q: q * (1 + V * V)),
        "a stop is not where v = 0",
    ),
    "stop of other sign": (with_guard(LEFT, STOP, value=V), "a stop is not where v = 0"),
    "stop jumps": (with_guard(RIGHT, STOP, reset={"v": ONE}), "a stop is not where"),
    "stop moves": (with_guard(RIGHT, STOP, reset={"v": ZERO, "x": X + 1}), "a stop is not"),
    "no turn": (with_guard(RIGHT, STOP, to=(REST,)), "not followed by a rest or a turn"),
    "spurious factor at a wall": (
        with_guard(RIGHT, WALL, value=lambda q: q * (1 + X * X)),
        "a hit is not at the wall",
    ),
    "wall of other sign": (with_guard(RIGHT, WALL, value=lambda q: -q), "not at the wall"),
    "beside the wall": (
        with_guard(RIGHT, WALL, reset={"x": Polynomial.of(3 - SMALL), "v": -e * V}),
        "a hit is not at the wall",
    ),
    "nowhere": (with_guard(RIGHT, WALL, reset={}), "a hit is not at the wall"),
    "a push at the wall": (
        with_guard(RIGHT, WALL, reset=lambda q: {**q, "v": q["v"] - 1}),
        "v does not become -e v",
    ),
    "through the wall": (with_guard(RIGHT, WALL, to=(RIGHT,)), "a hit is not at the wall"),
    "wall moves": (
        with_guard(
            RIGHT, WALL, value=variable("r") + C - X, reset={"x": variable("r") + C, "v": -e * V}
        ),
        "a wall moves",
    ),
    "wall depends on v": (
        with_guard(RIGHT, WALL, value=3 + V - X, reset={"x": 3 + V, "v": -e * V}),
        "a wall moves",
    ),
    "e depends on v": (
        with_guard(RIGHT, WALL, inviscid=True, reset={"x": Polynomial.of(3), "v": -V * V}),
        "v does not become -e v",
    ),
    "e depends on x": (
        with_guard(RIGHT, WALL, inviscid=True, reset={"x": Polynomial.of(3), "v": -X * V}),
        "e is not constant",
    ),
    "e depends on the time": (
        with_guard(RIGHT, WALL, inviscid=True, reset={"x": Polynomial.of(3), "v": -C * V}),
        "e is not constant",
    ),
    "x is twice as fast": (with_field(RIGHT, x=V * 2), "left by a mass that moves towards"),
    "x drifts": (with_field(LEFT, x=V + SMALL), "left by a mass that moves towards"),
    "other friction to the left": (
        with_field(LEFT, v=F * C + f + SMALL - mu * V),
        "not released where it begins to move",
    ),
    "other friction to the right": (
        with_field(RIGHT, v=F * C - f - SMALL - mu * V),
        "not released where it begins to move",
    ),
    "other force": (with_field(RIGHT, v=F * C * 2 - f - mu * V), "not released where"),
    "friction forwards": (with_field(RIGHT, v=F * C + f - mu * V), "not released where"),
    "spring": (with_field(RIGHT, v=F * C - f - mu * V - X), "depends on the state"),
    "drag of the square": (with_field(RIGHT, v=F * C - f - V * V), "depends on the state"),
    "drag of the time": (with_field(RIGHT, v=F * C - f - C * V), "depends on the state"),
    "other viscosity": (
        with_field(RIGHT, v=F * C - f - (mu + SMALL) * V),
        "not the same for both directions",
    ),
    "other e": (
        with_guard(LEFT, WALL, reset=lambda q: {**q, "v": q["v"] * (1 + SMALL)}),
        "not the same for both directions",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_another_model_is_refused(name):
    """One thing is changed, and the reason is said."""
    model, why = REFUSED[name]
    with pytest.raises(Rejected, match=why):
        one_mass(model)


def test_the_rate_of_a_guard():
    """By the viscosity it grows, by the force it is driven; that of a wall has no such form."""
    model = oscillator()
    assert clock_rate(model, RIGHT, STOP) == (mu, F * C - f)
    with pytest.raises(Rejected, match="the rate of the guard wall depends on the state"):
        clock_rate(model, RIGHT, WALL)


# certificates and another system


@pytest.fixture
def another(monkeypatch):
    """Give a function that puts another model in the place of the oscillator."""

    def put(model):
        monkeypatch.setattr(laws, "friction", model)
        laws.laws.cache_clear()

    yield put
    laws.laws.cache_clear()


CHANGES = "F", "f", "l", "r", "e", "mu", "omega"


@pytest.mark.parametrize("name", CHANGES)
def test_a_certificate_is_about_its_own_system(another, name):
    """With a constant of the model changed by 1e-9 it is rejected."""
    certificate = json.loads((STORED / "periodic-7.json").read_text("utf-8"))

    def altered(omega, constants):
        if name == "omega":
            return friction(omega + SMALL, constants)
        return friction(omega, constants | {name: constants[name] + SMALL})

    another(friction)
    assert verify(certificate)
    another(altered)
    rejected(certificate, ".")


@pytest.mark.parametrize("name", CHANGES)
def test_a_certificate_without_losses_is_about_its_own_system(monkeypatch, name):
    """The same where the flights are written out."""
    certificate, constants = json.loads((STORED / "elliptic.json").read_text("utf-8")), {}
    read = Mechanics.constants

    def altered(M, p):
        read(M, p._replace(**{key: getattr(p, key) + q for key, q in constants.items()}))

    monkeypatch.setattr(Mechanics, "constants", altered)
    assert verify(certificate)
    constants[name] = SMALL
    rejected(certificate, ".")
