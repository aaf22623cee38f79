"""fig:hist-gallery-low and fig:hist-gallery-high: regimes at six forcings."""

from collections import Counter
from dataclasses import dataclass
from math import gcd
from typing import NamedTuple

import numpy as np

from cap.audit.comparison import (
    Comparison,
    claim,
    count,
    number,
    percent,
    roughly,
    taken_from,
    unstated,
)
from cap.floats.diagnostics.attractor import strongest
from cap.floats.diagnostics.trajectory import Trajectory, trajectory
from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.floats.search import cycles
from cap.floats.search.cycles import Cycle
from cap.floats.search.orbits import search
from cap.paper.coexistence import mirrored
from cap.paper.figure import Figure, Result, Run
from cap.paper.rows import Row, Rows
from cap.parameters import at


class Printed(NamedTuple):
    """What the paper prints of an orbit: state, trace, determinant, hits right and left in 4T."""

    x: str
    v: str
    trace: str
    determinant: str
    hits: tuple[int, int] | None


ORBITS = {
    "1.5": Printed("+0.6276", "-0.1184", "-1.324", "+0.578", (8, 4)),
    "3": Printed("+0.4064", "-0.6708", "-0.968", "+0.578", (8, 8)),
    "4.5": Printed("+0.2156", "-0.8293", "-0.520", "+0.559", (8, 12)),
    "6": Printed("+0.0267", "-0.4816", "-0.665", "+0.538", None),
}
GENERIC = {"12": (4, 4, 5), "50": (2, 1, 7)}  # F: transient and window in T, |v| at most
SPEED_AT_6 = 2
SEEDS = 12  # per side, of the generic orbits


@dataclass(frozen=True)
class Seen:
    """An orbit at F, and its rows of the table."""

    row: Row
    rows: list[Comparison]


def _near(F: str) -> Cycle:
    printed = ORBITS[F]
    return cycles.near(at(F=F), float(printed.x), float(printed.v))


def _window(F: str, state: State, periods: int) -> Trajectory:
    return trajectory(at(F=F), orbit=state, exactly=True, periods=periods)


def _periodic(F: str) -> Seen:
    """Compare one of the periodic orbits."""
    printed, own = ORBITS[F], _near(F)
    state = own.x, own.v
    orbit = _window(F, state, 4)
    words = Counter(str(word) for word in orbit.words)
    found = [
        *taken_from("eq:hist-orbits-FPs" if printed.hits else "", [
            number(f"F = {F}: x_*", printed.x, own.x),
            number(f"F = {F}: v_*", printed.v, own.v),
            number(f"F = {F}: trace", printed.trace, own.trace),
            number(f"F = {F}: determinant", printed.determinant, own.determinant),
        ]),
        roughly(claim(
            f"F = {F}: type", "elliptic", own.kind(conserves=True),
            own.kind(conserves=True) == "elliptic",
            "det < 1: a sink, as the text says below; Omega_NS and KAM are not in question")),
    ]  # fmt: skip
    if printed.hits:
        right, left = printed.hits
        found += [
            count(f"F = {F}: right hits in 4 T", right, words["hit r"]),
            count(f"F = {F}: left hits in 4 T", left, words["hit l"]),
        ]
    turns = sum(n for word, n in words.items() if word.startswith("turn"))
    title = f"$F = {float(F):g}$: {own.kind(conserves=True)}, tr $= {own.trace:.3f}$, "
    title += f"det $= {own.determinant:.3f}$; in $4T$: {words['hit r']} r, {words['hit l']} l, "
    return Seen(Row(orbit, title + f"{turns} turns"), found)


def low(run: Run) -> Result:
    """Compare the three orbits at moderate F."""
    del run
    seen = {F: _periodic(F) for F in ("1.5", "3", "4.5")}
    hits = {F: _hits(each.row.orbit) for F, each in seen.items()}
    cycles_ = {F: _near(F) for F in seen}
    rates = [each.determinant**0.5 for each in cycles_.values()]
    symmetric = [F for F, own in cycles_.items() if _is_symmetric(F, own)]
    ratios = ", ".join(f"{a // gcd(a, b)}:{b // gcd(a, b)}" for a, b in hits.values())
    table = [row for each in seen.values() for row in each.rows]
    table += [
        count("wall hits in 4 T at F = 1.5", 12, sum(hits["1.5"])),
        count("wall hits in 4 T at F = 3", 16, sum(hits["3"])),
        count("wall hits in 4 T at F = 4.5", 20, sum(hits["4.5"])),
        count("wall hits per period at F = 1.5", 12, sum(hits["1.5"]) // 4,
              "12 in four periods: the text says per period"),
        count("wall hits per period at F = 4.5", 20, sum(hits["4.5"]) // 4,
              "20 in four periods: the text says per period"),
        claim("hits at F = 1.5, 3, 4.5: right to left", "2:1, 1:1, 2:3",
              ratios, ratios == "2:1, 1:1, 2:3"),
        number("contraction per period, sqrt det", "0.76", float(np.mean(rates)),
               note=", ".join(f"{rate:.3f}" for rate in rates)),
        number("determinants, about", "0.57", float(np.mean([r * r for r in rates]))),
        claim("each orbit is one of a pair of mirror images", "at every F",
              f"not at F = {', '.join(symmetric)}", not symmetric,
              "the orbit at F = 3 is its own mirror image"),
    ]  # fmt: skip
    return _result(table, [each.row for each in seen.values()])


