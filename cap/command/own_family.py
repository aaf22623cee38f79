"""The command ``cap.prove family --model FILE``: a continuum of periodic orbits."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

from cap.command import own_map
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.errors import BadInput, NotProved
from cap.floats.models.periodic import followed
from cap.option import integer
from cap.orbits.family import Family, family, quarters
from cap.orbits.itinerary import Itinerary
from cap.proofs import contacts_family
from cap.proofs.contacts import as_parameters
from cap.system.files import assigned, read, stem
from cap.system.model import System

THEOREM = "contacts_family"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()

    def run() -> int:
        if options.theorem not in ("family", THEOREM):
            raise BadInput(f"this is the command of `family`, not of {options.theorem}")
        values = assigned(options.set)
        system = read(options.model, values)
        periods = integer(options.period, "period", (1, 64))
        told = values | ({} if periods == 1 else {"period": str(periods)})
        path = own_map.place(options, [THEOREM, stem(options.model)], told, as_parameters(system))

        def prove() -> dict[str, Any]:
            progress.tell("following states", None)
            found, guess = _found(system, periods)
            return contacts_family.prove(found, guess, progress.tell)

        return own_map.answered(THEOREM, prove, path, progress)

    return answered(run, progress)


def parser() -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} family --model FILE",
        description="Prove a continuum of periodic orbits of a system of your own: with contacts "
        "at quarters of a period of the clock, and states just before them that are linear in a "
        "number c.  Flights must be sums of cos and sin of rational frequencies, whose angles "
        "between contacts are quarters of turns; then all is exact.  For each c of an interval "
        "there is an orbit with these contacts and no others.  FILE.py has a function of the "
        "parameters that returns a cap.System (see docs/own-system.md).",
        epilog="Example: python -m cap.prove family --model examples/den_hartog.py "
        "--set omega=1/2,f=1/10",
    )
    own_map.add_model(p, "family")
    p.add_argument(
        "--period", default="1", metavar="N", help="of N periods of the clock (default 1)"
    )
    own_map.add_out(p)
    return p


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
