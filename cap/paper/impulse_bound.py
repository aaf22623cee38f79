"""fig:impulse-bound: the elliptic orbit as F falls, and a forcing that holds no such orbit."""

import math

import numpy as np

from cap.audit.comparison import Comparison, claim, number
from cap.floats.diagnostics.grid import grid, whole
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.findings import Floats
from cap.floats.one_one import asymmetry, pair_member, root, symmetric_member, turn
from cap.floats.search import periodic
from cap.paper.figure import Figure, Result, Run, elliptic
from cap.paper.rows import Row, Rows
from cap.parameters import PAPER, at

HIGH = {"0.95": ("+1.157", "0.152"), "0.85": ("+0.538", "0.207")}  # F: trace, rotation number
LOW, START = "0.62", (0.0, 0.7)
SHIFT, ITERATES = 0.005, 800


def compute(run: Run) -> Result:
    """Follow the orbits of the three panels, and many others at the lowest F."""
    compared, shown = [], []
    for F, (trace, number_) in HIGH.items():
        row, own = _panel(F, trace, number_)
        compared += own
        shown.append(row)
    low = trajectory(at(F=LOW), orbit=START, exactly=True, periods=4)
    shown.append(Row(low, f"(c) $F = {LOW}$: from $(0, 0.7)$"))
    compared += [*_bound(run), *_resonances()]
    return Result(tuple(compared), Rows(tuple(shown), "Towards the bound $F = \\pi f/2$", ("F",)))


def _panel(F: str, trace: str, turns: str) -> tuple[Row, list[Comparison]]:
    p, centre = at(F=F), elliptic(F)
    own = periodic.near(p, *centre)
    start = centre[0], centre[1] + SHIFT
    found = swarm.follow(p, [start], ITERATES, every=True)
    symmetric = abs((own.hit_times[1] - own.hit_times[0]) - math.pi / float(p.omega)) < 1e-6
    turned = bool(found.turned[0] or found.stuck[0])
    kind = "symmetric orbit" if symmetric else "asymmetric, one of a pair"
    panel = "a" if F == "0.95" else "b"
    rows_ = [
        number(f"F = {F}: trace of Phi'(P_*)", trace, own.trace),
        number(f"F = {F}: rotation number", turns, float(turn(own.trace))),
        claim(f"F = {F}: hits per period", "one right, one left",
              f"{len(own.hit_times)}, in turn; never turns", len(own.hit_times) == 2),
        claim(f"F = {F}: {ITERATES + 1} iterates from (x_*, v_* + {SHIFT})",
              "a smooth closed curve", "turns" if turned else "never turns, "
              f"strays {thickness(found.states[0] - np.array(centre)):.0e} of the "
              "distance from a curve", not turned, "the orbit leaves"),
        claim(f"F = {F}: the orbit is the continuation of that at F = 1", "yes", kind,
              not symmetric, "continuation passed a pitchfork, where the pair ends: see below"),
    ]  # fmt: skip
    picture = trajectory(p, orbit=start, exactly=True, periods=4)
    words = f"({panel}) $F = {F}$: {kind}, tr $= {own.trace:.3f}$"
    return Row(picture, words, found.states[0]), rows_


def thickness(points: Floats) -> float:
    """Return how far points are from a curve given by some harmonics of their angle."""
    points = points - points.mean(axis=0)
    axes = np.linalg.svd(points, full_matrices=False)[2]
    plane = points @ axes.T / (points @ axes.T).std(axis=0)
    angle, radius = np.arctan2(plane[:, 1], plane[:, 0]), np.hypot(*plane.T)
    k = np.arange(25)
    terms = np.concatenate([np.cos(np.outer(angle, k)), np.sin(np.outer(angle, k[1:]))], axis=1)
    fit, *_ = np.linalg.lstsq(terms, radius, rcond=None)
    return float(np.abs(terms @ fit - radius).max() / radius.mean())


