"""The command ``cap.prove island --ball A=1/5``: an invariant curve of an elastic bouncing ball."""

import argparse
from collections.abc import Sequence

from cap.command import own_command
from cap.command.console import Parser, program
from cap.command.own_command import Asked
from cap.command.own_curve import GOLDEN
from cap.errors import BadInput
from cap.option import integer
from cap.parameters import exact
from cap.proofs import ball_curve
from cap.proofs.ball_curve import Table
from cap.proofs.rotation_choice import rotation
from cap.runner import Runner
from cap.system.files import assigned


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    return own_command.run(words, parser(), asked)


def parser() -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} island --ball A=Q,omega=Q,g=Q",
        description="Prove that a ball, y'' = -g, that bounces elastically on a table at A "
        "sin(omega t), A omega^2 < g, has an analytic invariant curve in the plane of the phase "
        "and the speed of impacts: it bounds all speeds below it, for all times.",
        epilog="Example: python -m cap.prove island --ball A=1/5 --rotation '[0;(1)]' --turns 1",
    )
    p.add_argument("theorem", metavar="island", help="what is proved")
    p.add_argument(
        "--ball",
        required=True,
        metavar="A=Q,..",
        help="A, omega and g, exact: 0.5 means 1/2 (default 1/5, 1, 1)",
    )
    p.add_argument(
        "--rotation",
        default=GOLDEN,
        metavar="[0;A,...]",
        help="so many times, besides --turns N, the table oscillates between two impacts on the "
        "curve: a continued fraction with its period in parentheses (default [0;(1)], the golden "
        "number)",
    )
    p.add_argument("--turns", default="0", metavar="N", help="and N times more (default 0)")
    return own_command.ended(p)


def asked(options: argparse.Namespace) -> Asked:
    """Read the options; raise `BadInput` with what is wrong."""
    given = assigned(options.ball)
    if unknown := sorted(given.keys() - set(Table._fields)):
        raise BadInput(f"a ball has no parameter {unknown[0]}: it has A, omega and g")
    table = Table(**{name: exact(word) for name, word in given.items()}).checked()
    q = rotation([options.rotation], "rotation")
    turns = integer(options.turns, "turns", (0, 999))
    told = {**given, **({"turns": turns} if turns else {})}
    path = own_command.place(options, ["ball_curve"], told, ball_curve.as_parameters(table))
    return Asked(
        "ball_curve",
        path,
        lambda tell: ball_curve.prove(table, q, turns, Runner(options.jobs, tell)),
    )
