"""Errors of a flight are carried over an event: what begins a little elsewhere is within them."""

from __future__ import annotations

import math
from itertools import product

import pytest

from cap.checker.folded import events, motion, paths
from cap.checker.folded.events import after, event
from cap.checker.kernel import line
from cap.checker.kernel import polynomials as q
from checker.test_checker_folded_guards import AHEAD, BACK, BEGUN, LINES, falling, flight, path

HITS = [(-1.0, 2.0, 0.0), (-0.5, 1.5, -0.8), (-1.5, 1.4, -0.3), (-0.9, 2.5, 0.8)]
TURNS = [(-9.0, falling(T), BEGUN) for T in (2.3, 3.0, 4.0)]
FAST = [(-1.5, 4.0, 0.0), (-0.8, 3.0, 0.9)]
WIDE = [(0.2, 0.0), (0.0, 0.3), (0.1, 0.2)]
RADII = [(1e-3, 0.0), (0.0, 1e-3), (0.02, 0.01), (0.01, 0.02)]


def one_variable(state, n=(0.0, 0.0), r=(0.0, 0.0)):
    """Return the next flight of a state, of which A and B are moved by n and wrong by r."""
    f = path(*state, r)
    A, B = (line.exact(line.moved(z, a, 0.0)) for z, a in zip((f.A, f.B), n, strict=True))
    f = f._replace(A=A, B=B)
    e = event(LINES, f)
    if e.p is None:
        paths.rested(LINES, e)
    return "stop" if e.p else "hit", e.ends[0], after(LINES, f, e)


def two_variables(y, state, n=(0.0, 0.0), r=(0.0, 0.0)):
    """Return the same for a flight in two variables."""
    f = flight(*state, r)
    f = f._replace(A=q.moved(f.A, n[0], 0.0), B=q.moved(f.B, n[1], 0.0))
    e = event(y, f)
    return "stop" if e.p else "hit", e.ends[0], after(y, f, e)


@pytest.mark.parametrize("angle", [0.0, 0.4, 2.0])
def test_the_influence_of_errors_on_the_place(angle):
    """D u + w for all errors that are carried, in one variable and in two; and little more."""
    c, s = math.cos(angle), math.sin(angle)
    for d, (r1, r2) in product((-1.5, 0.1, 2.0), ((0.01, 0.02), (0.02, 0.0), (0.0, 0.01))):
        errors = abs(c) * r1 + abs(s) * r2, abs(s) * r1 + abs(c) * r2
        known = {"C": (c, -s, s, c), "R": (r1, r2), "errors": errors}
        for far in (0.0, 0.1):
            truth = max(
                abs((d + e) * (c * x - s * y) + s * x + c * y)
                for e, x, y in product((-far, far), (-r1, r1), (-r2, r2))
            )
            one = LINES.influence(path(-1, 1)._replace(**known), d, far)
            two = AHEAD.influence(flight(-1, 1)._replace(**known), d, far)
            for found in (one, two):
                assert truth <= found <= truth + 2.1 * far * errors[0] + 1e-12


@pytest.mark.parametrize("errors", [(1e-3, 1e-9), (1e-9, 1e-3)])
def test_what_is_left_of_models_is_carried(errors):
    """A and B of the next flight are polynomials; each is wrong by what was left of its model."""
    f = flight(-1, 1)._replace(C=(1.0, 0.0, 0.0, 1.0), R=(0.0, 0.0), errors=(0.0, 0.0))
    models, same = tuple(q.model(e, one=1.0) for e in errors), (0.0, 0.0)
    times = (1.0, 1.0), (1.0, 1.0 - math.pi)
    found = motion.followed(AHEAD, f, *times, models, ((1.0, 0.0), same, same, (1.0, 0.0)))
    assert found.A == found.B == q.model(one=1.0)
    for error, carried in zip(errors, found.errors, strict=True):
        assert error <= carried <= error * (1 + 1e-9)


def constant(model):
    """Return the constant coefficient of a model in one variable or two."""
    return model[0] if isinstance(model[0], float) else model[0][0]