def _bound(run: Run) -> list[Comparison]:
    """Compare what happens below the bound."""
    p = at(F=LOW)
    bound = math.pi * float(PAPER.f) / 2
    events = swarm.itinerary(p, START, 12)
    first = {kind: next(e for e in events if e.word.startswith(kind)) for kind in ("turn", "stick")}
    sticks = [event for event in events if event.word == "stick"]
    rests = [e.time - s.time for s, e in zip(sticks, _releases(events), strict=False)]
    drift = abs(sticks[-1].x - sticks[-3].x)
    cells = grid(p, whole(p), run.size(200, 40))
    seen = swarm.follow(p, cells.states(slice(0, cells.count)), 20)
    lost = int((seen.turned | seen.stuck | seen.captured).sum())
    return [
        number("F_imp = pi f/2", "0.628", bound, note="not pi f/(2 omega): no omega in it"),
        number(f"F = {LOW}: the orbit of (0, 0.7) comes to rest at t", "14.4",
               first["stick"].time),
        claim(f"F = {LOW}: enters Omega_dissip", "at t = 14.4, where it rests",
              f"is in it at t = 0; turns at t = {first['turn'].time:.4f}",
              first["turn"].time > 14.3,
              "by the paper's definition: below the bound every orbit turns, so Omega_NS is empty"),
        claim(f"F = {LOW}: then", "oscillates around a slowly drifting equilibrium",
              f"is T-periodic: rests {rests[-1]:.4f} twice a period at x = {sticks[-1].x:.4f} and "
              f"{sticks[-2].x:.4f}, drift {drift:.0e}", drift > 1e-6,
              "the two slips of a period are equal and opposite, by symmetry"),
        claim(f"F = {LOW}: every orbit enters Omega_dissip", "yes",
              f"{lost} of {cells.count} within 20 periods", lost == cells.count,
              "some take longer"),
    ]  # fmt: skip


def _releases(events: tuple[swarm.Event, ...]) -> list[swarm.Event]:
    return [event for event in events if event.word.startswith("release")]


def _resonances() -> list[Comparison]:
    """Find the F at which the orbits take the rotation numbers that the paper names."""
    f, length = float(PAPER.f), float(PAPER.R)

    def birth(F: float) -> float:
        return 2 * F / math.pi * math.sqrt(1 - (2 * length / F / (math.pi**2 - 4)) ** 2) - f

    def identity(F: float) -> float:  # of Φ' = -1: S = ρ/(π² - 2)
        return math.sqrt(1 - (math.pi * f / (2 * F)) ** 2) - length / F / (math.pi**2 - 2)

    def pair(F: float) -> float:
        return pair_member(asymmetry(f / F, length / F), length / F).trace

    def plus(F: float) -> float:
        return symmetric_member(f / F, length / F, 1).trace

    def passes(trace, level: float, ends: tuple[float, float]) -> float:  # type: ignore[no-untyped-def]
        return root(lambda F: trace(F) - 2 * math.cos(2 * math.pi * level), *ends)

    fork, minus = root(birth, 0.75, 1.0), root(identity, 0.629, 0.8)
    quarter = passes(pair, 1 / 4, (fork + 1e-6, 1.0)), passes(plus, 1 / 4, (minus, fork - 1e-6))
    third = passes(plus, 1 / 3, (minus, fork - 1e-6))
    return [
        claim("rotation number varies smoothly with F", "from F = 1 down to F = 0.85",
              f"it falls to 0 at F = {fork:.8f} and rises again", not 0.85 < fork < 1,
              "a pitchfork, where the pair of asymmetric orbits merges with the symmetric one"),
        claim("rotation number 1/4", "passed", f"at F = {quarter[0]:.6f} and {quarter[1]:.6f}",
              math.isfinite(quarter[0])),
        claim("rotation number 1/3", "passed", f"at F = {third:.6f}", math.isfinite(third)),
        claim("rotation number 1/2", "passed", f"touched at F = {minus:.6f}, where Phi' = -1",
              math.isfinite(minus)),
    ]  # fmt: skip


FIGURE = Figure("approach to the impulse bound", compute, "rows:rows", (7.8, 7.4))
