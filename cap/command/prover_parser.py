"""The options of `cap.prove`, as they stand on the command line."""

import argparse
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from cap.checker.theorems import load
from cap.command.console import Parser, program
from cap.command.option import Option, choice, count, exact_positive, path
from cap.errors import BadInput
from cap.parameters import PAPER
from cap.proofs.symbolic import NAMES as SYMBOLIC
from cap.proofs.theorems import THEOREMS

NAMES = (*THEOREMS, *SYMBOLIC)


def order(words: Sequence[str], name: str) -> int:
    """Read the order of a normal form."""
    return int(choice("3", "5", "7", "9")(words, name))


OF_SOME = {
    option.name: option
    for option in (
        Option("period", count(1, 16), "of period N T (default 1)", "N"),
        Option(
            "order",
            order,
            "odd order of the normal form, 3 to 9 (default 3, or 5 with a resonance of order 5 to "
            "8 near)",
            "N",
        ),
        Option("speed", exact_positive, "for states |v| < Q (default 3/2 R omega)", "Q"),
        Option(
            "undecided",
            exact_positive,
            "go on until of at most the part Q of the states neither fate is shown (default: as "
            "far as 75000 regions go)",
            "Q",
        ),
        Option(
            "flights",
            count(1, 60),
            "launches are followed for N flights forward and backward, 1 to 60 (default 25); more "
            "take longer, and leave less",
            "N",
        ),
        Option("jobs", count(1, 1024), "processes (default 1)", "N"),
        Option(
            "journal",
            path,
            "a file of what is done, from which an interrupted proof goes on",
            "FILE",
        ),
    )
}
"""Options that some theorems take, which name them in their ``OPTIONS``."""


class _Parser(Parser):
    """The parser, whose help says which theorems take an option."""

    def __init__(self, **told: Any) -> None:
        super().__init__(**told)
        self._of_some = list[tuple[argparse.Action, Callable[[], list[str]]]]()

    def add_of_some(self, whose: Callable[[], list[str]], *words: str, **told: Any) -> None:
        """Add an option that some theorems take."""
        self._of_some.append((self.add_argument(*words, **told), whose))

    def format_help(self) -> str:
        """Return the help.  It asks all theorems, which takes time: nothing else needs it."""
        for action, whose in self._of_some:
            action.help = f"{', '.join(whose())}: {action.help}"
        self._of_some.clear()
        return super().format_help()


def takers(option: str) -> list[str]:
    """Return the theorems that take an option."""
    ranges = {name: THEOREMS[each.over_f or name] for name, each in THEOREMS.items()}
    return [
        name if option in each.options else f"{name} on a range of f"
        for name, each in THEOREMS.items()
        if option in each.options or option in ranges[name].options
    ]


def _over_f() -> list[str]:
    """Return the theorems that take a range of f."""
    return [name for name, each in THEOREMS.items() if each.over_f]


def _about_masses() -> list[str]:
    """Return the theorems on several masses."""
    return [name for name in THEOREMS if "masses" in load(name).PARAMETERS]


def parser() -> Parser:
    """Return the command line's parser."""
    p = _Parser(
        prog=program("cap.prove"),
        description="Prove a theorem on x'' = F cos(omega t) - f sgn(x') - mu x', l < x < r, where "
        "v becomes -e v at the walls, and write a certificate that `python -m cap.verify FILE` "
        "checks.  Orbits are searched for in floats, from many seeds or from the state given.",
        epilog="Numbers are integers, decimals or p/q, all exact: 0.4 means 2/5.  Examples: "
        "python -m cap.prove elliptic --f 9/20 --out /tmp;  "
        "python -m cap.prove periodic --F 3 --orbit 0.4 -0.67;  "
        "python -m cap.prove persistence --epsilon 1/1000 --mu 1/1000;  "
        "python -m cap.prove capture;  python -m cap.prove branch --from 2/5;  "
        "python -m cap.prove attractor --from 0.39 --to 0.43 --jobs 2",
    )
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
    p.add_of_some(
        _about_masses,
        "--masses",
        metavar="M1,M2",
        help="two masses, as 1,9/10, on each of which the forcing F and the friction f act; their "
        "orbits are found from equal masses, or from random states",
    )
    p.add_argument(
        "--proportional",
        action="store_true",
        help="with --masses: the friction f m_i instead of f; there is nothing to prove then, and "
        "this says why",
    )
    p.add_argument("--all", action="store_true", help="prove every orbit found that qualifies")
    p.add_argument("--epsilon", metavar="Q", help="the same as --e 1-Q")
    p.add_of_some(_over_f, "--from", dest="lowest", metavar="Q", help="for f from here")
    p.add_of_some(_over_f, "--to", dest="highest", metavar="Q", help="for f up to here")
    for name, option in OF_SOME.items():
        p.add_of_some(partial(takers, name), f"--{name}", metavar=option.metavar, help=option.help)
    p.add_argument("--digits", default="30", metavar="N", help="digits claimed (default 30)")
    p.add_argument(
        "--out",
        type=Path,
        default=Path("certificates"),
        metavar="PATH",
        help="a file ending in .json, which is replaced; or a directory (default: certificates), "
        "which is made if it is missing: there the name tells the theorem, the parameters that are "
        "not the paper's, and the orbit if one is asked for, and no other file is replaced",
    )
    return p


def without_options(options: argparse.Namespace) -> argparse.Namespace:
    """Return the options of a theorem without numbers; raise `BadInput` if any is given."""
    if options != parser().parse_args([options.theorem]):
        raise BadInput(
            f"the theorem {options.theorem} is about all parameters and writes no certificate: "
            "give no options"
        )
    return options
