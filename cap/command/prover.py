"""The command `cap.prove`: search, prove, write the certificate, print the theorem.

What can be proved: see `proofs.theorems`.
"""

import sys
from collections.abc import Iterator, Sequence
from concurrent import futures
from contextlib import contextmanager
from dataclasses import replace

from cap.cells.subdivision import Workers
from cap.certificate import report
from cap.certificate import writer as certificate
from cap.command import entry
from cap.command.console import printable, protected, quoted, say
from cap.command.progress import Progress
from cap.command.prover_options import Asked, parser
from cap.errors import BadInput, NotProved
from cap.floats.candidates import Candidate
from cap.maps.fixed_point import Start
from proofs import theorems
from proofs.fixed_point import Setting
from proofs.theorems import THEOREMS


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    if options.list:
        for name, theorem in THEOREMS.items():
            print(f"{name:<12} {theorem.summary}")
        return 0
    progress = Progress()
    try:
        return _run(Asked.of(options, progress.tell), progress)
    except BadInput as error:
        progress.clear()
        say(f"error: {printable(str(error))}", sys.stderr)
        return 2
    finally:
        progress.clear()


def _run(asked: Asked, progress: Progress) -> int:
    """Prove what is asked for."""
    found = THEOREMS[asked.request.kind].search(asked.request)
    for candidate in found.candidates:
        asked.path(candidate)
    progress.clear()
    print("\n".join([*found.lines, "\n"]), end="", flush=True)
    with _workers(asked, progress) as workers:
        ask = Setting(
            asked.request.parameters,
            Start(0.0, 0.0, ()),
            asked.digits,
            progress=progress.tell,
            f_range=asked.f_range,
            workers=workers,
        )
        return max([_proved(asked, ask, each) for each in found.candidates])


@contextmanager
def _workers(asked: Asked, progress: Progress) -> Iterator[Workers]:
    """Give what examines the cells of a theorem on a range of parameters."""
    if asked.jobs == 1:
        yield Workers(None, asked.journal, progress.tell)
        return
    try:
        with futures.ProcessPoolExecutor(asked.jobs, initializer=entry.as_worker) as executor:
            yield Workers(executor, asked.journal, progress.tell)
    except futures.BrokenExecutor:
        raise BadInput("a process of --jobs was killed (what a journal has is kept)") from None


def _proved(asked: Asked, ask: Setting, candidate: Candidate) -> int:
    """Prove the theorem of one orbit, write its certificate and print it; return the status."""
    path, theorem = asked.path(candidate), asked.request.kind
    setting = replace(ask, start=candidate.start, order=asked.order or candidate.order)
    try:
        proved = theorems.accepted(THEOREMS[theorem], setting)
    except NotProved as failure:
        setting.progress("")
        say(f"NOT PROVED ({theorem}, {candidate.shown}).  {failure}", sys.stderr)
        return 1
    setting.progress("")
    try:
        written = certificate.write(proved, path)
    except OSError as error:
        print(report.theorem(proved))
        raise BadInput(f"cannot write {quoted(path)}: {error.strerror}") from None
    print(report.theorem(proved))
    print(
        f"\nCertificate: {quoted(path)} ({written}; the independent checker accepts it)\n",
        flush=True,
    )
    return 0
