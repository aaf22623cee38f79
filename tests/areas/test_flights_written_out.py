"""Flights that the prover has written out, for speed or for narrow balls, are those of the data."""

from types import SimpleNamespace

import pytest
import sympy

from cap.areas.folded import backward, next_event, paths
from cap.areas.rings import half_periods
from cap.areas.strips import arcs, hits
from cap.floats.coverings import planar
from cap.floats.search import tori
from cap.flow.formulas import dry
from cap.maps.launch_set import flown
from cap.tori import flights

t, T, u, v, x, A, B, ref, d = sympy.symbols("t T u v x A B ref d", real=True)
f, a = sympy.symbols("f a", positive=True)
UNITS = {"F": sympy.Integer(1), "omega": sympy.Integer(1), "f": f}
DATA = dry(UNITS, lambda q: sympy.Rational(q.numerator, q.denominator))
CLOCK = SimpleNamespace(sin=sympy.sin, cos=sympy.cos, pi=sympy.pi)
RING = {
    "total": lambda p, q: p + q,
    "product": lambda p, q: p * q,
    "scaled": lambda p, c, _error: p * c,
    "moved": lambda p, c, _error: p + c,
}
EXACT = {"bound": lambda _: 0, "size": lambda _: 0, "constant": lambda p, _: p}


def of_the_data(s, start, state, end):
    """Return (x, v) at the time ``end`` on the flight of sign s through a state at ``start``."""
    rest = DATA[s].rest(*state, sympy.sin(start), sympy.cos(start))
    later = (*rest, end - start, sympy.sin(end), sympy.cos(end))
    return DATA[s].position(*later)[0], DATA[s].velocity(*later)[0]


def same(found, true):
    """Return whether two expressions are equal; halves in doubles are halves."""
    return sympy.simplify(sympy.expand(sympy.nsimplify(found) - true)) == 0


def at(time):
    """Return sine and cosine."""
    return sympy.sin(time), sympy.cos(time)


def test_launches():
    """From a wall at 0 with the speed u: in balls, and in doubles."""
    way, speed = of_the_data(1, t, (0, u), T)
    found = flown(f, ((t, *at(t)), u), (T, *at(T)))
    assert same(found[0], way)
    assert same(found[1], speed)
    assert same(hits.velocity(u, sympy.sin(t), T - t, sympy.sin(T), f), speed)
    launch = hits._Launch(t, sympy.cos(t), u - sympy.sin(t), f)
    assert same(hits._place(launch, T - t, sympy.cos(T)), way)
    assert same(hits._velocity(launch, T - t, sympy.sin(T)), speed)


def test_launches_along_an_arc():
    """How fast the way at a fixed time falls, where t and u change at the rates dt and du."""
    way, _ = of_the_data(1, t, (0, u), T)
    dt, du = sympy.symbols("dt du")
    falls = arcs._falls(u, T - t, sympy.cos(t) - f, dt, du)
    assert same(falls, -sympy.diff(way, t) * dt - sympy.diff(way, u) * du)


def test_half_periods():
    """From (x, v) at 0 to the wall a, and from the hit to π; the picture is mirrored then."""
    place, speed = of_the_data(1, 0, (x, v), t)
    assert same(flights.beyond(f, a, (x, v), t, sympy.cos(t)), place - a)
    assert same(flights.speed(f, v, t, sympy.sin(t)), speed)
    end, _ = of_the_data(-1, t, (a, -u), sympy.pi)
    assert same(flights.landing(f, a, u, at(t), sympy.pi - t), -end)


def test_half_periods_in_a_search(monkeypatch):
    """In doubles, from the time of the hit: the state at π."""
    monkeypatch.setattr(tori, "math", CLOCK)
    monkeypatch.setattr(tori.HalfPeriod, "hit", lambda *_: t)
    _, speed = of_the_data(1, 0, (x, v), t)
    place, after = of_the_data(-1, t, (a, -speed), sympy.pi)
    found = tori.HalfPeriod(f, a)(x, v)
    assert same(found[0], -place)
    assert same(found[1], -after)


