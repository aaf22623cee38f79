"""The mechanics, once, for any scalar.

    x'' = F cos(ωt) - f sgn(x'),   l < x < r,   v -> -v at the walls,   T = 2π/ω   (eq:model).

A *flight* is a piece of orbit on which the velocity has the sign s.  On it (eq:flight-closed)

    v(t) = A + (F/ω) sin ωt - s f t,
    x(t) = B + A t - (F/ω²) cos ωt - s f t²/2,

so a flight is the triple (s, A, B).  The scalar may be a float, an array, a ball, a jet or a
Taylor model; times are absolute, and sin ωt, cos ωt are passed in, because each is used twice.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Generic, NamedTuple

from cap.matrix import Matrix
from cap.parameters import Parameters
from cap.scalar import S


class Functions(NamedTuple, Generic[S]):
    """What a scalar type must offer beside its arithmetic."""

    constant: Callable[[Fraction], S]
    pi: S
    sin_cos: Callable[[S], tuple[S, S]]
    acos: Callable[[S], S]
    sqrt: Callable[[S], S]


@dataclass(frozen=True, slots=True)
class Flight(Generic[S]):
    """A flight with velocity sign ``s`` (+1 or -1) and constants ``A``, ``B`` (eq:flight-closed).

    ``drag`` is s f.
    """

    s: int
    drag: S
    A: S
    B: S


@dataclass(frozen=True, slots=True)
class Oscillator(Generic[S]):
    """The forced oscillator, for states of one scalar type.

    Its constants may stay balls while the states are jets or Taylor models over balls.
    ``F``, ``omega``, ``f``, ``l``, ``r``, ``T`` as in eq:model; ``F_v`` = F/ω, ``F_x`` = F/ω².
    ``sin_cos`` maps a scalar angle to the pair (sin, cos) in the same scalar type.

    On a flight of sign s the speed s v has the derivative s F cos ωt - f, so within a period it
    has exactly one minimum, where s cos ωt = f/F and s sin ωt < 0: at ``slow_right`` for s > 0,
    at ``slow_left`` for s < 0.  ``dip`` = (F/ω) sqrt(1 - (f/F)²) is -(F/ω) s sin ωt there.
    """

    F: S
    omega: S
    f: S
    l: S
    r: S
    T: S
    F_v: S
    F_x: S
    slow_right: S
    slow_left: S
    dip: S
    sin_cos: Callable[[S], tuple[S, S]]

    @classmethod
    def build(cls, p: Parameters, functions: Functions[S]) -> "Oscillator[S]":
        """Return the oscillator whose constants are the images of the exact parameters ``p``."""
        constant, pi, sin_cos, acos, sqrt = functions
        omega = constant(p.omega)
        angle = acos(constant(p.f / p.F))
        return cls(
            F=constant(p.F),
            omega=omega,
            f=constant(p.f),
            l=constant(p.l),
            r=constant(p.r),
            T=2 * pi / omega,
            F_v=constant(p.F / p.omega),
            F_x=constant(p.F / p.omega**2),
            slow_right=(2 * pi - angle) / omega,
            slow_left=(pi - angle) / omega,
            dip=constant(p.F / p.omega) * sqrt(constant(1 - (p.f / p.F) ** 2)),
            sin_cos=sin_cos,
        )

    def phase(self, t: S) -> tuple[S, S]:
        """Return (sin ωt, cos ωt)."""
        return self.sin_cos(self.omega * t)

    def wall(self, s: int) -> S:
        """Return the wall towards which a flight of sign ``s`` moves: r if s > 0, else l."""
        return self.r if s > 0 else self.l

    def drag(self, s: int) -> S:
        """Return s f."""
        return self.f if s > 0 else -self.f

    def start(self, s: int, x: S, v: S) -> Flight[S]:
        """Return the flight through (x, v) at t = 0, where sin ωt = 0 and cos ωt = 1."""
        return Flight(s, self.drag(s), v, x + self.F_x)

    def velocity(self, flight: Flight[S], t: S, sin: S) -> S:
        """Return v(t)."""
        return flight.A + self.F_v * sin - flight.drag * t

    def position(self, flight: Flight[S], t: S, cos: S) -> S:
        """Return x(t)."""
        return flight.B + t * (flight.A - flight.drag * t / 2) - self.F_x * cos

    def slowest(self, flight: Flight[S]) -> tuple[S, S]:
        """Return the time in [0, T] at which the speed s v has its minimum, and s v there."""
        if flight.s > 0:
            return self.slow_right, flight.A - self.dip - self.f * self.slow_right
        return self.slow_left, -flight.A - self.dip - self.f * self.slow_left

    def end(self, flight: Flight[S]) -> tuple[S, S]:
        """Return (x, v) at t = T, where sin ωt = 0 and cos ωt = 1."""
        t = self.T
        x = flight.B + t * (flight.A - flight.drag * t / 2) - self.F_x
        return x, flight.A - flight.drag * t

    def reflect(self, flight: Flight[S], t: S, sin: S, cos: S) -> Flight[S]:
        """Return the flight that leaves the wall which ``flight`` hits at time ``t``.

        The velocity changes sign and so does the drag, so A + (F/ω) sin ωt - s f t -> its
        negative with s -> -s gives A -> -A - 2 (F/ω) sin ωt; B follows from x(t) = wall.
        """
        s = -flight.s
        drag = -flight.drag
        a = -flight.A - 2 * self.F_v * sin
        b = self.wall(flight.s) - t * (a - drag * t / 2) + self.F_x * cos
        return Flight(s, drag, a, b)

    def saltation(self, v: S, cos: S) -> S:
        """Return 2F cos(ωt)/v, the lower left entry of the saltation matrix of a wall hit.

        The matrix is ((-1, 0), (2F cos(ωt)/v, -1)), v the velocity just before the hit.
        """
        return 2 * self.F * cos / v

    def kick(self, monodromy: Matrix[S], duration: S, salt: S) -> Matrix[S]:
        """Return ((-1, 0), (salt, -1)) ((1, duration), (0, 1)) monodromy: a flight, then a hit."""
        (a, b), (c, d) = self.drift(monodromy, duration)
        return (-a, -b), (salt * a - c, salt * b - d)

    def drift(self, monodromy: Matrix[S], duration: S) -> Matrix[S]:
        """Return ((1, duration), (0, 1)) monodromy: the derivative of a flight."""
        (a, b), (c, d) = monodromy
        return (a + duration * c, b + duration * d), (c, d)
