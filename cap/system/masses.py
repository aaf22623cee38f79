"""Several masses on a line with dry friction, pushed by one force, between two walls.

    m_i x_i'' = F cos wt - f_i sgn x_i',    l <= x_1 <= ... <= x_N <= r,    elastic contacts

(eq:Nparticle, eq:Ncollision), f_i = f, or f m_i.  The modes are the signs of the velocities, as
"+-0"; 0 is a mass at rest.  Guards: "hit l", "hit r", "meet i j" of neighbours, "stop i", and
"release i" of a mass at rest to either side.  A contact that cannot close in a mode (the gap grows
there, or nothing moves) is no guard of it.  Contacts may accumulate, where N > 1 also without loss:
no resting mode is named for them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product

from cap.errors import BadInput
from cap.parameters import Parameters
from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import COS, ZERO, Polynomial, Quotient, variable, variables

Signs = tuple[int, ...]
Reset = Mapping[str, Polynomial | Quotient] | Bounce
MOST = 5  # masses: 3^5 modes


def masses(p: Parameters, m: Sequence[Fraction], *, proportional: bool = False) -> System:
    """Return the model of N masses, in order from the left wall; ``proportional``: f_i = f m_i."""
    if not 1 <= len(m) <= MOST or min(m) <= 0:
        raise BadInput(f"give from 1 to {MOST} masses, and positive ones")
    inverse = [Polynomial.of(1 / q) for q in m]
    drags = [p.f * q if proportional else p.f for q in m]
    return _system(p, inverse, drags, lambda signs, i: _bounce(m, signs, i))


def second_mass(p: Parameters, m: Fraction) -> System:
    """Return the model of the masses m and q for all q.

    Its parameters are k = 1/q, a = 2q/(m + q), b = 2m/(m + q), c = (q - m)/(m + q): a collision
    makes (v_1, v_2) to (a v_2 - c v_1, b v_1 + c v_2).
    """
    k, a, b, c = variables("k a b c")
    reset = {"v1": a * _v(1) - c * _v(0), "v2": b * _v(0) + c * _v(1)}
    inverse, drags = [Polynomial.of(1 / m), k], [p.f, p.f]
    return _system(p, inverse, drags, lambda _signs, _i: reset, ("k", "a", "b", "c"))


def _system(
    p: Parameters,
    inverse: Sequence[Polynomial],
    drags: Sequence[Fraction],
    collision: Callable[[Signs, int], Reset],
    parameters: tuple[str, ...] = (),
) -> System:
    """Return the model, from all 1/m_i and f_i, and the resets of neighbours that meet."""
    if not p.conserves:
        raise BadInput("the walls must be elastic, without viscosity: e = 1, mu = 0")
    n = len(inverse)
    state = tuple(f"{kind}{i}" for kind in "xv" for i in range(1, n + 1))
    modes = {
        word(s): Mode(_field(p, inverse, drags, s), dict(_guards(p, drags, collision, s)))
        for s in _signs(n)
    }
    return System(state, Polynomial.of(p.omega), modes, parameters)


def word(signs: Signs) -> str:
    """Return the name of a mode."""
    return "".join("-0+"[s + 1] for s in signs)


def _signs(n: int) -> Iterator[Signs]:
    yield from product((1, 0, -1), repeat=n)


def _x(i: int) -> Polynomial:
    return variable(f"x{i + 1}")


def _v(i: int) -> Polynomial:
    return variable(f"v{i + 1}")


def _field(
    p: Parameters, inverse: Sequence[Polynomial], drags: Sequence[Fraction], signs: Signs
) -> dict[str, Polynomial]:
    """Return the field of a mode."""
    force = variable(COS) * p.F
    rates = {f"x{i + 1}": _v(i) if s else ZERO for i, s in enumerate(signs)}
    return rates | {
        f"v{i + 1}": (force - s * drags[i]) * inverse[i] if s else ZERO for i, s in enumerate(signs)
    }


def _guards(
    p: Parameters, drags: Sequence[Fraction], collision: Callable[[Signs, int], Reset], signs: Signs
) -> Iterator[tuple[str, Guard]]:
    """Yield the guards of a mode with their names."""
    last, force = len(signs) - 1, variable(COS) * p.F
    if signs[0] < 0:
        yield "hit l", _wall(_x(0) - p.l, signs, 0, p.l)
    if signs[last] > 0:
        yield "hit r", _wall(p.r - _x(last), signs, last, p.r)
    for i in range(last):
        if signs[i] >= signs[i + 1] and signs[i : i + 2] != (0, 0):
            yield f"meet {i + 1} {i + 2}", _meeting(signs, i, collision(signs, i))
    for i, s in enumerate(signs):
        if s:
            to = (word(_with(signs, i, -s)), word(_with(signs, i, 0)))
            yield f"stop {i + 1}", Guard(_v(i) * s, to, {f"v{i + 1}": ZERO})
        else:
            for side, name in ((1, "r"), (-1, "l")):
                away = word(_with(signs, i, side))
                yield f"release {i + 1} {name}", Guard(drags[i] - force * side, (away,))


def _wall(h: Polynomial, signs: Signs, i: int, place: Fraction) -> Guard:
    """Return the guard of a wall."""
    reset = {f"x{i + 1}": Polynomial.of(place), f"v{i + 1}": -_v(i)}
    return Guard(h, (word(_with(signs, i, -signs[i])),), reset)


def _meeting(signs: Signs, i: int, reset: Reset) -> Guard:
    """Return the contact of two neighbours, which separate after it, so not with signs + and -."""
    after = ((1, 1), (-1, -1), (-1, 1))
    to = tuple(word(signs[:i] + pair + signs[i + 2 :]) for pair in after)
    return Guard(_x(i + 1) - _x(i), to, reset)


def _bounce(m: Sequence[Fraction], signs: Signs, i: int) -> Reset:
    """Return the reset of two neighbours that meet.

    Where one is at rest L h has no velocity of it, which is 0: the bounce is written with it.
    """
    a, b = f"v{i + 1}", f"v{i + 2}"
    if 0 in signs[i : i + 2]:
        push = (_v(i + 1) - _v(i)) * (2 / (m[i] + m[i + 1]))
        return {a: _v(i) + push * m[i + 1], b: _v(i + 1) - push * m[i]}
    return Bounce(Polynomial.of(1), {a: Polynomial.of(m[i]), b: Polynomial.of(m[i + 1])})


def _with(signs: Signs, i: int, s: int) -> Signs:
    return (*signs[:i], s, *signs[i + 1 :])
