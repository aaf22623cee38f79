"""The picture of a certificate of `mixed`: ``python -m cap.explore.mixed FILE --out PICTURE``.

The theorem is proved again, as by `cap.verify`; if the checker rejects the certificate there is no
picture, and the exit status is 1.  So what is drawn is proved: of coloured regions all but at most
5 % has the fate, all of the white ones stops.  Beside it, what floats say.
"""

import sys
from collections.abc import Sequence
from concurrent.futures import BrokenExecutor
from pathlib import Path

from cap.checker.folded.masses import Places
from cap.checker.kernel.certificate import read
from cap.checker.kernel.processes import Work
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Certificate, Theorem
from cap.checker.theorems.mixed import PLACES, Map, Mixed
from cap.command import entry
from cap.command.console import Parser, program, protected
from cap.command.outcome import content, why
from cap.command.progress import Progress, answered
from cap.errors import BadInput
from cap.explore.export import IMAGES, kind
from cap.files import replacing
from cap.option import integer
from cap.runner import within
from cap.words import quoted, say


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()

    def run() -> int:
        _image(options.out)
        jobs = integer(options.jobs, "jobs", (1, 1024), 4)
        theorem = Proof(_certificate(options.file), lambda _step: None)
        drawn = {words: cost for words, cost in theorem.phases().items() if words != PLACES}
        proof = sum(theorem.phases().values())
        part = proof / (proof + sum(drawn.values()))
        theorem.jobs, theorem.tell = jobs, within(progress.tell, 0, part)
        rejected = _rejected(theorem)
        if rejected:
            progress.clear()
            say(f"REJECTED: {quoted(options.file)}: {rejected}; no picture is drawn", sys.stdout)
            return 1
        work = Work(jobs, within(progress.tell, part, 1, "picture: "), drawn)
        _draw(theorem, work, options.out)
        progress.clear()
        say(f"VERIFIED: {quoted(options.file)}; {quoted(options.out)}: written", sys.stdout)
        return 0

    return answered(run, progress)


def parser() -> Parser:
    """Return the command line."""
    parser = Parser(
        prog=program("cap.explore.mixed"),
        description="Draw the basins that a certificate of the theorem mixed proves.  It is "
        "verified first, as by cap.verify: one that is rejected is not drawn (exit status 1).  "
        "What is shown of every coloured region is proved for all of it but at most 5 %, all of "
        "the white ones stops at least once, of black ones nothing is shown; beside it, what "
        "floats say, from which nothing is proved.  It takes some minutes for the stored one.",
        epilog="Example: python -m cap.explore.mixed certificates/mixed.json --out mixed.png",
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="a certificate of mixed")
    parser.add_argument(
        "--out", type=Path, default=Path("mixed.png"), metavar="FILE", help="default mixed.png"
    )
    parser.add_argument("--jobs", default="1", metavar="N", help="processes (default 1)")
    return parser


class Proof(Mixed):
    """The proof of the checker, as it is; what it finds of places is kept for the picture."""

    known: Places

    def places(self, work: Map) -> Places:
        """Return what is known of all distances to the wall ahead."""
        self.known = super().places(work)
        return self.known


def _rejected(theorem: Theorem) -> str:
    """Return why the checker rejects a certificate; nothing if it proves the theorem."""
    try:
        theorem.prove()
    except BrokenExecutor:
        raise BadInput("a process was killed: that is no verdict") from None
    except Exception as reason:  # noqa: BLE001 (whatever goes wrong, nothing is proved)
        return why(reason)
    return ""


def _draw(theorem: Proof, work: Work, out: Path) -> None:
    """Write the picture of a theorem that is proved."""
    from cap.pictures.proved import draw  # noqa: PLC0415 (matplotlib is slow to load)

    figure = draw(theorem, theorem.known, work)
    with replacing(out) as target:
        figure.savefig(target, format=kind(out))


def _image(out: Path) -> None:
    """Refuse a file that is no picture, or that cannot be written."""
    if kind(out) not in IMAGES:
        raise BadInput(f"no picture: {quoted(out)}")


def _certificate(file: Path) -> Certificate:
    """Return a certificate of the theorem."""
    try:
        certificate = read(content(file))
    except OSError as error:
        raise BadInput(f"cannot read {quoted(file)}: {error.strerror}") from None
    except Rejected as reason:
        raise BadInput(f"{quoted(file)} is no certificate: {reason}") from None
    if certificate.theorem != "mixed":
        raise BadInput(f"{quoted(file)} is about the theorem {certificate.theorem}, not mixed")
    return certificate


if __name__ == "__main__":
    entry.leave(entry.run("cap.explore.mixed:main", None))
