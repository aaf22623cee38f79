"""What the proofs about one mass read from its model, and check of it.

A mass slides to the right or to the left, or rests.  Let h be the guard of the wall ahead, u that
of the stop, and q_+, q_- those that end a rest to the right and to the left.  What is checked, as
identities of polynomials:

- h = s (wall - x) for the direction s, and at a hit x becomes the wall, where h = 0;
- u = s v, and v becomes 0 at a stop; a turn or a rest follows;
- L h = -u: the wall comes nearer as long as the mass moves (Lemma M of ``lemmas``);
- (L + mu) u = -q_s: where v = 0 and q_s < 0 the mass moves on to this side, and e^(mu t) u has its
  local minima where q_s decreases through 0 (Lemma C);
- q_+ = f - F cos wt and q_- = f + F cos wt, F a number: f is the friction, F cos wt the force;
- at a wall v becomes -e v and the mass turns; e and mu are the same for both directions.

No mode has another guard, and the modes that follow are those of this list.
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

from cap.checker.kernel.rejection import need
from cap.checker.system.friction import LEFT, REST, RIGHT, STOP, WALL
from cap.checker.system.lemmas import clock_rate, falls_while_positive
from cap.checker.system.model import COS, Guard, Model
from cap.checker.system.polynomial import ZERO, Polynomial, variable

MODES = {1: RIGHT, -1: LEFT}


class OneMass(NamedTuple):
    """The constants of a mass between walls: numbers, or parameters."""

    F: Fraction
    f: Polynomial
    walls: dict[int, Polynomial]
    e: Polynomial
    mu: Polynomial


def one_mass(model: Model) -> OneMass:
    """Return the constants of a model of this form; another one rejects."""
    known = model.state == ("x", "v") and {*model.modes} == {*MODES.values(), REST}
    need(known, "the model is not that of one mass")
    F, f = _force(model)
    sliding = {s: _sliding(model, s, f - variable(COS) * F * s) for s in MODES}
    losses = {lost for _, lost in sliding.values()}
    need(len(losses) == 1, "hits or viscosity are not the same for both directions")
    return OneMass(F, f, {s: wall for s, (wall, _) in sliding.items()}, *losses.pop())


def _force(model: Model) -> tuple[Fraction, Polynomial]:
    """Return F and f, by what holds the mass."""
    rest, half = model.modes[REST], Fraction(1, 2)
    need(all(q == ZERO for q in rest.field.values()), "a mass at rest moves")
    right, left = (rest.guards[name].value for name in MODES.values())
    f, force = (right + left) * half, (left - right) * half
    F = force.terms.get((COS,), Fraction(0))
    need(force == variable(COS) * F, "the force is not F cos wt")
    need(model.is_constant(f), "the friction is not constant")
    released = {name: Guard(rest.guards[name].value, {}, (name,)) for name in MODES.values()}
    need(rest.guards == released, "a release is not to its own side")
    return F, f


def _sliding(
    model: Model, s: int, held: Polynomial
) -> tuple[Polynomial, tuple[Polynomial, Polynomial]]:
    """Return the wall ahead, and e and mu, of the mode with direction s."""
    mode, back, v = MODES[s], MODES[-s], variable("v")
    guards = model.modes[mode].guards
    need({*guards} == {WALL, STOP}, "a flight ends otherwise than with a hit or a stop")
    stop = Guard(v * s, {"v": ZERO}, (back, REST))
    need(guards[STOP] == stop, "a stop is not where v = 0, or not followed by a rest or a turn")
    reset = guards[WALL].reset
    wall, e = reset.get("x", ZERO), -reset.get("v", ZERO).derivative("v")
    hit = Guard((wall - variable("x")) * s, {"x": wall, "v": v * -e}, (back,))
    need(guards[WALL] == hit, "a hit is not at the wall, or v does not become -e v")
    need(model.is_constant(wall) and model.is_constant(e), "a wall moves, or e is not constant")
    approached = falls_while_positive(model, mode, WALL, STOP)
    need(approached, "a wall may be left by a mass that moves towards it")
    mu, rate = clock_rate(model, mode, STOP)
    need(rate == -held, "a mass is not released where it begins to move")
    return wall, (e, mu)
