"""``explore orbit``, ``portrait`` and ``attractor`` with ``--masses``: data, pictures, words."""

import csv
import math
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from support import only

from cap.command.entry import INTERRUPTED
from cap.errors import BadInput
from cap.explore import __main__ as explore
from cap.explore.arrays import load
from cap.floats.masses.mass_attractor import NEVER, NONE, SLIDING, attractors
from cap.floats.masses.mass_portrait import portrait
from cap.floats.masses.mass_swarm import Seeds, swarm
from cap.floats.masses.mass_trajectory import trajectory
from cap.floats.masses.masses import drawn
from cap.floats.masses.particles import Particles
from cap.parameters import PAPER
from cap.runner import Runner

MASSES = (Fraction(1), Fraction(9, 10))
AT = replace(PAPER, f=Fraction(91, 200))
TWO = ["--masses", "1,9/10", "--f", "91/200"]
TINY = {
    "orbit": ["--periods", "2"],
    "portrait": ["--orbits", "4", "--periods", "5"],
    "attractor": ["--points", "2", "--transient", "3"],
}


def run(*words):
    """Run a command on one core; return its status."""
    return explore.main([*words, "--jobs", "1"])


@pytest.mark.slow
@pytest.mark.parametrize("name", only(TINY, "attractor"))
def test_data_and_picture(name, tmp_path, capsys):
    """Each writes and draws the same again; the masses are told, written and read back."""
    files = [tmp_path / f"{name}.{kind}" for kind in ("png", "npz", "csv")]
    outputs = [word for file in files for word in ("--out", str(file))]
    words = [name, *TWO, *TINY[name], *outputs, "--dpi", "50"]
    assert run(*words) == 0
    assert "m = (1, 9/10)" in capsys.readouterr().out
    assert files[0].stat().st_size > 3000
    data = load(files[1])
    assert data["masses"].tolist() == ["1", "9/10"]
    head, *lines = files[2].read_text("utf-8").splitlines()
    assert head.endswith("masses = 1 9/10")
    names, *rows = csv.reader(lines)
    assert names[:2] in (["t", "x_1"], ["orbit", "period"], ["x_1", "x_2"])
    assert rows
    before = [file.read_bytes() for file in files]
    assert run(*words) == 0
    assert [file.read_bytes() for file in files] == before


BAD = {
    "at least one mass": ["orbit", "--masses", "1,0"],
    "not a number": ["orbit", "--masses", "1;2"],
    "too many masses": ["orbit", "--masses", ",".join("1" * 9)],
    "--state needs 4 numbers": ["orbit", "--masses", "1,1", "--state", "0", "1"],
    "must increase strictly": ["orbit", "--masses", "1,1", "--state", "1/2", "0", "1", "1"],
    "too many periods": ["orbit", "--masses", "1,1", "--periods", "300"],
    "--box is about one mass": ["portrait", "--masses", "1,1", "--box", "0", "1", "0", "1"],
    "--orbit is about one mass": ["orbit", "--masses", "1,1", "--orbit", "0", "1"],
    "the state of one mass is --orbit X V": ["orbit", "--state", "0", "1"],
    "--proportional needs the masses": ["attractor", "--proportional"],
    "elastic walls and no viscosity": ["attractor", "--masses", "1,1", "--mu", "1/10"],
    "the radius is too large": [
        "portrait", "--masses", "1,9/10", "--f", "91/200", "--radius", "1000", "--orbits", "2"
    ],
}  # fmt: skip


