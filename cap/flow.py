"""Certified non-sticking orbits over one period: the stroboscopic map on a box of states.

Every statement here holds for all states of a box at once.  A flight of sign s is certified by
`_fly`, which proves that the speed s v is positive on the whole of it.  Hence x is monotone, the
flight cannot return to the wall that it left, and it meets the wall ahead at most once: the zero of
x(t) - wall that `_next_hit` proves is the hit, the only one, and nothing else happens before it.

The same code runs over balls (fast, for small boxes) and Taylor models (tight, for large ones).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, NamedTuple, TypeVar, cast

from cap import interval
from cap.errors import NotProved
from cap.interval import Ball, Box
from cap.jet import Jet, Space
from cap.matrix import Matrix
from cap.model import Flight, Functions, Oscillator
from cap.parameters import Parameters
from cap.scalar import Scalar
from cap.taylor_model import TaylorModel

E = TypeVar("E", bound=Scalar)


def oscillator(parameters: Parameters) -> Oscillator[Ball]:
    """Return the oscillator over balls, its constants enclosed at the current precision."""
    functions = Functions(interval.ball, interval.pi(), Ball.sin_cos, Ball.acos, Ball.sqrt)
    return Oscillator.build(parameters, functions)


def over(osc: Oscillator[Ball], scalar: type[Any]) -> Oscillator[Any]:
    """Return the oscillator with the same ball constants for states of another scalar type."""
    return cast(Oscillator[Any], replace(osc, sin_cos=scalar.sin_cos))


class NoCertainHit(NotProved):
    """The zero of x(t) - wall was not proved in its ``window``; it may lie in ``newton``."""

    def __init__(self, number: int, window: Ball, newton: Ball) -> None:
        self.number, self.window, self.newton = number, window, newton
        sets = {"window": window, "newton": newton}
        super().__init__(f"hit {number}", "no hit is certain in its time window", sets)


class Enclosure(NamedTuple, Generic[E]):
    """What the certification asks of a scalar type whose values are functions on a box.

    ``bound(q)`` is a ball with all values of q; ``widened(q, b)`` adds the ball b to each of them;
    ``curve(osc, flight, window)`` is any function with values near the hit times (it only steers).
    """

    bound: Callable[[E], Ball]
    widened: Callable[[E, Ball], E]
    curve: Callable[[Oscillator[E], Flight[E], Ball], E]


@dataclass(frozen=True, slots=True)
class Hit(Generic[E]):
    """A transverse wall hit: its time, the velocity just before it, cos ωt, enclosed."""

    time: E
    velocity: E
    cos: E


@dataclass(frozen=True, slots=True)
class Orbit(Generic[E]):
    """Enclosures over a box of initial states of everything that happens in [0, T].

    ``s`` is the sign of the first flight; ``hits`` in order of time; ``end`` = Φ(box);
    ``monodromy`` encloses Φ' at every state of the box; ``least_speed`` encloses the minimum of |v|
    over [0, T].
    """

    s: int
    hits: tuple[Hit[E], ...]
    end: tuple[E, E]
    monodromy: Matrix[E]
    least_speed: Ball


def strobe(
    osc: Oscillator[E], state: tuple[E, E], windows: tuple[Ball, ...], kind: Enclosure[E]
) -> Orbit[E]:
    """Prove that all orbits from ``state`` at t = 0 are non-sticking on [0, T]; return enclosures.

    On return, every orbit that starts in the box ``state`` has on [0, T] exactly ``len(windows)``
    wall hits, the k-th at a time in ``windows[k]``, each transverse; its velocity has no zero; it
    ends strictly between the walls; and the returned `Orbit` encloses its hits, its end and Φ'.
    Raises `NotProved` where a step fails: the box or a window may be too large, the orbit another.
    ``windows`` need no trust.
    """
    bound, balls = kind.bound, cast(Oscillator[Ball], osc)
    x, v = state
    s = _direction(balls, bound(x), bound(v))
    flight = osc.start(s, x, v)
    least, now, before = abs(bound(v)), Ball(0), cast(E, 0)
    monodromy = cast(Matrix[E], ((1, 0), (0, 1)))
    hits: list[Hit[E]] = []
    for window in windows:
        hit, sin = _next_hit(osc, flight, window, kind, len(hits) + 1)
        then = bound(hit.time)
        slowest = _fly(osc, flight, (now, then), bound(hit.velocity), bound)
        least = interval.least(least, slowest)
        monodromy = osc.kick(monodromy, hit.time - before, osc.saltation(hit.velocity, hit.cos))
        flight = osc.reflect(flight, hit.time, sin, hit.cos)
        now, before = then, hit.time
        hits.append(hit)
    x, v = osc.end(flight)
    least = interval.least(least, _fly(osc, flight, (now, balls.T), bound(v), bound))
    if not balls.l < bound(x) < balls.r:
        raise NotProved("end", "the orbit may reach a wall once more before T", {"x(T)": bound(x)})
    monodromy = osc.drift(monodromy, osc.T - before)
    return Orbit(s, tuple(hits), (x, v), monodromy, least)


def _direction(osc: Oscillator[Ball], x: Ball, v: Ball) -> int:
    """Prove that the states lie strictly between the walls and move; return the sign of v."""
    if not osc.l < x < osc.r:
        raise NotProved("start", "the box is not between the walls", {"x": x})
    if not (v > 0 or v < 0):
        raise NotProved("start", "the velocity may vanish at t = 0", {"v": v})
    return 1 if v > 0 else -1


def _next_hit(
    osc: Oscillator[E], flight: Flight[E], window: Ball, kind: Enclosure[E], number: int
) -> tuple[Hit[E], E]:
    """Prove that x(t) meets the wall ahead in ``window``, once, with s v > 0; also give sin ωt.

    Parametric interval Newton: let v have no zero on the window, and let m be a time in it, which
    may depend on the state.  If N = m - (x(m) - wall)/v(window) lies in the window, then for each
    state of the box the window holds exactly one zero of x - wall, and this zero lies in N.
    Repeated while the window shrinks markedly.
    """
    wall = osc.wall(flight.s)
    time: E | None = None
    while True:
        sine, _ = (cast(Ball, osc.omega) * window).sin_cos()
        v = kind.bound(osc.velocity(flight, cast(E, window), cast(E, sine)))
        if not (v > 0 if flight.s > 0 else v < 0):
            reason = "the velocity may vanish in the time window of the hit"
            raise NotProved(f"hit {number}", reason, {"window": window, "v": v})
        middle = kind.curve(osc, flight, window)
        gap = kind.bound(osc.position(flight, middle, osc.phase(middle)[1]) - wall)
        better = kind.widened(middle, -gap / v)
        newton = kind.bound(better)
        if not (interval.subset(newton, window) and interval.subset(kind.bound(middle), window)):
            if time is None:
                raise NoCertainHit(number, window, newton)
            break
        time = better
        if 4 * newton.rad() > window.rad():
            break
        window = newton
    sin, cos = osc.phase(time)
    return Hit(time, osc.velocity(flight, time, sin), cos), sin


def _fly(
    osc: Oscillator[E],
    flight: Flight[E],
    times: tuple[Ball, Ball],
    velocity: Ball,
    bound: Callable[[E], Ball],
) -> Ball:
    """Prove that s v > 0 on the flight between ``times``; v is ``velocity`` at the second.

    The caller has proved s v > 0 at the first.  The speed has one local minimum in [0, T], so its
    least value on a flight is attained there or at an end.  Returns an enclosure of the lesser of
    the speed at the second time and, if it lies between, at the local minimum.
    """
    start, end = times
    if not start < end:
        raise NotProved("flight", "events may be out of order", {"start": start, "end": end})
    speed = velocity if flight.s > 0 else -velocity
    if not speed > 0:
        raise NotProved("flight", "the velocity may vanish at its end", {"speed": speed})
    when, minimum = cast(tuple[Ball, E], osc.slowest(flight))
    if when < start or when > end:
        return speed
    slowest = bound(minimum)
    if not slowest > 0:
        sets = {"start": start, "end": end, "least speed": slowest}
        raise NotProved("flight", "the velocity may vanish, so the mass may turn or stick", sets)
    lower = interval.least(speed, slowest)
    return lower if start < when < end else interval.hull(speed, lower)


def strobe_jet(osc: Oscillator[Ball], box: Box, orbit: Orbit[Ball], order: int) -> tuple[Jet, Jet]:
    """Return jets of Φ at every state of ``box``: coefficients enclose the Taylor coefficients.

    ``orbit`` is ``strobe(osc, box, ...)``: it proves that the hit times are analytic functions
    of the state on ``box`` and encloses them.  The jets are in (δx, δv).
    """
    jets = over(osc, Jet)
    x, v = Jet.variables(box, order)
    flight = jets.start(orbit.s, x, v)
    for hit in orbit.hits:
        t = _hit_time_jet(jets, flight, hit.time)
        sin, cos = jets.phase(t)
        flight = jets.reflect(flight, t, sin, cos)
    return jets.end(flight)


def _hit_time_jet(jets: Oscillator[Jet], flight: Flight[Jet], time: Ball) -> Jet:
    """Return the jet of the hit time, whose value is ``time``: it solves x(t) = wall.

    Newton's iteration on jets: an iterate that is right to order k gives one right to 2k + 1.
    The residual at order zero is exactly zero, because ``time`` encloses the true hit times.
    """
    order = flight.A.space.order
    known, t = 0, Jet.constant(time, Space(flight.A.space.variables, 0))
    while known < order:
        known = min(2 * known + 1, order)
        t = t.extended(known)
        near = Flight(flight.s, flight.drag, flight.A.truncated(known), flight.B.truncated(known))
        sin, cos = jets.phase(t)
        gap = (jets.position(near, t, cos) - jets.wall(flight.s)).without_constant()
        t = t - gap / jets.velocity(near, t, sin)
    return t


def _middle(_osc: Oscillator[Ball], _flight: Flight[Ball], window: Ball) -> Ball:
    return interval.point(window)


def _curve(osc: Oscillator[TaylorModel], flight: Flight[TaylorModel], window: Ball) -> TaylorModel:
    """Return nearly the Taylor polynomial of the hit time, by Newton's iteration.  It steers."""
    domain, jets = flight.A.domain, over(cast(Oscillator[Ball], osc), Jet)
    near = Flight(flight.s, osc.drag(flight.s), flight.A.polynomial, flight.B.polynomial)
    t = Jet.constant(interval.point(window), domain.space)
    for _ in range(domain.space.order.bit_length() + 6):
        sin, cos = jets.phase(t)
        t = t - (jets.position(near, t, cos) - jets.wall(flight.s)) / jets.velocity(near, t, sin)
        t = Jet(t.space, [interval.point(c + Ball(0)) for c in t.coefficients])
    return TaylorModel(domain, t, Ball(0))


BALLS = Enclosure[Ball](bound=lambda q: q, widened=Ball.__add__, curve=_middle)
TAYLOR_MODELS = Enclosure[TaylorModel](TaylorModel.bound, TaylorModel.widened, _curve)
