"""The options of `cap.prove`: each is read, and tried, before anything is searched or proved."""

import argparse
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cap.certificate import naming
from cap.checker.theorems import load
from cap.command.output import writable, writable_into
from cap.command.prover_parser import NAMES
from cap.errors import BadInput
from cap.floats.candidates import Candidate, Request
from cap.option import integer
from cap.parameters import PAPER, Parameters, exact
from cap.proofs.fixed_point import Setting
from cap.proofs.options import JOBS, JOURNAL
from cap.proofs.symbolic import NAMES as SYMBOLIC
from cap.proofs.theorems import OWN, THEOREMS, Theorem, takers
from cap.runner import Runner, Tell
from cap.words import meant, quoted


@dataclass(frozen=True)
class Asked:
    """What is asked for: a request that makes sense."""

    request: Request
    digits: int
    out: Path

    @classmethod
    def of(cls, options: argparse.Namespace, progress: Callable[[str], None]) -> "Asked":
        """Read the options; raise `BadInput` with what is wrong."""
        theorem = _theorem(options)
        own = _own(theorem, options.own)
        digits = integer(options.digits, "digits", (6, 1000), 4)
        asked = cls(_request(theorem, options, own, progress), digits, options.out)
        if asked.request.every and (asked.request.orbit or asked.into_a_file):
            raise BadInput(
                "--all goes neither with --orbit nor with one file as --out: name a directory"
            )
        theorem.fits(own, asked.request.parameters)
        if journal := own.get(JOURNAL.name):
            writable(journal)
        return asked

    def writable(self) -> "Asked":
        """Return this; raise `BadInput` if no certificate can be written to ``out``."""
        if self.into_a_file:
            writable(self.out)
        else:
            writable_into(self.out, ".json")
        return self

    def runner(self, tell: Tell, executor: Executor | None = None) -> Runner:
        """Return what does the parts of a long proof."""
        jobs, journal = (self.request.options.get(o.name, o.default) for o in (JOBS, JOURNAL))
        return Runner(jobs, tell, executor, journal, whole=True)

    def setting(self, candidate: Candidate, runner: Runner) -> Setting:
        """Return what the proof of the theorem about a candidate starts from."""
        return Setting(
            self.request.parameters,
            candidate.guess,
            self.digits,
            progress=lambda words: runner.tell(words, None),
            runner=runner,
            options=self.request.options,
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
        about = {
            option.name: _text(request.options[option.name])
            for option in THEOREMS[request.kind].options
            if option.about and request.options.get(option.name, option.default) != option.default
        }
        if request.orbit or request.every:
            about |= naming.of_state(state)
        path = self.out / naming.name(request.kind, request.parameters, about)
        if self.out.is_dir():
            writable(path)
        naming.free(path, request.kind, request.parameters, state, request.masses)
        return path


def _theorem(options: argparse.Namespace) -> Theorem:
    """Return the theorem that is asked for."""
    if options.theorem in SYMBOLIC:
        raise BadInput(
            f"the theorem {options.theorem} has no certificate: its proof is printed by "
            f"`python -m cap.prove {options.theorem}`"
        )
    if options.theorem not in THEOREMS:
        raise BadInput(_unknown(options.theorem))
    return THEOREMS[options.theorem].meant(options.own)


def _unknown(theorem: str | None) -> str:
    """Return what is said of a theorem that there is not."""
    if theorem is None:
        return f"say what to prove: one of {', '.join(NAMES)}"
    if theorem in OWN:
        return f"{theorem} is about a system of your own: python -m cap.prove periodic --model FILE"
    guess = meant(theorem, NAMES)
    return f"there is no theorem {quoted(theorem)}{guess or ': one of ' + ', '.join(NAMES)}"


def _own(theorem: Theorem, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of the options that not all theorems take; this one must take them."""
    options = {option.name: option for option in theorem.options}
    for name in given:
        if name not in options:
            raise BadInput(f"--{name} is an option of: {', '.join(takers(name))}")
    return {name: options[name].read(words) for name, words in given.items()}


def _text(value: Any) -> str:
    """Return the value of an option for the name of a certificate."""
    return ",".join(map(str, value)) if isinstance(value, tuple) else str(value)


def _request(
    theorem: Theorem,
    options: argparse.Namespace,
    own: dict[str, Any],
    progress: Callable[[str], None],
) -> Request:
    """Return what the search is asked for."""
    given = {name: getattr(options, name) for name in PAPER.strings()}
    if options.epsilon is not None:
        if options.e is not None:
            raise BadInput("--epsilon Q means --e 1-Q: give one of them")
        given["e"] = str(1 - exact(options.epsilon))
    if "f" not in load(theorem.name).PARAMETERS:
        if options.f is not None:
            raise BadInput(f"the theorem {theorem.name} holds for more than one f: leave out --f")
        F = PAPER.F if options.F is None else exact(options.F)
        given["f"] = str(F / 2)  # any f will do
    paper = PAPER.strings()
    words = (paper[name] if word is None else word for name, word in given.items())
    orbit = tuple(float(exact(word)) for word in options.orbit or ())
    return Request(
        theorem.name,
        Parameters(*map(exact, words)),
        (orbit[0], orbit[1]) if orbit else None,
        every=options.all,
        options=own,
        progress=progress,
    )
