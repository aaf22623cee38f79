"""What can be explored of a model, a system of your own: ``--model FILE.py --set A=6/5``."""

from cap import option
from cap.explore.commands import Command
from cap.option import Option

STATE = Option("state", option.numbers, "the variables at t = 0, in the model's order", "Z", "+")
MODE = Option("mode", option.text, "the mode in which it begins", "NAME")
PLANE = Option("plane", option.texts, "the two variables shown", ("Y", "Z"), 2)

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
}
MODEL = (
    Option("model", option.text, "FILE.py, FILE.py:FUNCTION or FILE.json", "FILE"),
    Option("set", option.settings, "values of its parameters, exact: A=6/5,e=1/2", "NAME=Q", "+"),
)
