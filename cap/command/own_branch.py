"""The command ``cap.prove branch --model FILE``: a curve of orbits of a system of one's own.

An orbit is found as by ``periodic``; the curve through it is followed over a range of a parameter,
and proved (`cap.proofs.contacts_branch`).
"""

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from cap.command import own_command, own_orbit
from cap.command.console import Parser
from cap.command.own_command import Asked
from cap.errors import BadInput
from cap.floats.models.periodic import Closed, search
from cap.orbits.halves import half
from cap.orbits.itinerary import Itinerary
from cap.parameters import exact
from cap.proofs import contacts_branch
from cap.proofs.contacts import as_parameters
from cap.runner import Tell
from cap.system.files import Loaded, assigned, load
from cap.system.model import System
from cap.system.moving import moving
from cap.words import printable

THEOREM = "contacts_branch"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    return own_command.run(words, parser(), asked)


def parser() -> Parser:
    """Return the parser of this command."""
    p = own_command.begun(
        "branch",
        "--model",
        "Prove a curve of periodic orbits of a system of your own over a range of a parameter: it "
        "exists, in pieces on which it is the only one, nothing else happens on its orbits, how "
        "many multipliers are outside the unit circle, and where one passes -1, two pass the "
        "circle elsewhere, the curve turns back, or ends in a graze, of a guard or of a contact "
        "whose speed goes to 0, to 20 digits; with --symmetric through pitchforks.  The parameter "
        "must stand in guards, resets or constant forces.",
        "Example: python -m cap.prove branch --model examples/ball.py --parameter A --range 1 3 "
        "--set e=1/2",
    )
    own_orbit.add(p)
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
    return own_command.ended(p, workers="")


def asked(options: argparse.Namespace) -> Asked:
    """Read the options; raise `BadInput` with what is wrong."""
    low, high = (exact(word) for word in options.range)
    if not low < high:
        raise BadInput("--range is LOW HIGH, LOW below HIGH")
    values, name = assigned(options.set), options.parameter
    here = load(options.file, values)
    if name not in here.values:
        known = ", ".join(here.values) or "none"
        raise BadInput(f"{options.file} has no parameter {name}: there are {known}")
    if not low < here.values[name] < high:
        raise BadInput(
            f"the curve begins at {name} = {here.values[name]}, which is not inside of the range: "
            f"give a value with --set"
        )
    ends = [word.strip() for word in options.range]  # a number below zero has a space before it
    told = [name, *ends, *own_command.valued(values), *["symmetric"] * options.symmetric]
    path = own_command.named(options, [THEOREM, *told])
    state = own_orbit.state(options, here.system)
    periods = own_orbit.periods(options, here.system)
    curve = _Curve(options, values, here, (low, high), state, periods, path, [])
    return Asked(THEOREM, path, curve.prove, lambda: curve.remarks)


@dataclass(frozen=True)
class _Curve:
    """A curve over ``span``, and where it begins: at the model as it is ``here``."""

    options: argparse.Namespace
    values: Mapping[str, str]
    here: Loaded
    span: tuple[Fraction, Fraction]
    state: list[float]
    periods: int
    path: Path
    remarks: list[str]

    def prove(self, tell: Tell) -> dict[str, Any]:
        """Find the orbit at which it begins, and prove it; what ends it is remarked."""
        name, orbit = self.options.parameter, self._orbit(tell)
        start = self.here.values[name]
        tell("", None)
        print(f"The curve begins at {name} = {start}: {printable(orbit.shown())}\n", flush=True)
        begun = {contact.mode for contact in orbit.itinerary.contacts}
        system = moving(self._at, name, self.span, begun)
        if self.path != self.options.out:
            own_command.free(self.path, as_parameters(system))
        itinerary = Itinerary(system, orbit.itinerary.contacts, orbit.itinerary.periods)
        guess = [*orbit.guess, float(start)]
        if self.options.symmetric:
            itinerary, guess = _halved(itinerary, orbit, guess)
        proved, ends = contacts_branch.prove(itinerary, guess, self.span, tell)
        sides = zip(("first", "last"), ends, strict=True)
        self.remarks[:] = [
            f"It is not followed beyond its {side} piece: {why}" for side, why in sides if why
        ]
        return proved

    def _at(self, value: Fraction) -> System:
        """Return the system at a value of the parameter."""
        return load(self.options.file, {**self.values, self.options.parameter: value}).system

    def _orbit(self, tell: Tell) -> Closed:
        """Return the orbit at which it begins."""
        if self.state:
            return own_orbit.closed(self.here.system, self.state, self.options.mode, self.periods)
        met = search(self.here.system, self.periods, tell)
        if not met.orbits:
            raise BadInput(
                "no isolated orbit with a contact was found where the curve begins "
                "(a state near one can be given with --orbit)"
            )
        return met.orbits[0]


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
