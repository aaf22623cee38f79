"""The command ``cap.prove capture --model FILE``: a system of one's own comes to rest.

The wall is a guard that names a mode of rest.  A box of states is given, or looked for at the wall
(`cap.proofs.contact_capture`).
"""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from cap.command import own_map
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.errors import BadInput
from cap.orbits.capture import Boxes
from cap.orbits.wall import Wall, wall
from cap.parameters import exact
from cap.proofs import contact_capture, wall_boxes
from cap.proofs.contacts import as_parameters
from cap.system.files import assigned, read, stem
from cap.system.model import System


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()
    return answered(lambda: _proved(Asked.of(options), progress), progress)


def parser() -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} capture --model FILE",
        description="Prove that a system of your own comes to rest: from a box of states every "
        "motion hits a guard infinitely often in a finite time, and then stays in the mode of rest "
        "that the guard names, for ever or at least until a time that is printed.  FILE.py has a "
        "function of the parameters that returns a cap.System (see docs/own-system.md).  The "
        "certificate holds the system: `python -m cap.verify` needs no FILE.py.",
        epilog="Examples: python -m cap.prove capture --model examples/ball.py --set A=1/5 --box 0 "
        "10 -5 5;  python -m cap.prove capture --model examples/ball.py",
    )
    own_map.add_model(p, "capture")
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
    own_map.add_out(p)
    return p


def add_guard(p: argparse.ArgumentParser) -> None:
    """Add which guard is the wall."""
    p.add_argument(
        "--guard",
        metavar="MODE/GUARD",
        help="the guard that is hit, and its mode (default: the first that names a mode of rest)",
    )


@dataclass(frozen=True)
class Asked:
    """What is asked for; all of it makes sense."""

    wall: Wall
    mode: str
    time: Fraction | None
    box: Boxes | None
    path: Path

    @classmethod
    def of(cls, options: argparse.Namespace) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        values = assigned(options.set)
        system = read(options.model, values)
        place = wall_of(system, options.guard)
        box = None if options.box is None else box_of(system.state, options.box)
        if box is None and len(system.state) != 2:
            raise BadInput(f"give --box: the state has {len(system.state)} variables, not two")
        started = options.mode or place.falling
        if started not in (place.falling, place.rising):
            raise BadInput(f"--mode is {place.falling} or {place.rising}, before or after a hit")
        time = None if options.start is None else exact(options.start)
        told = {**values, **({"start": options.start} if options.start else {})}
        parameters = as_parameters(system, rests=True)
        path = own_map.place(options, ["contact_capture", stem(options.model)], told, parameters)
        return cls(place, started, time, box, path)


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


def _proved(asked: Asked, progress: Progress) -> int:
    """Prove it, write the certificate and print it; return the status."""

    def prove() -> dict[str, Any]:
        time, box = asked.time, asked.box
        if box is None:
            time, box = wall_boxes.at_the_wall(asked.wall, time, progress.tell)
        start = time or Fraction(0)
        return contact_capture.prove(asked.wall, start, asked.mode, box, progress.tell)

    return own_map.answered("contact_capture", prove, asked.path, progress)
