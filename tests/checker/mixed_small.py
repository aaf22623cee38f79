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
SHALLOW = 12  # the deepest nodes of the tree of places, and its cells


def here(f, tasks):
    """Do tasks in this process."""
    return [f(task) for task in tasks]


def pruned(letters, depth):
    """Return a tree without what is deeper; the letters of the whole tree are used up."""
    letter = next(letters)
    if letter != "2":
        return letter
    halves = pruned(letters, depth - 1), pruned(letters, depth - 1)
    return "2" + "".join(halves) if depth > 0 else "0"


@cache
def _small():
    """Return the certificate, as text, its theorem, and what tells fates."""
    certificate = {**json.loads(STORED.read_text()), "provenance": {}}
    hints = certificate["hints"]
    tree = pruned(iter(hints["places"]["tree"]), SHALLOW)
    hints["places"] = {"level": str(SHALLOW), "tree": tree}
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
