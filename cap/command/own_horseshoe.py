"""The commands ``cap.prove horseshoe --map FILE`` and ``--model FILE``: chaos of a map given by
formulas, and of the map from contact to contact of a system of one's own.
"""

import argparse
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

from cap.command import own_command
from cap.command.console import Parser
from cap.command.own_command import Asked
from cap.errors import BadInput
from cap.option import choice, integer
from cap.proofs import contact_horseshoe, map_horseshoe
from cap.proofs.contacts import as_parameters
from cap.proofs.coverings import ABOUT, WHICH
from cap.runner import Runner
from cap.system.files import assigned, planar, read


class Kind(NamedTuple):
    """What a file may describe, how that is read and proved, and how people are told."""

    flag: str
    theorem: str
    effort: tuple[int, int]  # the usual one, and the most
    read: Callable[[str, Mapping[str, str]], Any]
    prove: Callable[..., dict[str, Any]]
    parameters: Callable[[Any], dict[str, Any]]
    about: str
    example: str


MAP = Kind(
    "--map",
    "map_horseshoe",
    (3, 5),
    planar,
    map_horseshoe.prove,
    map_horseshoe.as_parameters,
    "Prove a lower bound of the topological entropy of a planar map, on a compact invariant set, "
    "by parallelograms that cover each other.  They are found from a saddle of the map within 10 "
    "of the origin, or on the torus.",
    "Examples: python -m cap.prove horseshoe --map examples/maps/henon.py --effort 2;  python -m "
    "cap.prove horseshoe --map examples/maps/standard.py --set K=5/2",
)
MODEL = Kind(
    "--model",
    "contact_horseshoe",
    (1, 4),
    read,
    contact_horseshoe.prove_any,
    as_parameters,
    "Prove a lower bound of the topological entropy of the map from one contact of a system of "
    "your own to the next, on a compact invariant set, and of the flow of these motions, by "
    "parallelograms that cover each other.  They are found from a saddle: an orbit with one "
    "contact in a round.  The state has two variables, flights are polynomial in time but for the "
    "response to the clock, and a guard is linear in one variable and the clock.",
    "Example: python -m cap.prove horseshoe --model examples/ball.py --set A=1/2,e=1",
)


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    kind = MAP if any(word.partition("=")[0] == MAP.flag for word in words) else MODEL
    return own_command.run(words, parser(kind), partial(asked, kind))


def parser(kind: Kind = MODEL) -> Parser:
    """Return the parser of these commands."""
    p = own_command.begun("horseshoe", kind.flag, kind.about, kind.example)
    usual, most = kind.effort
    p.add_argument(
        "--effort",
        default=str(usual),
        metavar="N",
        help=f"words of N symbols before a point and 2N from it on, 1 to {most} (default {usual}): "
        "longer ones give more sets, often more entropy, and take longer",
    )
    p.add_argument(
        "--sets",
        default="any",
        metavar="WHICH",
        help=ABOUT,
    )
    return own_command.ended(p)


def asked(kind: Kind, options: argparse.Namespace) -> Asked:
    """Read the options; raise `BadInput` with what is wrong."""
    if options.theorem not in ("horseshoe", kind.theorem):
        raise BadInput(f"of a map `horseshoe` is proved: for {options.theorem} leave out --map")
    values = assigned(options.set)
    given = kind.read(options.file, values)
    path = own_command.place(options, [kind.theorem], values, kind.parameters(given))
    effort = integer(options.effort, "effort", (1, kind.effort[1]))
    which = choice(*WHICH)([options.sets], "sets")
    return Asked(
        kind.theorem,
        path,
        lambda tell: kind.prove(given, effort, Runner(options.jobs, tell), which),
    )
