"""What can be explored: for each command its options, its computation and its picture.

The options of a command are the keyword arguments of its function; a function and a picture are
named here and imported when they are used.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from inspect import signature
from typing import TYPE_CHECKING, Any

from cap import option
from cap.errors import BadInput
from cap.option import PARAMETERS, Option

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Command:
    """A computation ``module:function``, in `cap.floats` if no package is named, and its picture.

    The picture is in `cap.pictures`.  ``of_masses`` are both, and the size,
    for --masses.
    """

    summary: str
    run: str
    draw: str
    example: str = ""
    more: str = ""
    options: tuple[Option, ...] = ()
    size: tuple[float, float] = (5.4, 4.6)
    of_masses: tuple[str, str, tuple[float, float]] | None = None

    def line(self, name: str) -> str:
        """Return an example of its use."""
        example = self.example or f"--out {name}.png"
        return f"python -m cap.explore {name} {example}"

    def about(self, given: Mapping[str, Any]) -> "Command":
        """Return the command, or that of more than one mass; `BadInput` for options of the other.

        ``given`` are the values of the options that are given.
        """
        if self.of_masses is None:
            return self
        if "masses" not in given:
            alone = [f"--{o.name}" for o in (*MASSES, STATE) if o.keyword in given]
            if alone:
                one = " (the state of one mass is --orbit X V)" if alone[0] == "--state" else ""
                raise BadInput(f"{alone[0]} needs the masses: --masses 1,9/10{one}")
            return self
        run, draw, size = self.of_masses
        command = replace(self, run=run, draw=draw, size=size, of_masses=None)
        known = signature(command.function()).parameters
        wrong = [o.name for o in self.options if o.keyword in given and o.keyword not in known]
        if wrong:
            raise BadInput(f"--{wrong[0]} is about one mass: leave it out, or --masses")
        return command

    def function(self) -> Callable[..., Any]:
        """Return the computation."""
        module, function = self.run.split(":")
        path = module if "." in module else f"cap.floats.diagnostics.{module}"
        found: Callable[..., Any] = getattr(import_module(path), function)
        return found

    def picture(
        self, findings: Any, size: tuple[float, float] | None = None, dpi: float = 200
    ) -> "Figure":
        """Return the picture of findings, of a size in inches."""
        from cap.pictures.style import drawn  # noqa: PLC0415 (matplotlib, only where it draws)

        return drawn(self.draw, findings, size or self.size, dpi)

    @staticmethod
    def status(findings: Any) -> int:
        """Return the exit status: 1 if something was not proved."""
        return int(getattr(findings, "failed", 0) > 0)


ORBIT = Option("orbit", option.numbers, "the fixed point near this state", ("X", "V"), 2)
BOX = Option("box", option.numbers, "the states shown (default: around the fixed point)",
             ("X0", "X1", "V0", "V1"), 4)  # fmt: skip
SEED = Option("seed", option.count(0, 10**9 - 1), "of the random deviations (0)", "N")
PARAMETER = Option(
    "parameter", option.choice(*PARAMETERS), f"one of {', '.join(PARAMETERS)}", "NAME"
)
VALUES = Option("values", option.exacts, "of the parameter", "Q", "+")
MASSES = (
    Option("masses", option.masses, "these masses, on each of which F and f act", "M1,M2"),
    Option("proportional", None, "with --masses: the friction is f m_i, not f"),
)
STATE = Option("state", option.numbers, "with --masses: x_1 .. x_N v_1 .. v_N at t = 0", "Z", "+")


def _periods(default: int) -> Option:
    return Option("periods", option.count(1, 1_000_000), f"forcing periods ({default})", "N")


def _points(default: int) -> Option:
    return Option("points", option.count(2, 5000), f"N x N states ({default})", "N")


def _alignment(name: str, words: str) -> Command:
    return Command(
        f"{name.upper()} over a grid: regular, chaotic, or turning orbits",
        f"alignment:{name}",
        "states:alignment",
        f"--points 300 --periods 15 --out {name}.png",
        f"{words}\nLarge on regular orbits, where it falls like a power of the number of periods;"
        "\non chaotic ones it falls exponentially.  Grey: the orbit turns, sticks or is captured.",
        (ORBIT, BOX, _points(200), _periods(15), SEED),
        (7.6, 3.9),
    )


COMMANDS = {
    "orbit": Command(
        "an orbit in time and in the plane, with its events",
        "trajectory:trajectory",
        "times:orbit",
        "--F 3 --orbit 0.4 -0.67 --periods 2 --out orbit.pdf",
        "Hits, turns, sticks, releases and captures are marked; the list printed has their times.\n"
        "Before a capture it has the hits that are seen in floats, of infinitely many.\n"
        "With --masses 1,9/10: of two masses, by default the orbit continued from equal masses.",
        (
            Option(
                "orbit", option.numbers, "the state at t = 0, or near a fixed point", ("X", "V"), 2
            ),
            Option("exactly", None, "follow this very state, no periodic orbit near it"),
            Option("periods", option.positive_to(10_000), "forcing periods (1)", "Q"),
            *MASSES,
            STATE,
        ),
        (7.4, 4.2),
        ("cap.floats.masses.mass_trajectory:trajectory", "masses:orbit", (7.4, 4.2)),
    ),
    "portrait": Command(
        "a stroboscopic portrait of many orbits",
        "portrait:portrait",
        "states:portrait",
        "--radius 1/40 --orbits 200 --periods 1000 --out portrait.png",
        "Around an elliptic orbit, or of a box, or of the whole plane if there is no such orbit.\n"
        "With --masses 1,9/10: projections to the planes of two masses (--orbits 40, --periods\n"
        "100, --radius 1/250), half of the orbits from a ball around the orbit continued from\n"
        "equal masses, and half from anywhere: mixed dynamics.",
        (
            ORBIT,
            Option("box", option.numbers, "where the orbits start", ("X0", "X1", "V0", "V1"), 4),
            Option(
                "radius", option.positive, "of the starts, in units of R and R omega (1/40)", "Q"
            ),
            Option("orbits", option.count(1, 100_000), "orbits (100)", "N"),
            _periods(500),
            *MASSES,
            STATE,
        ),
        (5.8, 5.0),
        ("cap.floats.masses.mass_portrait:portrait", "masses:portrait", (6.4, 7.0)),
    ),
    "sali": _alignment("sali", "The smaller alignment index, min |w1 + w2|, |w1 - w2|."),
    "gali": _alignment("gali", "The generalised alignment index of two vectors, |w1 ^ w2|."),
    "basin": Command(
        "which states turn, stick or are captured, and when they first do",
        "fate:fate",
        "states:fate",
        "--box -1 1 -2 2 --points 1000 --periods 100 --out basin.png",
        "Blue: the orbit never turned, Omega_NS; the rest is the dissipative part.",
        (ORBIT, BOX, _points(300), _periods(25)),
        (7.8, 4.2),
    ),
    "basin-entropy": Command(
        "basin entropies S_b and S_bb over box sizes",
        "entropy:basin_entropy",
        "graphs:entropy",
        "--points 1000 --periods 25 --out entropy.pdf",
        "Of two colours: never turns; turns, sticks or is captured.  S_b ~ size^alpha.",
        (
            ORBIT,
            BOX,
            _points(600),
            _periods(25),
            Option("boxes", option.counts, "sides of the boxes, in cells", "N", "+"),
        ),
        (7.6, 4.2),
    ),
    "lyapunov": Command(
        "Lyapunov exponents, and how they converge",
        "lyapunov:lyapunov",
        "graphs:lyapunov",
        "--orbits 6 --radius 1/25 --periods 10000 --out lyapunov.pdf",
        "Benettin's method, per time; the second is -inf once the orbit has stuck.",
        (
            Option("orbit", option.numbers, "the state at t = 0 (default: a ray)", ("X", "V"), 2),
            Option(
                "orbits",
                option.count(1, 100_000),
                "orbits on a ray from the elliptic point (5)",
                "N",
            ),
            Option("radius", option.positive, "length of the ray, in units of R (1/25)", "Q"),
            _periods(5000),
        ),
    ),
    "rotation": Command(
        "rotation number and twist against the distance from an elliptic point",
        "rotation:rotation",
        "graphs:rotation",
        "--orbits 400 --out rotation.pdf",
        "tau1 and tau2 as in the theorem `elliptic`: per |z|^2 and |z|^4, area = pi |z|^2.",
        (
            ORBIT,
            Option("radius", option.positive, "largest distance, in units of R (0.03)", "Q"),
            Option(
                "near", option.positive, "distance within which the twist is read off (0.001)", "Q"
            ),
            Option("orbits", option.count(20, 100_000), "orbits (200)", "N"),
            Option("periods", option.count(100, 100_000), "forcing periods (4000)", "N"),
        ),
        (7.8, 3.8),
    ),
    "continuation": Command(
        "a periodic orbit followed in a parameter, with its bifurcations",
        "continuation:continuation",
        "diagrams:continuation",
        "--parameter f --range 0.1 0.65 --out continuation.pdf",
        "Folds, pitchforks, branch points, flips, grazing and sticking borders are located and\n"
        "labelled; at branch points the other branch is followed too, and at flips (period\n"
        "doublings) that of twice the period.",
        (
            Option("orbit", option.numbers, "the orbit near this state", ("X", "V"), 2),
            PARAMETER,
            Option("range", option.numbers, "values between which it is followed", ("A", "B"), 2),
            Option("period", option.count(1, 16), "of period N T (1)", "N"),
            Option("points", option.count(1, 100_000), "points on each side, at most (1000)", "N"),
            Option("branches", option.count(1, 20), "branches, at most (3)", "N"),
        ),
        (6.0, 6.0),
    ),
    "plane": Command(
        "a map over two parameters: orbits or attractors",
        "plane:plane",
        "diagrams:plane",
        "--axes f R --first 0.02 0.65 --second 0.2 4.5 --points 100 --out plane.png",
        "orbits: which ones hit each wall once per period and never turn or stick;\n"
        "attractors: that of most of 36 seeds.",
        (
            Option("axes", option.names, f"two of {', '.join(PARAMETERS)} (f R)", ("A", "B"), 2),
            Option("first", option.numbers, "range of the first", ("Q0", "Q1"), 2),
            Option("second", option.numbers, "range of the second", ("Q0", "Q1"), 2),
            Option("points", option.count(2, 2000), "N x N pairs (40)", "N"),
            Option(
                "what",
                option.choice("orbits", "attractors"),
                "orbits (default), attractors",
                "WHAT",
            ),
        ),
        (6.0, 5.4),
    ),
    "inventory": Command(
        "the periodic orbits found from thousands of seeds, by type, over a parameter",
        "cap.explore.inventory:inventory",
        "diagrams:inventory",
        "--parameter F --values 0.85 1 1.5 2 3 --prove --out inventory.pdf",
        "There may be more: nothing is proved by a search.  With --prove each orbit goes to the\n"
        "prover (theorem `periodic`) and its certificate to the independent checker; exit status\n"
        "1 if one is not proved.  A capture stands for infinitely many hits of a wall.",
        (
            PARAMETER,
            VALUES,
            Option("period", option.count(1, 16), "of least period N T (1)", "N"),
            Option("prove", None, "prove them, and mark those proved"),
            Option("certificates", option.path, "prove them, and keep the certificates", "DIR"),
        ),
        (6.0, 5.6),
    ),
    "gallery": Command(
        "the attractor of most seeds at several values of a parameter",
        "gallery:gallery",
        "times:gallery",
        "--parameter F --values 1.5 3 4.5 --out gallery.pdf",
        "Default: F = 1.5, 3, 4.5, 6, 12, 50.",
        (
            PARAMETER,
            VALUES,
            Option(
                "periods",
                option.positive_to(1000),
                "forcing periods shown (the longest found)",
                "Q",
            ),
        ),
        (7.4, 9.0),
    ),
    "chatter": Command(
        "a capture: hits that accumulate at a wall",
        "chatter:chatter",
        "times:chatter",
        "--out chatter.pdf",
        "Infinitely many hits in finite time; speeds fall like e sqrt((a - f)/(a + f)).",
        (
            Option("orbit", option.numbers, "the state at t = 0", ("X", "V"), 2),
            Option(
                "periods",
                option.positive_to(100_000),
                "in which the capture must happen (100)",
                "Q",
            ),
        ),
        (8.4, 3.4),
    ),
    "manifolds": Command(
        "stable and unstable manifolds of a saddle, and homoclinic points",
        "manifold:manifolds",
        "states:manifolds",
        "--orbit 0.34 0.775 --length 4 --out manifolds.pdf",
        "Default: the non-sticking saddle with the smallest multiplier.",
        (
            Option("orbit", option.numbers, "the saddle near this state", ("X", "V"), 2),
            Option("length", option.positive, "of each branch, in units of R and R omega (4)", "Q"),
            Option(
                "spacing",
                option.positive_to(0.1),
                "of its points, in the same units (0.005)",
                "Q",
            ),
            Option("periods", option.count(1, 1000), "images, at most (40)", "N"),
        ),
        (6.0, 5.4),
    ),
    "attractor": Command(
        "the attractors of seeds all over the plane, and their basins",
        "attractor:attractors",
        "states:attractors",
        "--F 3 --points 100 --out attractor.png",
        "Chaos may be transient: try a longer --transient before you call it an attractor.\n"
        "With --masses 1,9/10: where N x N random seeds end (--points 12, --transient 120,\n"
        "--periods 24), told apart by period and events, projected to the planes of the masses.",
        (
            Option("box", option.numbers, "the seeds", ("X0", "X1", "V0", "V1"), 4),
            Option("points", option.count(2, 2000), "N x N seeds (40)", "N"),
            Option("transient", option.count(0, 1_000_000), "periods before (2000)", "N"),
            _periods(200),
            *MASSES,
        ),
        (7.8, 4.6),
        ("cap.floats.masses.mass_attractor:attractors", "masses:attractors", (7.8, 4.6)),
    ),
    "release": Command(
        "after sticks: the map from one release to the next, or its orbits over a parameter",
        "return_map:release",
        "releases:release",
        "--parameter f --range 0.36 0.44 --points 300 --out release.png",
        "The map G takes the place of a release to the right to that of the next release,\n"
        "mirrored if that is to the left.  Without --parameter its graph, with one orbit.\n"
        "With it, windows are listed in which the four orbits that are followed, or those\n"
        "of them that go on, settle on attracting cycles of one period (by Newton's method).",
        (
            Option("points", option.count(2, 200_000), "places (4000), or values (400)", "N"),
            Option("start", option.numbers, "the orbit of this place", ("X",), 1),
            PARAMETER,
            Option("range", option.numbers, "of the parameter (within 5 %%)", ("Q0", "Q1"), 2),
            Option("iterates", option.count(1, 100_000), "of each orbit, after 60 (40)", "N"),
        ),
        (8.4, 4.6),
    ),
}
