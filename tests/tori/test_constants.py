"""The constants of the written proof are those of prover and checker."""

import re
from fractions import Fraction
from math import e as euler
from pathlib import Path

from cap.checker.kernel.interval import Interval
from cap.checker.tori import invariant_curve as checker
from cap.sets import interval
from cap.sets.interval import Ball
from cap.tori import invariant_curve as prover

PAGE = Path(__file__).parents[2] / "docs/invariant-curve-proof.md"
VALUES = {
    "eps": 1e-40,
    "l0": 0.7,
    "n0": 90.0,
    "d0": 0.01,
    "t0": 80.0,
    "tm": 50.0,
    "M": 1.3,
    "r": 0.01,
    "rho": 0.1,
    "c": 0.6,
}


def written(allowed, tilt):
    """Evaluate the formulas of the page."""
    text = PAGE.read_text(encoding="utf-8")
    block = re.search(r"R\*, s\* ≥ 0, and let δ = ρ/7 and\n\n((?:    .*\n)+)", text)[1]
    values = {**VALUES, "R": allowed, "S": tilt, "e": euler, "delta": VALUES["rho"] / 7}
    for line in block.splitlines():
        name, formula = (part.strip() for part in line.split(" = "))
        formula = formula.replace("R*", "R").replace("s*", "S").replace("^", "**")
        formula = re.sub(r"(?<=[\w)]) (?=[\w(])", " * ", formula)
        formula = formula.replace(")(", ")*(")
        values[name] = eval(formula, {"__builtins__": {}}, values)  # noqa: S307 (our own page)
    return values


def test_they_are_the_same():
    """To ten digits, at numbers drawn by nobody: each has its own."""
    page = written(1e-9, 1e-8)
    with interval.workprec(200):
        balls = [Ball(value) for value in VALUES.values()]
        found = prover.constants(prover.Sizes(*balls), Ball(1e-9), Ball(1e-8))
        mine = [float(x.mid()) for x in found]
    exact = [
        Interval.enclosing(Fraction(x), Fraction(x), 400) for x in [*VALUES.values(), 1e-9, 1e-8]
    ]
    theirs = checker.bounds(checker.Sizes(*exact[:10]), *exact[10:])
    for name, a, b in zip(("RK", "s"), mine, theirs, strict=False):
        assert abs(a / page[name] - 1) < 1e-10
        assert abs(float(b.upper) / page[name] - 1) < 1e-10
    assert abs(mine[2] / page["y0"] - 1) < 1e-10
