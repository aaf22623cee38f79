"""The command ``cap.prove horseshoe --map FILE``: chaos of a map given by formulas."""

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cap.command import own_map
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.errors import BadInput
from cap.option import choice, integer
from cap.proofs import map_horseshoe
from cap.runner import Runner
from cap.system.planar import Map

EFFORT = 3


def main(words: list[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()
    return answered(lambda: _proved(Asked.of(options), progress), progress)


def parser() -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} horseshoe --map FILE",
        description="Prove a lower bound of the topological entropy of a planar map, on a compact "
        "invariant set, by parallelograms that cover each other.  They are found from a saddle of "
        "the map within 10 of the origin, or on the torus.  FILE.py has a function of the "
        "parameters that returns a cap.Map.  The certificate holds the map: `python -m cap.verify` "
        "needs no FILE.py.",
        epilog="Examples: python -m cap.prove horseshoe --map examples/maps/henon.py --effort 2;  "
        "python -m cap.prove horseshoe --map examples/maps/standard.py --set K=5/2",
    )
    own_map.add_common(p, "horseshoe")
    p.add_argument(
        "--effort",
        default=str(EFFORT),
        metavar="N",
        help=f"words of N symbols before a point and 2N from it on, 1 to 5 (default {EFFORT}): "
        "longer ones give more sets, often more entropy, and take longer",
    )
    p.add_argument(
        "--sets",
        default="any",
        metavar="WHICH",
        help="any: sets may overlap, for more entropy (default); disjoint: they do not, for a "
        "semiconjugacy",
    )
    return p


@dataclass(frozen=True)
class Asked:
    """What is asked for; all of it makes sense."""

    map: Map
    effort: int
    disjoint: bool
    jobs: int
    path: Path

    @classmethod
    def of(cls, options: argparse.Namespace) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        if options.theorem != "horseshoe":
            raise BadInput(f"of a map `horseshoe` is proved: for {options.theorem} leave out --map")
        given = own_map.given(options)
        path = own_map.certificate(options, "map_horseshoe", given)
        return cls(
            given,
            integer(options.effort, "effort", (1, 5)),
            choice("any", "disjoint")([options.sets], "sets") == "disjoint",
            integer(options.jobs, "jobs", (1, 1024)),
            path,
        )


def _proved(asked: Asked, progress: Progress) -> int:
    """Prove it, write the certificate and print it; return the status."""
    runner = Runner(asked.jobs, progress.tell)

    def prove() -> dict[str, Any]:
        return map_horseshoe.prove(asked.map, asked.effort, runner, disjoint=asked.disjoint)

    return own_map.answered("map_horseshoe", prove, asked.path, progress)
