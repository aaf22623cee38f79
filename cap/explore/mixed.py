"""The picture of a certificate of `mixed`: ``python -m cap.explore.mixed FILE --out PICTURE``.

The theorem is proved again, as by `cap.verify`; if the checker rejects the certificate there is no
picture, and the exit status is 1.  So what is drawn is proved: of coloured regions all but at most
5 % has the fate, all of the white ones stops.  Beside it, what floats say.
"""

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any

from cap.checker.folded.areas import Areas
from cap.checker.folded.masses import Places
from cap.checker.folded.motion import System
from cap.checker.folded.portions import Node
from cap.checker.folded.regions import Leaf
from cap.checker.folded.tree import nodes
from cap.checker.kernel.certificate import read
from cap.checker.kernel.processes import each
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import Certificate, Theorem
from cap.checker.theorems.mixed import SIDES, Mixed, Work
from cap.command import entry
from cap.command.console import Parser, program, protected, quoted, say
from cap.command.option import integer
from cap.command.progress import Progress, answered
from cap.command.verifier import content, why
from cap.errors import BadInput
from cap.explore.export import IMAGES, kind
from cap.files import replacing
from cap.runner import Runner

_AT_A_TIME = 64  # tasks
_LEAF, _PART = 0.9, 0.4  # nodes of places are followed while a leaf is, and a part of a leaf


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()

    def run() -> int:
        _image(options.out)
        jobs = integer(options.jobs, "jobs", (1, 1024), 4)
        theorem = Proof(_certificate(options.file), jobs, progress)
        rejected = _rejected(theorem)
        if rejected:
            progress.clear()
            say(f"REJECTED: {quoted(options.file)}: {rejected}; no picture is drawn", sys.stdout)
            return 1
        _draw(theorem, options.out)
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
    """The proof of the checker, as it is, with what it finds of places kept for the picture.

    Its long steps, and those of the picture, are done by ``work``, with one estimate for all.
    """

    known: Places

    def __init__(self, certificate: Certificate, jobs: int, progress: Progress) -> None:
        super().__init__(certificate, lambda _step: None)
        self.jobs, self._progress = jobs, progress
        self._done = self._total = 0.0

    def prove(self) -> None:
        """Prove the theorem."""
        y = System(self.p)
        leaves = chain(*(self.sticks(y, side) for side in SIDES), self.turns(y))
        twice = sum(map(_weight, leaves))  # they are followed for the proof, then for the picture
        self._total = 2 * twice + sum(map(_weight, nodes(self.hints["places"]["tree"])))
        super().prove()

    def places(self, work: Work) -> Places:  # noqa: ARG002 (ours tells how far it is)
        """Return what is known of all distances to the wall ahead."""
        self.known = super().places(self.work)
        return self.known

    def counted(self, work: Work, places: Places) -> Iterator[Areas]:  # noqa: ARG002 (likewise)
        """Give the areas of the states, by regions of their first stops."""
        return super().counted(self.work, places)

    def work(self, function: Callable[[Any], Any], tasks: Iterable[Any]) -> list[Any]:
        """Do tasks in processes: what the function knows, of all places, goes with many of them."""
        waiting = list(tasks)
        many = [waiting[k : k + _AT_A_TIME] for k in range(0, len(waiting), _AT_A_TIME)]
        own = sum(map(_weight, waiting))

        def tell(_words: str, part: float | None) -> None:
            self._progress.tell("proof and picture", (self._done + own * (part or 0)) / self._total)

        runner = Runner(self.jobs, tell, whole=True)
        found = runner.map(partial(each, 1, function), many, "leaves", processes=True)
        self._done += own
        return list(chain.from_iterable(found))


def _weight(task: Node | Leaf) -> float:
    """Return about how long a task takes, in the time of a node of the places."""
    return _LEAF + _PART * len(task.parts) if isinstance(task, Leaf) else 1.0


def _rejected(theorem: Theorem) -> str:
    """Return why the checker rejects a certificate; nothing if it proves the theorem."""
    try:
        theorem.prove()
    except BadInput:  # a process was killed: that is no verdict
        raise
    except Exception as reason:  # noqa: BLE001 (whatever goes wrong, nothing is proved)
        return why(reason)
    return ""


def _draw(theorem: Proof, out: Path) -> None:
    """Write the picture of a theorem that is proved."""
    from cap.pictures.proved import draw  # noqa: PLC0415 (matplotlib is slow to load)

    figure = draw(theorem, theorem.known, theorem.work)
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
