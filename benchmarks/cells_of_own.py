"""Cells of `branch --model`: milliseconds for each that is tried, in processor time.

    python benchmarks/cells_of_own.py [ROUNDS]

Times are the least of the rounds, of the curve alone: to find the orbit at which it begins, its
bifurcations and the certificate are not in it.  Of the cells that are tried some fail.
"""

import sys
import time
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any
from unittest.mock import patch

from cap.floats.models.periodic import search
from cap.orbits.branch import Follower
from cap.orbits.cells import Cells
from cap.orbits.curve import Curve
from cap.orbits.itinerary import Itinerary
from cap.orbits.periodic import Prover
from cap.proofs import contacts
from cap.proofs.contacts_branch import BITS
from cap.sets import interval
from cap.system.files import load
from cap.system.moving import moving

EXAMPLES = Path(__file__).parents[1] / "examples"
CASES = {  # parameter, range
    "ball": ("A", "1", "2"),
    "harvester": ("s", "1/10", "3/5"),
    "impact_oscillator": ("gap", "3/40", "1/8"),
    "clock": ("f", "1/100", "3/100"),
}


def follower(name: str, parameter: str, low: str, high: str) -> tuple[Follower[Any], list[float]]:
    """Return what follows the curve of an example, and the orbit at which it begins."""
    path, ends = EXAMPLES / f"{name}.py", (Fraction(low), Fraction(high))
    here = load(path)
    orbit = search(here.system, 1, lambda *_: None).orbits[0]
    begun = {contact.mode for contact in orbit.itinerary.contacts}
    system = moving(lambda p: load(path, {parameter: p}).system, parameter, ends, begun)
    curve = Curve(Itinerary(system, orbit.itinerary.contacts, orbit.itinerary.periods))
    prover = Prover(curve.equations, pieces=True)

    def quiet(box: Sequence[Any]) -> contacts.Cuts:
        around = tuple(curve.expanded(box))
        return contacts.legs(prover, around, prover.reasons(around))

    guess = [*orbit.guess, float(here.values[parameter])]
    return Follower(Cells(curve), ends, quiet, lambda *_: None), guess


def followed(of: Follower[Any], guess: list[float]) -> tuple[float, int]:
    """Return the milliseconds for a curve, and how many cells were tried."""
    with (
        patch.object(of, "points", return_value=()),
        patch.object(of.cells, "line", wraps=of.cells.line) as tried,
        interval.workprec(BITS),
    ):
        began = time.process_time()
        of.branch(guess)
        return (time.process_time() - began) * 1e3, tried.call_count


def main(rounds: int) -> None:
    """Print a line for each example."""
    for name, case in CASES.items():
        of, guess = follower(name, *case)
        least, count = min(followed(of, guess) for _ in range(rounds))
        print(f"{name:18} {least / count:6.2f} ms for each of {count} cells")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10)
