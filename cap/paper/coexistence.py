"""fig:coexist-main: a focus and a saddle at F = 3, and the other T-periodic orbits there."""

import math
from collections import Counter

import numpy as np

from cap.explore.inventory import inventory
from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.engine import swarm
from cap.floats.findings import State
from cap.floats.search.inventory import PROVED
from cap.paper import events
from cap.paper.certified import theorem
from cap.paper.figure import Found, Run
from cap.paper.rows import Row, Rows
from cap.parameters import Parameters, at

F = "3"
STARTS = {"focus": (0.4064, -0.6708), "saddle": (0.1992, -1.4002)}


def data(_run: Run) -> Rows:
    """Follow both orbits."""
    shown = _row("focus", "sink (focus)"), _row("saddle", "saddle")
    return Rows(shown, "Two $T$-periodic orbits", forcing=False)


def _row(name: str, title: str) -> Row:
    x, v = STARTS[name]
    orbit = trajectory(at(F=F), orbit=(x, v), periods=2)
    return Row(orbit, f"{title}: $(x_*, v_*) = ({x:.4f}, {v:.4f})$")


def orbit(_run: Run, name: str) -> Found:
    """Prove an orbit: the claims of the theorem, and what follows."""
    own = theorem("periodic", STARTS[name], F)
    product = math.prod(float(low) for low, _ in own["turning_factors"])
    size = math.sqrt(float(own["determinant"][0]))  # of multipliers that are complex
    return own | {
        **events.counted(own["itinerary"]),
        "modulus": [f"{size:.15f}"],
        "product": product,
        "error": abs(product - float(own["determinant"][0])),
    }


def patterns(run: Run) -> Found:
    """Compare the events of both orbits."""
    first, second = (orbit(run, name)["itinerary"] for name in STARTS)
    return {"differ": first != second}


def mirrored(p: Parameters, state: State) -> State:
    """Return the state at t = 0 of the mirror image of an orbit."""
    x, v = swarm.follow(p, [state], 0.5).states[0].tolist()
    return float(p.l + p.r) - x, -v


def symmetry(_run: Run) -> Found:
    """Compare both orbits with their mirror images."""
    defects = [np.abs(np.subtract(mirrored(at(F=F), s), s)).max() for s in STARTS.values()]
    own = max(defects) < 1e-3
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
