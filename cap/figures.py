"""Pictures from Python, as `cap.explore` draws them: what is found, and its figure.

    import cap
    picture = cap.figures.portrait(f="9/20")
    picture.figure.savefig("portrait.pdf"), picture.findings.states, print(picture)

A notebook shows the picture.  All of it is floats, from which nothing is proved.  Parameters are
exact, as in `cap.prove_theorem`; what else is given are the options of ``cap.explore NAME --help``.
"""

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Unpack

from cap.errors import BadInput
from cap.explore.commands import COMMANDS
from cap.interface import exact_parameters
from cap.keywords import System

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Pair = tuple[float, float]
Box = tuple[float, float, float, float]


@dataclass(frozen=True, repr=False, eq=False)
class Picture:
    """What was found, as arrays, and its ``figure``, of matplotlib; ``print`` gives its numbers."""

    name: str
    findings: Any
    figure: "Figure"

    def __str__(self) -> str:
        return "\n".join(self.findings.lines())

    def __repr__(self) -> str:
        return f"<Picture: {self.findings.lines()[0]}>"

    def _repr_png_(self) -> bytes:
        file = io.BytesIO()
        self.figure.savefig(file, format="png", dpi=100)
        return file.getvalue()


def portrait(
    *,
    orbit: Pair | None = None,
    box: Box | None = None,
    radius: float | None = None,
    orbits: int = 100,
    periods: int = 500,
    **parameters: Unpack[System],
) -> Picture:
    """Draw orbits once a period: from around the elliptic orbit (or ``orbit``), or from a box.

    ``radius`` is that of the ellipse on which they start, in units of R and Rω.
    """
    own = {"orbit": orbit, "box": box, "radius": radius, "orbits": orbits, "periods": periods}
    return draw("portrait", own, **parameters)


def orbit(
    state: Pair | None = None,
    *,
    periods: float = 1,
    exactly: bool = False,
    **parameters: Unpack[System],
) -> Picture:
    """Draw one orbit in time and in the plane, with its events.

    Near a periodic orbit it is that, unless ``exactly``; without a state the elliptic one.
    """
    own = {"orbit": state, "periods": periods, "exactly": exactly}
    return draw("orbit", own, **parameters)


def basin(
    *,
    orbit: Pair | None = None,
    box: Box | None = None,
    points: int = 300,
    periods: int = 25,
    **parameters: Unpack[System],
) -> Picture:
    """Draw the fate of states: which first turn, stick or are captured, and when."""
    own = {"orbit": orbit, "box": box, "points": points, "periods": periods}
    return draw("basin", own, **parameters)


def attractor(
    *,
    box: Box | None = None,
    points: int = 40,
    transient: int = 2000,
    periods: int = 200,
    **parameters: Unpack[System],
) -> Picture:
    """Draw where seeds end, and from where: attractors and their basins."""
    own = {"box": box, "points": points, "transient": transient, "periods": periods}
    return draw("attractor", own, **parameters)


def continuation(
    parameter: str = "f",
    *,
    orbit: Pair | None = None,
    between: Pair | None = None,
    period: int = 1,
    points: int = 1000,
    **parameters: Unpack[System],
) -> Picture:
    """Draw a periodic orbit over a parameter, with its bifurcations."""
    own = {
        "parameter": parameter,
        "orbit": orbit,
        "range": between,
        "period": period,
        "points": points,
    }
    return draw("continuation", own, **parameters)


def release(
    parameter: str | None = None,
    *,
    between: Pair | None = None,
    points: int | None = None,
    iterates: int = 40,
    **parameters: Unpack[System],
) -> Picture:
    """Draw the map from one release to the next, or its late iterates over a parameter."""
    own = {"parameter": parameter, "range": between, "points": points, "iterates": iterates}
    return draw("release", own, **parameters)


def inventory(*, period: int = 1, **parameters: Unpack[System]) -> Picture:
    """Draw all periodic orbits found, of least period ``period`` T."""
    return draw("inventory", {"period": period}, **parameters)


def draw(name: str, options: dict[str, Any] | None = None, **parameters: Unpack[System]) -> Picture:
    """Draw what ``cap.explore NAME`` draws: a picture of any of its commands.

    ``options`` are those of the command, by name and as numbers.  Raises `BadInput`.
    """
    if name not in COMMANDS:
        raise BadInput(f"there is no picture {name!r}: one of {', '.join(COMMANDS)}")
    given = {key: value for key, value in (options or {}).items() if value is not None}
    command = COMMANDS[name].about(given)
    unknown = given.keys() - {option.keyword for option in command.options}
    if unknown:
        raise BadInput(f"{name} has no option {min(unknown)!r}")
    findings = command.function()(exact_parameters(**parameters), **given)
    return Picture(name, findings, command.picture(findings, dpi=200))
