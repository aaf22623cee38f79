"""Flights that the prover has written out follow from the model: its own code, over symbols.

They stay because they are compiled, or have the form that the checker has, or cancel nothing.
"""

from math import factorial
from types import SimpleNamespace

import numpy as np
import pytest
import sympy

from cap.areas.folded import backward, lines, next_event, paths, polynomials
from cap.areas.folded.laws import laws
from cap.areas.strips import arcs, hits
from cap.floats.engine import flight as floats
from cap.floats.engine import lifted
from cap.flow import flight, kernels
from cap.maps import launch_set
from cap.one_one import closed_form
from cap.system.flight import Scalars, flights
from cap.system.friction import LEFT, RIGHT, friction

t, T, u, f, mu, R = sympy.symbols("t T u f mu R", positive=True)
d = sympy.Symbol("d", positive=True)
A, B, ref = sympy.symbols("A B ref", real=True)
sin, cos = sympy.sin, sympy.cos


def relaxed(rate, span):
    """Return D, h and k."""
    D = sympy.exp(-rate * span)
    h = (1 - D) / rate
    return D, h, (span - h) / rate


def integral(rate, span, k):
    """Return I_k of `cap.system.flight`."""
    return relaxed(-rate, span)[k] if rate else span**k / sympy.Integer(factorial(k))


SYMBOLS = Scalars(lambda q: sympy.Rational(q.numerator, q.denominator), sympy.pi, integral)


def from_the_model(mode, start, times, viscosity=0):
    """Return (x, v) at the second time on the flight of a mode from a state at the first."""
    model = friction().at({"F": 1, "omega": 1} | ({} if viscosity else {"mu": 0}))
    form, values = flights(model, mode), {"f": f, "mu": viscosity}
    clock = [(cos(time), sin(time)) for time in times]
    rest = form.launch(start, clock[0], values, SYMBOLS)
    return form.state_at(rest, times[1] - times[0], clock[1], values, SYMBOLS)


X, W = from_the_model(RIGHT, (0, u), (t, T))


def same(found, truth):
    """Return whether two expressions are equal."""
    return sympy.simplify(sympy.expand(sympy.nsimplify(found - truth), trig=True)) == 0


def phase(time):
    """Return a time with its sine and cosine."""
    return time, sin(time), cos(time)


@pytest.mark.parametrize("mode", [RIGHT, LEFT])
def test_flights(mode):
    """Of ``flow.flight``: from any state; it is also what compiled code calls."""
    state = x, v = sympy.symbols("x v")
    rest, friction_ = (x + cos(t), v - sin(t)), {RIGHT: f, LEFT: -f}[mode]
    found = (
        flight.place(*rest, T - t, friction_ / 2, cos(T)),
        flight.velocity(rest[1], T - t, friction_, sin(T)),
    )
    truth = from_the_model(mode, state, (t, T))
    assert all(same(a, b) for a, b in zip(found, truth, strict=True))
    assert (kernels.place, kernels.velocity) == (flight.place, flight.velocity)


# launches


def test_launches():
    """Of ``launch_set``: way and speed, and how they depend on the launch."""
    found = launch_set.flown(f, (phase(t), u), phase(T))
    assert all(same(a, b) for a, b in zip(found, (X, W), strict=True))
    one, zero = sympy.Integer(1), sympy.Integer(0)
    at, unit = launch_set.Phase(*phase(t)), ((one, zero), (zero, one))
    launches = launch_set.LaunchSet(at, u, unit, (zero, zero), (at, u), own=True)
    system = SimpleNamespace(alpha=f)
    for row, truth in ((launches.slopes(system, T), X), (launches.own_slopes(system), W)):
        assert all(same(a, sympy.diff(truth, z)) for a, z in zip(row, (t, u), strict=True))


# orbits with one hit of each wall


@pytest.mark.parametrize("sign", [1, -1])
def test_starts_of_closed_orbits(sign):
    """Of ``Orbit``: at t = 0, before the hit of the right wall at t1 > 0, or after it."""
    t1 = sympy.Symbol("t1", positive=True) * sign
    at = {"right_hit": lambda: t1, "phases": [(sin(t1), cos(t1))], "speeds": [u], "alpha": f}
    gap, v = closed_form.Orbit.start(SimpleNamespace(**at))
    x, velocity = from_the_model(RIGHT if sign > 0 else LEFT, (0, sign * u), (t1, 0))
    assert same(gap, -x)
    assert same(v, velocity)