def _result(table: list[Comparison], shown: list[Row]) -> Result:
    return Result(tuple(table), Rows(tuple(shown), "Regimes over $F$", ("F",)))


def _hits(orbit: Trajectory) -> tuple[int, int]:
    words = [str(word) for word in orbit.words]
    return words.count("hit r"), words.count("hit l")


def _is_symmetric(F: str, own: Cycle) -> bool:
    state = own.x, own.v
    return bool(np.abs(np.subtract(mirrored(at(F=F), state), state)).max() < 1e-6)


def high(run: Run) -> Result:
    """Compare the orbit at F = 6, and generic orbits at F = 12 and 50."""
    six = _periodic("6")
    speed = float(np.abs(six.row.orbit.v).max())
    table = [
        *six.rows,
        claim("F = 6: largest |v|", f"<~ {SPEED_AT_6}", f"{speed:.4f}", speed <= SPEED_AT_6,
              "the hits are faster than that"),
    ]  # fmt: skip
    shown = [six.row]
    for F, (transient, window, most) in GENERIC.items():
        row, own = _generic(F, (transient, window), most, run)
        shown.append(row)
        table += own
    return _result(table, shown)


def _generic(F: str, spans: tuple[int, int], most: int, run: Run) -> tuple[Row, list[Comparison]]:
    """Compare generic orbits after a transient: the paper does not say where its orbit starts."""
    p, (transient, window) = at(F=F), spans
    side = run.size(SEEDS, 3)
    x, v = np.meshgrid(np.linspace(-0.9, 0.9, side), np.linspace(-2, 2, side))
    seeds = np.stack([x.ravel(), v.ravel()], axis=-1)
    late = swarm.follow(p, seeds, transient).states
    orbits = [_window(F, (float(a), float(b)), window) for a, b in late if np.isfinite(a)]
    speeds = np.array([np.abs(orbit.v).max() for orbit in orbits])
    stuck = sum("stick" in orbit.counts() or "capture" in orbit.counts() for orbit in orbits)
    found = () if run.quick else search(p).isolated
    sinks = [cycle for cycle in found if "sink" in cycle.kind(conserves=True)]
    settled = None if run.quick else strongest(p)
    shown = orbits[len(orbits) // 2]
    table = [
        unstated(claim(f"F = {F}: largest |v| in {window} T", f"<~ {most}",
              f"{speeds.min():.2f} to {speeds.max():.2f} ({len(speeds)} starts); "
              f"{percent(float((speeds <= most).sum()), len(speeds))} stay so slow", False),
              "where the paper's one orbit starts is not said"),
        unstated(claim(f"F = {F}: sticking in the window", "none",
              f"in {stuck} of {len(orbits)} orbits", False),
              "where the paper's one orbit starts is not said"),
    ]  # fmt: skip
    if F == "50":
        bounce = float(p.F / p.omega)
        table.append(
            claim("F = 50: near-wall chattering at", f"|v| = F/omega = {bounce:.0f}",
                  f"|v| <= {speeds.max():.2f}", bool(speeds.max() > bounce / 2),
                  "the gap is too short to reach that: the same caption has |v| <~ 7"),
        )  # fmt: skip
    if settled is not None:
        words = f"{len(sinks)} sinks of period T found; most seeds end on: {settled.kind}"
        table.append(
            roughly(claim(
                f"F = {F}: stable T-periodic orbit", "none found", words, not sinks,
                "more seeds find them; the generic orbits are transients to one of them"))
        )  # fmt: skip
    counts = Counter(str(word).split()[0] for word in shown.words)
    a, b = _hits(shown)
    title = f"$F = {F}$: after ${transient}T$; in ${window}T$: {a} r, {b} l, {counts['turn']} turns"
    return Row(shown, title), table


LOW = Figure("regimes at F = 1.5, 3, 4.5", low, "rows:rows", (7.8, 7.4))
HIGH = Figure("regimes at F = 6, 12, 50", high, "rows:rows", (7.8, 7.4))
