"""The command ``python -m cap.explore``: floats, from which nothing is proved.

What can be explored: see `cap.explore.commands`.  After an interrupt what was done is written.
"""

import argparse
import logging
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from cap.command import entry
from cap.command.console import Parser, add_jobs, program, protected
from cap.command.entry import INTERRUPTED
from cap.command.progress import Progress, answered
from cap.errors import BadInput
from cap.explore import certificate
from cap.explore.commands import COMMANDS, Command
from cap.explore.model_commands import COMMANDS as MODEL_COMMANDS
from cap.explore.play import command as page
from cap.option import Option, integer
from cap.parameters import PAPER, Parameters, exact
from cap.runner import Runner
from cap.system.files import assigned, load
from cap.words import printable, quoted, say

MOST_PIXELS = 300_000_000
OF_OSCILLATOR = """\
Explore x'' = F cos(omega t) - f sgn(x') - mu x', l < x < r, where v becomes -e v
at the walls: pictures and numbers in floats, from which nothing is proved."""
OF_MODEL = """\
Explore a system of your own, a model of ten lines (docs/own-system.md): pictures and
numbers in floats, from which nothing is proved, and the commands that prove."""
FIRST = ("--paper", "--out", "--help", "--version")  # options before a command


def read(words: Sequence[str]) -> argparse.Namespace:
    """Return the options given: of the oscillator, or of a model."""
    protected_words = [protected(word) for word in words]
    of_model = any(word.partition("=")[0] == "--model" for word in words)
    if not of_model and words and words[0] in MODEL_COMMANDS and words[0] not in COMMANDS:
        raise BadInput(f"{words[0]} is about a model: --model FILE (of the oscillator: inventory)")
    return parser(of_model=of_model).parse_args(protected_words)


def parser(*, of_model: bool = False) -> Parser:
    """Return the command line's parser."""
    known = MODEL_COMMANDS if of_model else COMMANDS
    p = Parser(
        prog=program("cap.explore"),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description=OF_MODEL if of_model else OF_OSCILLATOR,
        epilog="Examples:\n"
        + "\n".join(f"  {c.line(name)}" for name, c in known.items())
        + "\n\nOf a system of your own, a model of ten lines (docs/own-system.md):\n"
        + "\n".join(f"  {c.line(name)}" for name, c in MODEL_COMMANDS.items())
        + f"\n\nWhat a certificate proves, which is verified first:\n  {certificate.EXAMPLE}\n\n"
        "A page to play with, in the browser, also of your own system:\n"
        "  python -m cap.explore play [--model FILE.py]",
    )
    p.add_argument(
        "--paper",
        action="append",
        metavar="LABEL",
        help="a figure of the paper (fig:sali, or all), and its numbers",
    )
    p.add_argument(
        "--out",
        type=Path,
        action="append",
        default=[],
        dest="first_out",
        metavar="PATH",
        help="a file, may be repeated; of --paper all: a directory",
    )
    commands = p.add_subparsers(dest="command", metavar="WHAT", title="what to explore")
    for name, command in known.items():
        each = commands.add_parser(name, **_described(name, command))
        _add(each, command, _model if of_model else _parameters)
    page.add(commands, _model if of_model else _parameters)
    if not of_model:
        certificate.add(commands)
    return p


def _described(name: str, command: Command) -> dict[str, Any]:
    return {
        "help": command.summary,
        "formatter_class": argparse.RawDescriptionHelpFormatter,
        "description": f"{command.summary[0].upper()}{command.summary[1:]}.\n\n{command.more}",
        "epilog": f"Example:\n  {command.line(name)}",
    }


def _parameters(p: argparse.ArgumentParser) -> None:
    """Add the parameters of the oscillator."""
    given = p.add_argument_group("parameters (integers, decimals or p/q, exact)")
    for name, value in PAPER.strings().items():
        given.add_argument(f"--{name}", default=value, metavar="Q", help=f"default {value}")


def _model(p: argparse.ArgumentParser) -> None:
    """Add the options that name a model, and its parameters."""
    given = p.add_argument_group("the model, a system of your own")
    given.add_argument(
        "--model", metavar="FILE", required=True, help="FILE.py[:FUNCTION] or FILE.json"
    )
    given.add_argument(
        "--set",
        nargs="+",
        action="extend",
        default=[],
        metavar="A=Q,..",
        help="values of its parameters, exact: 0.5 means 1/2",
    )


