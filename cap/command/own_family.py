"""The command ``cap.prove family --model FILE``: a continuum of periodic orbits."""

import argparse
from collections import Counter
from collections.abc import Sequence
from typing import Any

from cap.command import own_command
from cap.command.console import Parser
from cap.command.own_command import Asked
from cap.errors import NotProved
from cap.floats.models.periodic import followed
from cap.option import integer
from cap.orbits.family import Family, family, quarters
from cap.orbits.itinerary import Itinerary
from cap.proofs import contacts_family
from cap.proofs.contacts import as_parameters
from cap.runner import Tell
from cap.system.files import assigned, read
from cap.system.model import System

THEOREM = "contacts_family"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    return own_command.run(words, parser(), asked)


def parser() -> Parser:
    """Return the parser of this command."""
    p = own_command.begun(
        "family",
        "--model",
        "Prove a continuum of periodic orbits of a system of your own: with contacts at quarters "
        "of a period of the clock, and states just before them that are linear in a number c.  "
        "Flights must be sums of cos and sin of rational frequencies, whose angles between "
        "contacts are quarters of turns; then all is exact.  For each c of an interval there is "
        "an orbit with these contacts and no others.",
        "Example: python -m cap.prove family --model examples/den_hartog.py --set omega=1/2,f=1/10",
    )
    p.add_argument(
        "--period", default="1", metavar="N", help="of N periods of the clock (default 1)"
    )
    return own_command.ended(p, workers="")


def asked(options: argparse.Namespace) -> Asked:
    """Read the options; raise `BadInput` with what is wrong."""
    values = assigned(options.set)
    system = read(options.file, values)
    periods = integer(options.period, "period", (1, 64))
    told = values | ({} if periods == 1 else {"period": str(periods)})
    path = own_command.place(options, [THEOREM], told, as_parameters(system))

    def prove(tell: Tell) -> dict[str, Any]:
        tell("following states", None)
        found, guess = _found(system, periods)
        return contacts_family.prove(found, guess, tell)

    return Asked(THEOREM, path, prove)


def _found(system: System, periods: int) -> tuple[Itinerary, list[float]]:
    """Return an orbit of the family that is met most often; raise `NotProved` if none is met."""
    seen, first = Counter[str](), dict[str, tuple[Itinerary, list[float]]]()
    why = NotProved("family", "no orbit with contacts closes nearly")
    for itinerary, guess in followed(system, periods):
        try:
            found = _line(itinerary, guess)
        except NotProved as reason:
            why = reason
            continue
        name = str((found.quarters, *itinerary.contacts))
        seen[name] += 1
        first.setdefault(name, (itinerary, guess))
    if not seen:
        raise why
    return first[seen.most_common(1)[0][0]]


def _line(itinerary: Itinerary, guess: list[float]) -> Family:
    """Return the line of orbits through one."""
    return family(itinerary, quarters(itinerary, guess[:: len(itinerary.system.state) + 1]))
