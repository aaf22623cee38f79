"""The command ``python -m cap.explore play``: its words, without Bokeh until it serves."""

import argparse
from collections.abc import Callable
from typing import Any

from cap.command import entry
from cap.errors import BadInput
from cap.option import integer

NAME = "play"
SUMMARY = "a page in the browser: portrait, orbits, and the prover beside them"
MORE = """
Sliders for all parameters; a click on the portrait shows the orbit of that state, its
events and the mass; `prove this` proves a theorem in a process of its own.  With --model
it is about a system of your own, of two variables and with a clock.  The page is served
from this machine to itself alone, until ctrl-C.  It needs the library Bokeh, 3.4 or later:
  pip install bokeh
"""


def add(
    commands: Any,
    parameters: Callable[[argparse.ArgumentParser], None],
) -> None:
    """Add the command to others, with the options that ``parameters`` adds."""
    p = commands.add_parser(
        NAME,
        help=SUMMARY,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description=f"{SUMMARY[0].upper()}{SUMMARY[1:]}.\n{MORE}",
        epilog=f"Examples:\n  python -m cap.explore {NAME} --f 9/20\n"
        f"  python -m cap.explore {NAME} --model examples/ball.py",
    )
    p.add_argument("--port", default="0", metavar="N", help="listen on it (default: any free)")
    p.add_argument("--no-browser", action="store_true", help="say the address, open no browser")
    parameters(p)


def run(options: argparse.Namespace, about: Any) -> int:
    """Serve the page until an interrupt."""
    port = integer(options.port, "port", (0, 65535))
    with entry.loading():
        try:
            from cap.explore.play.server import play  # noqa: PLC0415 (Bokeh is an extra)
            from cap.explore.play.worlds import world  # noqa: PLC0415
        except ModuleNotFoundError as error:
            if str(error.name).partition(".")[0] != "bokeh":
                raise
            raise BadInput("the page needs the library Bokeh: pip install bokeh") from None
    play(world(about), port, opens=not options.no_browser, say=lambda line: print(line, flush=True))
    return 0
