"""fig:coexist-main: a focus and a saddle at F = 3, and the other T-periodic orbits there."""

import math
from collections import Counter
from fractions import Fraction
from functools import partial

from cap.floats.diagnostics.trajectory import trajectory
from cap.floats.search.orbits import search
from cap.paper import events, mirror
from cap.paper.certified import proves, theorem
from cap.paper.figure import Found, Run
from cap.paper.rows import Row, Rows
from cap.parameters import at
from cap.sets import interval

F = "3"
PLACES = 30
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
    low, high = (
        math.prod(map(Fraction, each)) for each in zip(*own["turning_factors"], strict=True)
    )
    least, most = map(Fraction, own["determinant"])
    ends = (interval.ball(interval.stated(end)) for end in own["determinant"])
    modulus = interval.hull(*ends).sqrt()  # of multipliers that are complex
    return own | {
        **events.counted(own["itinerary"]),
        "modulus": interval.outward(modulus, PLACES),
        "product": float(low),
        "error": max(high - least, most - low),  # the factors are positive
    }


def patterns(run: Run) -> Found:
    """Compare the events of both orbits."""
    first, second = (orbit(run, name)["itinerary"] for name in STARTS)
    return {"differ": first != second}


def symmetry(_run: Run) -> Found:
    """Compare both orbits with their mirror images."""
    own = max(mirror.defect(at(F=F), state) for state in STARTS.values()) < 1e-3
    return {"images": "each is its own image" if own else "not their own images", "own": own}


def all_orbits(run: Run) -> Found:
    """Search for others; prove one of each pair of mirror images, and so both."""
    p = at(F=F)
    found = search(p).isolated
    kinds = Counter(cycle.kind(conserves=True) for cycle in found)
    chosen = [] if run.quick else mirror.of_pairs(p, found)
    proofs = run.runner.map(partial(proves, p), [cycle for cycle, _ in chosen], "proving",
                            processes=True)  # fmt: skip
    return {
        "orbits": len(found),
        "kinds": ", ".join(f"{n} {kind}" for kind, n in kinds.items()),
        "proved": sum(n for (_, n), proved in zip(chosen, proofs, strict=True) if proved),
    }
