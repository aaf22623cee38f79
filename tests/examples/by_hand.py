"""The examples once more, by hand and for `scipy.solve_ivp`: fields, events and what follows them.

A mode is a field (t, y) -> y' and a list of pairs: a function that is positive in the mode, and
what follows where it comes to zero, (t, y) -> (mode, y).
"""
# ruff: noqa: ARG005, E731 (a field and a guard are functions of t and y)

from math import cos, inf, pi, sin

import numpy as np
from scipy.integrate import solve_ivp


def ball(A=1.2, e=0.5, g=1.0):
    """A ball on a vibrating table."""

    def hit(t, y):
        u = A * cos(t)
        return "fly", [A * sin(t), u - e * (y[1] - u)]

    return {"fly": (lambda t, y: (y[1], -g), [(lambda t, y: y[0] - A * sin(t), hit)])}


def impact_oscillator(w=2.0, e=0.8, d=0.05, gap=0.1):
    """A spring and a wall."""
    field = lambda t, y: (y[1], cos(w * t) - y[0] - 2 * d * y[1])
    return {"free": (field, [(lambda t, y: gap - y[0], lambda t, y: ("free", [gap, -e * y[1]]))])}


def harvester(s=0.5, e=0.5, G=0.1):
    """A ball in a capsule."""
    field = lambda t, y: (y[1], cos(pi * t) + G)
    return {"free": (field, between(-s / 2, s / 2, e))}


def gear_rattle(a=1.5, b=0.5, m=0.1, d=0.1, e=0.5):
    """Gears with backlash."""
    field = lambda t, y: (y[1], m + a * cos(t) - d * y[1])
    return {"free": (field, between(-b, b, e))}


def between(l, r, e):
    """Two walls."""
    return [
        (lambda t, y: r - y[0], lambda t, y: ("free", [r, -e * y[1]])),
        (lambda t, y: y[0] - l, lambda t, y: ("free", [l, -e * y[1]])),
    ]


def den_hartog(w=1.4, f=0.2):
    """A spring and dry friction."""
    force = lambda t, y: cos(w * t) - y[0]

    def stopped(t, y):
        F = force(t, y)
        return "rest" if abs(F) <= f else "right" if F > 0 else "left", [y[0], 0.0]

    return {
        "right": (lambda t, y: (y[1], force(t, y) - f), [(lambda t, y: y[1], stopped)]),
        "left": (lambda t, y: (y[1], force(t, y) + f), [(lambda t, y: -y[1], stopped)]),
        "rest": (
            lambda t, y: (0.0, 0.0),
            [
                (lambda t, y: f - force(t, y), lambda t, y: ("right", [y[0], 0.0])),
                (lambda t, y: f + force(t, y), lambda t, y: ("left", [y[0], 0.0])),
            ],
        ),
    }


def belt(a=0.5, w=1.5, u=0.5, k=0.8, s=1.5, d=0.05):
    """A mass on a belt."""
    force = lambda t, y: a * cos(w * t) - y[0] - 2 * d * y[1]
    catch = lambda t, y: ("stick", [y[0], u])
    return {
        "slower": (lambda t, y: (y[1], force(t, y) + k), [(lambda t, y: u - y[1], catch)]),
        "faster": (lambda t, y: (y[1], force(t, y) - k), [(lambda t, y: y[1] - u, catch)]),
        "stick": (
            lambda t, y: (y[1], 0.0),
            [
                (lambda t, y: s - force(t, y), lambda t, y: ("faster", [y[0], u])),
                (lambda t, y: s + force(t, y), lambda t, y: ("slower", [y[0], u])),
            ],
        ),
    }


def coupled_masses(a=1.0, w=2.0, k=1.0, d=0.1, e=0.8, gap=0.1):
    """Two masses, a spring between them, a wall."""

    def field(t, y):
        p, q, u, v = y
        spring = k * (p - q)
        return u, v, a * cos(w * t) - p - spring - 2 * d * u, spring - 2 * d * v

    hit = lambda t, y: ("free", [y[0], gap, y[2], -e * y[3]])
    return {"free": (field, [(lambda t, y: gap - y[1], hit)])}


