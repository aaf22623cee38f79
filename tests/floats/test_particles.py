"""The flow of N masses in floats, against a general integrator and against masses alone."""

import math
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support import rounds, seeded

from cap.errors import BadInput
from cap.floats.masses.particles import Particles, Unresolved, follow
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER, Parameters

T = 2 * math.pi
HALF = Fraction(1, 2)
UNEQUAL = (Fraction(1), Fraction(9, 10))
SYSTEMS = [
    Particles(PAPER, UNEQUAL),
    Particles(PAPER, (Fraction(1), Fraction(2), Fraction(1, 2)), proportional=True),
    Particles(Parameters(*map(Fraction, (3, 2, 1, 0, 4))), (Fraction(3, 2), Fraction(1, 3))),
]


def drawn(system, random, speed=2.0):
    """Return a random state."""
    p = system.parameters
    x = sorted(random.uniform(float(p.l), float(p.r)) for _ in system.masses)
    return x, [random.uniform(-speed, speed) for _ in system.masses]


def integrated(system, x, v, end):
    """Integrate with a Runge-Kutta method that stops at contacts and zeros of velocities."""
    p, m = system.parameters, [float(mass) for mass in system.masses]
    F, w, l, r = (float(value) for value in (p.F, p.omega, p.l, p.r))
    f = [float(p.f) * (mass if system.proportional else 1) for mass in m]
    n, t, words = len(m), 0.0, []
    x, v = list(x), list(v)
    sign = [math.copysign(1, u) for u in v]

    def right(t, y):
        force = F * math.cos(w * t)
        a = [s and (force - b * s) / mass for s, b, mass in zip(sign, f, m, strict=True)]
        return [*y[n:], *a]

    while t < end:
        gaps = [lambda _t, y: y[0] - l]
        gaps += [lambda _t, y, k=k: y[k] - y[k - 1] for k in range(1, n)]
        gaps += [lambda _t, y: r - y[n - 1]]
        stops = [lambda _t, y, i=i: sign[i] * y[n + i] if sign[i] else 1.0 for i in range(n)]
        frees = [
            lambda t, _y, i=i: f[i] - abs(F * math.cos(w * t)) if not sign[i] else 1.0
            for i in range(n)
        ]
        events = [*gaps, *stops, *frees]
        for event in events:
            event.terminal, event.direction = True, -1
        run = solve_ivp(
            right, (t, end), [*x, *v], events=events, rtol=1e-11, atol=1e-13, max_step=0.05
        )
        t, y = run.t[-1], run.y[:, -1]
        x, v = list(y[:n]), list(y[n:])
        if run.status == 0:
            break
        k = next(k for k, times in enumerate(run.t_events) if len(times))
        if k in (0, n):
            v[0 if k == 0 else n - 1] *= -1
            words.append("hit r" if k else "hit l")
        elif k < n:
            centre = (m[k - 1] * v[k - 1] + m[k] * v[k]) / (m[k - 1] + m[k])
            v[k - 1], v[k] = 2 * centre - v[k - 1], 2 * centre - v[k]
            words.append(f"meet {k} {k + 1}")
        else:
            i = (k - n - 1) % n
            force, v[i] = F * math.cos(w * t), 0.0
            free = k > 2 * n or abs(force) > f[i]
            sign[i] = math.copysign(1, force) if free else 0.0
            word = "release" if k > 2 * n else "turn" if free else "stick"
            side = (" right" if force > 0 else " left") if free else ""
            words.append(f"{word} {i + 1}{side}")
            continue
        for i in (n - 1,) if k == n else (0,) if k == 0 else (k - 1, k):
            sign[i] = math.copysign(1, v[i])
    return words, [*x, *v]


@pytest.mark.parametrize("system", SYSTEMS, ids=["unequal", "proportional", "other"])
def test_a_general_integrator(system):
    """Events and the state after a period are those of Runge-Kutta with stops at events."""
    random, compared, seen = seeded(5), 0, set()
    for _ in range(rounds(8)):
        x, v = drawn(system, random)
        end = T / float(system.parameters.omega)
        try:
            path = follow(system, x, v, end)
        except Unresolved:
            continue
        stretch = np.abs(path.monodromy).sum()  # how much errors grow
        words, state = integrated(system, x, v, end)
        assert list(path.words) == words
        assert [*path.x, *path.v] == pytest.approx(state, abs=1e-8 * (1 + stretch))
        compared += 1
        seen |= {word.split()[0] for word in words}
    assert compared >= rounds(6)
    assert seen >= {"hit", "meet", "turn", "stick", "release"}


