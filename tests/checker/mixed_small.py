"""A small certificate of ``mixed``: few regions, cut evenly, with claims that hold."""

from __future__ import annotations

import copy
import json
from functools import cache
from pathlib import Path

from cap.areas.listing import written
from cap.checker.kernel.certificate import read
from cap.checker.theorems.mixed import Mixed

STORED = Path(__file__).parents[2] / "certificates/mixed.json"
SHALLOW = 12  # the deepest nodes of the tree of places, and its cells


def even(halvings, cuts, flights):
    """Return a tree, as text: times halved, then places cut, so often; all leaves are followed."""
    return written(numbers(halvings, cuts, [flights + 2]))


def parted(halvings, cuts, flights, more):
    """Return a tree of which each leaf has one of parts: halved and cut so often, all followed."""
    return written(numbers(halvings, cuts, [flights + 2, *numbers(*more, [3])]))


def numbers(halvings, cuts, leaf):
    """Return the numbers of such a tree."""
    if halvings + cuts == 0:
        return leaf
    part = numbers(halvings - 1, cuts, leaf) if halvings else numbers(0, cuts - 1, leaf)
    return [*([1] if halvings else [2, 0, 0, 0]), *part, *part]


def pruned(letters, depth):
    """Return a tree without what is deeper; the letters of the whole tree are used up."""
    letter = next(letters)
    if letter != "2":
        return letter
    halves = pruned(letters, depth - 1), pruned(letters, depth - 1)
    return "2" + "".join(halves) if depth > 0 else "0"


def here(f, tasks, *_):
    """Do tasks in this process."""
    return [f(task) for task in tasks]


def counted(theorem, places):
    """Return the parts of the area."""
    return theorem.parts(theorem.counted(here, places))


@cache
def _small():
    """Return the certificate, as text, its theorem, and the fates of places."""
    certificate = {**json.loads(STORED.read_text("utf-8")), "provenance": {}}
    hints = certificate["hints"]
    tree = pruned(iter(hints["places"]["tree"]), SHALLOW)
    hints["places"] = {"level": str(SHALLOW), "tree": tree}
    sticks = {"late": even(3, 3, 20), "early": even(3, 6, 20)}
    hints["stops"] = {**sticks, "turns": parted(3, 3, 20, (2, 2))}
    theorem = Mixed(read(json.dumps(certificate).encode()), lambda _step: None)
    places = theorem.places(here)
    a, s, either, known = map(float, counted(theorem, places))
    certificate["claims"] |= {
        "shares": {
            "attractor": [f"{a - 1e-6:.6f}", f"{1 - s + 1e-6:.6f}"],
            "segment": [f"{max(0, s - 1e-6):.6f}", f"{1 - a + 1e-6:.6f}"],
            "either": [f"{either - 1e-6:.6f}", "1"],
            "stops": [f"{known - 1e-6:.6f}", "1"],
            "undecided": ["0", f"{1 - known + 1e-6:.6f}"],
        },
        "never_stopping_area": ["0", f"{12 * (1 - known) + 1e-5:.6f}"],
    }
    return json.dumps(certificate), theorem, places


def small():
    """Return the theorem, and the fates of places."""
    return _small()[1:]


def certificate():
    """Return the small certificate."""
    return copy.deepcopy(json.loads(_small()[0]))
