"""The options of `cap.prove`: each is read, and tried, before anything is searched or proved."""

import argparse
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

from cap.certificate import naming
from cap.checker.theorems import load
from cap.command.option import integer, masses
from cap.command.output import writable, writable_into
from cap.command.prover_parser import NAMES, OF_SOME, takers
from cap.errors import BadInput
from cap.floats.candidates import Candidate, Request
from cap.parameters import PAPER, Parameters, exact
from cap.proofs.fixed_point import Setting
from cap.proofs.symbolic import NAMES as SYMBOLIC
from cap.proofs.theorems import THEOREMS
from cap.runner import Runner, Tell
from cap.words import meant, quoted

Range = tuple[Fraction | None, Fraction | None]


@dataclass(frozen=True)
class Asked:
    """What is asked for: a request that makes sense."""

    request: Request
    digits: int
    f_range: Range
    out: Path
    jobs: int
    journal: Path | None
    more: dict[str, Any]  # what else the theorem takes, by the names that `Setting` has

    @classmethod
    def of(cls, options: argparse.Namespace, progress: Callable[[str], None]) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        if options.theorem in SYMBOLIC:
            raise BadInput(
                f"the theorem {options.theorem} has no certificate: its proof is printed by "
                f"`python -m cap.prove {options.theorem}`"
            )
        if options.theorem not in THEOREMS:
            raise BadInput(_unknown(options.theorem))
        f_range = _range(options)
        if any(f_range):
            theorem = THEOREMS[options.theorem].over_f or options.theorem
            options = argparse.Namespace(**{**vars(options), "theorem": theorem})
        more = _of_some(options)
        asked = cls(
            _request(options, more.pop("period", 1), progress),
            integer(options.digits, "digits", (6, 1000), 4),
            f_range,
            options.out,
            more.pop("jobs", 1),
            more.pop("journal", None),
            more,
        )
        asked._fits()
        if asked.journal:
            writable(asked.journal)
        return asked

    def writable(self) -> "Asked":
        """Return this; raise `BadInput` if no certificate can be written to ``out``."""
        if self.into_a_file:
            writable(self.out)
        else:
            writable_into(self.out, ".json")
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
            progress=lambda words: runner.tell(words, None),
            f_range=self.f_range,
            runner=runner,
            particles=candidate.particles,
            **{"order": candidate.order, **self.more},
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
        if self.out.is_dir():
            writable(path)
        naming.free(path, request.kind, request.parameters, state, request.masses)
        return path

    def _fits(self) -> None:
        """Raise `BadInput` for options of other theorems, or that exclude each other."""
        theorem = self.request.kind
        if self.request.every and (self.request.orbit or self.into_a_file):
            raise BadInput("--all goes neither with --orbit nor with one file as --out")
        if any(self.f_range) and THEOREMS[theorem].over_f != theorem:
            raise BadInput("--from and --to are for theorems on a range of f")
        if self.request.masses and "masses" not in load(theorem).PARAMETERS:
            raise BadInput(f"the theorem {theorem} is about one mass: leave out --masses")


def _unknown(theorem: str | None) -> str:
    """Return what is said of a theorem that there is not."""
    if theorem is None:
        return f"say what to prove: one of {', '.join(NAMES)}"
    guess = meant(theorem, NAMES)
    return f"there is no theorem {quoted(theorem)}{guess or ': one of ' + ', '.join(NAMES)}"


def _of_some(options: argparse.Namespace) -> dict[str, Any]:
    """Return the values of the options that not all theorems take; this one must take them."""
    given = {name: vars(options)[name] for name in OF_SOME if vars(options)[name] is not None}
    for name in given:
        if name not in THEOREMS[options.theorem].options:
            raise BadInput(f"--{name} is an option of: {', '.join(takers(name))}")
    return {name: OF_SOME[name].read(word) for name, word in given.items()}


def _request(options: argparse.Namespace, periods: int, progress: Callable[[str], None]) -> Request:
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
        periods=periods,
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
