"""How long a model takes to become straight-line code: from its JSON to functions, in milliseconds.

    python benchmarks/specialised.py [ROUNDS]

All contacts and all guards of each example: the equations of a leg with their derivatives, guards
along flights with theirs, resets and flights; over balls (which jets take, too) and over doubles.
Each is evaluated nowhere.  Times are the least of the rounds, of processor time.
"""

import sys
import time
from collections.abc import Iterator
from pathlib import Path

from cap.errors import BadInput
from cap.orbits.itinerary import Contact
from cap.orbits.leg import Kinds
from cap.orbits.strobe import contact
from cap.sets import interval
from cap.system.files import load
from cap.system.form import dumps, loads
from cap.system.source import Function

EXAMPLES = Path(__file__).parents[1] / "examples"
BITS = 96


def functions(kinds: Kinds) -> Iterator[Function]:
    """Give all functions of a system whose flights are known in closed form, or by exponentials."""
    system = kinds.system
    for mode in system.modes:
        kinds.lemmas(mode)
        yield kinds.state(mode)
        for guard in system.modes[mode].guards:
            watch = kinds.watch(mode, guard)
            yield from (watch.along, watch.height, watch.bend, watch.at, watch.rate)
            for to in system.modes[mode].guards[guard].to:
                key = Contact(mode, guard, to)
                leg = kinds.leg(key)
                yield from (leg.after, leg.value, leg.slope, contact(system, key))


def specialised(text: str) -> int:
    """Make all functions of a system; return how many lines they have."""
    lines = 0
    with interval.workprec(BITS):
        for function in functions(Kinds(loads(text))):
            function.balls()
            function.floats()
            lines += function.source.count("\n")
    return lines


def main(rounds: int) -> None:
    """Print a line for each example."""
    for path in sorted(EXAMPLES.glob("*.py")):
        try:
            text = dumps(load(path).system)
            least, lines = float("inf"), 0
            for _ in range(rounds):
                began = time.process_time()
                lines = specialised(text)
                least = min(least, (time.process_time() - began) * 1e3)
        except BadInput as why:
            print(f"{path.stem:18} {why}")
            continue
        print(f"{path.stem:18} {least:6.1f} ms, {lines} lines")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
