"""The command ``cap.prove capture --model FILE``: a system of one's own comes to rest.

The wall is a guard that names a mode of rest.  A box of states is given, or looked for at the wall
(`cap.proofs.contact_capture`).
"""

import argparse
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from cap.command import own_command
from cap.command.console import Parser
from cap.command.own_command import Asked
from cap.errors import BadInput
from cap.orbits.capture import Boxes
from cap.orbits.wall import Wall, wall
from cap.parameters import exact
from cap.proofs import contact_capture, wall_boxes
from cap.proofs.contacts import as_parameters
from cap.runner import Tell
from cap.system.files import assigned, read
from cap.system.model import System

THEOREM = "contact_capture"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    return own_command.run(words, parser(), asked)


def parser() -> Parser:
    """Return the parser of this command."""
    p = own_command.begun(
        "capture",
        "--model",
        "Prove that a system of your own comes to rest: from a box of states every motion hits a "
        "guard infinitely often in a finite time, and then stays in the mode of rest that the "
        "guard names, for ever or at least until a time that is printed.",
        "Examples: python -m cap.prove capture --model examples/ball.py --set A=1/5 --box 0 10 -5 "
        "5;  python -m cap.prove capture --model examples/ball.py",
    )
    p.add_argument(
        "--box",
        nargs="+",
        metavar="Q",
        help="least and greatest value of each variable of the state, in its order; without it a "
        "large box at the wall is looked for (two variables)",
    )
    p.add_argument(
        "--start",
        metavar="T",
        help="the time at which motions are in the box (default 0; without --box one is chosen)",
    )
    p.add_argument(
        "--mode", metavar="MODE", help="the mode in which they are (default: that of the guard)"
    )
    add_guard(p)
    return own_command.ended(p, workers="")


def add_guard(p: argparse.ArgumentParser) -> None:
    """Add which guard is the wall."""
    p.add_argument(
        "--guard",
        metavar="MODE/GUARD",
        help="the guard that is hit, and its mode (default: the first that names a mode of rest)",
    )


def asked(options: argparse.Namespace) -> Asked:
    """Read the options; raise `BadInput` with what is wrong."""
    values = assigned(options.set)
    system = read(options.file, values)
    place = wall_of(system, options.guard)
    given = None if options.box is None else box_of(system.state, options.box)
    if given is None and len(system.state) != 2:
        raise BadInput(f"give --box: the state has {len(system.state)} variables, not two")
    mode = options.mode or place.falling
    if mode not in (place.falling, place.rising):
        raise BadInput(f"--mode is {place.falling} or {place.rising}, before or after a hit")
    begin = None if options.start is None else exact(options.start)
    told = {**values, **({"start": options.start} if options.start else {})}
    path = own_command.place(options, [THEOREM], told, as_parameters(system, rests=True))

    def prove(tell: Tell) -> dict[str, Any]:
        time, box = begin, given
        if box is None:
            time, box = wall_boxes.at_the_wall(place, time, tell)
        return contact_capture.prove(place, time or Fraction(0), mode, box, tell)

    return Asked(THEOREM, path, prove)


def wall_of(system: System, given: str | None) -> Wall:
    """Return the wall whose MODE/GUARD is given, or the first one."""
    mode, slash, guard = (given or "").rpartition("/")
    if given and not slash:
        raise BadInput("--guard is MODE/GUARD")
    return wall(system, mode or None, guard or None)


def box_of(state: Sequence[str], given: Sequence[str]) -> Boxes:
    """Return the box of the state."""
    ends = [exact(word) for word in given]
    pairs = list(zip(ends[::2], ends[1::2], strict=False))
    if len(ends) != 2 * len(state) or any(a > b for a, b in pairs):
        told = ", ".join(state)
        raise BadInput(f"--box is the least and the greatest value of each of: {told}")
    return dict(zip(state, pairs, strict=True))
