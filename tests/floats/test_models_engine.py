"""The float engine made from a model: against the hand-written ones, and against dense sampling."""

import math
import os
import re
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import mpmath
import numpy as np
import pytest
from models import ball, spring

from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.models import source
from cap.floats.models.engine import OUTSIDE, Engine
from cap.floats.models.identities import split
from cap.floats.models.source import MANY
from cap.floats.models.spectrum import exponential
from cap.parameters import PAPER
from cap.system.friction import friction, oscillator
from cap.system.masses import masses
from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import COS, ONE, SIN, Polynomial, variable, variables

LOSSY = replace(PAPER, e=Fraction(9, 10), mu=Fraction(1, 20))
SCALED = replace(PAPER, F=Fraction(2), omega=Fraction(3, 2), f=Fraction(1, 2), e=Fraction(4, 5))
TWO = Fraction(1), Fraction(9, 10)


@cache
def engine(system):
    """Return the engine of one of the systems here; each is compiled once."""
    made = {"ball": ball, "spring": spring, "masses": lambda: masses(PAPER, TWO)}
    return Engine(made[system]() if isinstance(system, str) else oscillator(system))


@pytest.mark.slow
@pytest.mark.parametrize("p", [LOSSY, PAPER, SCALED], ids=["lossy", "paper", "scaled"])
def test_friction_as_the_hand_written_engine(p):
    """The same states after three periods, hits and captures, of 2000 orbits."""
    random = np.random.default_rng(7)
    states = random.uniform([-1, -2], [1, 2], size=(2000, 2))
    found, other = engine(p).follow(states, periods=3), swarm.follow(p, states, 3)
    assert not found.flags.any()
    assert np.abs(found.states - other.states).max() < 1e-9
    assert found.counts[:, -1].sum() == other.captured.sum() > 0
    assert (found.counts[:, -1] > 0).tolist() == (other.captured > 0).tolist()


STARTS = [0.3, 0.9, -0.4, 1.5], [-0.7, -0.2, 2.0, -1.1], [-0.1, 0.6, -1.2, 0.4]


@pytest.mark.parametrize(
    ("name", "starts"),
    [
        (LOSSY, [[0.2, 0.5], [-0.6, 1.9], [0.0, -0.1]]),
        pytest.param("masses", STARTS, marks=pytest.mark.slow),
    ],
    ids=["one", "two"],
)
def test_what_is_interpreted_is_what_is_compiled(name, starts):
    """To the last bit: states, events, and what happened."""
    compiled = engine(name)
    plain = Engine(compiled.system, interpreted=True)
    found, other = (E.follow(starts, periods=9, log=2000, every=True) for E in (plain, compiled))
    assert found.counts.sum() > 60
    for part in ("states", "modes", "counts", "flags", "log", "path"):
        assert np.array_equal(getattr(found, part), getattr(other, part), equal_nan=True)


def test_a_release_is_no_stop():
    """What is released at a zero of its acceleration does not stop there again, by rounding."""
    random = np.random.default_rng(1)
    x = np.sort(random.uniform(-0.9, 0.9, size=(60, 2)))
    v = random.uniform(-2, 2, size=(60, 2))
    modes = ["".join("+" if u > 0 else "-" for u in each) for each in v]
    found = Engine(masses(PAPER, TWO), interpreted=True).follow(np.hstack([x, v]), modes)
    assert ((found.flags & MANY) > 0).sum() < 3  # contacts accumulate; it was 9


def matrix(system, mode):
    """Return M of y' = M y at the precision of mpmath."""
    number = lambda c: mpmath.mpf(c.numerator) / c.denominator  # noqa: E731
    rows = [[q.evaluated({}, number, mpmath.pi) for q in row] for row in system.matrix(mode)]
    return mpmath.matrix(rows)


def sampled(system, mode, y, times):
    """Return the states at the times after y = (state, cos, sin, 1) on one flight, to 15 digits."""
    with mpmath.workdps(30):
        M = matrix(system, mode)
        start = mpmath.matrix([float(z) for z in y])
        return np.array([[float(z) for z in mpmath.expm(M * t) * start] for t in times])


