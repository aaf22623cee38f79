"""The options of `cap.prove`, as they stand on the command line.

What all theorems take is declared here, what some take in their modules: only that of the theorem
named is loaded, unless help or a mistake asks for all.
"""

import argparse
from collections.abc import Iterable, Sequence
from typing import Any

from cap.command.console import Parser, program, protected
from cap.command.output import add_out
from cap.errors import BadInput
from cap.option import Option
from cap.parameters import PAPER
from cap.proofs.symbolic import NAMES as SYMBOLIC
from cap.proofs.theorems import THEOREMS, takers

NAMES = (*THEOREMS, *SYMBOLIC)
NUMBERS = "Numbers are integers, decimals or p/q, all exact: 0.4 means 2/5."


def options_of(theorems: Iterable[str]) -> dict[str, Option]:
    """Return the options, by name, that some of these theorems take, perhaps on a range of f."""
    both = [each for name in theorems for each in (THEOREMS[name], THEOREMS[name].over_f)]
    return {option.name: option for theorem in both for option in theorem.options}


def read(words: Sequence[str]) -> argparse.Namespace:
    """Return the options given; those that not all theorems take are in ``own``, by name."""
    words = [protected(word) for word in words]
    named = next((word for word in words if word in NAMES), None)
    options, others = parser(named).parse_known_args(words)
    return _whole().parse_args(words) if others else options


def parser(theorem: str | None = None) -> Parser:
    """Return the parser for the options of a theorem, or for those that all theorems take."""
    if theorem is None:
        return _completed(_Bare(**_about()), {})
    if theorem not in THEOREMS:
        return _completed(Parser(**_about()), {})
    said = {"description": f"Prove {theorem}: {THEOREMS[theorem].summary}.", "epilog": NUMBERS}
    about = _about() | said
    helps = {option: option.help for option in options_of([theorem]).values()}
    return _completed(Parser(**about), helps)


def _whole() -> Parser:
    """Return the parser for the options of all theorems, whose help says which ones take them."""
    every = options_of(THEOREMS).values()
    helps = {option: f"{', '.join(takers(option.name))}: {option.help}" for option in every}
    return _completed(Parser(**_about()), helps)


class _Bare(Parser):
    """A parser that has loaded no theorem; its help tells of all."""

    def format_help(self) -> str:
        """Return the help.  It asks all theorems, which takes time: nothing else needs it."""
        return _whole().format_help()


def _about() -> dict[str, Any]:
    """Return what the help says before and after the options."""
    return {
        "prog": program("cap.prove"),
        "description": "Prove a theorem on x'' = F cos(omega t) - f sgn(x') - mu x', l < x < r, "
        "where v becomes -e v at the walls, and write a certificate that `python -m cap.verify "
        "FILE` checks.  Orbits are searched for in floats, from many seeds or from the state "
        "given.  `python -m cap.prove THEOREM --help` has the options of one theorem.  "
        "For a system of your own: `python -m cap.prove periodic --model FILE --help`.",
        "epilog": f"{NUMBERS}  Examples: "
        "python -m cap.prove elliptic --f 9/20 --out /tmp;  "
        "python -m cap.prove periodic --F 3 --orbit 0.4 -0.67;  "
        "python -m cap.prove persistence --epsilon 1/1000 --mu 1/1000;  "
        "python -m cap.prove capture;  python -m cap.prove branch --from 2/5;  "
        "python -m cap.prove attractor --from 0.39 --to 0.43 --jobs 2",
    }


class _Own(argparse.Action):
    """Keeps the words of an option that not all theorems take in ``own``, by its name."""

    def __call__(self, _parser: Any, options: Any, words: Any, _called: Any = None) -> None:
        options.own = {**options.own, self.dest: words}


def _completed(p: Parser, own: dict[Option, str]) -> Parser:
    """Add all options to a parser: those that all theorems take, and ``own`` with their helps."""
    p.add_argument("theorem", nargs="?", metavar="THEOREM", help="one of: " + ", ".join(NAMES))
    p.add_argument("--list", action="store_true", help="say what can be proved")
    for name, value in PAPER.strings().items():
        p.add_argument(f"--{name}", metavar="Q", help=f"default {value}")
    p.add_argument(
        "--orbit",
        nargs=2,
        metavar=("X", "V"),
        help="prove the orbit to which Newton's method leads from this state at t = 0 (capture: of "
        "this state; attractor: the critical point near X)",
    )
    p.add_argument("--all", action="store_true", help="prove every orbit found that qualifies")
    p.add_argument("--epsilon", metavar="Q", help="the same as --e 1-Q")
    p.set_defaults(own={})
    for option, told in own.items():
        words: dict[str, Any] = {"nargs": option.nargs, "metavar": option.metavar, "help": told}
        p.add_argument(f"--{option.name}", action=_Own, default=argparse.SUPPRESS, **words)
    p.add_argument("--digits", default="30", metavar="N", help="digits claimed (default 30)")
    add_out(
        p,
        "the name tells the theorem, the parameters that are not the paper's, and the orbit if one "
        "is asked for, and no other file is replaced",
    )
    return p


def without_options(options: argparse.Namespace) -> argparse.Namespace:
    """Return the options of a theorem without numbers; raise `BadInput` if any is given."""
    if options != parser(options.theorem).parse_args([options.theorem]):
        raise BadInput(
            f"the theorem {options.theorem} is about all parameters and writes no certificate: "
            "give no options"
        )
    return options
