"""The command ``cap.prove basin --model FILE``: the share of a rectangle that comes to rest.

The wall is a guard that names a mode of rest (`cap.proofs.contact_basin`).
"""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

from cap.areas.resting.asked import Rectangle, driven
from cap.checker.theorems.contact_basin import LONGEST
from cap.command import own_map
from cap.command.console import Parser, program, protected
from cap.command.own_capture import add_guard, box_of, wall_of
from cap.command.progress import Progress, answered
from cap.errors import BadInput
from cap.option import integer
from cap.orbits.numbers import Floats
from cap.orbits.wall import Wall
from cap.parameters import exact
from cap.proofs import contact_basin
from cap.proofs.contact_basin import CELLS
from cap.proofs.contacts import as_parameters
from cap.runner import Runner
from cap.system.files import assigned, read, stem

MOST = 100_000  # cells


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()
    return answered(lambda: _proved(Asked.of(options), progress), progress)


def parser() -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} basin --model FILE",
        description="Prove which share of a rectangle of states of a system of your own comes to "
        "rest before a time, after infinitely many contacts with a guard that names a mode of "
        "rest, and which share still flies then.  The state has two variables, the guard is the "
        "only one of its mode, and its second derivative depends on the clock alone, as that of a "
        "ball on a vibrating table.  FILE.py has a function of the parameters that returns a "
        "cap.System (see docs/own-system.md).  The certificate holds the system: `python -m "
        "cap.verify` needs no FILE.py.",
        epilog="Example: python -m cap.prove basin --model examples/ball.py --set A=3/10 --box 0 2 "
        "-2 2 --until 6",
    )
    own_map.add_model(p, "basin")
    p.add_argument(
        "--box",
        nargs="+",
        required=True,
        metavar="Q",
        help="least and greatest value of each variable of the state, in its order",
    )
    p.add_argument("--until", required=True, metavar="T", help="they are followed until this time")
    p.add_argument(
        "--start", default="0", metavar="T", help="the time at which they are in it (default 0)"
    )
    p.add_argument(
        "--cells",
        default=str(CELLS),
        metavar="N",
        help=f"about so many cells (default {CELLS}): more of them leave less undecided",
    )
    add_guard(p)
    own_map.add_ends(p, "of the checker, which follows each cell again")
    return p


@dataclass(frozen=True)
class Asked:
    """What is asked for; all of it makes sense."""

    wall: Wall
    rectangle: Rectangle
    cells: int
    jobs: int
    path: Path

    @classmethod
    def of(cls, options: argparse.Namespace) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        values = assigned(options.set)
        system = read(options.model, values)
        place, box = wall_of(system, options.guard), box_of(system.state, options.box)
        driven(place)
        start, until = exact(options.start), exact(options.until)
        if not start < until:
            raise BadInput("--until is not after --start")
        if 2 * pi / Floats(system).period * float(until - start) > LONGEST:
            raise BadInput(f"--until is too late: at most {LONGEST}/omega after --start")
        if any(a == b for a, b in box.values()):
            raise BadInput("--box has no area")
        cells = integer(options.cells, "cells", (1, MOST))
        jobs = integer(options.jobs, "jobs", (1, 1024))
        told = {**values, "until": options.until, **({"start": options.start} if start else {})}
        names = ["contact_basin", stem(options.model)]
        parameters = as_parameters(system, rests=True)
        path = own_map.place(options, names, told, parameters)
        return cls(place, Rectangle(start, until, box), cells, jobs, path)


def _proved(asked: Asked, progress: Progress) -> int:
    """Prove it, write the certificate and print it; return the status."""

    def prove() -> dict[str, Any]:
        runner = Runner(asked.jobs, progress.tell)
        return contact_basin.prove(asked.wall, asked.rectangle, asked.cells, runner)

    return own_map.answered("contact_basin", prove, asked.path, progress)