@pytest.mark.parametrize(
    ("name", "box"),
    [
        pytest.param("ball", ([0.0, -3], [3, 3]), marks=pytest.mark.slow),
        pytest.param("spring", ([-2, -2], [0, 2]), marks=pytest.mark.slow),
    ],
)
def test_no_event_is_missed(name, box):
    """On flights sampled densely, by another exponential, each guard is positive up to the event
    that is told, and zero there."""
    E = engine(name)
    random = np.random.default_rng(5)
    states = random.uniform(*box, size=(30, 2))
    states[:, 0] += 1.3 if name == "ball" else 0  # above the table
    found = E.follow(states, ["fly"] * len(states), log=400)
    assert len(found.log) < 400
    flights = 0
    for orbit, state in enumerate(states):
        t, y = 0.0, state
        events = [line for line in found.log if line[0] == orbit]
        for line in events[:4]:
            if E.words[int(line[2])] != E.words[0] or line[1] - t < 1e-6:
                break
            w = float(E.system.omega.terms[()])
            start = [*y, np.cos(w * t), np.sin(w * t), 1.0]
            path = sampled(E.system, "fly", start, np.linspace(0, line[1] - t, 60)[1:])
            guards = E.system.modes["fly"].guards
            rows = np.array([split(E.system, "fly", word)[0] for word in guards])
            assert (path[:-1] @ rows.T > -1e-12).all()
            assert np.abs(path[-1] @ rows.T).max() < 1e-10
            t, y, flights = line[1], line[4:], flights + 1
    assert flights > 10


@pytest.mark.parametrize("p", [PAPER, LOSSY])
def test_exponential(p):
    """R and its projectors make up exp(M d), also for short flights, to full relative precision."""
    system = oscillator(p)
    E = exponential(system, "left")
    for d in (1e-8, 0.3, 4.0):
        x = E.rates * d
        with mpmath.workdps(40):
            R = [complex(mpmath.exp(z) - 1 - z - z * z / 2) for z in map(mpmath.mpc, x)]
            exact = mpmath.expm(matrix(system, "left") * d) - mpmath.eye(5)
        total = E.first * d + E.second * d**2 / 2
        for r, real, im in zip(R, E.real, E.imaginary, strict=True):
            total = total + real * r.real + im * r.imag
        error = np.abs(total - np.array(exact.tolist(), dtype=float))
        assert error.max() < 4e-15 * d * np.exp(d)


@pytest.mark.slow
def test_rest_at_the_wall_of_a_ball():
    """A ball that bounces lower and lower lies on the table until the table falls faster than g."""
    E = engine("ball")
    found = E.follow([[1.3, 0.0]], ["fly"], periods=6, log=4000)
    told = [E.words[int(line[2])] for line in found.log]
    assert "capture" in told
    assert told[told.index("capture") + 1] == "leave"


def test_it_may_be_asked_again():
    """Another value of a parameter compiles nothing: the source is the same, its numbers differ."""
    near = replace(LOSSY, f=Fraction(41, 100))
    one, other = engine(LOSSY), Engine(oscillator(near))
    assert one._follow is other._follow
    assert (one.follow([[0.2, 0.5]]).states != other.follow([[0.2, 0.5]]).states).any()


@pytest.mark.parametrize("system", [ball(), spring(), oscillator(LOSSY)])
def test_a_least_number_is_one_of_several(system):
    """No numba before 0.61 takes min(a)."""
    alone = re.compile(r"\b(?:min|max)\([^,()]*\)")
    assert not alone.findall(source.Source(system).text)


@pytest.mark.slow
def test_many_orbits_are_followed_in_parts(monkeypatch):
    """Between two parts a signal is noticed; what is found is the same."""
    states = np.random.default_rng(3).normal((3, 0), size=(23, 2))
    whole = engine("ball").follow(states, periods=40, every=True)
    monkeypatch.setattr("cap.floats.models.engine.AT_ONCE", 200)
    parts = engine("ball").follow(states, periods=40, every=True)
    for name in ("states", "modes", "counts", "flags", "log", "path"):
        assert np.array_equal(getattr(whole, name), getattr(parts, name))
    assert whole.counts.sum() > 100


def test_what_is_outside_is_flagged():
    """A start at which a guard of its mode is negative."""
    assert engine(PAPER).follow([[0.0, 0.5]], ["left"]).flags[0] & OUTSIDE
    assert not engine(PAPER).follow([[0.0, 0.5]]).flags[0]


