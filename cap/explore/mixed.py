"""The picture of a certificate of `mixed`: ``python -m cap.explore.mixed FILE --out PICTURE``.

What is drawn is proved, by the checker's arithmetic, as far as what the certificate says to attract
does so: of coloured regions all but at most 5 % has the fate, all of the pale ones stops.  Beside
it, what floats say.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

from cap.checker.kernel.certificate import read
from cap.checker.kernel.processes import Work
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.mixed import Mixed
from cap.command import entry
from cap.command.console import Parser, program, protected, quoted, say
from cap.command.option import integer
from cap.command.progress import Progress, answered
from cap.command.verifier import content
from cap.errors import BadInput
from cap.explore.export import IMAGES, kind
from cap.files import replacing


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = _parser().parse_args([protected(word) for word in words])
    progress = Progress()

    def run() -> int:
        _draw(options.file, options.out, integer(options.jobs, "jobs", (1, 1024), 4), progress)
        progress.clear()
        say(quoted(options.out), sys.stdout)
        return 0

    return answered(run, progress)


def _parser() -> Parser:
    parser = Parser(
        prog=program("cap.explore.mixed"),
        description="Draw the basins that a certificate of the theorem mixed proves: what is "
        "shown of every coloured region is proved for all of it but at most 5 %, all of the pale "
        "ones stops at least once, of grey ones nothing is shown; beside it, what floats say.  It "
        "takes as long as the certificate takes to verify.",
        epilog="Example: python -m cap.explore.mixed certificates/mixed.json --out mixed.png",
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="a certificate of mixed")
    parser.add_argument(
        "--out", type=Path, default=Path("mixed.png"), metavar="FILE", help="default mixed.png"
    )
    parser.add_argument("--jobs", default="1", metavar="N", help="processes (default 1)")
    return parser


def _draw(file: Path, out: Path, jobs: int, progress: Progress) -> None:
    """Write the picture of a certificate."""
    suffix = kind(out)
    if suffix not in IMAGES:
        raise BadInput(f"no picture: {quoted(out)}")
    theorem = _theorem(file)
    work = Work(jobs, progress.tell, theorem.phases())
    from cap.pictures.proved import draw  # noqa: PLC0415 (matplotlib is slow to load)

    figure = draw(theorem, work)
    with replacing(out) as target:
        figure.savefig(target, format=suffix)


def _theorem(file: Path) -> Mixed:
    """Return the theorem of a certificate."""
    try:
        certificate = read(content(file))
    except OSError as error:
        raise BadInput(f"cannot read {quoted(file)}: {error.strerror}") from None
    except Rejected as reason:
        raise BadInput(f"{quoted(file)} is no certificate: {reason}") from None
    if certificate.theorem != "mixed":
        raise BadInput(f"{quoted(file)} is about the theorem {certificate.theorem}, not mixed")
    return Mixed(certificate, lambda _step: None)


if __name__ == "__main__":
    entry.leave(entry.run("cap.explore.mixed:main", None))
