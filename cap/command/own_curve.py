"""The command ``cap.prove island --map FILE``: an invariant curve of a map given by formulas."""

import argparse
from collections.abc import Sequence

from cap.command import own_map
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.option import integer
from cap.proofs import map_curve
from cap.proofs.rotation_choice import rotation
from cap.runner import Runner
from cap.tori.kicked import Kicked

GOLDEN = "[0;(1)]"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()
    return answered(lambda: _run(options, progress), progress)


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


def _run(options: argparse.Namespace, progress: Progress) -> int:
    """Prove it, write the certificate and print it; return the status."""
    given = own_map.given(options)
    Kicked.of(given)
    q = rotation([options.rotation], "rotation")
    runner = Runner(integer(options.jobs, "jobs", (1, 1024)), progress.tell)
    path = own_map.certificate(options, "map_curve", given)
    return own_map.answered("map_curve", lambda: map_curve.prove(given, q, runner), path, progress)