def test_least_speeds_of_closed_orbits(monkeypatch):
    """Of ``Orbit.slowest``: where |sin| = sqrt(1 - α²), after the hits of both walls."""
    monkeypatch.setattr(closed_form, "sqrt", sympy.sqrt)
    after, least = sympy.symbols("after:2"), sympy.sqrt(1 - f**2)
    phases, speeds = [(sin(z), cos(z)) for z in (t, T)], sympy.symbols("u1 u2")
    own = SimpleNamespace(alpha=f, phases=phases, speeds=speeds, delays=lambda: after)
    found = closed_form.Orbit.slowest(own)
    for k, (mode, sign) in enumerate(((LEFT, -1), (RIGHT, 1))):
        end = sympy.Symbol("end")
        _, v = from_the_model(mode, (0, sign * speeds[k]), ((t, T)[k], end))
        truth = sign * v.subs(sin(end), -sign * least).subs(end, (t, T)[k] + after[k])
        assert same(found[k], truth)


# strips of launches, in doubles


def test_hits_of_strips():
    """Of ``hits``: x and v, and the slope of the image of a direction in (t, E)."""
    n = hits._Launch(t, cos(t), u - sin(t), f)
    assert same(hits._place(n, T - t, cos(T)), X)
    assert same(hits._velocity(n, T - t, sin(T)), W)
    assert same(hits.velocity(u, sin(t), T - t, sin(T), f), W)


def test_slopes_of_strips(monkeypatch):
    """By the implicit function theorem, with dE = u du at both ends; v is W."""
    monkeypatch.setattr(hits, "math", sympy)
    slope, dt, du = sympy.symbols("slope dt du")
    fall = arcs._falls(u, T - t, cos(t) - f, dt, du)
    assert same(fall, -(sympy.diff(X, t) * dt + sympy.diff(X, u) * du))
    by_t, by_u = (-sympy.diff(X, z) / W for z in (t, u))
    at_t, at_u = (sympy.diff(W, z) + sympy.diff(W, T) * b for z, b in ((t, by_t), (u, by_u)))
    back = hits.pulled(t, u**2 / 2, T, W, f, slope)
    numbers = {t: 0.3, u: 1.1, T: 1.7, f: 0.4, slope: 0.2}
    image = W * (at_t + at_u * back / u) / (by_t + by_u * back / u)
    assert abs(sympy.N((image - slope).subs(numbers), 30)) < 1e-14


# folded flights: friction brakes in ``paths``, and drives, backwards, in the others

PLAIN = {
    "total": lambda p, q: p + q,
    "product": lambda p, q: p * q,
    "scaled": lambda p, a, _: p * a,
    "moved": lambda p, a, _: p + a,
    "widened": lambda p, _: p,
    "bound": lambda _: 0,
    "size": lambda _: 0,
    "constant": lambda a, _: a,
    "influence": lambda *_: 0,
}
Y = SimpleNamespace(a=f, a_error=0)


def folded(push):
    """Return p and s at T of s' = cos t + push, if they are A and B at ref as the modules say."""
    mode = {-f: RIGHT, f: LEFT}[push]  # the field of the mode to the left has + f
    s, p = sin(ref) + A, B - cos(ref)
    return from_the_model(mode, (p, s), (ref, T))


@pytest.mark.parametrize(("module", "push"), [(paths, -f), (backward, f)])
def test_folded_flights(monkeypatch, module, push):
    """Place and speed at an event and at a given time, and B of the flight from p = 0 at T."""
    for name, plain in PLAIN.items():
        if hasattr(module, name):
            monkeypatch.setattr(module, name, plain)
    p, s = folded(push)
    path, span = SimpleNamespace(A=A, B=B, ref=ref, errors=(0, 0)), T - ref
    speed, place, start, from_rest = laws(
        *(PLAIN[n] for n in ("total", "product", "scaled")), push / f
    )
    ours = place(Y, path, span, cos(T)), speed(Y, A, span, sin(T))
    now = module.seen if module is paths else module.at
    at = now(Y, path, (T, 0), cos(T), sin(T))
    for found, truth in (*zip(ours, (p, s), strict=True), *zip(at, (p, s), strict=True)):
        assert same(found, truth)
    assert same(p.subs(B, start(Y, A, span, cos(T))), 0)
    assert same(s.subs(A, from_rest(Y, span, -sin(T))), 0)


