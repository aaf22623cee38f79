"""Prove a theorem: ``python -m cap.prove elliptic``.

Exit status 0 if everything was proved and the checker accepted the certificate, 1 if not, 2 on bad
input.  What can be proved: see `proofs.theorems`.
"""

import argparse
import signal
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

from cap import certificate, report
from cap.approx.candidates import Candidate, Request
from cap.console import Parser, closing_quietly, printable, protected, quoted
from cap.errors import BadInput, NotProved
from cap.fixed_point import Start
from cap.option import integer
from cap.parameters import PAPER, Parameters, exact
from cap.subdivision import Workers
from proofs import theorems
from proofs.fixed_point import Setting
from proofs.theorems import THEOREMS

WITHOUT_F = ("pitchfork", "branch")  # theorems that hold for more than one f


def parser() -> Parser:
    """Return the command line's parser."""
    p = Parser(
        prog="python -m cap.prove",
        description="Prove a theorem on x'' = F cos(omega t) - f sgn(x') - mu x', l < x < r, where "
        "v becomes -e v at the walls, and write a certificate that `python -m cap.verify FILE` "
        "checks.  Orbits are searched for in floats, from many seeds or from the state given.",
        epilog="Numbers are integers, decimals or p/q, all exact: 0.4 means 2/5.  Examples: "
        "python -m cap.prove elliptic --f 9/20 --out /tmp;  "
        "python -m cap.prove periodic --F 3 --orbit 0.4 -0.67;  "
        "python -m cap.prove persistence --epsilon 1/1000 --mu 1/1000;  "
        "python -m cap.prove capture;  python -m cap.prove branch --from 2/5",
    )
    p.add_argument("theorem", nargs="?", metavar="THEOREM", help="one of: " + ", ".join(THEOREMS))
    p.add_argument("--list", action="store_true", help="say what can be proved")
    for name, value in PAPER.strings().items():
        p.add_argument(f"--{name}", metavar="Q", help=f"default {value}")
    p.add_argument(
        "--orbit",
        nargs=2,
        metavar=("X", "V"),
        help="prove the orbit to which Newton's method leads from this state at t = 0 (capture: of "
        "this state)",
    )
    p.add_argument("--all", action="store_true", help="prove every orbit found that qualifies")
    p.add_argument("--period", default="1", metavar="N", help="periodic: of period N T (default 1)")
    p.add_argument("--epsilon", metavar="Q", help="the same as --e 1-Q")
    p.add_argument("--from", dest="lowest", metavar="Q", help="branch: for f from here")
    p.add_argument("--to", dest="highest", metavar="Q", help="branch: for f up to here")
    p.add_argument("--jobs", default="1", metavar="N", help="branch: processes (default 1)")
    p.add_argument(
        "--journal",
        type=Path,
        metavar="FILE",
        help="branch: a file of what is done, from which an interrupted proof goes on",
    )
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
    options = parser().parse_args([protected(word) for word in arguments])
    if options.list:
        for name, theorem in THEOREMS.items():
            print(f"{name:<12} {theorem.summary}")
        return 0
    try:
        return _run(options)
    except BadInput as error:
        _progress("")
        print(f"error: {printable(str(error))}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted; nothing half-written", file=sys.stderr)
        return 130


def _run(options: argparse.Namespace) -> int:
    """Prove what the options ask for."""
    if options.theorem not in THEOREMS:
        raise BadInput(f"say what to prove: one of {', '.join(THEOREMS)}")
    if options.all and (options.orbit or options.out.suffix == ".json"):
        raise BadInput("--all goes neither with --orbit nor with one file as --out")
    request = _request(options)
    digits = integer(options.digits, "digits", (6, 1000), 4)
    found = THEOREMS[options.theorem].search(request)
    _progress("")
    print("\n".join(found.lines), end="\n\n", flush=True)
    with _workers(options) as workers:
        ask = Setting(
            request.parameters,
            Start(0.0, 0.0, ()),
            digits,
            progress=_progress,
            f_range=_range(options),
            workers=workers,
        )
        return max(_proved(options, ask, each) for each in found.candidates)


