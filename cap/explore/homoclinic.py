"""The picture of a certificate of `homoclinic`: ``python -m cap.explore.homoclinic FILE``.

The theorem is proved again, as by `cap.verify`; if the checker rejects the certificate there is no
picture, and the exit status is 1.  The points drawn are proved: each lies in a box that is smaller
than a pixel.  The curves are floats.
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from cap.checker.maps.cones import Cones
from cap.checker.maps.homoclinic import Orbit
from cap.checker.theorems.homoclinic import Homoclinic
from cap.command import entry
from cap.command.console import Parser, program, protected
from cap.command.progress import Progress, answered
from cap.explore.export import kind
from cap.explore.verified import certificate, image, rejected
from cap.files import replacing
from cap.words import quoted, say


def main(words: Sequence[str]) -> int:
    """Run the command line; return its exit status."""
    options = parser().parse_args([protected(word) for word in words])
    progress = Progress()

    def run() -> int:
        image(options.out)
        theorem = Proof(certificate(options.file, "homoclinic"), lambda _step: None)
        if reason := rejected(theorem):
            say(f"REJECTED: {quoted(options.file)}: {reason}; no picture is drawn", sys.stdout)
            return 1
        from cap.pictures.homoclinic import draw  # noqa: PLC0415 (matplotlib is slow to load)

        figure = draw(theorem, theorem.orbits)
        with replacing(options.out) as target:
            figure.savefig(target, format=kind(options.out))
        say(f"VERIFIED: {quoted(options.file)}; {quoted(options.out)}: written", sys.stdout)
        return 0

    return answered(run, progress)


def parser() -> Parser:
    """Return the command line."""
    parser = Parser(
        prog=program("cap.explore.homoclinic"),
        description="Draw the homoclinic orbits that a certificate of the theorem homoclinic "
        "proves.  It is verified first, as by cap.verify: one that is rejected is not drawn (exit "
        "status 1).  The points are proved, the curves are floats.",
        epilog="Example: python -m cap.explore.homoclinic certificates/homoclinic.json",
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="a certificate of homoclinic")
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("homoclinic.png"),
        metavar="FILE",
        help="default homoclinic.png",
    )
    return parser


class Proof(Homoclinic):
    """The proof of the checker, as it is; the orbits are kept for the picture."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.orbits: list[Orbit] = []

    def followed(self, cones: Cones, hint: dict[str, Any]) -> Orbit:
        """Return an orbit, with its hits proved."""
        self.orbits.append(super().followed(cones, hint))
        return self.orbits[-1]


if __name__ == "__main__":
    entry.leave(entry.run("cap.explore.homoclinic:main", None))
