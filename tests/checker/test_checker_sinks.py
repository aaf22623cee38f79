"""Sinks that turn: what contracts is accepted, as orbits in floats do; nothing else."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from cap.checker.attracting import sinks
from cap.checker.attracting.sinks import Part, Sink, norm
from cap.checker.attracting.sinks import sink as of_claim
from cap.checker.folded.basins import Basins, bounds_of
from cap.checker.folded.motion import Direction
from cap.checker.folded.table import ATTRACTOR, NONE
from cap.checker.folded.units import Units
from cap.checker.kernel import polynomials as q
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.walls import Parameters
from cap.floats.engine import swarm
from cap.parameters import Parameters as Given

SYSTEMS = {
    "weak": Parameters(*map(Fraction, (1, 1, "1/5", -1, 1))),
    "other": Parameters(*map(Fraction, (3, 2, "3/5", "-1/2", 1))),  # in other units
}
NODE = {
    "x": Fraction("0.0538"),
    "v": Fraction("0.7002"),
    "matrix": [list(map(Fraction, row)) for row in (("-11.9", "-45.1"), ("-0.62", "-46.7"))],
    "halves": 4,
}
FOCUS = {
    "x": Fraction("0.2368"),
    "v": Fraction("1.2433"),
    "matrix": [list(map(Fraction, row)) for row in (("33.8", "0"), ("-8.94", "102.6"))],
    "halves": 8,
}


def rescaled(claim, name):
    """Return a claim at the first system as one at another."""
    p, unit = SYSTEMS[name], SYSTEMS["weak"]
    x, v = p.F / p.omega**2 * unit.omega**2 / unit.F, p.F / p.omega * unit.omega / unit.F
    matrix = [[a / x, b / v] for a, b in claim["matrix"]]
    return claim | {"x": p.r + x * (claim["x"] - unit.r), "v": v * claim["v"], "matrix": matrix}


def sink(claim, name="weak"):
    """Return a sink."""
    return of_claim(Units(SYSTEMS[name]), claim)


def contract(claim, name="weak"):
    """Prove that a sink contracts."""
    sink(claim, name).contract(Direction(SYSTEMS[name], forwards=True))


LEFT = NODE | {"x": Fraction("0.5659"), "v": Fraction("-0.9116")}  # the image of the node, at T/2
LEFT |= {"matrix": [list(map(Fraction, row)) for row in (("30", "0"), ("0", "60"))]}


@pytest.mark.parametrize("name", SYSTEMS)
@pytest.mark.parametrize("claim", [NODE, FOCUS, LEFT], ids=["node", "focus", "left"])
def test_orbits_come_together(claim, name):
    """From all of the ellipse, to a state in it, in floats: each time nearer."""
    contract(rescaled(claim, name), name)
    p, here = SYSTEMS[name], rescaled(claim, name)
    given = Given(p.F, p.omega, p.f, p.l, p.r)
    W = np.array([[float(a) for a in row] for row in here["matrix"]])
    centre, rng = np.array([float(here["x"]), float(here["v"])]), np.random.default_rng(6)
    u = rng.normal(size=(300, 2))
    u *= (rng.random((300, 1)) ** 0.5) / np.linalg.norm(u, axis=1)[:, None]
    states, wide = centre + np.linalg.solve(W, u.T).T, 2.0
    for _ in range(30):
        states = swarm.follow(given, states, here["halves"] / 2).states
        apart = (states - states.mean(axis=0)) @ W.T
        assert np.linalg.norm((states - centre) @ W.T, axis=1).max() < 1
        assert np.linalg.norm(apart, axis=1).max() < max(wide, 1e-6)
        wide = np.linalg.norm(apart, axis=1).max()
    assert wide < 1e-6


def wrong(**changes):
    """Return the first claim with changes."""
    return NODE | changes


@pytest.mark.parametrize(
    ("lie", "why"),
    [
        (wrong(x=Fraction("0.2")), "sink is cut too often"),
        (wrong(v=Fraction("-0.7002")), "may stick"),
        (wrong(halves=3), "which orbits"),
        (wrong(matrix=[[a / 4 for a in row] for row in NODE["matrix"]]), "cut too"),
        (wrong(matrix=[NODE["matrix"][0], NODE["matrix"][0]]), "matrix of a sink is singular"),
        (wrong(matrix=[[Fraction(50), Fraction(0)], [Fraction(0), Fraction(2)]]), "cut too"),
    ],
)
def test_lies(lie, why):
    """Another place, to the left, at other times, too large, no ellipse, another shape."""
    with pytest.raises(Rejected, match=why):
        contract(lie)


def test_states_at_rest_or_past_the_wall_are_refused():
    """All states of an ellipse move to the wall ahead."""
    y = Direction(SYSTEMS["weak"], forwards=True)
    for changes in ({"v": Fraction(1, 50)}, {"x": Fraction(99, 100)}):
        with pytest.raises(Rejected, match="do not move to the wall ahead"):
            sink(wrong(**changes)).image(y, Part(), Fraction(1))


def test_what_sticks_is_no_sink():
    """At more friction the orbit through a state that returns sticks."""
    p = Given(*map(Fraction, (1, 1, "1/4", -1, 1)))
    state = [[0.058960209, 0.63871682]]
    assert swarm.follow(p, state, 1).states[0] == pytest.approx(state[0], abs=1e-6)
    claim = {"x": Fraction("0.058960209"), "v": Fraction("0.63871682"), "halves": 2}
    small = [[Fraction(10**5), Fraction(0)], [Fraction(0), Fraction(10**5)]]
    y = Direction(Parameters(p.F, p.omega, p.f, p.l, p.r), forwards=True)
    with pytest.raises(Rejected, match="may stick"):
        sink(claim | {"matrix": small}).image(y, Part(), Fraction(0))


def test_each_condition(monkeypatch):
    """A factor of 1, a centre that moves too far, states that stick, are refused at once."""
    contract(NODE)
    y = Direction(SYSTEMS["weak"], forwards=True)
    monkeypatch.setattr(Sink, "factor", lambda *_: 1.0)
    with pytest.raises(Rejected, match="cut too"):
        sink(NODE).contract(y)
    monkeypatch.setattr(Sink, "factor", lambda *_: 0.5)
    sink(NODE).contract(y)
    monkeypatch.setattr(Sink, "shift", lambda *_: 0.5)
    with pytest.raises(Rejected, match="cut too"):
        sink(NODE).contract(y)
    monkeypatch.setattr(Sink, "shift", lambda *_: 0.4)
    sink(NODE).contract(y)
    monkeypatch.setattr(sinks, "sticking", lambda *_: (True, False))
    with pytest.raises(Rejected, match="may stick"):
        sink(NODE).image(y, Part(), Fraction(0))


def test_the_derivative_is_that_of_orbits_in_floats():
    """W DP W^-1 at the centre has nearly the norm that is said; the centre comes back so far."""
    p = SYSTEMS["weak"]
    y, here = Direction(p, forwards=True), sink(FOCUS)
    given, W = Given(p.F, p.omega, p.f, p.l, p.r), np.array(FOCUS["matrix"], float)
    state = np.array([float(FOCUS["x"]), float(FOCUS["v"])])
    found = swarm.follow(given, [state], FOCUS["halves"] / 2, derivative=True)
    M = W @ found.monodromy[0] @ np.linalg.inv(W)
    n = 12
    tiny = here.factor(y, Part(1 << (n - 1), 1 << (n - 1), n))
    assert tiny == pytest.approx(np.linalg.norm(M, 2), rel=0.05)
    moved = np.linalg.norm(W @ (found.states[0] - state))
    assert moved <= here.shift(y) == pytest.approx(moved, abs=1e-3)


def test_the_parts_cover_the_disc():
    """Quarters cover a part; those left out do not meet the disc."""
    parts, rng = [Part()], np.random.default_rng(3)
    for _ in range(4):
        parts = [each for part in parts for each in part.quarters() if not each.outside()]
    for radius, angle in rng.random((2000, 2)):
        z = radius**0.5 * np.array([np.cos(7 * angle), np.sin(7 * angle)])
        inside = (max(abs(z - np.array(part.middle(), float))) <= 2.0**-part.n for part in parts)
        assert any(inside)
    assert len(parts) < 4**4


def test_norms():
    """They are those of numpy, and not less."""
    rng = np.random.default_rng(2)
    for _ in range(200):
        M = rng.normal(size=(2, 2)) * 10.0 ** rng.integers(-3, 3)
        bound = norm([[(a, 0.0) for a in row] for row in M.tolist()])
        assert np.linalg.norm(M, 2) * (1 - 1e-14) <= bound
        assert bound == pytest.approx(np.linalg.norm(M, 2), rel=1e-9)
        wider = norm([[(a, 0.1) for a in row] for row in M.tolist()])
        assert wider >= np.linalg.norm(np.abs(M) + 0.1, 2) * (1 - 1e-12) or wider > bound


def test_states_in_an_ellipse():
    """Models all of which are inside, or not."""
    ellipse = sink(NODE).ellipse()
    x, v = float(NODE["x"]) - 1, float(NODE["v"])
    inside = q.model(one=x, X=0.005), q.model(one=v, Y=0.005)
    assert ellipse.contains(bounds_of(q, *inside))
    assert Basins(ellipses=(ellipse,)).fate(0, bounds_of(q, *inside)) == ATTRACTOR
    for p, s in (
        (q.model(one=x, X=0.1), inside[1]),
        (inside[0], q.model(0.03, one=v)),
        (q.model(one=x + 0.3), inside[1]),
    ):
        assert Basins(ellipses=(ellipse,)).fate(0, bounds_of(q, p, s)) == NONE
    W = np.array(NODE["matrix"], float)
    for angle in np.linspace(0, 6, 50):
        for size in (0.999, 1.001):
            z = np.linalg.solve(W, size * np.array([np.cos(angle), np.sin(angle)]))
            at = bounds_of(q, q.model(one=x + z[0]), q.model(one=v + z[1]))
            assert ellipse.contains(at) == (size < 1)