def test_senses_of_folded_flights():
    """Friction brakes in ``paths``: its speed falls by a d where the one of ``backward`` grows."""
    none, one = lines.constant(0.0, 0.0), lines.constant(1.0, 0.0)
    y = SimpleNamespace(a=0.25, a_error=0.0)
    assert paths.speed(y, none, one, none)[0] == -0.25
    none, one = polynomials.constant(0.0, 0.0), polynomials.constant(1.0, 0.0)
    assert backward.speed(y, none, one, none)[0] == 0.25


@pytest.mark.parametrize("push", [f, -f])
def test_next_events(monkeypatch, push):
    """Of ``next_event``: both."""
    monkeypatch.setattr(next_event, "math", sympy)
    p, s = folded(push)
    assert same(next_event.place_at(T, push, A, B, ref), p)
    assert same(next_event.speed_at(T, push, A, ref), s)


# single orbits in doubles


@pytest.mark.parametrize("mode", [RIGHT, LEFT])
@pytest.mark.parametrize("viscosity", [0, mu])
@pytest.mark.parametrize("short", [sympy.oo, -1])
def test_engine(monkeypatch, mode, viscosity, short):
    """Of ``engine.flight``: speed, distance, sine and cosine, with differences of d and without."""
    monkeypatch.setattr(floats, "SHORT", short)
    monkeypatch.setattr(floats, "_small", lambda z: (sin(z), 1 - cos(z), z - sin(z)))
    monkeypatch.setattr(floats, "decay", relaxed)
    sign = 1 if mode == RIGHT else -1
    y = SimpleNamespace(alpha=f, m=viscosity)
    n = SimpleNamespace(sign=sign, speed=u, sin=sin(t), cos=cos(t))
    x, v = from_the_model(mode, (0, sign * u), (t, t + d), viscosity)
    truth = sign * v, sign * x, sin(t + d), cos(t + d)
    found = floats.flown.py_func(y, n, d, sin(t + d), cos(t + d))
    assert all(same(a, b) for a, b in zip(found, truth, strict=True))


def test_short_series():
    """Of ``engine.flight``: they are those of sin d, 1 - cos d and d - sin d, to order 10."""
    truth = sin(d), 1 - cos(d), d - sin(d)
    for found, exact in zip(floats._small.py_func(d), truth, strict=True):
        ours = sympy.Poly(sympy.expand(found), d)
        series = sympy.Poly(sympy.series(exact, d, 0, 11).removeO(), d)
        for k in range(11):
            one, two = ours.coeff_monomial(d**k), series.coeff_monomial(d**k)
            assert abs(one - two) <= abs(two) * 1e-15


# hit times


def test_flights_between_hits(monkeypatch):
    """Of ``lifted``: from the first speed the way is ρ, and leads to the last speed."""
    g = {h: np.vectorize(h, otypes=[object]) for h in (sin, cos)}
    monkeypatch.setattr(
        lifted,
        "np",
        SimpleNamespace(where=np.where, arange=np.arange, roll=np.roll, sin=g[sin], cos=g[cos]),
    )
    found = lifted.flights(np.array([[t, T]], dtype=object), lifted.Ratios(f, R))
    assert found.sign.tolist() == [-1, 1]
    begin, end = found.start[0, 0], found.end[0, 0]
    x, v = from_the_model(LEFT, (0, -begin), (t, T))
    assert same(-x, R)
    assert same(-v, end)


def test_least_speeds_and_states():
    """Of ``lifted``: the model has the least speeds at their times, and the states at 0."""
    ratios, times = lifted.Ratios(0.4, 2.0), lifted.seeds(4, 10)
    s, _, start, _ = lifted.flights(times, ratios)
    when, least = lifted.slowest(times, ratios)
    states = lifted.states(times, ratios)
    of = {
        sign: sympy.lambdify((t, T, u, f), from_the_model(mode, (0, sign * u), (t, T)))
        for sign, mode in ((1, RIGHT), (-1, LEFT))
    }
    for i, row in enumerate(times):
        for k, hit in enumerate(row):
            _, v = of[s[k]](hit, when[i, k], start[i, k], ratios.alpha)
            assert abs(s[k] * v - least[i, k]) < 1e-12
        k = int((row % lifted.PERIOD).argmax())
        x, v = of[s[k]](row[k] % lifted.PERIOD, lifted.PERIOD, start[i, k], ratios.alpha)
        place = x if s[k] > 0 else ratios.rho + x
        assert np.abs(states[i] - [place, v]).max() < 1e-12


def test_a_wrong_formula_is_seen():
    """Twice the friction is not the flight of the model."""
    x, w = launch_set.flown(2 * f, (phase(t), u), phase(T))
    assert not same(x, X)
    assert not same(w, W)
