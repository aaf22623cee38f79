"""The command ``cap.prove basin --model FILE``: the share of a rectangle that comes to rest.

The wall is a guard that names a mode of rest (`cap.proofs.contact_basin`).
"""

import argparse
from collections.abc import Sequence
from math import pi

from cap.areas.resting.asked import Rectangle, driven
from cap.checker.theorems.contact_basin import LONGEST
from cap.command import own_command
from cap.command.console import Parser
from cap.command.own_capture import add_guard, box_of, wall_of
from cap.command.own_command import Asked
from cap.errors import BadInput
from cap.option import integer
from cap.orbits.numbers import Floats
from cap.parameters import exact
from cap.proofs import contact_basin
from cap.proofs.contact_basin import CELLS
from cap.proofs.contacts import as_parameters
from cap.runner import Runner
from cap.system.files import assigned, read

THEOREM = "contact_basin"
MOST = 100_000  # cells


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    return own_command.run(words, parser(), asked)


def parser() -> Parser:
    """Return the parser of this command."""
    p = own_command.begun(
        "basin",
        "--model",
        "Prove which share of a rectangle of states of a system of your own comes to rest before "
        "a time, after infinitely many contacts with a guard that names a mode of rest, and which "
        "share still flies then.  The state has two variables, the guard is the only one of its "
        "mode, and its second derivative depends on the clock alone, as that of a ball on a "
        "vibrating table.",
        "Example: python -m cap.prove basin --model examples/ball.py --set A=3/10 --box 0 2 -2 2 "
        "--until 6",
    )
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
    return own_command.ended(p, "processes of the checker, which follows each cell again")


def asked(options: argparse.Namespace) -> Asked:
    """Read the options; raise `BadInput` with what is wrong."""
    values = assigned(options.set)
    system = read(options.file, values)
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
    told = {**values, "until": options.until, **({"start": options.start} if start else {})}
    path = own_command.place(options, [THEOREM], told, as_parameters(system, rests=True))
    rectangle = Rectangle(start, until, box)
    return Asked(
        THEOREM,
        path,
        lambda tell: contact_basin.prove(place, rectangle, cells, Runner(options.jobs, tell)),
    )
