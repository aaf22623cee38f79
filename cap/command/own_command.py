"""What the commands share that prove something of a system, a map or a ball of one's own.

Such a command has a parser, which begins as `begun` says and ends as `ended`, and a function from
the options to what is asked for, an `Asked`; `run` does the rest.
"""

import argparse
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cap.certificate import naming
from cap.command.console import Parser, add_jobs, program, protected
from cap.command.output import add_out, writable, writable_into
from cap.command.progress import Progress, answered
from cap.command.proving import proved
from cap.errors import BadInput
from cap.runner import Tell
from cap.system.files import stem
from cap.words import quoted

FILES = {"--model": "FILE.py[:FUNCTION] or FILE.json", "--map": "FILE.py[:FUNCTION]"}
ABOUT = {
    "--model": "  FILE.py has a function of the parameters that returns a cap.System (see "
    "docs/own-system.md); it may be FILE.json, which runs nothing.  The certificate holds the "
    "system: `python -m cap.verify` needs no FILE.py.",
    "--map": "  FILE.py has a function of the parameters that returns a cap.Map.  The certificate "
    "holds the map: `python -m cap.verify` needs no FILE.py.",
}


@dataclass(frozen=True)
class Asked:
    """What is asked for, all of which makes sense: where the certificate goes, and the proof.

    The proof says how far it is; afterwards ``remarks`` are what else is to be said.
    """

    theorem: str
    path: Path
    prove: Callable[[Tell], dict[str, Any]]
    remarks: Callable[[], Iterable[str]] = tuple


def run(words: Sequence[str], parser: Parser, asked: Callable[..., Asked]) -> int:
    """Run the command line of a parser, whose options ask for a proof; return its exit status."""
    options = parser.parse_args([protected(word) for word in words])
    progress = Progress()

    def prove() -> int:
        it = asked(options)
        return proved(
            it.theorem, lambda: it.prove(progress.tell), it.path, progress, remarks=it.remarks
        )

    return answered(prove, progress)


def begun(name: str, flag: str, about: str, example: str) -> Parser:
    """Return a parser of the theorem ``name`` about the system or the map in a file."""
    p = Parser(
        prog=f"{program('cap.prove')} {name} {flag} FILE",
        description=about + ABOUT[flag],
        epilog=example,
    )
    p.add_argument("theorem", metavar=name, help="what is proved")
    p.add_argument(flag, required=True, metavar="FILE", dest="file", help=FILES[flag])
    p.add_argument("--set", default="", metavar="A=Q,..", help="parameters, exact: 0.5 means 1/2")
    return p


def ended(p: Parser, workers: str = "processes") -> Parser:
    """Return the parser, with how many processes there are, and where the certificate goes."""
    if workers:
        add_jobs(p, f"{workers} (default 1)")
    add_out(p, "no other file is replaced")
    return p


def place(
    options: argparse.Namespace, names: Sequence[str], told: Mapping[str, Any], about: object
) -> Path:
    """Return where a certificate goes, whose name tells values; `BadInput` for another file."""
    path = named(options, [*names, *valued(told)])
    if path != options.out:
        free(path, about)
    return path


def named(options: argparse.Namespace, words: Sequence[str]) -> Path:
    """Return where a certificate goes whose name has these words, the first is the theorem.

    The file of the system or the map, if it is one, is the second.  Raises `BadInput` if nothing
    can be written there.
    """
    path: Path = options.out
    if path.suffix == ".json":
        writable(path)
        return path
    writable_into(path, ".json")
    theorem, *others = words
    about = [stem(options.file)] if "file" in options else []
    return path / naming.short([theorem, *about, *others])


def valued(told: Mapping[str, Any]) -> list[str]:
    """Return values in words, in the order of their names."""
    return [f"{key}={value}" for key, value in sorted(told.items())]


def free(path: Path, parameters: object, contacts: object = None) -> None:
    """Raise `BadInput` if there is a file at a path, but about the same system (and contacts)."""
    if not path.exists():
        return
    try:
        old = json.loads(path.read_bytes())
        same = old["parameters"] == parameters
        same = same and contacts in (None, old["claims"]["contacts"] if contacts else None)
    except (OSError, ValueError, LookupError, TypeError):
        same = False
    if not same:
        advice = "move it away, or name the file with --out FILE.json"
        raise BadInput(f"there is another file at {quoted(path)}: {advice}")