def billiard(a=1.8, e=0.75, E=1.5, g=9.81):
    """A ball over a parabola that moves up and down."""
    w = 2 * pi

    def hit(t, y):
        n = np.array([-2 * a * y[0], 1.0])
        v = np.array([y[2], y[3] - w * E * cos(w * t)])
        v = v - (1 + e) * (v @ n) / (n @ n) * n
        return "fly", [y[0], y[1], v[0], v[1] + w * E * cos(w * t)]

    table = lambda t, y: y[1] - a * y[0] ** 2 - E * sin(w * t)
    return {"fly": (lambda t, y: (y[2], y[3], 0.0, -g), [(table, hit)])}


def clock(f=0.02, k=0.5, d=0.05):
    """A balance that gets a kick once a turn."""
    force = lambda y, side: -y[0] - 2 * d * y[1] - side * f
    rest = lambda y, other: ("rest" if abs(y[0]) <= f else other, [y[0], 0.0])
    forward = lambda t, y: (y[1], force(y, 1))
    kick = (lambda t, y: -y[0], lambda t, y: ("going", [0.0, y[1] + k]))
    return {
        "coming": (forward, [kick, (lambda t, y: y[1], lambda t, y: rest(y, "rest"))]),
        "going": (forward, [(lambda t, y: y[1], lambda t, y: rest(y, "back"))]),
        "back": (
            lambda t, y: (y[1], force(y, -1)),
            [(lambda t, y: -y[1], lambda t, y: rest(y, "coming"))],
        ),
        "rest": (lambda t, y: (0.0, 0.0), [(lambda t, y: f - abs(y[0]) + 1e-9, lambda t, y: None)]),
    }


def oscillator(f=0.4):
    """Dry friction between two walls."""

    def stopped(t, y):
        F = cos(t)
        return "rest" if abs(F) <= f else "right" if F > 0 else "left", [y[0], 0.0]

    return {
        "right": (
            lambda t, y: (y[1], cos(t) - f),
            [
                (lambda t, y: 1 - y[0], lambda t, y: ("left", [1.0, -y[1]])),
                (lambda t, y: y[1], stopped),
            ],
        ),
        "left": (
            lambda t, y: (y[1], cos(t) + f),
            [
                (lambda t, y: y[0] + 1, lambda t, y: ("right", [-1.0, -y[1]])),
                (lambda t, y: -y[1], stopped),
            ],
        ),
        "rest": (
            lambda t, y: (0.0, 0.0),
            [
                (lambda t, y: f - cos(t), lambda t, y: ("right", [y[0], 0.0])),
                (lambda t, y: f + cos(t), lambda t, y: ("left", [y[0], 0.0])),
            ],
        ),
    }


def follow(modes, mode, y, end, most=60, longest=0.05):
    """Return mode, state and number of events at a time, and the least |h'| at an event.

    Two events within the longest step may be missed.

    None if there are too many events, or if a guard is negative at the start of its mode.
    """
    t, slowest, count = 0.0, inf, 0
    while count <= most:
        field, guards = modes[mode]
        events = [falling(h) for h, _ in guards]
        options = {"rtol": 1e-12, "atol": 1e-13, "max_step": longest}
        run = solve_ivp(field, (t, end), y, method="DOP853", events=events, **options)
        t, y = run.t[-1], run.y[:, -1]
        if run.status != 1:
            return mode, y, count, slowest
        (g,) = [k for k, times in enumerate(run.t_events) if len(times)]
        h, then = guards[g]
        step = 1e-6
        back = y - step * np.array(field(t, y))
        slowest, count = min(slowest, abs(h(t, y) - h(t - step, back)) / step), count + 1
        mode, y = then(t, y)
        if min(h(t, y) for h, _ in modes[mode][1]) < -1e-9:
            break
    return None


def falling(h):
    """Return an event of `solve_ivp`."""

    def event(t, y):
        return h(t, y)

    event.terminal, event.direction = True, -1
    return event
