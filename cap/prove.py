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
from pathlib import Path
from typing import Any

from cap import certificate, report
from cap.approx.periodic import Guess, near, search
from cap.checker.rejection import Rejected
from cap.checker.theorem import check
from cap.errors import BadInput, NotProved
from cap.fixed_point import Start
from cap.parameters import PAPER, Parameters, exact
from proofs import elliptic, saddle
from proofs.non_sticking import Setting

MOST_HITS = 6
MARGINS = [Fraction(n, 10) for n in range(9, 0, -2)]  # of the largest box; see _certified
GUARDS = (15, 30, 60)


@dataclass(frozen=True)
class Theorem:
    """A theorem on one orbit: what it says, which orbits it is about, and its proof."""

    summary: str
    kind: str
    prove: Callable[[Setting, int], dict[str, Any]]


THEOREMS = {
    "elliptic": Theorem(
        "an elliptic non-sticking T-periodic orbit exists, with twist, inside KAM curves",
        "elliptic",
        elliptic.prove,
    ),
    "saddle": Theorem(
        "a hyperbolic non-sticking T-periodic orbit exists",
        "saddle",
        lambda setting, _order: saddle.prove(setting),
    ),
}


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = argparse.ArgumentParser(
        prog="python -m cap.prove",
        description="Prove a theorem on x'' = F cos(omega t) - f sgn(x'), l < x < r, with elastic "
        "walls, and write a certificate that `python -m cap.verify FILE` checks.",
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
        help="prove the orbit near this state at t = 0, not the first that is found",
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
        metavar="PATH",
        help="a directory, or a file ending in .json (default: certificates/)",
    )
    return p


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    arguments = sys.argv[1:] if argv is None else argv
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
    theorem = THEOREMS[options.theorem]
    parameters = Parameters(*(exact(getattr(options, name)) for name in PAPER.strings()))
    digits = _digits(options.digits)
    chosen = _chosen(options, parameters, theorem.kind)
    status = 0
    for number, guess in chosen:
        path = _path(options, parameters, number)
        try:
            proved = _certified(theorem, parameters, guess, digits, options.order)
        except NotProved as failure:
            print(f"NOT PROVED ({options.theorem}, orbit {number}).  {failure}", file=sys.stderr)
            status = 1
            continue
        written = certificate.write(proved, path)
        print(report.theorem(proved))
        print(f"\nCertificate: {path} ({written}; the independent checker accepts it)\n")
    return status


def _digits(text: str) -> int:
    """Return the number of digits asked for."""
    if not re.fullmatch(r"\d{1,4}", text, re.ASCII) or not 6 <= int(text) <= 1000:
        raise BadInput(f"--digits must be an integer from 6 to 1000: {text[:40]!r}")
    return int(text)


def _chosen(
    options: argparse.Namespace, parameters: Parameters, kind: str
) -> list[tuple[int, Guess]]:
    """Return the orbits to prove, numbered in the documented order: fewest hits, smallest x."""
    if options.orbit:
        x, v = (exact(word) for word in options.orbit)
        guess = near(parameters, float(x), float(v))
        if guess.kind != kind:
            raise BadInput(
                f"the orbit near ({x}, {v}) is no {kind} orbit: its trace is {guess.trace:.6g}"
            )
        same = [g for g in search(parameters, len(guess.hit_times)) if g.kind == kind]
        number = next((i for i, g in enumerate(same, 1) if _close(g, guess)), len(same) + 1)
        print(f"The orbit near the guess: {_shown(guess)}")
        return [(number, guess)]
    return _searched(parameters, kind, options.all)


def _searched(parameters: Parameters, kind: str, every: bool) -> list[tuple[int, Guess]]:
    """Search; say what was found; return the first orbit of the kind, or all of them."""
    found: list[Guess] = []
    for guess in search(parameters, MOST_HITS):
        if found and not every and len(guess.hit_times) > len(found[0].hit_times):
            break
        if guess.kind == kind:
            found.append(guess)
    if not found:
        raise BadInput(
            f"no {kind} non-sticking T-periodic orbit with at most {MOST_HITS} hits was found "
            "(a guess can be given with --orbit X V)"
        )
    print(f"Found {len(found)} {kind} orbit(s); proving {'all' if every else 'the first'}:")
    for number, guess in enumerate(found, 1):
        print(f"  {number}  {_shown(guess)}")
    print()
    return list(enumerate(found, 1))[: None if every else 1]


def _shown(guess: Guess) -> str:
    return (
        f"x = {guess.x:.6f}, v = {guess.v:.6f}, {len(guess.hit_times)} hits, "
        f"trace {guess.trace:.6g}, least speed {guess.least_speed:.6g}"
    )


def _close(a: Guess, b: Guess) -> bool:
    return abs(a.x - b.x) <= 1e-6 * abs(a.v) + 1e-6 * abs(a.x) and abs(a.v - b.v) < 1e-6 * abs(a.v)


def _certified(
    theorem: Theorem, parameters: Parameters, guess: Guess, digits: int, order: str | None
) -> dict[str, Any]:
    """Return a certificate that the independent checker accepts, or raise `NotProved`.

    More guard digits are computed until all digits claimed are certain; a smaller part of the
    box is claimed until the checker, whose arithmetic is looser, can follow.
    """
    began = time.perf_counter()
    start = Start(guess.x, guess.v, guess.hit_times)
    setting = Setting(parameters, start, digits)
    chosen = int(order) if order else _order(guess)
    for guard in GUARDS:
        setting = replace(setting, guard=guard)
        try:
            proved = theorem.prove(setting, chosen)
            break
        except NotProved as failure:
            if failure.step != "rounding" or guard == GUARDS[-1]:
                raise
    for margin in MARGINS:
        if margin != setting.margin:
            proved = theorem.prove(replace(setting, margin=margin), chosen)
        seconds = time.perf_counter() - began
        proved["provenance"] = certificate.provenance(setting.bits, seconds)
        try:
            check(certificate.dumps(proved).encode(), lambda _step: None)
        except Rejected as reason:
            rejection = str(reason)
        else:
            return proved
    raise NotProved("checker", f"the independent checker rejects the certificate: {rejection}")


def _order(guess: Guess) -> int:
    """Return 5 if the rotation number is within 1/100 of some p/q with 5 <= q <= 8, else 3.

    Such a resonance is allowed, but makes the second twist coefficient large.
    """
    if guess.kind != "elliptic":
        return 3
    rotation = math.acos(guess.trace / 2) / (2 * math.pi)
    distances = (abs(rotation - p / q) for q in range(5, 9) for p in range(1, q))
    return 5 if min(distances) < 1 / 100 else 3


def _path(options: argparse.Namespace, parameters: Parameters, number: int) -> Path:
    """Return where the certificate goes: THEOREM[-PARAMETERS][-NUMBER].json in ``--out``.

    PARAMETERS, given when ``--out`` is not, are those that differ from the paper's.
    """
    suffix = "" if number == 1 else f"-{number}"
    out: Path | None = options.out
    if out is None:
        paper = PAPER.strings()
        changed = [f"{k}={v}" for k, v in parameters.strings().items() if v != paper[k]]
        name = "-".join([options.theorem, *changed]).replace("/", "_")
        return Path("certificates") / f"{name}{suffix}.json"
    if out.suffix != ".json":
        return out / f"{options.theorem}{suffix}.json"
    return out.with_name(f"{out.stem}{suffix}.json") if options.all else out


if __name__ == "__main__":
    sys.exit(main())
