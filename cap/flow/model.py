"""The mechanics, once, for any scalar.

    x'' = F cos(ωt) - f sgn(x') - μ x',   l < x < r,   v -> -e v at the walls,   T = 2π/ω

(eq:model with e = 1 and μ = 0; eq:perturbed).  A *flight* is a piece of orbit on which the velocity
has the sign s.  From (x0, v0) at t0, with d = t - t0,

    v(t) = V(t) + (v0 - V(t0)) D(d) - s f h(d),        D(d) = exp(-μd),
    x(t) = X(t) + (x0 - X(t0)) + (v0 - V(t0)) h(d) - s f k(d),

h(d) = (1 - D)/μ and k(d) = (d - h)/μ, which are d and d²/2 for μ = 0, and the forced response

    V(t) = F (ω sin ωt + μ cos ωt)/(ω² + μ²),   X(t) = F ((μ/ω) sin ωt - cos ωt)/(ω² + μ²).

The scalar may be a float, a ball, a jet or a Taylor model.  A moment carries sin ωt and cos ωt
with the time t, because each is used several times.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Generic, NamedTuple, cast

from cap.flow.formulas import Formulas, dry
from cap.parameters import Parameters
from cap.sets.matrix import Matrix
from cap.sets.scalar import S

Relaxation = Callable[[S, S], tuple[S, S, S]]


class Functions(NamedTuple, Generic[S]):
    """What a scalar type must offer beside its arithmetic.

    ``relax(μ, d)`` is (D, h, k) as above, for μ >= 0.
    """

    constant: Callable[[Fraction], S]
    pi: S
    sin_cos: Callable[[S], tuple[S, S]]
    acos: Callable[[S], S]
    sqrt: Callable[[S], S]
    relax: Relaxation[S]


class Moment(NamedTuple, Generic[S]):
    """A time t with sin ωt and cos ωt."""

    t: S
    sin: S
    cos: S


class Constants(NamedTuple, Generic[S]):
    """The constants of the model, as in `cap.parameters.Parameters`, in one scalar type."""

    F: S
    omega: S
    f: S
    l: S
    r: S
    e: S
    mu: S

    @classmethod
    def of(cls, p: Parameters, constant: Callable[[Fraction], S]) -> "Constants[S]":
        """Return the images of the exact parameters."""
        F, omega, f, l, r, e, mu = map(constant, (p.F, p.omega, p.f, p.l, p.r, p.e, p.mu))
        return cls(F, omega, f, l, r, e, mu)


class Flight(NamedTuple, Generic[S]):
    """A flight with velocity sign ``s`` (+1 or -1) that starts at the time ``t``.

    ``x`` and ``v`` are the state at its start less the forced response there.
    """

    s: int
    t: S
    x: S
    v: S


@dataclass(frozen=True, slots=True)
class Oscillator(Generic[S]):
    """The forced oscillator, for states of one scalar type.

    Its constants may stay balls while the states are jets or Taylor models over balls.
    ``F``, ``omega``, ``f``, ``l``, ``r``, ``e``, ``mu`` as above; ``T`` = 2π/ω.  ``sin_cos`` and
    ``relax`` work in the type of the states.  ``viscous`` and ``elastic`` say whether μ may be
    other than 0, and e is exactly 1.  ``F_v`` = Fω/(ω² + μ²), ``F_x`` = F/(ω² + μ²), ``lag`` = μ/ω.
    Without viscosity the flights are those of ``formulas``, by sign, made from the data of
    `cap.system.friction`.  With it they are written here: F_x (lag sin - cos) is narrower, for sets
    of μ, than the two products of the data.

    ``slow_right``, ``slow_left``: on a flight of sign s, p = exp(μt) s v has the derivative
    exp(μt) (s F cos ωt - f), so p has its local minima where s cos ωt = f/F and s sin ωt < 0: at
    ``slow_right`` + kT for s > 0, at ``slow_left`` + kT for s < 0, both in (0, T).  These are also
    the times at which a mass at rest is released to that side.  ``sine`` = sqrt(1 - (f/F)²) is
    -s sin ωt there, ``ratio`` = f/F.
    """

    F: S
    omega: S
    f: S
    l: S
    r: S
    e: S
    mu: S
    viscous: bool
    elastic: bool
    T: S
    F_v: S
    F_x: S
    lag: S
    slow_right: S
    slow_left: S
    ratio: S
    sine: S
    sin_cos: Callable[[S], tuple[S, S]]
    relax: Relaxation[S]
    constant: Callable[[Fraction], Any]
    formulas: dict[int, Formulas[S]] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Make the formulas of these constants."""
        values = {"F": self.F, "omega": self.omega, "f": self.f}
        formulas = {} if self.viscous else dry(values, self.constant)
        object.__setattr__(self, "formulas", formulas)

    @classmethod
    def build(cls, p: Parameters, functions: Functions[S]) -> "Oscillator[S]":
        """Return the oscillator whose constants are the images of the exact parameters ``p``."""
        return cls.over(Constants.of(p, functions.constant), functions)

    @classmethod
    def over(cls, c: Constants[S], functions: Functions[S]) -> "Oscillator[S]":
        """Return the oscillator with these constants, which may be sets of parameters."""
        pi, ratio = functions.pi, c.f / c.F
        angle = functions.acos(ratio)
        zero, one = cast("tuple[object, object]", (0, 1))
        nothing = zero == c.mu  # a set that contains zero and more is not equal to it
        F_x = c.F / (c.omega * c.omega + (0 if nothing else c.mu * c.mu))
        return cls(
            *c,
            viscous=not nothing,
            elastic=one == c.e,
            T=2 * pi / c.omega,
            F_v=c.F / c.omega if nothing else F_x * c.omega,
            F_x=F_x,
            lag=c.mu / c.omega,
            slow_right=(2 * pi - angle) / c.omega,
            slow_left=(pi - angle) / c.omega,
            ratio=ratio,
            sine=functions.sqrt((1 - ratio) * (1 + ratio)),
            sin_cos=functions.sin_cos,
            relax=functions.relax,
            constant=functions.constant,
        )

    def moment(self, t: S) -> Moment[S]:
        """Return the moment at the time ``t``."""
        sin, cos = self.sin_cos(self.omega * t)
        return Moment(t, sin, cos)

    def wall(self, s: int) -> S:
        """Return the wall towards which a flight of sign ``s`` moves: r if s > 0, else l."""
        return self.r if s > 0 else self.l

    def drag(self, s: int) -> S:
        """Return s f."""
        return self.f if s > 0 else -self.f

    def response_velocity(self, at: Moment[S]) -> S:
        """Return V(t)."""
        return self.F_v * (at.sin + self.lag * at.cos if self.viscous else at.sin)

    def response_position(self, at: Moment[S]) -> S:
        """Return X(t)."""
        if not self.viscous:
            return -self.F_x * at.cos
        return self.F_x * (self.lag * at.sin - at.cos)

    def launch(self, s: int, at: Moment[S], x: S, v: S) -> Flight[S]:
        """Return the flight of sign ``s`` through (x, v) at a moment."""
        if not self.viscous:
            t, sin, cos = at
            rest, rest_v = self.formulas[s].rest(x, v, sin, cos)
            return Flight(s, t, rest, rest_v)
        response = self.response_position(at), self.response_velocity(at)
        return Flight(s, at.t, x - response[0], v - response[1])

    def velocity(self, flight: Flight[S], at: Moment[S]) -> S:
        """Return v(t)."""
        (s, start, x, v), (t, sin, cos) = flight, at
        d = t - start
        if not self.viscous:
            return self.formulas[s].velocity(x, v, d, sin, cos)[0]
        drag = self.drag(s)
        decay, h, _ = self.relax(self.mu, d)
        return v * decay + self.response_velocity(at) - drag * h

    def position(self, flight: Flight[S], at: Moment[S]) -> S:
        """Return x(t)."""
        (s, start, x, v), (t, sin, cos) = flight, at
        d = t - start
        if not self.viscous:
            return self.formulas[s].position(x, v, d, sin, cos)[0]
        drag = self.drag(s)
        _, h, k = self.relax(self.mu, d)
        return x + v * h - drag * k + self.response_position(at)

    def forcing(self, at: Moment[S]) -> S:
        """Return F cos ωt."""
        return self.F * at.cos

    def acceleration(self, flight: Flight[S], at: Moment[S]) -> S:
        """Return x''(t) on a flight."""
        if not self.viscous:
            return self.formulas[flight.s].acceleration(at.cos)[0]
        return self.F * at.cos - self.drag(flight.s) - self.mu * self.velocity(flight, at)

    def slow(self, s: int, k: int) -> Moment[S]:
        """Return the k-th moment at which p has a minimum and a rest to the side ``s`` ends."""
        first, sine, cosine = (
            (self.slow_right, -self.sine, self.ratio)
            if s > 0
            else (self.slow_left, self.sine, -self.ratio)
        )
        return Moment(first + k * self.T if k else first, sine, cosine)

    def reflect(self, flight: Flight[S], at: Moment[S], velocity: S) -> Flight[S]:
        """Return the flight that leaves the wall which ``flight`` hits with this velocity."""
        after = -velocity if self.elastic else -self.e * velocity
        return self.launch(-flight.s, at, self.wall(flight.s), after)

    def saltation(self, s: int, velocity: S, cos: S) -> S:
        """Return ((1+e) F cos ωt + (1-e) s f)/v, the lower left entry of a hit's saltation matrix.

        The matrix is ((-e, 0), (this, -e)), v the ``velocity`` just before the hit, s its sign.
        """
        force = self.F * cos
        if self.elastic:
            return 2 * force / velocity
        return (force + self.e * force + (1 - self.e) * self.drag(s)) / velocity

    def hit(self, monodromy: Matrix[S], salt: S) -> Matrix[S]:
        """Return ((-e, 0), (salt, -e)) monodromy."""
        (a, b), (c, d) = monodromy
        if self.elastic:
            return (-a, -b), (salt * a - c, salt * b - d)
        e = self.e
        return (-e * a, -e * b), (salt * a - e * c, salt * b - e * d)

    def turning_factor(self, s: int, cos: S) -> S:
        """Return (|F cos ωt| - f)/(|F cos ωt| + f) for a turn from the sign ``s``; s F cos ωt < 0.

        The saltation matrix of a turn is diag(1, this), because the acceleration jumps by 2f.
        """
        force = -self.F * cos if s > 0 else self.F * cos
        return (force - self.f) / (force + self.f)

    def drift(self, monodromy: Matrix[S], duration: S) -> Matrix[S]:
        """Return ((1, h), (0, D)) monodromy: the derivative of a flight."""
        (a, b), (c, d) = monodromy
        if not self.viscous:
            return (a + duration * c, b + duration * d), (c, d)
        decay, h, _ = self.relax(self.mu, duration)
        return (a + h * c, b + h * d), (decay * c, decay * d)
