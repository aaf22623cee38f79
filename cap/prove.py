"""Prove a theorem: ``python -m cap.prove elliptic``.

Exit status 0 if everything was proved and the checker accepted the certificate, 1 if not, 2 on bad
input.  A theorem is a function of a `proofs.non_sticking.Setting`; see `THEOREMS`.
"""

import argparse
import math
import re
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from hashlib import sha256
from pathlib import Path
from typing import Any

from cap import certificate, report
from cap.approx.periodic import MOST_HITS, Guess, near, orbits
from cap.checker.rejection import Rejected
from cap.checker.theorem import check
from cap.console import Parser, closing_quietly
from cap.errors import BadInput, NotProved, TooFewDigits
from cap.fixed_point import Start
from cap.parameters import PAPER, Parameters, exact
from proofs import elliptic, saddle
from proofs.non_sticking import Setting

MARGINS = [Fraction(n, 10) for n in (9, 7, 5, 3, 1)]  # of the largest box found
GUARDS = (15, 30, 60)  # digits computed beyond those claimed


@dataclass(frozen=True)
class Theorem:
    """A theorem on orbits of one kind, which is its name: what it says, and its proof."""

    summary: str
    prove: Callable[[Setting], dict[str, Any]]


THEOREMS = {
    "elliptic": Theorem(
        "an elliptic non-sticking T-periodic orbit exists, with twist, inside invariant curves",
        elliptic.prove,
    ),
    "saddle": Theorem("a hyperbolic non-sticking T-periodic orbit exists", saddle.prove),
}


def parser() -> Parser:
    """Return the command line's parser."""
    p = Parser(
        prog="python -m cap.prove",
        description="Prove a theorem on x'' = F cos(omega t) - f sgn(x'), l < x < r, with elastic "
        "walls, and write a certificate that `python -m cap.verify FILE` checks.  The orbit is "
        "searched for in floats, with at most "
        f"{MOST_HITS} hits per period: fewest hits first, then smallest x.",
        epilog="Numbers are integers, decimals or p/q, all exact: 0.4 means 2/5.  "
        "Example: python -m cap.prove elliptic --f 9/20 --out /tmp",
    )
    p.add_argument("theorem", nargs="?", metavar="THEOREM", help="one of: " + ", ".join(THEOREMS))
    p.add_argument("--list", action="store_true", help="say what can be proved")
    for name, value in PAPER.strings().items():
        p.add_argument(f"--{name}", default=value, metavar="Q", help=f"default {value}")
    p.add_argument(
        "--orbit",
        nargs=2,
        metavar=("X", "V"),
        help="prove the orbit to which Newton's method leads from this state at t = 0",
    )
    p.add_argument("--all", action="store_true", help="prove every orbit found that qualifies")
    p.add_argument("--digits", default="30", metavar="N", help="digits claimed (default 30)")
    p.add_argument(
        "--order",
        metavar="N",
        choices=["3", "5", "7", "9"],
        help="odd order of the normal form (default 3, or 5 with a resonance of order 5 to 8 near)",
    )
    p.add_argument(
        "--out",
        type=Path,
        default=Path("certificates"),
        metavar="PATH",
        help="a directory, or a file ending in .json (default: certificates); a file is replaced, "
        "but in a directory no certificate on another orbit or of other parameters",
    )
    return p


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    return closing_quietly(lambda: _main(sys.argv[1:] if argv is None else argv))


def _main(arguments: Sequence[str]) -> int:
    """Run the command line; bad input and interrupts become a line and an exit status."""
    options = parser().parse_args([_protected(word) for word in arguments])
    if options.list:
        for name, theorem in THEOREMS.items():
            print(f"{name:<10} {theorem.summary}")
        return 0
    try:
        return _run(options)
    except BadInput as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted; nothing half-written", file=sys.stderr)
        return 130


def _protected(word: str) -> str:
    """Return ``word`` such that argparse takes a negative number, also -1/2, for a value."""
    return " " + word if re.fullmatch(r"-[\d.]\S*", word) else word


def _run(options: argparse.Namespace) -> int:
    """Prove what the options ask for."""
    if options.theorem not in THEOREMS:
        raise BadInput(f"say what to prove: one of {', '.join(THEOREMS)}")
    if options.all and (options.orbit or options.out.suffix == ".json"):
        raise BadInput("--all goes neither with --orbit nor with one file as --out")
    parameters = Parameters(*(exact(getattr(options, name)) for name in PAPER.strings()))
    digits = _digits(options.digits)
    if options.orbit:
        guesses = [_guessed(options, parameters)]
    else:
        guesses = _searched(parameters, options.theorem, options.all)
    print()
    statuses = [_proved(options, parameters, guess, digits) for guess in guesses]
    return max(statuses)


def _digits(text: str) -> int:
    """Return the number of digits asked for."""
    text = text.strip()
    if not re.fullmatch(r"\d{1,4}", text, re.ASCII) or not 6 <= int(text) <= 1000:
        raise BadInput(f"--digits must be an integer from 6 to 1000: {text[:40]!r}")
    return int(text)


