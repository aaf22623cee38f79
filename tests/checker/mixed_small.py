"""A small certificate of ``mixed``: few leaves of the stored one, with claims that hold."""

from __future__ import annotations

import copy
import json
from functools import cache, partial
from pathlib import Path

from cap.checker.folded.places import shares
from cap.checker.kernel.certificate import read
from cap.checker.theorems.mixed import Mixed

STORED = Path(__file__).parents[2] / "certificates/mixed.json"
FEW = 24  # leaves that are followed


def here(f, tasks):
    """Do tasks in this process."""
    return [f(task) for task in tasks]


@cache
def _small():
    """Return the certificate, as text, its theorem, and what tells fates."""
    certificate = {**json.loads(STORED.read_text()), "provenance": {}}
    hints = certificate["hints"]
    hints["places"] = {"parts": "128", "cuts": "4", "depth": "8"}
    count = len(hints["leaves"])
    step = count // FEW
    hints["leaves"] = "".join("4" if n % step == 7 else "-" for n in range(count))
    theorem = Mixed(read(json.dumps(certificate).encode()), lambda _step: None)
    judge = theorem.judge(here)
    counts = here(partial(shares, theorem.p, judge), theorem.leaves())
    a, s, stops = map(float, theorem.parts(counts, hints["leaves"]))
    known = a + s + stops
    certificate["claims"] |= {
        "shares": {
            "attractor": [f"{a - 1e-6:.6f}", f"{1 - s + 1e-6:.6f}"],
            "segment": [f"{max(0, s - 1e-6):.6f}", f"{1 - a + 1e-6:.6f}"],
            "stops": [f"{known - 1e-6:.6f}", "1"],
            "undecided": ["0", f"{1 - known + 1e-6:.6f}"],
        },
        "never_stopping_area": ["0", f"{12 * (1 - known) + 1e-5:.6f}"],
    }
    return json.dumps(certificate), theorem, judge


def small():
    """Return the theorem, and what tells fates."""
    return _small()[1:]


def certificate():
    """Return the small certificate."""
    return copy.deepcopy(json.loads(_small()[0]))
