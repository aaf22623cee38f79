"""What commands about maps and models share: where the certificate goes, and what is printed."""

import argparse
import json
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from cap.certificate import report, writer
from cap.command.console import columns
from cap.command.output import writable, writable_into
from cap.command.progress import Progress
from cap.errors import BadInput, NotProved
from cap.proofs.map_horseshoe import as_parameters
from cap.system.files import assigned, planar, stem
from cap.system.planar import Map
from cap.words import quoted, say


def add_common(p: argparse.ArgumentParser, theorem: str) -> None:
    """Add what all proofs about maps take."""
    p.add_argument("theorem", metavar=theorem, help="what is proved")
    p.add_argument("--map", required=True, metavar="FILE", help="FILE.py[:FUNCTION]")
    p.add_argument("--set", default="", metavar="A=Q,..", help="parameters, exact: 0.5 means 1/2")
    add_ends(p)


def add_model(p: argparse.ArgumentParser, theorem: str) -> None:
    """Add what all proofs about a system of one's own take."""
    p.add_argument("theorem", metavar=theorem, help="what is proved")
    p.add_argument("--model", required=True, metavar="FILE", help="FILE.py[:FUNCTION] or FILE.json")
    p.add_argument("--set", default="", metavar="A=Q,..", help="parameters, exact: 0.5 means 1/2")


def add_ends(p: argparse.ArgumentParser, which: str = "") -> None:
    """Add how many processes there are, and where the certificate goes."""
    told = f"processes {which}".rstrip()
    p.add_argument("--jobs", default="1", metavar="N", help=f"{told} (default 1)")
    add_out(p)


def add_out(p: argparse.ArgumentParser) -> None:
    """Add where the certificate goes."""
    p.add_argument(
        "--out",
        type=Path,
        default=Path("certificates"),
        metavar="PATH",
        help="a file ending in .json, which is replaced; or a directory (default: certificates), "
        "which is made if it is missing: there no other file is replaced",
    )


def given(options: argparse.Namespace) -> Map:
    """Return the map; raise `BadInput` if there is none."""
    return planar(options.map, assigned(options.set))


def certificate(options: argparse.Namespace, name: str, about: Map) -> Path:
    """Return where a certificate about a map goes; raise `BadInput` if another file is there."""
    return place(options, [name, stem(options.map)], assigned(options.set), as_parameters(about))


def place(
    options: argparse.Namespace, names: list[str], told: Mapping[str, Any], about: dict[str, Any]
) -> Path:
    """Return where a certificate goes, whose name tells values; `BadInput` for another file."""
    path: Path = options.out
    if path.suffix == ".json":
        writable(path)
        return path
    writable_into(path, ".json")
    values = [f"{key}={value}" for key, value in sorted(told.items())]
    words = "-".join([*names, *values]).replace("/", "_")
    path /= f"{words[:120]}.json"
    free(path, about)
    return path


def answered(
    theorem: str, prove: Callable[[], dict[str, Any]], path: Path, progress: Progress
) -> int:
    """Prove a theorem, write the certificate and print it; return the status."""
    try:
        proved = prove()
    except NotProved as failure:
        progress.clear()
        say(f"NOT PROVED ({theorem}).  {failure}", sys.stderr)
        return 1
    progress.clear()
    told = report.theorem(proved, columns(sys.stdout) or report.WIDTH)
    try:
        written = writer.write(proved, path)
    except OSError as error:
        print(told)
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
    name = quoted(path)
    print(f"{told}\n\nCertificate: {name} ({written}; the independent checker accepts it)\n")
    return 0


def free(path: Path, parameters: dict[str, Any]) -> None:
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
