"""The options of `cap.prove`: each is read, and tried, before anything is searched or proved."""

import argparse
import os
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from errno import ENOENT
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

from cap.certificate import naming
from cap.checker.theorems import load
from cap.command.console import Parser, program, quoted
from cap.command.option import choice, integer, masses
from cap.errors import BadInput
from cap.files import tried
from cap.floats.candidates import Candidate, Request
from cap.parameters import PAPER, Parameters, exact
from cap.proofs.fixed_point import Setting
from cap.proofs.symbolic import NAMES as SYMBOLIC
from cap.proofs.theorems import THEOREMS
from cap.runner import Runner, Tell

NAMES = (*THEOREMS, *SYMBOLIC)
ORDERS = ("3", "5", "7", "9")
Range = tuple[Fraction | None, Fraction | None]


def parser() -> Parser:
    """Return the command line's parser."""
    p = Parser(
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
    p.add_argument(
        "--masses",
        metavar="M1,M2",
        help="particles, particles_saddle, particles_sink, particles_limits, sliding: two masses, "
        "as 1,9/10, on each of which the forcing F and the friction f act; their orbits are found "
        "from equal masses, or from random states",
    )
    p.add_argument(
        "--proportional",
        action="store_true",
        help="with --masses: the friction f m_i instead of f; there is nothing to prove then, and "
        "this says why",
    )
    p.add_argument("--all", action="store_true", help="prove every orbit found that qualifies")
    p.add_argument("--period", default="1", metavar="N", help="periodic: of period N T (default 1)")
    p.add_argument("--epsilon", metavar="Q", help="the same as --e 1-Q")
    p.add_argument("--from", dest="lowest", metavar="Q", help="branch, attractor: for f from here")
    p.add_argument("--to", dest="highest", metavar="Q", help="branch, attractor: for f up to here")
    p.add_argument("--speed", metavar="Q", help="mixed: for states |v| < Q (default 3/2 R omega)")
    p.add_argument(
        "--cuts",
        metavar="N",
        help="mixed: leaves are cut in halves N times on average, 1 to 9 (default 2); one more "
        "doubles the time",
    )
    p.add_argument(
        "--flights",
        metavar="N",
        help="conservative: launches are followed for N flights forward and backward, 1 to 40 "
        "(default 20); more take longer, and leave less area",
    )
    p.add_argument(
        "--jobs",
        default="1",
        metavar="N",
        help="on a range of f, conservative, mixed: processes (default 1)",
    )
    p.add_argument(
        "--journal",
        type=Path,
        metavar="FILE",
        help="on a range of f, conservative: a file of what is done, from which an interrupted "
        "proof goes on",
    )
    p.add_argument("--digits", default="30", metavar="N", help="digits claimed (default 30)")
    p.add_argument(
        "--order",
        metavar="N",
        help="odd order of the normal form, 3 to 9 (default 3, or 5 with a resonance of order 5 to "
        "8 near)",
    )
    p.add_argument(
        "--out",
        type=Path,
        default=Path("certificates"),
        metavar="PATH",
        help="a file ending in .json, which is replaced; or a directory (default: certificates): "
        "there the name tells the theorem, the parameters that are not the paper's, and the orbit "
        "if one is asked for, and no other file is replaced",
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


@dataclass(frozen=True)
class Asked:
    """What is asked for: a request that makes sense."""

    request: Request
    digits: int
    order: int | None
    f_range: Range
    jobs: int
    journal: Path | None
    out: Path
    speed: Fraction | None = None
    cuts: int | None = None
    flights: int | None = None

    @classmethod
    def of(cls, options: argparse.Namespace, progress: Callable[[str], None]) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        if options.theorem in SYMBOLIC:
            raise BadInput(
                f"the theorem {options.theorem} has no certificate: its proof is printed by "
                f"`python -m cap.prove {options.theorem}`"
            )
        if options.theorem not in THEOREMS:
            raise BadInput(f"say what to prove: one of {', '.join(NAMES)}")
        f_range = _range(options)
        if any(f_range):
            theorem = THEOREMS[options.theorem].over_f or options.theorem
            options = argparse.Namespace(**{**vars(options), "theorem": theorem})
        asked = cls(
            _request(options, progress),
            integer(options.digits, "digits", (6, 1000), 4),
            int(choice(*ORDERS)([options.order], "order")) if options.order else None,
            f_range,
            integer(options.jobs, "jobs", (1, 1024), 4),
            options.journal,
            options.out,
            _positive(options.speed),
            None if options.cuts is None else integer(options.cuts, "cuts", (1, 9), 1),
            None if options.flights is None else integer(options.flights, "flights", (1, 40), 2),
        )
        asked._fits()
        if asked.journal:
            _try(asked.journal)
            if not asked.journal.parent.is_dir():
                raise BadInput(f"cannot write {quoted(asked.journal)}: {os.strerror(ENOENT)}")
        return asked

    def writable(self) -> "Asked":
        """Return this; raise `BadInput` if no certificate can be written to ``out``."""
        _try(self.out, directory=not self.into_a_file)
        return self

    def runner(self, tell: Tell, executor: Executor | None = None) -> Runner:
        """Return what examines the cells of a theorem on a range of parameters."""
        return Runner(self.jobs, tell, executor, self.journal, whole=True)

    def setting(self, candidate: Candidate, runner: Runner) -> Setting:
        """Return what the proof of the theorem about a candidate starts from."""
        return Setting(
            self.request.parameters,
            candidate.start,
            self.digits,
            order=self.order or candidate.order,
            progress=lambda words: runner.tell(words, None),
            f_range=self.f_range,
            runner=runner,
            particles=candidate.particles,
            speed=self.speed,
            cuts=self.cuts,
            flights=self.flights,
        )

    @property
    def into_a_file(self) -> bool:
        """Whether ``out`` is the file itself."""
        return self.out.suffix == ".json"

    def path(self, candidate: Candidate) -> Path:
        """Return where the certificate goes; raise `BadInput` if another file is there."""
        if self.into_a_file:
            return self.out
        request, state = self.request, (candidate.start.x, candidate.start.v)
        ends = zip(("from", "to"), self.f_range, strict=True)
        about = {key: str(f) for key, f in ends if f is not None}
        if request.masses:
            about["masses"] = ",".join(map(str, request.masses))
        if request.periods > 1:
            about["period"] = str(request.periods)
        if request.orbit or request.every:
            about |= naming.of_state(state)
        path = self.out / naming.name(request.kind, request.parameters, about)
        _try(path)
        naming.free(path, request.kind, request.parameters, state, request.masses)
        return path

    def _fits(self) -> None:
        """Raise `BadInput` for options of other theorems, or that exclude each other."""
        theorem = self.request.kind
        over_f = THEOREMS[theorem].over_f == theorem
        if self.request.every and (self.request.orbit or self.into_a_file):
            raise BadInput("--all goes neither with --orbit nor with one file as --out")
        if any(self.f_range) and not over_f:
            raise BadInput("--from and --to are for theorems on a range of f")
        if self.journal and not (over_f or theorem == "conservative"):
            raise BadInput("--journal is for theorems on a range of f, and for conservative")
        if self.jobs > 1 and not (over_f or theorem in ("conservative", "mixed")):
            raise BadInput("--jobs is for theorems on a range of f, for conservative and mixed")
        if theorem != "mixed" and (self.speed is not None or self.cuts is not None):
            raise BadInput("--speed and --cuts are for the theorem mixed")
        if theorem != "conservative" and self.flights is not None:
            raise BadInput("--flights is for the theorem conservative")
        if self.order and theorem != "elliptic":
            raise BadInput("--order is for the theorem elliptic")
        if self.request.masses and "masses" not in load(theorem).PARAMETERS:
            raise BadInput(f"the theorem {theorem} is about one mass: leave out --masses")
        if theorem != "periodic" and self.request.periods > 1:
            raise BadInput("--period is for the theorem periodic")


def _request(options: argparse.Namespace, progress: Callable[[str], None]) -> Request:
    """Return what the search is asked for."""
    if options.proportional:
        raise BadInput(_proportional(options.theorem))
    given = {name: getattr(options, name) for name in PAPER.strings()}
    if options.epsilon is not None:
        if options.e is not None:
            raise BadInput("--epsilon Q means --e 1-Q: give one of them")
        given["e"] = str(1 - exact(options.epsilon))
    if "f" not in load(options.theorem).PARAMETERS:
        if options.f is not None:
            raise BadInput(
                f"the theorem {options.theorem} holds for more than one f: leave out --f"
            )
        F = PAPER.F if options.F is None else exact(options.F)
        given["f"] = str(F / 2)  # any f will do
    paper = PAPER.strings()
    words = (paper[name] if word is None else word for name, word in given.items())
    orbit = tuple(float(exact(word)) for word in options.orbit or ())
    return Request(
        options.theorem,
        Parameters(*map(exact, words)),
        (orbit[0], orbit[1]) if orbit else None,
        every=options.all,
        periods=integer(options.period, "period", (1, 16), 4),
        progress=progress,
        masses=masses([options.masses], "masses") if options.masses is not None else (),
    )


def _proportional(theorem: str) -> str:
    """Return in words why nothing is proved of masses with friction f m_i."""
    if "masses" not in load(theorem).PARAMETERS:
        return f"--proportional goes with --masses: the theorem {theorem} is about one mass"
    return (
        "with friction f m_i and unequal masses a collision preserves sum m_i dv_i^dx_i only if it "
        "keeps the signs of both velocities, and no orbit that never stops has such collisions "
        "only (theorem symplectic); two equal masses m have the friction force f m: give it as --f"
    )


def _range(options: argparse.Namespace) -> Range:
    """Return the range of f that is asked for."""
    words = options.lowest, options.highest
    low, high = (None if word is None else exact(word) for word in words)
    ends = [f for f in (Fraction(0), low, high) if f is not None]
    if any(a >= b for a, b in pairwise(ends)):
        raise BadInput("the range must be 0 < from < to")
    return low, high


def _positive(word: str | None) -> Fraction | None:
    """Return a positive number, if one is given."""
    if word is None:
        return None
    if exact(word) <= 0:
        raise BadInput(f"--speed must be positive: {word.strip()}")
    return exact(word)


def _try(path: Path, *, directory: bool = False) -> None:
    """Raise `BadInput` if a file, or one in a directory, certainly cannot be written."""
    try:
        tried(path / "certificate.json" if directory else path)
    except OSError as error:
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
