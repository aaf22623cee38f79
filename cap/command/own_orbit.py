"""An orbit of a system of one's own, as it is named on the command line: near a state."""

import argparse

from cap.errors import BadInput, NotProved
from cap.floats.models.periodic import Closed, near
from cap.option import integer
from cap.parameters import exact
from cap.system.model import System


def add(p: argparse.ArgumentParser) -> None:
    """Add the options that name an orbit."""
    p.add_argument(
        "--period", default="1", metavar="N", help="of N periods of the clock (default 1)"
    )
    p.add_argument(
        "--orbit", nargs="+", metavar="Z", help="prove the orbit near that of this state at t = 0"
    )
    p.add_argument("--mode", metavar="MODE", help="the mode of that state")


def periods(options: argparse.Namespace, system: System) -> int:
    """Return of how many periods of the clock it is; `BadInput` if there is no clock."""
    if system.autonomous and options.period != "1":
        raise BadInput("nothing depends on the clock: leave out --period, the period is unknown")
    return integer(options.period, "period", (1, 64))


def state(options: argparse.Namespace, system: System) -> list[float]:
    """Return the state that is given, or none."""
    given = [float(exact(word)) for word in options.orbit or ()]
    if given and len(given) != len(system.state):
        raise BadInput(f"--orbit is a state: give {', '.join(system.state)}")
    if options.mode is not None and (not given or options.mode not in system.modes):
        raise BadInput(f"--mode is that of --orbit: one of {', '.join(system.modes)}")
    return given


def closed(system: System, given: list[float], mode: str | None, count: int) -> Closed:
    """Return the orbit to which Newton's method leads from a state; `BadInput` if there is none."""
    try:
        return near(system, given, mode, count)
    except NotProved as failure:
        raise BadInput(f"no orbit that closes is near that of the state: {failure}") from None