@pytest.mark.slow
@pytest.mark.parametrize("system", SYSTEMS, ids=["unequal", "proportional", "other"])
def test_the_derivative(system):
    """It is what differences of neighbouring orbits say, through all events."""
    random, compared = seeded(6), 0
    end, h, n = T / float(system.parameters.omega), 1e-6, len(system.masses)
    for _ in range(rounds(8)):
        x, v = drawn(system, random)
        try:
            path = follow(system, x, v, end)
        except Unresolved:
            continue
        columns, same = [], True
        for k in range(2 * n):
            ends = []
            for side in (h, -h):
                y = [value + side * (j == k) for j, value in enumerate([*x, *v])]
                other = follow(system, y[:n], y[n:], end)
                same = same and other.words == path.words
                ends.append(np.array([*other.x, *other.v]))
            columns.append((ends[0] - ends[1]) / (2 * h))
        size = np.abs(path.monodromy).max()
        if same and size < 300:
            error = np.abs(np.array(columns).T - path.monodromy).max()
            assert error < 1e-5 * (1 + size**2)
            compared += 1
    assert compared >= rounds(4)


@pytest.mark.slow
def test_order_is_kept():
    """After every period the masses are in order between the walls, also after slow bounces."""
    random, system = seeded(7), Particles(PAPER, UNEQUAL)
    followed = 0
    for _ in range(rounds(20)):
        x, v = drawn(system, random)
        start = 0.0
        for period in range(1, 11):
            try:
                path = follow(system, x, v, period * T, start)
            except (Unresolved, BadInput):
                break
            x, v, start = path.x, path.v, period * T
            assert all(a <= b + 1e-12 for a, b in pairwise((-1.0, *x, 1.0)))
            followed += 1
    assert followed > rounds(50)


def test_one_mass_is_the_oscillator():
    """With N = 1 the events, the end and the derivative are those of one mass."""
    system, random = Particles(PAPER, (Fraction(1),)), seeded(8)
    for _ in range(rounds(20)):
        x, v = drawn(system, random)
        alone = itinerary(PAPER, x[0], v[0], T)
        if any(word.startswith("capture") for word in alone.words):
            continue
        path = follow(system, x, v, T)
        words = [" ".join(part for part in word.split() if part != "1") for word in path.words]
        assert words == list(alone.words)
        assert (path.x[0], path.v[0]) == pytest.approx(alone.end, abs=1e-9)
        assert path.monodromy == pytest.approx(np.array(alone.monodromy), abs=1e-6)


def test_equal_masses_pass_through_each_other():
    """Two equal masses are at the places of two masses alone, as long as none rests."""
    system, random, compared = Particles(PAPER, (Fraction(1), Fraction(1))), seeded(9), 0
    for _ in range(rounds(250)):
        x, v = drawn(system, random)
        alone = [itinerary(PAPER, *state, T) for state in zip(x, v, strict=True)]
        if any(not word.startswith("hit") for path in alone for word in path.words):
            continue
        path = follow(system, x, v, T)
        found = sorted(zip(path.x, path.v, strict=True))
        assert np.array(found) == pytest.approx(np.array(sorted(p.end for p in alone)), abs=1e-8)
        assert path.least_speed > 0
        compared += 1
    assert compared >= rounds(4)


def test_the_weighted_form_is_preserved():
    """Σ m dv ∧ dx and the volume are kept where no mass stops and collisions keep s1 + s2."""
    system, random, kept, broken = Particles(PAPER, (Fraction(1), HALF)), seeded(10), 0, 0
    M = np.diag([1.0, 0.5])
    J = np.block([[np.zeros((2, 2)), -M], [M, np.zeros((2, 2))]])
    for _ in range(rounds(200)):
        x, v = drawn(system, random, 3.0)
        try:
            path = follow(system, x, v, 3.0)
        except Unresolved:
            continue
        if path.least_speed == 0:
            continue
        D = path.monodromy
        size = np.abs(D).max() ** 2
        assert np.linalg.det(D) == pytest.approx(1, abs=1e-9 * (1 + size**2))
        meetings = [event for event in path.events if event.word.startswith("meet")]
        jumps = [sum(np.sign(e.after)) - sum(np.sign(e.before)) for e in meetings]
        defect = np.abs(D.T @ J @ D - J).max()
        if any(jumps):
            broken += defect > 1e-3
        else:
            assert defect < 1e-10 * (1 + size)
            kept += bool(meetings)
    assert kept > rounds(3)
    assert broken > rounds(3)


def test_masses_are_released_together():
    """Two masses that rest are released at the same time, both of them."""
    path = follow(Particles(PAPER, UNEQUAL), (-0.5, 0.5), (0.01, -0.01), 6.0, start=1.4)
    releases = [event for event in path.events if event.word.startswith("release")]
    assert [event.word for event in releases[:2]] == ["release 1 left", "release 2 left"]
    assert releases[0].time == releases[1].time == pytest.approx(math.pi - math.acos(0.4))


@pytest.mark.parametrize(
    ("masses", "x", "v"),
    [
        ((1, 1), (0.5, 0.5), (1, 1)),
        ((1, 1), (0.5, 0.1), (1, 1)),
        ((1, 1), (-1, 0.1), (1, 1)),
        ((1, 1), (0, 0.1), (1, math.nan)),
        ((1, 1), (0,), (1,)),
        ((1, 0), (0, 0.1), (1, 1)),
        ((), (), ()),
    ],
)
def test_bad_input(masses, x, v):
    """What is no state, or no system, is refused."""
    with pytest.raises(BadInput):
        follow(Particles(PAPER, tuple(map(Fraction, masses))), x, v, T)