@pytest.mark.parametrize(("place", "start"), [(0.5, 0.8), (0.7, 1.5), (-0.8, 0.6)])
def test_half_periods_with_derivatives(place, start):
    """In compiled doubles, where coverings are looked for; the derivatives by differences."""
    known, (X, V, *slopes) = planar._half_period(0.4, 1.0, place, start)
    assert known
    hit = planar._hit(0.4, 1.0, place, start, planar._until(0.4, start))
    numbers = {f: 0.4, a: 1.0, x: place, v: start, t: hit}
    wall, speed = of_the_data(1, 0, (x, v), t)
    assert abs(wall.subs(numbers) - 1) < 1e-12
    for found, true in zip((X, V), of_the_data(-1, t, (a, -speed), sympy.pi), strict=True):
        assert abs(found + true.subs(numbers)) < 1e-12
    step = 1e-6
    for k in range(2):
        ends = [planar._half_period(0.4, 1.0, place + d * (1 - k), start + d * k)[1][:2]
                for d in (-step, step)]  # fmt: skip
        for found, low, high in zip(slopes[k::2], *ends, strict=True):
            assert abs((high - low) / (2 * step) - found) < 1e-7


@pytest.mark.parametrize("e", [1, -1])
def test_half_periods_in_both_senses_of_time(monkeypatch, e):
    """In intervals, and in doubles: -x(-t) against time, so the data are asked at -t."""
    monkeypatch.setattr(half_periods, "sin_cos", at)
    monkeypatch.setattr(half_periods, "PI", sympy.pi)
    given = SimpleNamespace(alpha=f, a=a)
    place, speed = of_the_data(1, 0, (e * x, v), e * t)
    assert same(half_periods.gap(x, v, t, given, e), e * place - a)
    place, after = of_the_data(-1, e * t, (e * a, -speed), e * sympy.pi)
    found = half_periods.image(v, t, given, e)
    assert same(found[0], -e * place)
    assert same(found[1], -after)
    monkeypatch.setattr(half_periods, "hit", lambda *_: sympy.Rational(1, 2))
    monkeypatch.setattr(half_periods, "LEAST", -sympy.oo)
    numbers = {v: sympy.Rational(7, 3), f: sympy.Rational(1, 5), a: 1}
    flies = half_periods.flown(0, numbers[v], float(numbers[f]), 1, e)
    for found, true in ((flies.y, -e * place), (flies.v, -after)):
        assert abs(found - true.subs(t, sympy.Rational(1, 2)).subs(numbers)) < 1e-14


@pytest.mark.parametrize(("module", "s"), [(paths, 1), (backward, -1)])
def test_folded_flights(monkeypatch, module, s):
    """s' is the force of the data, p' is s; against time, of a mass that moves left, at -t."""
    for name, operation in (RING | EXACT | {"influence": lambda *_: 0}).items():
        monkeypatch.setattr(module, name, operation, raising=False)
    y = SimpleNamespace(a=f, a_error=0)
    flight = SimpleNamespace(A=A, B=B, ref=ref, errors=(0, 0))
    place, speed = module.seen(y, flight, (t, 0), *at(t)[::-1]) if s > 0 else module.at(
        y, flight, (t, 0), *at(t)[::-1]
    )  # fmt: skip
    (force,) = DATA[s].acceleration(sympy.cos(t))
    assert same(sympy.diff(speed, t), force)
    assert same(sympy.diff(place, t), speed)


@pytest.mark.parametrize("s", [1, -1])
def test_what_comes_next(monkeypatch, s):
    """The same in doubles; forwards friction has the other sign."""
    monkeypatch.setattr(next_event, "math", CLOCK)
    place = next_event.place_at(t, -s * f, A, B, ref)
    speed = next_event.speed_at(t, -s * f, A, ref)
    (force,) = DATA[s].acceleration(sympy.cos(t))
    assert same(sympy.diff(speed, t), force)
    assert same(sympy.diff(place, t), speed)