def moved(g, ref, drag):
    """Return A and B of a flight for another ref, but for errors."""
    d = ref - g.ref
    A, B = constant(g.A), constant(g.B)
    s = math.sin(ref) - drag * d + A
    p = -math.cos(ref) - drag * d * d / 2 + A * d + B
    return s - math.sin(ref), p + math.cos(ref)


def check(following, state, radii, drag, kind):
    """Compare flights of moved states with the bounds; at one corner they are nearly reached."""
    found, until, g = following(state, r=radii)
    assert found == kind
    (c11, c12, c21, c22), most, worst = g.C, g.R, [0.0, 0.0]
    for signs in product((-1, -0.5, 0, 1), repeat=2):
        n = [sign * r for sign, r in zip(signs, radii, strict=True)]
        _, time, other = following(state, n=n)
        A, B = moved(other, g.ref, drag)
        u, w = A - constant(g.A), B - constant(g.B)
        assert until <= time + 1e-12
        assert g.begun[0] <= other.begun[0] + 1e-12
        assert other.begun[1] <= g.begun[1] + 1e-12
        for k, size in enumerate((c11 * u + c21 * w, c12 * u + c22 * w)):
            assert abs(size) <= most[k] + 1e-12
            worst[k] = max(worst[k], abs(size))
        assert abs(u) <= g.errors[0] + 1e-12
        assert abs(w) <= g.errors[1] + 1e-12
    assert max(most) < 1.5 * max(worst) + 20 * max(radii) ** 2 + 1e-9


@pytest.mark.parametrize("radii", RADII)
@pytest.mark.parametrize(
    ("state", "kind"), [*((s, "hit") for s in HITS), *((s, "stop") for s in TURNS)]
)
def test_flights_in_one_variable(state, kind, radii):
    """Of places, for releases."""
    check(one_variable, state, radii, -LINES.a, kind)


@pytest.mark.parametrize("radii", RADII)
@pytest.mark.parametrize("y", [AHEAD, BACK])
@pytest.mark.parametrize("state", HITS)
def test_hits_in_two_variables(state, y, radii):
    """Forwards and backwards."""

    def following(*given, **options):
        return two_variables(y, *given, **options)

    check(following, state, radii, -y.a, "hit")


def test_a_hit_about_a_slow_time(monkeypatch):
    """That slow time counts, unless all flights begin after it."""
    f = flight(*HITS[0])
    hit, slow = event(AHEAD, f), sum(AHEAD.slow(0))
    for first, last, number in ((-0.2, -0.1, 0), (-0.1, 0.1, 0), (0.1, 0.2, 1)):
        begun = slow + first, slow + last
        monkeypatch.setattr(events, "followed", lambda *_, t=begun: f._replace(begun=t))
        assert events.after_hit(AHEAD, f, hit).slow == number


@pytest.mark.parametrize("radii", RADII)
@pytest.mark.parametrize("state", TURNS)
def test_turns_in_two_variables(state, radii):
    """Forwards."""
    assert isinstance(AHEAD, motion.Direction)

    def following(*given, **options):
        return two_variables(AHEAD, *given, **options)

    check(following, state, radii, -AHEAD.a, "stop")


@pytest.mark.parametrize("radii", WIDE)
@pytest.mark.parametrize("state", FAST)
def test_large_errors(state, radii):
    """Of fast flights: in one variable and in two."""
    check(one_variable, state, radii, -LINES.a, "hit")

    def following(*given, **options):
        return two_variables(AHEAD, *given, **options)

    check(following, state, radii, -LINES.a, "hit")


@pytest.mark.parametrize("radii", [*RADII, *WIDE])
def test_the_speed_of_a_hit_that_may_be_slow(monkeypatch, radii):
    """All speeds are at most what is said to decide whether the mass rests; and nearly reach it."""
    seen, state = [], FAST[0]
    monkeypatch.setattr(paths, "height", lambda _y, _ends, most: seen.append(most))
    one_variable(state, r=radii)
    most = seen.pop()
    for signs in product((-1, 0, 1), repeat=2):
        one_variable(state, n=[sign * r for sign, r in zip(signs, radii, strict=True)])
    assert max(seen) <= most + 1e-12
    assert most <= max(seen) + 2 * max(radii)
