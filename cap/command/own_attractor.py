"""The command ``cap.prove attractor --model FILE``: motions that are released again and again."""

import argparse
from collections.abc import Sequence

from cap.command import own_command
from cap.command.console import Parser
from cap.command.own_command import Asked
from cap.proofs import contact_attractor
from cap.proofs.contacts import as_parameters
from cap.runner import Runner
from cap.system.files import assigned, read
from cap.system.release import releases

THEOREM = "contact_attractor"


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    return own_command.run(words, parser(), asked)


def parser() -> Parser:
    """Return the parser of this command."""
    p = own_command.begun(
        "attractor",
        "--model",
        "Prove what becomes of motions of a system of your own that are released again and again: "
        "where a guard, linear in one variable and the clock, comes to zero, and its reset gives "
        "the other variables by that one and the clock, the time of a release gives all that "
        "follows.  The map of an interval of these times into itself has one fixed point that all "
        "its orbits tend to, or its entropy is bounded from both sides.",
        "Example: python -m cap.prove attractor --model examples/belt.py",
    )
    return own_command.ended(p)


def asked(options: argparse.Namespace) -> Asked:
    """Read the options; raise `BadInput` with what is wrong."""
    values = assigned(options.set)
    system = read(options.file, values)
    releases(system)
    path = own_command.place(options, [THEOREM], values, as_parameters(system))
    return Asked(
        THEOREM, path, lambda tell: contact_attractor.prove_any(system, Runner(options.jobs, tell))
    )
