"""Motions that touch no wall, of one mass and of two; and the time until every motion rests."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
from matplotlib.figure import Figure

from cap.checker.kernel.theorem import Theorem
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.pictures.style import BLACK, BLUE, CYCLE, GREEN, GREY, ORANGE, RED, UNITS, walls
from cap.pictures.theorems.parts import PALE_BLUE, heading, middle, number, plane, system

ORBITS, PERIODS, SEED = 3000, 60, 1
FAR = Fraction(100)  # walls that nothing reaches
FASTEST = 4.0  # in units of R omega
PALE_GREEN = "#CDEBE2"


def segment(theorem: Theorem, figure: Figure) -> None:
    """Draw the segment of orbits that touch no wall, with its basin, and three of them in time."""
    claims, p = theorem.claims, system(theorem)
    left, right, v = (middle(claims[k]) for k in ("left", "right", "v"))
    time, states = figure.subplots(1, 2, width_ratios=[1.2, 1])
    for k, x in enumerate((left, (left + right) / 2, right)):
        rim = 1e-6 * (right - left) * (1 - k)
        found = trajectory(p, orbit=(x + rim, v), exactly=True, periods=1)
        time.plot(found.t / found.period, found.x, color=CYCLE[k], lw=0.9)
    walls(time, p)
    time.set(xlabel=UNITS["t"], ylabel=UNITS["x"], xlim=(0, 1))
    time.set_title(f"three of them (floats), stroke {number(claims['stroke'])} (proved)")
    d, (a, b) = float(claims["basin"]["speed"]), map(float, claims["basin"]["drift"])
    u = np.linspace(0, d, 100)
    drift = a * u + b * u**2
    area, speed = number(claims["basin_area"]), number(claims["v"])
    states.fill_betweenx(v + u, left, right - drift, fc=PALE_GREEN, ec=GREEN, lw=0.8)
    states.fill_betweenx(v - u, left + drift, right, fc=PALE_GREEN, ec=GREEN, lw=0.8,
                         label=f"tend to one of these (proved): area {area}")  # fmt: skip
    states.plot([left, right], [v, v], color=RED, lw=1.6,
                label=f"orbits of period $T$ (proved): $\\dot x$ = {speed}")  # fmt: skip
    plane(states)
    figure.legend(loc="outside lower center", ncols=1)
    heading(figure, theorem, "Orbits of period $T$ that touch no wall")


def impulse(theorem: Theorem, figure: Figure) -> None:
    """Draw the time within which every motion rests, over its speed; orbits in floats below it."""
    claims, p = theorem.claims, system(theorem)
    delay, slope = middle(claims["delay"]), middle(claims["delay_per_speed"])
    fastest = FASTEST * float(p.R * p.omega)
    random = np.random.default_rng(SEED)
    x = random.uniform(float(p.l), float(p.r), ORBITS)
    v = random.uniform(-fastest, fastest, ORBITS)
    found = swarm.follow(p, np.column_stack([x, v]), PERIODS)
    times = [found.first_time("stick"), found.first_time("capture")]
    rest = np.fmin(*times)
    axes = figure.subplots()
    axes.plot(np.abs(v), rest, ".", ms=2, color=GREY, label="first rest of random states (floats)")
    speeds = np.array([0, fastest])
    axes.plot(speeds, delay + slope * speeds, color=BLUE, lw=1.4,
              label=f"$D + B|v|$, $D$ = {number(claims['delay'])}, $B$ = "
              f"{number(claims['delay_per_speed'])}: by then it rests (proved)")  # fmt: skip
    axes.set(xlim=(0, fastest), xlabel="speed $|v|$  [length / time]", ylabel="time until the mass "
             "first rests", ylim=(0, None))  # fmt: skip
    axes.legend(loc="upper left")
    heading(figure, theorem, r"Above $f = 2F/\pi$ every motion comes to rest")


def sliding(theorem: Theorem, figure: Figure) -> None:
    """Draw the places of two masses that touch nothing, and one such motion in time."""
    claims, p = theorem.claims, system(theorem)
    left, gap, right = (middle(claims["places"][k]) for k in ("left", "gap", "right"))
    places, time = figure.subplots(1, 2, width_ratios=[1, 1.2])
    corners = np.array([(left, left + gap), (left, right), (right - gap, right)])
    area = number(claims["places_area"])
    places.fill(*corners.T, fc=PALE_BLUE, ec=BLUE, lw=1.0,
                label=f"orbits of period $T$ (proved): area {area}")  # fmt: skip
    middle_of = corners.mean(axis=0)
    places.plot(*middle_of, "o", ms=5, mfc=ORANGE, mec=BLACK, label="the one drawn beside")
    places.set(xlabel="$x_1$ at $t = 0$  [length]", ylabel="$x_2$ at $t = 0$  [length]")
    places.set_title("the places where they touch neither walls nor each other")
    t, momentum = _momentum(theorem)
    for i, mass in enumerate(theorem.p.masses):
        time.plot(t, middle_of[i] + momentum / float(mass), color=CYCLE[i], lw=1.0,
                  label=f"$m_{i + 1} = {mass}$ (floats)")  # fmt: skip
    walls(time, p)
    time.set(xlabel=UNITS["t"], ylabel="positions $x_i$  [length]", xlim=(0, 1))
    time.set_title(f"the basin has the volume {number(claims['basin_volume'])} (proved)")
    figure.legend(loc="outside lower center", ncols=2)
    heading(figure, theorem, "Two masses that touch nothing")


def _momentum(theorem: Theorem) -> tuple[Floats, Floats]:
    """Return times in T and the integral of the momentum: the place of a mass 1 far from walls."""
    p = system(theorem)
    v = middle(theorem.claims["v"][0]) * float(theorem.p.masses[0])
    wide = replace(p, l=-FAR, r=FAR)
    found = trajectory(wide, orbit=(0.0, v), exactly=True, periods=1)
    return found.t * float(p.omega) / (2 * math.pi), found.x
