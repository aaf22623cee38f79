"""The command `cap.prove`: search, prove, write the certificate, print the theorem.

What can be proved: see `cap.proofs.theorems`.
"""

import sys
from collections.abc import Iterator, Sequence
from importlib import import_module
from typing import Any

from cap.command.own_refusals import LISTED
from cap.command.progress import Progress, answered
from cap.command.prover_options import Asked
from cap.command.prover_parser import read, without_options
from cap.command.proving import proved
from cap.errors import NotProved
from cap.floats.candidates import Candidate
from cap.proofs import symbolic, theorems
from cap.proofs.theorems import GROUPS, THEOREMS
from cap.runner import Runner
from cap.words import say


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    named = {word.split("=")[0] for word in words}
    if "--map" in named:
        kind = "curve" if "island" in named else "horseshoe"
        return import_module(f"cap.command.own_{kind}").main(words)  # type: ignore[no-any-return]
    if "--ball" in named:
        return import_module("cap.command.own_ball").main(words)  # type: ignore[no-any-return]
    if "--model" in named:
        return import_module("cap.command.own").main(words)  # type: ignore[no-any-return]
    if "--set" in named:
        say("error: --set goes with --model FILE: it gives values to its parameters", sys.stderr)
        return 2
    options = read(words)
    if options.list:
        print("\n".join(_listed()))
        return 0
    progress = Progress()

    def run() -> int:
        if options.theorem in symbolic.NAMES:
            return _symbolic(without_options(options).theorem)
        return _run(Asked.of(options, progress.tell).writable(), progress)

    return answered(run, progress)


def _listed() -> Iterator[str]:
    """Give the lines that say what can be proved, by what one wants."""
    summaries = {name: (each.group, each.summary) for name, each in THEOREMS.items()}
    for name in symbolic.NAMES:
        proof = symbolic.proof(name)
        summaries[name] = proof.GROUP, proof.SUMMARY
    width = max(map(len, summaries))
    for key, wanted in GROUPS.items():
        yield f"{wanted}:"
        for name, (group, summary) in summaries.items():
            if group == key:
                yield f"  {name:<{width}}  {summary}"
    yield "a system or a map of your own (docs/own-system.md; each with --help):"
    for words, summary in LISTED.items():
        yield f"  {words:<{max(map(len, LISTED))}}  {summary}"


def _symbolic(name: str) -> int:
    """Prove a theorem that has no numbers and print its proof; return the status."""
    try:
        lines = symbolic.lines(name)
    except NotProved as failure:
        say(f"NOT PROVED ({name}).  {failure}", sys.stderr)
        return 1
    print("\n".join(lines), flush=True)
    return 0


def _run(asked: Asked, progress: Progress) -> int:
    """Prove what is asked for."""
    found = THEOREMS[asked.request.kind].search(asked.request)
    for candidate in found.candidates:
        asked.path(candidate)
    progress.clear()
    print("\n".join([*found.lines, "\n"]), end="", flush=True)
    runner = asked.runner(progress.tell)
    return max([_proved(asked, runner, each, progress) for each in found.candidates])


def _proved(asked: Asked, runner: Runner, candidate: Candidate, progress: Progress) -> int:
    """Prove the theorem of one orbit, write its certificate and print it; return the status."""
    path, theorem = asked.path(candidate), asked.request.kind
    setting = asked.setting(candidate, runner)

    def prove() -> dict[str, Any]:
        return theorems.accepted(THEOREMS[theorem], setting)

    return proved(theorem, prove, path, progress, about=candidate.shown)
