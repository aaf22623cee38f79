"""The command ``cap.prove branch --model FILE``: a curve of orbits of a system of one's own.

An orbit is found as by ``periodic``; the curve through it is followed over a range of a parameter,
and proved (`cap.proofs.contacts_branch`).
"""

import argparse
import sys
from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path

from cap.certificate import report, writer
from cap.command import own_map
from cap.command.console import Parser, columns, program, protected
from cap.command.output import writable, writable_into
from cap.command.progress import Progress, answered
from cap.errors import BadInput, NotProved
from cap.floats.models.periodic import Closed, near, search
from cap.option import integer
from cap.orbits.halves import half
from cap.orbits.itinerary import Itinerary
from cap.parameters import exact
from cap.proofs import contacts_branch
from cap.proofs.contacts import as_parameters
from cap.system.files import assigned, load, stem
from cap.system.model import System
from cap.system.moving import moving
from cap.words import printable, quoted, say


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()
    return answered(lambda: _run(options, progress), progress)


def add_orbit(p: argparse.ArgumentParser, theorem: str) -> None:
    """Add what proofs about an orbit of a system of one's own take."""
    own_map.add_model(p, theorem)
    p.add_argument(
        "--period", default="1", metavar="N", help="of N periods of the clock (default 1)"
    )
    p.add_argument(
        "--orbit", nargs="+", metavar="Z", help="prove the orbit near that of this state at t = 0"
    )
    p.add_argument("--mode", metavar="MODE", help="the mode of that state")


def parser() -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} branch --model FILE",
        description="Prove a curve of periodic orbits of a system of your own over a range of a "
        "parameter: it exists, in pieces on which it is the only one, nothing else happens on its "
        "orbits, how many multipliers are outside the unit circle, and where one passes -1, two "
        "pass the circle elsewhere, the curve turns back, or ends in a graze, of a guard or of a "
        "contact whose speed goes to 0, to 20 digits; with --symmetric through pitchforks.  The "
        "parameter must stand in guards, resets or constant forces.",
        epilog="Example: python -m cap.prove branch --model examples/ball.py --parameter A "
        "--range 1 3 --set e=1/2",
    )
    add_orbit(p, "branch")
    p.add_argument("--parameter", required=True, metavar="A", help="the parameter that varies")
    p.add_argument(
        "--range",
        required=True,
        nargs=2,
        metavar=("LOW", "HIGH"),
        help="its least and greatest value; the curve begins at the value of --set or of the model",
    )
    p.add_argument(
        "--symmetric",
        action="store_true",
        help="the orbits that a symmetry takes into themselves half a period later: their curve "
        "goes on through pitchforks, where the map of half a round has the multiplier -1",
    )
    p.add_argument(
        "--out",
        type=Path,
        default=Path("certificates"),
        metavar="PATH",
        help="a file ending in .json, or a directory (default: certificates)",
    )
    return p


def _run(options: argparse.Namespace, progress: Progress) -> int:
    """Find an orbit, and prove the curve through it."""
    values, name = assigned(options.set), options.parameter
    low, high = (exact(word) for word in options.range)
    if not low < high:
        raise BadInput("--range is LOW HIGH, LOW below HIGH")
    here = load(options.model, values)
    if name not in here.values:
        known = ", ".join(here.values) or "none"
        raise BadInput(f"{options.model} has no parameter {name}: there are {known}")
    start = here.values[name]
    if not low < start < high:
        raise BadInput(
            f"the curve begins at {name} = {start}, which is not inside of the range: "
            f"give a value with --set"
        )
    path = _path(options, values)
    periods = integer(options.period, "period", (1, 64))
    orbit = _orbit(options, here.system, periods, progress)
    progress.clear()
    print(f"The curve begins at {name} = {start}: {printable(orbit.shown())}\n", flush=True)
    begun = {contact.mode for contact in orbit.itinerary.contacts}

    def at(value: Fraction) -> System:
        return load(options.model, {**values, name: value}).system

    system = moving(at, name, (low, high), begun)
    _free(path, options, system)
    itinerary = Itinerary(system, orbit.itinerary.contacts, orbit.itinerary.periods)
    guess = [*orbit.guess, float(start)]
    if options.symmetric:
        itinerary, guess = _halved(itinerary, orbit, guess)
    try:
        proved, ends = contacts_branch.prove(itinerary, guess, (low, high), progress.tell)
    except NotProved as failure:
        progress.clear()
        say(f"NOT PROVED (contacts_branch).  {failure}", sys.stderr)
        return 1
    progress.clear()
    told = report.theorem(proved, columns(sys.stdout) or report.WIDTH)
    try:
        written = writer.write(proved, path)
    except OSError as error:
        print(told)
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
    print(told)
    for side, why in zip(("first", "last"), ends, strict=True):
        if why:
            print(printable(f"It is not followed beyond its {side} piece: {why}"))
    print(f"\nCertificate: {quoted(path)} ({written}; the independent checker accepts it)\n")
    return 0


def _halved(
    whole: Itinerary, orbit: Closed, guess: Sequence[float]
) -> tuple[Itinerary, list[float]]:
    """Return half a round of a symmetric orbit, and its guess; the parameter is its last number."""
    step = len(orbit.guess) // len(whole.contacts)
    places = range(0, len(orbit.guess), step)
    states = [x for k in places for x in (*orbit.guess[k : k + step], guess[-1])]
    found = half(whole, states, whole.system.state[-1:])
    if found is None:
        raise BadInput(
            "this orbit is not symmetric: no symmetry of the system, by signs of the variables, "
            "takes it into itself half a period later (choose another with --orbit)"
        )
    return found, [*orbit.guess[: step * len(found.contacts)], guess[-1]]


def _path(options: argparse.Namespace, values: Mapping[str, str]) -> Path:
    """Return where the certificate goes."""
    out: Path = options.out
    if out.suffix == ".json":
        writable(out)
        return out
    writable_into(out, ".json")
    told = [f"{key}={value}" for key, value in sorted(values.items())]
    ends = [word.strip() for word in options.range]  # a number below zero has a space before it
    words = ["contacts_branch", stem(options.model), options.parameter, *ends, *told]
    words += ["symmetric"] if options.symmetric else []
    return out / f"{'-'.join(words).replace('/', '_')}.json"


def _free(path: Path, options: argparse.Namespace, system: System) -> None:
    """Raise `BadInput` if another file is where the certificate goes, unless it is to go there."""
    if path != options.out:
        own_map.free(path, as_parameters(system))


def _orbit(options: argparse.Namespace, system: System, periods: int, progress: Progress) -> Closed:
    """Return the orbit at which the curve begins."""
    if system.autonomous and periods != 1:
        raise BadInput("nothing depends on the clock: leave out --period, the period is unknown")
    if options.orbit:
        state = [float(exact(word)) for word in options.orbit]
        if len(state) != len(system.state):
            raise BadInput(f"--orbit is a state: give {', '.join(system.state)}")
        try:
            return near(system, state, options.mode, periods)
        except NotProved as failure:
            raise BadInput(f"no orbit that closes is near that of the state: {failure}") from None
    met = search(system, periods, progress.tell)
    if not met.orbits:
        raise BadInput(
            "no isolated orbit with a contact was found where the curve begins "
            "(a state near one can be given with --orbit)"
        )
    return met.orbits[0]
