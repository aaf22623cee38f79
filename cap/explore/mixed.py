"""The picture of a certificate of `mixed`: ``python -m cap.explore.mixed FILE --out PICTURE``.

The theorem is proved again, as by `cap.verify`; if the checker rejects the certificate there is no
picture, and the exit status is 1.  So what is drawn is proved: of coloured regions all but at most
5 % has the fate, all of the white ones stops.  Beside it, what floats say.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

from cap.checker.folded.masses import Places
from cap.checker.kernel.processes import Work
from cap.checker.theorems.mixed import PLACES, Map, Mixed
from cap.command import entry
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.explore.export import kind
from cap.explore.verified import certificate, image, rejected
from cap.files import replacing
from cap.option import integer
from cap.runner import within
from cap.words import quoted, say


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()

    def run() -> int:
        image(options.out)
        jobs = integer(options.jobs, "jobs", (1, 1024), 4)
        theorem = Proof(certificate(options.file, "mixed"), lambda _step: None)
        drawn = {words: cost for words, cost in theorem.phases().items() if words != PLACES}
        proof = sum(theorem.phases().values())
        part = proof / (proof + sum(drawn.values()))
        theorem.jobs, theorem.tell = jobs, within(progress.tell, 0, part)
        reason = rejected(theorem)
        if reason:
            progress.clear()
            say(f"REJECTED: {quoted(options.file)}: {reason}; no picture is drawn", sys.stdout)
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


def _draw(theorem: Proof, work: Work, out: Path) -> None:
    """Write the picture of a theorem that is proved."""
    from cap.pictures.proved import draw  # noqa: PLC0415 (matplotlib is slow to load)

    figure = draw(theorem, theorem.known, work)
    with replacing(out) as target:
        figure.savefig(target, format=kind(out))


if __name__ == "__main__":
    entry.leave(entry.run("cap.explore.mixed:main", None))