def _guessed(options: argparse.Namespace, parameters: Parameters) -> Guess:
    """Return the orbit that the guess leads to."""
    x, v = (exact(word) for word in options.orbit)
    guess = near(parameters, float(x), float(v))
    if guess.kind != options.theorem:
        raise BadInput(
            f"the orbit that ({x}, {v}) leads to is no {options.theorem} orbit: its trace is "
            f"{guess.trace:.6g}"
        )
    print(f"Newton's method leads from ({x}, {v}) to:\n  {_shown(guess)}")
    return guess


def _searched(parameters: Parameters, kind: str, every: bool) -> list[Guess]:
    """Search; say what was found; return the first orbit of the kind, or all of them."""
    found: list[Guess] = []
    for hits in range(2, MOST_HITS + 1, 2):
        found += [guess for guess in orbits(parameters, hits) if guess.kind == kind]
        if found and not every:
            break
    if not found:
        raise BadInput(
            f"no {kind} non-sticking T-periodic orbit with at most {MOST_HITS} hits was found "
            "(a guess can be given with --orbit X V)"
        )
    counted = f"{len(found)} {kind} orbit{'s' if len(found) > 1 else ''}"
    number = f"at most {MOST_HITS}" if every else f"{len(found[0].hit_times)}"
    which = "all" if every else "the first (smallest x)" if len(found) > 1 else "it"
    print(f"Found {counted} with {number} hits per period; proving {which}:")
    for place, guess in enumerate(found, 1):
        print(f"  {place}  {_shown(guess)}")
    return found if every else found[:1]


def _shown(guess: Guess) -> str:
    return (
        f"x = {guess.x:.6g}, v = {guess.v:.6g}, {len(guess.hit_times)} hits, "
        f"trace {guess.trace:.6g}, least speed {guess.least_speed:.6g}"
    )


def _proved(options: argparse.Namespace, parameters: Parameters, guess: Guess, digits: int) -> int:
    """Prove the theorem of one orbit, print it and write its certificate; return the status."""
    theorem = THEOREMS[options.theorem]
    start = Start(guess.x, guess.v, guess.hit_times)
    order = int(options.order) if options.order else _order(guess)
    try:
        proved = _accepted(theorem, Setting(parameters, start, digits, order))
    except NotProved as failure:
        print(f"NOT PROVED ({options.theorem}, {_shown(guess)}).  {failure}", file=sys.stderr)
        return 1
    print(report.theorem(proved))
    path = options.out
    try:
        if path.suffix != ".json":
            path = certificate.place(proved, path, _special(parameters))
        written = certificate.write(proved, path)
    except OSError as error:
        raise BadInput(f"cannot write {path}: {error.strerror}") from None
    print(f"\nCertificate: {path} ({written}; the independent checker accepts it)\n")
    return 0


def _special(parameters: Parameters) -> str:
    """Return what tells the parameters from the paper's, for a file name."""
    paper = PAPER.strings()
    changed = [f"{k}={v}" for k, v in parameters.strings().items() if v != paper[k]]
    name = "-".join(changed).replace("/", "_") or "paper"
    return name if len(name) <= 80 else sha256(name.encode()).hexdigest()[:12]


def _accepted(theorem: Theorem, setting: Setting) -> dict[str, Any]:
    """Return a certificate that the independent checker accepts, or raise `NotProved`.

    A smaller part of the largest box is claimed until the checker, in looser arithmetic, follows.
    """
    rejection = ""
    for margin in MARGINS:
        proved = _sharp(theorem, replace(setting, margin=margin))
        try:
            check(certificate.dumps(proved).encode(), lambda _step: None)
        except Rejected as reason:
            rejection = str(reason)
        else:
            return proved
    raise NotProved("checker", f"the independent checker rejects the certificate: {rejection}")


def _sharp(theorem: Theorem, setting: Setting) -> dict[str, Any]:
    """Return the certificate, computing more guard digits until all digits claimed are certain."""
    began = time.perf_counter()
    for guard in GUARDS:
        sharper = replace(setting, guard=guard)
        try:
            proved = theorem.prove(sharper)
        except TooFewDigits:
            if guard == GUARDS[-1]:
                raise
        else:
            break
    seconds = time.perf_counter() - began
    return {**proved, "provenance": certificate.provenance(sharper.bits, seconds)}


def _order(guess: Guess) -> int:
    """Return 5 if the rotation number is within 1/100 of a p/q with 5 <= q <= 8, else 3.

    Near such a resonance the first twist says little at a small distance from the fixed point
    already, so the second one is claimed as well.
    """
    if guess.kind != "elliptic":
        return 3
    rotation = math.acos(guess.trace / 2) / (2 * math.pi)
    distances = (abs(rotation - p / q) for q in range(5, 9) for p in range(1, q))
    return 5 if min(distances) < 1 / 100 else 3


if __name__ == "__main__":
    sys.exit(main())
