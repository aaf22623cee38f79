"""The command ``cap.prove island --map FILE``: an invariant curve of a map given by formulas."""

import argparse
from collections.abc import Sequence

from cap.command import own_command
from cap.command.console import Parser
from cap.command.own_command import Asked
from cap.proofs import map_curve
from cap.proofs.map_horseshoe import as_parameters
from cap.proofs.rotation_choice import rotation
from cap.runner import Runner
from cap.system.files import assigned, planar
from cap.tori.kicked import Kicked

GOLDEN = "[0;(1)]"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    return own_command.run(words, parser(), asked)


def parser() -> Parser:
    """Return the parser of this command."""
    p = own_command.begun(
        "island",
        "--map",
        "Prove that a map (x, y) -> (x + b y' + c, y'), y' = y + q(x), x an angle, q a polynomial "
        "in cos x and sin x with mean 0, has an analytic invariant curve around the cylinder with "
        "a given rotation number: no orbit crosses it.",
        "Example: python -m cap.prove island --map examples/maps/standard.py --set K=9/10",
    )
    p.add_argument(
        "--rotation",
        default=GOLDEN,
        metavar="[0;A,...]",
        help="the rotation number of the curve, modulo 1, as [0;3,1,1,6,(1)]: a continued fraction "
        "with its period in parentheses (default [0;(1)], the golden one)",
    )
    return own_command.ended(p)


def asked(options: argparse.Namespace) -> Asked:
    """Read the options; raise `BadInput` with what is wrong."""
    values = assigned(options.set)
    given = planar(options.file, values)
    Kicked.of(given)
    q = rotation([options.rotation], "rotation")
    path = own_command.place(options, ["map_curve"], values, as_parameters(given))
    return Asked(
        "map_curve", path, lambda tell: map_curve.prove(given, q, Runner(options.jobs, tell))
    )
