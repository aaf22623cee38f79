"""Explore the oscillator in floats: ``python -m cap.explore portrait --out portrait.png``.

Exit status 0; 1 if something asked for was not proved; 2 on bad input; 130 after an interrupt, when
what had been done is written.  What can be explored: see `cap.commands`.
"""

import argparse
import os
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from cap.commands import COMMANDS, Command
from cap.console import Parser, closing_quietly, printable, protected, quoted, say
from cap.errors import BadInput
from cap.option import Option, integer
from cap.parameters import PAPER, Parameters, exact

INTERRUPTED = 130
MOST_PIXELS = 300_000_000


def parser() -> Parser:
    """Return the command line's parser."""
    p = Parser(
        prog="python -m cap.explore",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Explore x'' = F cos(omega t) - f sgn(x') - mu x', l < x < r, where v becomes "
        "-e v\nat the walls: pictures and numbers in floats, from which nothing is proved.",
        epilog="Examples:\n" + "\n".join(f"  {c.line(name)}" for name, c in COMMANDS.items()),
    )
    p.add_argument(
        "--paper", metavar="LABEL", help="a figure of the paper (fig:sali, or all), and its numbers"
    )
    p.add_argument(
        "--out",
        type=Path,
        dest="paper_out",
        metavar="PATH",
        help="of --paper: a file; of --paper all: a directory",
    )
    commands = p.add_subparsers(dest="command", metavar="WHAT", title="what to explore")
    for name, command in COMMANDS.items():
        _add(commands.add_parser(name, **_described(name, command)), command)
    return p


def _described(name: str, command: Command) -> dict[str, Any]:
    return {
        "help": command.summary,
        "formatter_class": argparse.RawDescriptionHelpFormatter,
        "description": f"{command.summary[0].upper()}{command.summary[1:]}.\n\n{command.more}",
        "epilog": f"Example:\n  {command.line(name)}",
    }


def _add(p: argparse.ArgumentParser, command: Command) -> None:
    """Add the options of one command."""
    own = p.add_argument_group("of this picture")
    for option in command.options:
        if option.flag:
            own.add_argument(f"--{option.name}", action="store_true", help=option.help)
        else:
            own.add_argument(
                f"--{option.name}", nargs=option.nargs, metavar=option.metavar, help=option.help
            )
    given = p.add_argument_group("parameters (integers, decimals or p/q, exact)")
    for name, value in PAPER.strings().items():
        given.add_argument(f"--{name}", default=value, metavar="Q", help=f"default {value}")
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
    cores = str(os.cpu_count() or 1)
    output.add_argument("--jobs", default=cores, metavar="N", help="cores to use (default: all)")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    return closing_quietly(lambda: _main(sys.argv[1:] if argv is None else argv))


def _main(arguments: Sequence[str]) -> int:
    options = parser().parse_args([protected(word) for word in arguments])
    try:
        if options.paper is not None and options.command is None:
            return _paper(options.paper, options.paper_out)
        if options.command is None:
            raise BadInput(f"say what to explore: one of {', '.join(COMMANDS)} (--help says more)")
        return _run(options, COMMANDS[options.command])
    except BadInput as error:
        say(f"error: {printable(str(error))}", sys.stderr)
        return 2
    except MemoryError:
        say("error: not enough memory: ask for fewer states or periods", sys.stderr)
        return 2
    except KeyboardInterrupt:
        say("interrupted; nothing half-written", sys.stderr)
        return INTERRUPTED


def _paper(label: str, out: Path | None) -> int:
    """Compute a figure of the paper, or all, and compare its numbers."""
    from cap.paper import command  # noqa: PLC0415 (numpy is slow to load: not for --help)

    bar = _Bar()
    status = command.run(label, out, bar.tell)
    bar.clear()
    return status


def _run(options: argparse.Namespace, command: Command) -> int:
    """Compute, say the numbers, write the files."""
    from cap import export  # noqa: PLC0415 (numpy is slow to load: not for --help)
    from cap.approx.work import Work  # noqa: PLC0415

    p = Parameters(*(exact(getattr(options, name)) for name in PAPER.strings()))
    values = {o.keyword: _value(o, getattr(options, o.keyword)) for o in command.options}
    given = {name: value for name, value in values.items() if value is not None}
    size, dpi = _size(options, command)
    for path in options.out:
        export.kind(path)
    bar = _Bar()
    work = Work(integer(options.jobs, "jobs", (1, 256)), bar.tell)
    study = command.function()(p, work=work, **given)
    bar.clear()
    print("\n".join(study.lines()))
    failed = 0
    for path in options.out:
        try:
            export.write(study, path, lambda: command.picture(study, size, dpi))
        except BadInput as error:  # the other files are written all the same
            failed = 2
            say(f"error: {printable(str(error))}", sys.stderr)
        else:
            print(f"{quoted(path)}: written")
    if not study.complete:
        say("interrupted; what was done is kept", sys.stderr)
        return INTERRUPTED
    return failed or command.status(study)


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


@dataclass
class _Bar:
    """A bar on a terminal, of what takes more than a second."""

    began: float = field(default_factory=time.monotonic)
    shown: float = 0.0
    words: str = ""

    def tell(self, words: str, part: float) -> None:
        """Show which part is done, and how long the rest may take."""
        now = time.monotonic()
        if words != self.words:
            self.words, self.began = words, now
        terminal = sys.stderr is not None and sys.stderr.isatty()
        if not terminal or now - self.began < 1 or now - self.shown < 0.1:
            return
        self.shown = now
        left = (now - self.began) * (1 - part) / part if part else 0.0
        bar = "#" * round(30 * part)
        line = f"{words:<20.20} [{bar:<30}] {part:4.0%}  {left:.0f} s left"
        print(f"\r{line:<75}", end="\r", file=sys.stderr, flush=True)

    def clear(self) -> None:
        """Take the bar away."""
        if self.shown:
            print(f"\r{'':<75}", end="\r", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
