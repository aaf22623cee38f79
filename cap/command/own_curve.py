"""The command ``cap.prove island --map FILE``: an invariant curve of a map given by formulas."""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cap.command import own_map
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.option import integer
from cap.proofs import map_curve
from cap.proofs.rotation_choice import rotation
from cap.runner import Runner
from cap.system.planar import Map
from cap.tori.kicked import Kicked
from cap.tori.rotation import Quadratic

GOLDEN = "[0;(1)]"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()
    return answered(lambda: _proved(Asked.of(options), progress), progress)


def parser() -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} island --map FILE",
        description="Prove that a map (x, y) -> (x + b y' + c, y'), y' = y + q(x), x an angle, q a "
        "polynomial in cos x and sin x with mean 0, has an analytic invariant curve around the "
        "cylinder with a given rotation number: no orbit crosses it.  FILE.py has a function of "
        "the parameters that returns a cap.Map.  The certificate holds the map: `python -m "
        "cap.verify` needs no FILE.py.",
        epilog="Example: python -m cap.prove island --map examples/maps/standard.py --set K=9/10",
    )
    own_map.add_common(p, "island")
    p.add_argument(
        "--rotation",
        default=GOLDEN,
        metavar="[0;A,...]",
        help="the rotation number of the curve, modulo 1, as [0;3,1,1,6,(1)]: a continued fraction "
        "with its period in parentheses (default [0;(1)], the golden one)",
    )
    return p


@dataclass(frozen=True)
class Asked:
    """What is asked for; all of it makes sense."""

    map: Map
    rotation: Quadratic
    jobs: int
    path: Path

    @classmethod
    def of(cls, options: argparse.Namespace) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        given = own_map.given(options)
        Kicked.of(given)
        q = rotation([options.rotation], "rotation")
        jobs = integer(options.jobs, "jobs", (1, 1024))
        return cls(given, q, jobs, own_map.certificate(options, "map_curve", given))


def _proved(asked: Asked, progress: Progress) -> int:
    """Prove it, write the certificate and print it; return the status."""
    runner = Runner(asked.jobs, progress.tell)

    def prove() -> dict[str, Any]:
        return map_curve.prove(asked.map, asked.rotation, runner)

    return own_map.answered("map_curve", prove, asked.path, progress)