def double():
    """Return a system in resonance: x'' = - x + cos t."""
    x, v, cos = variables("x v cos")
    mode = Mode({"x": v, "v": cos - x}, {"wall": Guard(1 - x, ("fly",), {"v": -v})})
    return System(("x", "v"), ONE, {"fly": mode})


def cubic():
    """Return a point mass over a table of the third degree."""
    x, y, v, w = variables("x y v w")
    table = Guard(y - x**3, ("fly",), Bounce(ONE))
    return System(
        "x y v w", ONE, {"fly": Mode({"x": v, "y": w, "v": 0, "w": -1}, {"table": table})}
    )


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Engine(friction()), "numbers for F, omega"),
        (lambda: Engine(cubic()), "table of the mode fly is neither"),
        (lambda: Engine(double()), "resonance"),
        (lambda: engine(PAPER).follow([0.0, 1.0]), "rows of x, v"),
        (lambda: engine(PAPER).follow([[0.0, np.nan]]), "not finite"),
        (lambda: engine(PAPER).follow([[9.0, 1.0]], ["up"]), "no mode 'up'"),
        (lambda: engine(PAPER).follow([[0.0, 1.0]], ["left", "left"]), "2 modes for 1"),
        (lambda: engine(PAPER).follow([[9.0, 1.0]]), "in no mode"),
    ],
)
def test_refusals(make, words):
    """What cannot be followed is told in a line."""
    with pytest.raises(BadInput, match=words):
        make()


COUNTS = """
import sys
import numpy as np
from cap.floats.models.engine import Engine
from cap.system.files import read

for path in sys.argv[1:]:
    engine = Engine(read(path))
    states = np.random.default_rng(1).normal(size=(40, 2))
    inside = engine.inside(states)
    begun = inside.any(axis=0)
    ends = engine.follow(states[begun], np.argmax(inside[:, begun], axis=0), periods=20)
    print(*ends.counts.sum(axis=0))
"""


@pytest.mark.slow
def test_code_that_is_kept_is_that_of_its_own_system(tmp_path):
    """Whatever was compiled before it in a process; guards of these two are of different kinds."""
    examples = Path(__file__).parents[2] / "examples"

    def counts(*names):
        command = [sys.executable, "-c", COUNTS, *(str(examples / f"{name}.py") for name in names)]
        env = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}
        run = subprocess.run(
            command, check=True, env=env, capture_output=True, text=True, timeout=100
        )
        return run.stdout.splitlines()

    (kept,) = counts("impact_oscillator")
    assert counts("den_hartog", "impact_oscillator")[1:] == [kept]


@pytest.mark.slow
def test_two_ways_to_the_next_event(monkeypatch):
    """Angles of the clock, where guards are least or fall, give the same events as bisection."""
    system = oscillator(PAPER)
    states = np.random.default_rng(3).uniform([-1, -1], [1, 1], size=(500, 2))
    fast = Engine(system).follow(states, periods=2)
    text = source.Source(system).text
    assert "clocked_T((" in text
    assert "ahead < -CLOSE" in text
    monkeypatch.setattr(source, "least_angle", lambda _: None)
    monkeypatch.setattr(source, "fall_angle", lambda _: None)
    slow = Engine(system).follow(states, periods=2)
    text = source.Source(system).text
    assert "clocked_T((" not in text
    assert "ahead" not in text
    assert (fast.counts == slow.counts).all()
    assert np.abs(fast.states - slow.states).max() < 1e-9


def test_the_angle_at_which_a_guard_falls():
    """Of 3 cos + 4 sin + c: where it is zero, and falls; nowhere, or not known."""
    cos, sin, x = variable(COS), variable(SIN), variable("x")
    for c in (Fraction(-4), Fraction(0), Fraction(9, 2)):
        angle = source.fall_angle(cos * 3 + sin * 4 + c)
        assert abs(3 * math.cos(angle) + 4 * math.sin(angle) + c) < 1e-14
        assert 4 * math.cos(angle) - 3 * math.sin(angle) < 0
    assert source.fall_angle(cos * 3 + sin * 4 - 6) == math.inf
    assert source.fall_angle(Polynomial.of(1)) == math.inf
    assert source.fall_angle(cos + x) is None
    assert source.fall_angle(cos * sin) is None