@contextmanager
def _workers(options: argparse.Namespace) -> Iterator[Workers]:
    """Give what examines the cells of a theorem on a range of parameters."""
    jobs = integer(options.jobs, "jobs", (1, 1024), 4)
    if options.theorem != "branch" and (jobs > 1 or options.journal):
        raise BadInput("--jobs and --journal are for the theorem branch")
    if jobs == 1:
        yield Workers(None, options.journal, _progress)
        return
    try:
        ignore = signal.SIGINT, signal.SIG_IGN  # ctrl-C is for this process
        with ProcessPoolExecutor(jobs, initializer=signal.signal, initargs=ignore) as executor:
            yield Workers(executor, options.journal, _progress)
    except BrokenExecutor:
        raise BadInput("a process of --jobs was killed (what a journal has is kept)") from None


def _range(options: argparse.Namespace) -> tuple[Fraction | None, Fraction | None]:
    """Return the range of f that is asked for."""
    words = options.lowest, options.highest
    if options.theorem != "branch" and words != (None, None):
        raise BadInput("--from and --to are for the theorem branch")
    low, high = (None if word is None else exact(word) for word in words)
    ends = [f for f in (Fraction(0), low, high) if f is not None]
    if any(a >= b for a, b in pairwise(ends)):
        raise BadInput("the range must be 0 < from < to")
    return low, high


def _request(options: argparse.Namespace) -> Request:
    """Return what is asked for."""
    if options.epsilon is not None:
        if options.e is not None:
            raise BadInput("--epsilon Q means --e 1-Q: give one of them")
        options.e = str(1 - exact(options.epsilon))
    if options.theorem != "periodic" and options.period != "1":
        raise BadInput("--period is for the theorem periodic")
    if options.order and options.theorem != "elliptic":
        raise BadInput("--order is for the theorem elliptic")
    if options.theorem in WITHOUT_F:
        if options.f is not None:
            raise BadInput(
                f"the theorem {options.theorem} holds for more than one f: leave out --f"
            )
        F = PAPER.F if options.F is None else exact(options.F)
        options.f = str(F / 2)  # any f will do
    given = {name: getattr(options, name) for name in PAPER.strings()}
    paper = PAPER.strings()
    words = (paper[name] if word is None else word for name, word in given.items())
    parameters = Parameters(*map(exact, words))
    orbit = tuple(float(exact(word)) for word in options.orbit or ())
    return Request(
        options.theorem,
        parameters,
        (orbit[0], orbit[1]) if orbit else None,
        every=options.all,
        periods=integer(options.period, "period", (1, 16), 4),
        progress=_progress,
    )


def _proved(options: argparse.Namespace, ask: Setting, candidate: Candidate) -> int:
    """Prove the theorem of one orbit, print it and write its certificate; return the status."""
    order = int(options.order) if options.order else candidate.order
    try:
        setting = replace(ask, start=candidate.start, order=order)
        proved = theorems.accepted(THEOREMS[options.theorem], setting)
    except NotProved as failure:
        _progress("")
        print(f"NOT PROVED ({options.theorem}, {candidate.shown}).  {failure}", file=sys.stderr)
        return 1
    _progress("")
    print(report.theorem(proved))
    path = options.out
    try:
        if path.suffix != ".json":
            path = certificate.place(proved, path)
        written = certificate.write(proved, path)
    except OSError as error:
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
    print(f"\nCertificate: {quoted(path)} ({written}; the independent checker accepts it)\n")
    return 0


def _progress(words: str) -> None:
    """Show how far a search or a proof is, on one line of a terminal; no words clear it."""
    if sys.stderr is not None and sys.stderr.isatty():
        print(f"\r{words:<70}", end="\r", file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main())