@pytest.mark.parametrize("complaint", BAD)
def test_bad_input(complaint, capsys):
    """One line, status 2."""
    assert run(*BAD[complaint]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert complaint in err
    assert err.count("\n") == 1


def test_an_orbit_in_time():
    """The samples follow the motion: in order between the walls, continuous, v = dx/dt."""
    state = (-0.5, 0.2, 0.9, -1.1)
    found = trajectory(AT, masses=MASSES, state=state, exactly=True, periods=3)
    assert {str(w).split()[0] for w in found.words} >= {"hit", "meet", "turn"}
    places = np.hstack([np.full((len(found.t), 1), -1.0), found.x, np.ones((len(found.t), 1))])
    assert np.diff(places, axis=1).min() > -1e-12
    dt = np.diff(found.t)
    assert dt.min() >= 0
    middle = (found.v[1:] + found.v[:-1]) / 2
    assert np.abs(np.diff(found.x, axis=0) - middle * dt[:, None]).max() < 1e-4
    assert np.allclose(found.strobe[0], state)
    last = np.concatenate([found.x[-1], found.v[-1]])
    assert np.allclose(last, found.strobe[-1], atol=1e-9)
    assert found.least_speed == 0


def test_a_mass_at_rest():
    """Who rests stays where he is until the next event."""
    rests = 0
    for state in drawn(Particles(PAPER, MASSES), 6, 5):
        try:
            found = trajectory(PAPER, masses=MASSES, state=tuple(state), exactly=True, periods=3)
        except BadInput:
            continue
        for k, word in enumerate(found.words[:-1]):
            kind, mass, *_ = str(word).split()
            inside = (found.t > found.times[k]) & (found.t < found.times[k + 1])
            if kind == "stick" and inside.any():
                rests += 1
                assert not found.v[inside, int(mass) - 1].any()
                assert np.ptp(found.x[inside, int(mass) - 1]) == 0
    assert rests > 3


def test_without_a_state():
    """Two masses have the orbit continued from equal masses; it is periodic and never stops."""
    found = trajectory(AT, masses=MASSES, periods=2)
    assert found.least_speed == pytest.approx(0.127, abs=1e-3)
    assert np.allclose(found.strobe, found.strobe[0], atol=1e-8)
    near = tuple(z + 1e-3 for z in found.strobe[0])
    again = trajectory(AT, masses=MASSES, state=near)
    assert np.allclose(again.strobe[0], found.strobe[0], atol=1e-9)
    three = trajectory(AT, masses=(*MASSES, Fraction(1, 2)))
    assert three.x.shape[1] == 3


@pytest.mark.slow
def test_mixed_dynamics():
    """Orbits near the orbit do not stop; those from anywhere do, and slide or have period 3T."""
    found = portrait(AT, masses=MASSES, orbits=8, periods=20, runner=Runner())
    assert not found.stopped[found.near].any()
    assert found.stopped[~found.near].all()
    ends = attractors(AT, masses=MASSES, points=3, transient=60, runner=Runner())
    kinds = {each.kind for each in ends.found}
    assert SLIDING in kinds
    assert NEVER not in kinds
    assert sum(each.share for each in ends.found) + (ends.label == NONE).mean() == pytest.approx(1)
    sliding = next(each for each in ends.found if each.kind == SLIDING)
    q = math.pi * 0.455 / 2  # the velocities in closed form
    for i, mass in enumerate((1.0, 0.9)):
        v = (q - 0.455 * math.asin(q)) / mass
        assert sliding.states[:, 2 + i] == pytest.approx(v, abs=1e-6)


def test_processes_change_nothing():
    """One process or two, the same states; the order is kept in each period."""
    system = Particles(AT, MASSES)
    starts = drawn(system, 6, 4)
    alone, two = (swarm(Seeds(system, 8), starts, Runner(jobs), "") for jobs in (1, 2))
    assert np.array_equal(alone.states, two.states, equal_nan=True)
    assert np.array_equal(alone.counts, two.counts)
    for x in alone.states[..., :2].reshape(-1, 2):
        if np.isfinite(x).all():
            assert all(a <= b + 1e-12 for a, b in pairwise((-1.0, *x, 1.0)))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["portrait", "attractor"])
def test_ctrl_c_at_once(name, tmp_path, monkeypatch, capsys):
    """Even nothing can be written and drawn."""

    def interrupted(runner, *_, **__):
        runner.interrupted = True
        return []

    monkeypatch.setattr(Runner, "map", interrupted)
    files = [tmp_path / f"a.{kind}" for kind in ("png", "csv")]
    outputs = [word for file in files for word in ("--out", str(file))]
    assert run(name, *TWO, *TINY[name], *outputs, "--dpi", "50") == INTERRUPTED
    assert "interrupted" in capsys.readouterr().err
    assert all(file.stat().st_size > 0 for file in files)