def _add(
    p: argparse.ArgumentParser,
    command: Command,
    about: Callable[[argparse.ArgumentParser], None],
) -> None:
    """Add the options of one command, and those that say what it is about."""
    own = p.add_argument_group("of this picture")
    for option in command.options:
        if option.flag:
            own.add_argument(f"--{option.name}", action="store_true", help=option.help)
        else:
            own.add_argument(
                f"--{option.name}", nargs=option.nargs, metavar=option.metavar, help=option.help
            )
    about(p)
    output = p.add_argument_group("output")
    output.add_argument(
        "--out",
        type=Path,
        action="append",
        default=[],
        metavar="FILE",
        help="write FILE.png, .pdf or .svg (the picture), .csv or .npz (its data); may be repeated",
    )
    output.add_argument("--size", nargs=2, metavar=("W", "H"), help="of the picture, in inches")
    output.add_argument("--dpi", default="200", metavar="N", help="pixels per inch (default 200)")
    add_jobs(output, "cores to use (default: all)", os.cpu_count() or 1)


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    progress = Progress()
    logging.getLogger("matplotlib").setLevel(logging.ERROR)  # it tells where it keeps its fonts

    def run() -> int:
        _in_order(words)
        options = read(words)
        if options.paper and options.command:
            raise BadInput(f"give --paper or {options.command}: not both")
        if options.paper:
            return _paper(options.paper, options.first_out, progress)
        if options.command is None:
            raise BadInput(f"say what to explore: one of {', '.join(COMMANDS)} (--help says more)")
        if options.command == certificate.NAME:
            return certificate.run(options, progress)
        if options.command == page.NAME:
            return page.run(options, _about(options))
        of_model = getattr(options, "model", None) is not None
        known = MODEL_COMMANDS if of_model else COMMANDS
        return _run(options, known[options.command], progress)

    return answered(run, progress)


def _in_order(words: Sequence[str]) -> None:
    """Raise `BadInput` if an option of a command comes before the command."""
    first = words[0].partition("=")[0] if words else ""
    if first.startswith("--") and not any(own.startswith(first) for own in FIRST):
        raise BadInput(f"say what to explore before its options: {first[:40]} comes after it")


def _paper(labels: Sequence[str], out: Sequence[Path], progress: Progress) -> int:
    """Compute a figure of the paper, or all, and compare its numbers."""
    if len(set(labels)) > 1:
        raise BadInput("one figure at a time, --paper LABEL; or --paper all")
    with entry.loading():  # numpy is slow to load: not for --help
        from cap.explore import paper  # noqa: PLC0415
    return paper.run(labels[0], out, progress.tell)


def _run(options: argparse.Namespace, command: Command, progress: Progress) -> int:
    """Compute, say the numbers, write the files."""
    with entry.loading():  # numpy is slow to load: not for --help
        from cap.explore import export  # noqa: PLC0415
    out = [*options.first_out, *options.out]
    p = _about(options)
    values = {o.keyword: _value(o, getattr(options, o.keyword)) for o in command.options}
    given = {name: value for name, value in values.items() if value is not None}
    command = command.about(given)
    size, dpi = _size(options, command)
    for path in out:
        export.kind(path)
    runner = Runner(options.jobs, progress.tell)
    with entry.loading():
        function = command.function()
    findings = function(p, runner=runner, **given)
    progress.clear()
    print("\n".join(findings.lines()))
    failed = 0
    for path in out:
        try:
            export.write(findings, path, lambda: command.picture(findings, size, dpi))
        except BadInput as error:  # the other files are written all the same
            failed = 2
            say(f"error: {printable(str(error))}", sys.stderr)
        else:
            print(f"{quoted(path)}: written")
    if not findings.complete:
        say("interrupted; what was done is kept", sys.stderr)
        return INTERRUPTED
    return failed or command.status(findings)


def _about(options: argparse.Namespace) -> Any:
    """Return what is explored: the parameters of the oscillator, or a model."""
    if getattr(options, "model", None) is None:
        return Parameters(*(exact(getattr(options, name)) for name in PAPER.strings()))
    from cap.floats.models.subject import Subject  # noqa: PLC0415 (numba is slow to load)

    return Subject(load(options.model, assigned(",".join(options.set))))


def _value(option: Option, text: Any) -> Any:
    """Return the value of an option of one command, or None if it was not given."""
    return text or None if option.flag else None if text is None else option.read(text)


def _size(options: argparse.Namespace, command: Command) -> tuple[tuple[float, float], int]:
    """Return the size of the picture in inches, and its pixels per inch."""
    width, height = (float(exact(word)) for word in options.size or map(str, command.size))
    if not (1 <= width <= 100 and 1 <= height <= 100):
        raise BadInput(f"--size must be from 1 to 100 inches: {width:.6g} x {height:.6g}")
    dpi = integer(options.dpi, "dpi", (20, 2000))
    if width * height * dpi**2 > MOST_PIXELS:
        raise BadInput(f"the picture is too large: {width:g} x {height:g} inches at {dpi} dpi")
    return (width, height), dpi
