"""fig:coexist-main: a focus and a saddle at F = 3, and the other T-periodic orbits there."""

import math
from collections import Counter
from typing import Any

import numpy as np

from cap.explore.inventory import inventory
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.floats.search.inventory import PROVED
from cap.paper.certified import theorem
from cap.paper.figure import Found, Run
from cap.paper.formulas import saddle_center
from cap.paper.rows import Row, Rows
from cap.parameters import Parameters, at

F = "3"
STARTS = {"focus": (0.4064, -0.6708), "saddle": (0.1992, -1.4002)}
EVENTS = "2 right, 2 left, 2 turns"


def _own(name: str) -> dict[str, Any]:
    """Prove the orbit."""
    return theorem("periodic", STARTS[name], F)


def data(_run: Run) -> Rows:
    """Follow both orbits."""
    shown = _row("focus", "sink (focus)"), _row("saddle", "saddle")
    return Rows(shown, "Two $T$-periodic orbits", forcing=False)


def _row(name: str, title: str) -> Row:
    x, v = STARTS[name]
    orbit = trajectory(at(F=F), orbit=(x, v), periods=2)
    return Row(orbit, f"{title}: $(x_*, v_*) = ({x:.4f}, {v:.4f})$")


def orbit(_run: Run, name: str) -> Found:
    """Enclose a fixed point, and say what its orbit does."""
    own = _own(name)
    words, kinds = Counter(own["itinerary"]), Counter(w.split()[0] for w in own["itinerary"])
    pattern = f"{words['hit r']} right, {words['hit l']} left, {kinds['turn']} turns"
    return {
        **{what: own[what] for what in ("x", "v", "trace", "determinant", "type")},
        "pattern": pattern,
        "same": pattern == EVENTS,
        "right": words["hit r"],
        "left": words["hit l"],
        "once": words["hit r"] == words["hit l"] == 1,
        "sink_focus": own["type"] == "sink focus",
        "saddle": own["type"] == "saddle",
    }


def complex_multipliers(_run: Run) -> Found:
    """Enclose the multipliers of the focus."""
    first = _own("focus")["multipliers"][0]
    size = math.hypot(float(first["re"][0]), float(first["im"][0]))
    return {"re": first["re"], "im": first["im"], "modulus": [f"{size:.15f}"]}


def real_multipliers(_run: Run) -> Found:
    """Enclose the multipliers of the saddle."""
    larger, smaller = _own("saddle")["multipliers"]
    return {"larger": larger, "smaller": smaller}


def patterns(_run: Run) -> Found:
    """Compare the events of both orbits."""
    return {"differ": _own("saddle")["itinerary"] != _own("focus")["itinerary"]}


def mirrored(p: Parameters, state: State) -> State:
    """Return the state at t = 0 of the mirror image of an orbit."""
    x, v = swarm.follow(p, [state], 0.5).states[0].tolist()
    return float(p.l + p.r) - x, -v


def symmetry(_run: Run) -> Found:
    """Compare both orbits with their mirror images."""
    defects = [np.abs(np.subtract(mirrored(at(F=F), s), s)).max() for s in STARTS.values()]
    own = all(defect < 1e-3 for defect in defects)
    return {"images": "each is its own image" if own else "not their own images", "own": own}


def all_orbits(run: Run) -> Found:
    """Search for others, and prove them."""
    found = inventory(at(F=F), prove=not run.quick, runner=run.runner).orbits
    kinds = Counter(each.kind for each in found)
    return {
        "orbits": len(found),
        "kinds": ", ".join(f"{n} {kind}" for kind, n in kinds.items()),
        "proved": sum(each.verdict == PROVED for each in found),
    }


def turns(_run: Run) -> Found:
    """Compare the determinant with the product over the turns."""
    own = _own("focus")
    product = math.prod(float(low) for low, _ in own["turning_factors"])
    return {
        "product": product,
        "equal": abs(product - float(own["determinant"][0])) < 1e-9,
        "turns": len(own["turning_factors"]),
        "never": not own["turning_factors"],
    }


def curve(_run: Run) -> Found:
    """Evaluate the paper's curve f_sc at F = 3."""
    sc = saddle_center(2, float(F))
    return {"sc": sc, "positive": sc > 0}
