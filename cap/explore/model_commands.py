"""What can be explored of a model, a system of your own: ``--model FILE.py --set A=6/5``."""

from cap import option
from cap.explore.commands import Command
from cap.option import Option

STATE = Option("state", option.numbers, "the variables at t = 0, in the model's order", "Z", "+")
MODE = Option("mode", option.text, "the mode in which it begins", "NAME")
PLANE = Option("plane", option.texts, "the two variables shown", ("Y", "Z"), 2)
BOX = Option("box", option.numbers, "ranges of all variables, from and to", "Z", "+")
PARAMETER = Option("parameter", option.text, "of the model", "NAME")

COMMANDS = {
    "orbit": Command(
        "an orbit in time, between the walls, and in a plane, with its events",
        "cap.floats.models.trajectory:orbit",
        "models:orbit",
        "--model examples/ball.py --set A=6/5 --out ball.png",
        "Without --state an orbit at which others end.  If it nearly closes, Newton's method\n"
        "closes it; then its multipliers are told, and the command that proves it.",
        (
            STATE,
            MODE,
            Option("exactly", None, "follow this very state, no closed orbit near it"),
            Option("transient", option.count(0, 1_000_000), "periods before (0; 400)", "N"),
            Option("periods", option.count(1, 2000), "of the clock, shown (until it closes)", "N"),
            PLANE,
        ),
        (7.6, 4.4),
    ),
    "portrait": Command(
        "the states of many orbits, once a period of the clock",
        "cap.floats.models.portrait:portrait",
        "model_states:portrait",
        "--model examples/ball.py --set A=2,e=9/10 --transient 100 --out portrait.png",
        "Without a clock just after events of one kind.  More than one position: a plane for each.",
        (
            BOX,
            Option("orbits", option.count(1, 100_000), "orbits (60)", "N"),
            Option("transient", option.count(0, 1_000_000), "periods before (0)", "N"),
            Option("periods", option.count(1, 1_000_000), "periods shown (400)", "N"),
            PLANE,
        ),
        (6.4, 4.8),
    ),
    "attractor": Command(
        "where seeds end: attractors, exponents; over a parameter a bifurcation diagram",
        "cap.floats.models.diagram:attractor",
        "model_states:attractor",
        "--model examples/ball.py --parameter A --range 1 2 --out diagram.png",
        "Lyapunov exponents are by the saltation matrices of all events.  Chaos may be transient:\n"
        "try a longer --transient.  Of cycles the command is told that proves them.",
        (
            PARAMETER,
            Option("range", option.exacts, "of the parameter", ("A", "B"), 2),
            BOX,
            Option("points", option.count(1, 20_000), "seeds (400), or values (300)", "N"),
            Option("transient", option.count(0, 1_000_000), "periods before (1000; 300)", "N"),
            PLANE,
        ),
        (6.8, 5.2),
    ),
    "basin": Command(
        "which states of a plane end on which attractor",
        "cap.floats.models.basin:basin",
        "model_states:basin",
        "--model examples/ball.py --box 0 4 -4 4 --points 300 --out basin.png",
        "The other variables are those of --state, or the middle of the box.",
        (
            BOX,
            PLANE,
            STATE,
            Option("points", option.count(2, 190), "N x N states (120)", "N"),
            Option("transient", option.count(0, 1_000_000), "periods before (300)", "N"),
        ),
        (6.4, 4.8),
    ),
    "search": Command(
        "the periodic orbits found from thousands of seeds, and the commands that prove them",
        "cap.floats.models.inventory:inventory",
        "models:orbits",
        "--model examples/ball.py --period 2 --out orbits.png",
        "Those that attract and those that do not.  There may be more.  Orbits with contacts that\n"
        "accumulate are not looked for, and orbits without contacts.",
        (Option("period", option.count(1, 64), "of N periods of the clock (1)", "N"), PLANE),
        (6.0, 5.2),
    ),
    "continuation": Command(
        "a periodic orbit followed over a parameter, with its bifurcations",
        "cap.floats.models.continuation:continuation",
        "model_states:continuation",
        "--model examples/ball.py --state 2.06 -2.63 --parameter A --range 1 2 --out branch.png",
        "It is the orbit near --state, or to which that leads.\n"
        "Folds, flips, branch points, Neimark-Sacker points and changes of events are located.\n"
        "It ends where an event comes to t = 0: `cap.prove branch` goes on.  Twice the\n"
        "period: give a --state beyond the flip.",
        (
            PARAMETER,
            Option("range", option.exacts, "of the parameter", ("A", "B"), 2),
            STATE,
            MODE,
            Option("points", option.count(1, 20_000), "orbits on each side, at most (300)", "N"),
        ),
        (6.4, 5.2),
    ),
}
