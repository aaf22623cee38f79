"""The command ``cap.prove attractor --model FILE``: motions that are released again and again."""

from collections.abc import Sequence
from typing import Any

from cap.command import own_map
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.errors import BadInput
from cap.option import integer
from cap.proofs import contact_attractor
from cap.proofs.contacts import as_parameters
from cap.runner import Runner
from cap.system.files import assigned, read, stem
from cap.system.release import releases

THEOREM = "contact_attractor"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()

    def run() -> int:
        if options.theorem not in ("attractor", THEOREM):
            raise BadInput(f"this is the command of `attractor`, not of {options.theorem}")
        values = assigned(options.set)
        system = read(options.model, values)
        releases(system)
        names = [THEOREM, stem(options.model)]
        path = own_map.place(options, names, values, as_parameters(system))
        runner = Runner(integer(options.jobs, "jobs", (1, 1024)), progress.tell)

        def prove() -> dict[str, Any]:
            return contact_attractor.prove_any(system, runner)

        return own_map.answered(THEOREM, prove, path, progress)

    return answered(run, progress)


def parser() -> Parser:
    """Return the parser of this command."""
    p = Parser(
        prog=f"{program('cap.prove')} attractor --model FILE",
        description="Prove what becomes of motions of a system of your own that are released again "
        "and again: where a guard, linear in one variable and the clock, comes to zero, and its "
        "reset gives the other variables by that one and the clock, the time of a release gives "
        "all that follows.  The map of an interval of these times into itself has one fixed point "
        "that all its orbits tend to, or its entropy is bounded from both sides.  FILE.py has a "
        "function of the parameters that returns a cap.System (see docs/own-system.md).  The "
        "certificate holds the system: `python -m cap.verify` needs no FILE.py.",
        epilog="Example: python -m cap.prove attractor --model examples/belt.py",
    )
    own_map.add_model(p, "attractor")
    own_map.add_ends(p)
    return p
