"""The commands ``cap.prove horseshoe --map FILE`` and ``--model FILE``: chaos of a map given by
formulas, and of the map from contact to contact of a system of one's own.
"""

import argparse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from cap.command import own_map
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.errors import BadInput
from cap.option import choice, integer
from cap.proofs import contact_horseshoe, map_horseshoe
from cap.proofs.contacts import as_parameters
from cap.proofs.coverings import ABOUT, WHICH, Which
from cap.runner import Runner
from cap.system.files import assigned, planar, read, stem


class Kind(NamedTuple):
    """What a file may describe, how that is read and proved, and how people are told."""

    flag: str
    theorem: str
    effort: tuple[int, int]  # the usual one, and the most
    read: Callable[[str, Mapping[str, str]], Any]
    prove: Callable[..., dict[str, Any]]
    parameters: Callable[[Any], dict[str, Any]]
    help: str
    about: str
    examples: str


MAP = Kind(
    "--map",
    "map_horseshoe",
    (3, 5),
    planar,
    map_horseshoe.prove,
    map_horseshoe.as_parameters,
    "FILE.py[:FUNCTION]",
    "Prove a lower bound of the topological entropy of a planar map, on a compact invariant set, "
    "by parallelograms that cover each other.  They are found from a saddle of the map within 10 "
    "of the origin, or on the torus.  FILE.py has a function of the parameters that returns a "
    "cap.Map.  The certificate holds the map: `python -m cap.verify` needs no FILE.py.",
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
    "FILE.py[:FUNCTION] or FILE.json",
    "Prove a lower bound of the topological entropy of the map from one contact of a system of "
    "your own to the next, on a compact invariant set, and of the flow of these motions, by "
    "parallelograms that cover each other.  They are found from a saddle: an orbit with one "
    "contact in a round.  The state has two variables, flights are polynomial in time but for the "
    "response to the clock, and a guard is linear in one variable and the clock.  FILE.py has a "
    "function of the parameters that returns a cap.System (see docs/own-system.md).  The "
    "certificate holds the system: `python -m cap.verify` needs no FILE.py.",
    "Example: python -m cap.prove horseshoe --model examples/ball.py --set A=1/2,e=1",
)


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    kind = MAP if any(word.partition("=")[0] == MAP.flag for word in words) else MODEL
    options = parser(kind).parse_args([protected(word) for word in words])
    progress = Progress()
    return answered(lambda: _proved(kind, Asked.of(kind, options), progress), progress)


def parser(kind: Kind = MAP) -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} horseshoe {kind.flag} FILE",
        description=kind.about,
        epilog=kind.examples,
    )
    usual, most = kind.effort
    p.add_argument("theorem", metavar="horseshoe", help="what is proved")
    p.add_argument(kind.flag, required=True, metavar="FILE", help=kind.help, dest="file")
    p.add_argument("--set", default="", metavar="A=Q,..", help="parameters, exact: 0.5 means 1/2")
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
    own_map.add_ends(p)
    return p


@dataclass(frozen=True)
class Asked:
    """What is asked for; all of it makes sense."""

    given: Any
    effort: int
    which: Which
    jobs: int
    path: Path

    @classmethod
    def of(cls, kind: Kind, options: argparse.Namespace) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        if options.theorem not in ("horseshoe", kind.theorem):
            raise BadInput(f"of a map `horseshoe` is proved: for {options.theorem} leave out --map")
        values = assigned(options.set)
        given = kind.read(options.file, values)
        names = [kind.theorem, stem(options.file)]
        path = own_map.place(options, names, values, kind.parameters(given))
        return cls(
            given,
            integer(options.effort, "effort", (1, kind.effort[1])),
            choice(*WHICH)([options.sets], "sets"),
            integer(options.jobs, "jobs", (1, 1024)),
            path,
        )


def _proved(kind: Kind, asked: Asked, progress: Progress) -> int:
    """Prove it, write the certificate and print it; return the status."""
    runner = Runner(asked.jobs, progress.tell)

    def prove() -> dict[str, Any]:
        return kind.prove(asked.given, asked.effort, runner, asked.which)

    return own_map.answered(kind.theorem, prove, asked.path, progress)
