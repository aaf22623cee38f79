"""The command ``cap.prove horseshoe --map FILE``: chaos of a map given by formulas."""

import argparse
import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cap.certificate import report, writer
from cap.command.console import Parser, columns, program, protected
from cap.command.output import writable, writable_into
from cap.command.progress import Progress, answered
from cap.errors import BadInput, NotProved
from cap.option import choice, integer
from cap.proofs import map_horseshoe
from cap.runner import Runner
from cap.system.files import assigned, planar
from cap.system.planar import Map
from cap.words import quoted, say

EFFORT = 3
FLAGS = ("--map",)


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
    p.add_argument("theorem", metavar="horseshoe", help="what is proved")
    p.add_argument("--map", required=True, metavar="FILE", help="FILE.py[:FUNCTION]")
    p.add_argument("--set", default="", metavar="A=Q,..", help="parameters, exact: 0.5 means 1/2")
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
    p.add_argument("--jobs", default="1", metavar="N", help="processes (default 1)")
    p.add_argument(
        "--out",
        type=Path,
        default=Path("certificates"),
        metavar="PATH",
        help="a file ending in .json, which is replaced; or a directory (default: certificates), "
        "which is made if it is missing: there no other file is replaced",
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
        values = assigned(options.set)
        given = planar(options.map, values)
        stem = options.map.rpartition(":")[2] if ".py:" in options.map else options.map
        told = [f"{key}={value}" for key, value in sorted(values.items())]
        path = options.out
        if path.suffix == ".json":
            writable(path)
        else:
            writable_into(path, ".json")
            name = "-".join(["map_horseshoe", Path(stem).stem, *told]).replace("/", "_")
            path /= f"{name[:120]}.json"
            _free(path, map_horseshoe.as_parameters(given))
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
    try:
        proved = map_horseshoe.prove(asked.map, asked.effort, runner, disjoint=asked.disjoint)
    except NotProved as failure:
        progress.clear()
        say(f"NOT PROVED (map_horseshoe).  {failure}", sys.stderr)
        return 1
    progress.clear()
    told = report.theorem(proved, columns(sys.stdout) or report.WIDTH)
    try:
        written = writer.write(proved, asked.path)
    except OSError as error:
        print(told)
        raise BadInput(f"cannot write {quoted(asked.path)}: {error.strerror}") from None
    path = quoted(asked.path)
    print(f"{told}\n\nCertificate: {path} ({written}; the independent checker accepts it)\n")
    return 0


def _free(path: Path, parameters: dict[str, Any]) -> None:
    """Raise `BadInput` if there is a file at a path, but about the same system."""
    if not path.exists():
        return
    try:
        old = json.loads(path.read_bytes())["parameters"]
    except (OSError, ValueError, LookupError, TypeError):
        old = None
    if old != parameters:
        advice = "move it away, or name the file with --out FILE.json"
        raise BadInput(f"there is another file at {quoted(path)}: {advice}")
