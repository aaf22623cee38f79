"""How a variable of the state moves on the flights of a mode: closed forms, by exact algebra.

Let the field of the mode be A z + b + c cos wt + s sin wt, where A, b, c, s are constant on the
flights: numbers and parameters.

*The response* U cos wt + V sin wt solves z' = A z + c cos wt + s sin wt.  Let the field of each
variable contain only itself, with a factor lambda, and variables that come after it in the state.
With the responses of these in c and s, w V = lambda U + c and -w U = lambda V + s, that is

    V = (w c - lambda s)/(w^2 + lambda^2),      U = -(lambda c + w s)/(w^2 + lambda^2).

*The rest* y = z - response has y' = A y + b.  Let g_0 be one of its components and g_(j+1) the
derivative of g_j along this field.  If g_(k+1) = lambda g_k with a constant lambda, then g_k grows
like e^(lambda t), and by Taylor's formula with its remainder as an integral, with d = t - t_0,

    g_0(t) = g_0 + g_1 d + ... + g_(k-1) d^(k-1)/(k-1)! + g_k d^k phi_k(lambda d),

g_j on the right at t_0; phi_k(0) = 1/k!, and for lambda /= 0 see ``exponential``.  There is no
division by lambda, so it may be a parameter that is known in an interval around 0.

*A flight* is so a polynomial: in the rests at t_0, named as the variables of the state, in d, cos,
sin, the parameters and, if a lambda is not zero, in phi_k(lambda d) and, if it is a parameter, in
1/(w^2 + lambda^2).
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial
from typing import NamedTuple

from cap.checker.kernel.rejection import Rejected, need
from cap.checker.system.model import CLOCK, COS, SIN, Model
from cap.checker.system.polynomial import ZERO, Polynomial, variable

ELAPSED, GROWTH, INVERSE = "d", ("exp", "phi 1", "phi 2"), "1/(w^2 + lambda^2)"


class Course(NamedTuple):
    """One component of the rest: g_0, ..., g_k and lambda."""

    terms: tuple[Polynomial, ...]
    rate: Polynomial


def course(model: Model, mode: str, variable: Polynomial) -> Course:
    """Return the course of one variable of the state in a mode."""
    field = {z: q.without(CLOCK) for z, q in model.modes[mode].field.items()}
    terms = [variable]
    while len(terms) <= len(model.state) + 1:
        last = terms[-1]
        rate = sum((last.derivative(z) * q for z, q in field.items()), ZERO)
        for factor in (ZERO, *(q.derivative(z) for z, q in field.items())):
            if rate == last * factor and model.is_constant(factor):
                return Course(tuple(terms), factor)
        terms.append(rate)
    raise Rejected(f"the flights in the mode {mode} are not of a known form")


def response(model: Model, mode: str, z: str) -> Polynomial:
    """Return the response of a variable of the state in a mode."""
    field, w = model.modes[mode].field[z], model.omega
    later = model.state[model.state.index(z) + 1 :]
    factors = {y: field.derivative(y) for y in (z, *later, *CLOCK)}
    linear = all(map(model.is_constant, factors.values()))
    rest = field - sum((variable(y) * a for y, a in factors.items()), ZERO)
    need(linear and model.is_constant(rest), f"the field of {z} in the mode {mode} is not linear")
    forced = sum((response(model, mode, y) * factors[y] for y in later), ZERO)
    c, s = (forced.derivative(y) + factors[y] for y in CLOCK)
    rate = factors[z]
    square = rate * rate + w**2
    inverse = variable(INVERSE) if square.variables else Polynomial.of(1 / square.number)
    U, V = -(c * rate + s * w), c * w - s * rate
    return (variable(COS) * U + variable(SIN) * V) * inverse


def flight(model: Model, mode: str, z: str) -> Polynomial:
    """Return a variable of the state on the flights of a mode."""
    *terms, last = (found := course(model, mode, variable(z))).terms
    k, total = len(terms), response(model, mode, z)
    for n, term in enumerate(terms):
        total += term * after(n)
    grown = variable(GROWTH[k]) * factorial(k) if found.rate.terms else Polynomial.of(1)
    return total + last * after(k) * grown


def after(n: int) -> Polynomial:
    """Return d^n/n!."""
    return Polynomial({(ELAPSED,) * n: Fraction(1, factorial(n))})
