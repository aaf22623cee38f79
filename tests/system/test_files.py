"""A system from a file: what is read, and in which words the rest is refused."""

from fractions import Fraction
from pathlib import Path

import models
import pytest

import cap
from cap.errors import BadInput
from cap.system import form
from cap.system.files import assigned, load, read

BALL = """\
from fractions import Fraction
from cap import Bounce, Guard, Mode, System, variables
y, v, cos, sin = variables("y v cos sin")

def ball(A, e=Fraction(1, 2), g=1):
    fly = Mode({"y": v, "v": -g}, {"table": Guard(y - A * sin, "fly", Bounce(e), rest="rest")})
    leave = Guard(g - A * sin, "fly")
    rest = Mode({"y": A * cos, "v": -A * sin}, {"leave": leave})
    return System("y v", 1, {"fly": fly, "rest": rest})
"""
SECOND = "\n\ndef other(A):\n    return ball(A)\n"


@pytest.fixture
def written(tmp_path):
    """Return a function that writes a file and returns its path."""

    def write(text, name="ball.py"):
        path = tmp_path / name
        path.write_text(text)
        return path

    return write


def changed(old, new):
    """Return the text of the ball with something else in its place."""
    assert old in BALL
    return BALL.replace(old, new)


def test_python(written):
    """Its parameters are exact, and the others have their defaults."""
    path = written(BALL)
    assert read(path, {"A": "1.2"}) == models.ball()
    assert read(path, {"A": "6/5", "e": Fraction(1, 2), "g": 1}) == models.ball()
    assert read(path, {"A": 2, "e": "0.8"}) == models.ball(Fraction(2), Fraction(4, 5))
    assert not (path.parent / "__pycache__").exists()


def test_one_of_several(written):
    """Named after a colon; a function that was imported, or begins with _, is not meant."""
    path = written(BALL + SECOND)
    assert read(f"{path}:other", {"A": "6/5"}) == models.ball()
    helped = BALL.replace(
        "def ball", "from math import sin as s\nfrom cap import variables as w\ndef ball"
    )
    assert read(written(helped + SECOND.replace("other", "_other")), {"A": "6/5"}) == models.ball()


def test_json(written):
    """All parameters of the system get values."""
    y, A = cap.variables("y A")
    hit = cap.Guard(y - A, "fly", {"y": A})
    free = cap.System("y", 1, {"fly": cap.Mode({"y": -1}, {"hit": hit})}, ("A",))
    path = written(form.dumps(free), "fall.json")
    assert read(path, {"A": "1.5"}) == free.at({"A": Fraction(3, 2)})
    for values, message in (
        ({}, "the parameter A needs a value"),
        ({"A": 1, "b": 2}, "parameter b"),
    ):
        with pytest.raises(BadInput, match=message):
            read(path, values)
    certificate = Path(__file__).parents[2] / "certificates/elliptic.json"
    with pytest.raises(BadInput, match=r"a certificate, which `cap\.verify` reads, no system"):
        read(certificate)
    with pytest.raises(BadInput, match=r"fall\.json: not JSON"):
        read(written("{", "fall.json"))


def test_sympy(written):
    """Its expressions are read."""
    text = changed("from cap import", "import sympy\nfrom cap import")
    text = text.replace('variables("', 'sympy.symbols("')
    assert read(written(text), {"A": "6/5"}) == models.ball()


REFUSED = {
    "ball.py: ball: the parameter A needs a value": (BALL, {}),
    "ball.py: ball: no parameter B: there are A, e = 1/2, g = 1": (BALL, {"B": "1"}),
    'A = 1.2 is a binary double: write "1.2", or a fraction': (BALL, {"A": 1.2}),
    "A: not a number: 'six' (write an integer, a decimal or p/q); the parameters are A, e = 1/2": (
        BALL,
        {"A": "six"},
    ),
    "A is no exact number: True": (BALL, {"A": True}),
    "ball: e = 0.5 is a binary double": (changed("Fraction(1, 2)", "0.5"), {"A": 1}),
    "ball: the parameter e needs a value: there are A, e, g = 1": (
        changed("Fraction(1, 2)", "None"),
        {"A": 1},
    ),
    "no public function": ("A = 1\n", {}),
    "several functions: name one": (BALL + SECOND, {"A": 1}),
    "*A is no parameter with a name": (changed("(A,", "(*A,"), {}),
    "ball returns no cap.System, but dict": (
        changed('    return System("y v", 1, ', "    return dict("),
        {"A": 1},
    ),
    "ball.py:6: v': not an exact polynomial: -9.81 (write rationals as Fraction)": (
        changed("-g}", "-9.81}"),
        {"A": 1},
    ),
    "ball.py:6: not an exact polynomial: 0.5 (write": (changed("A * sin,", "0.5 * sin,"), {"A": 1}),
    "ball.py:6: ZeroDivisionError": (changed("-g}", "-g / (A - 1)}"), {"A": 1}),
    "ball.py:6: NameError: name 'h' is not defined": (changed("-g}", "-h}"), {"A": 1}),
    "ball.py:3: ValueError": (changed("y, v, cos, sin =", "y, v ="), {"A": 1}),
    "ball.py:2: ImportError": (changed("Bounce,", "Bouncing,"), {"A": 1}),
    "ball.py:6: not Python": (changed("fly = Mode", "fly = = Mode"), {"A": 1}),
    "ball.py:1: SystemExit: 3": ("raise SystemExit(3)\n", {}),
    "source code string cannot contain null bytes": ("\0", {}),
    "RecursionError": ("def f():\n    return f()\n", {}),
    "v' in the mode fly is not linear in the state and the clock: -y^2 (flights that are not": (
        changed("-g}", "-y * y}"),
        {"A": 1},
    ),
    "v': not a polynomial with rational coefficients: sin(y)": (
        "import sympy\n" + changed("-g}", 'sympy.sin(sympy.Symbol("y"))}'),
        {"A": 1},
    ),
    "the new v: not an exact polynomial: a function": (
        changed("Bounce(e)", '{"v": lambda v: -v}'),
        {"A": 1},
    ),
    "unknown mode: flies": (changed('"fly", Bounce', '"flies", Bounce'), {"A": 1}),
    "make b an argument of the function": (BALL.rstrip()[:-1] + ', ("b",))\n', {"A": 1}),
}


@pytest.mark.parametrize("message", REFUSED)
def test_refused(written, message):
    """In one line, which names the file or the parameter, and the line."""
    text, values = REFUSED[message]
    with pytest.raises(BadInput) as refusal:
        read(written(text), values)
    assert message in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("no.py", "cannot read no.py: No such file"),
        ("no.json", "cannot read no.json: No such file"),
        ("ball", "a model is FILE.py, FILE.py:FUNCTION or FILE.json: ball"),
        ("ball.py:", "not a name of a function"),
        ("ball.py:a b", "not a name of a function"),
        ("ball.txt:f", "a model is"),
        ("tests", "a model is"),
    ],
)
def test_no_such_file(path, message, tmp_path, monkeypatch):
    """The path is told."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(BadInput, match=message):
        read(path)


def test_a_name_that_is_none(written):
    """The functions that there are, are told."""
    with pytest.raises(BadInput, match="no function other: there are ball"):
        read(f"{written(BALL)}:other", {"A": 1})


def test_no_text(written):
    """Bytes that are no UTF-8."""
    path = written("")
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(BadInput, match="not a text"):
        read(path)


def test_settings(written):
    """The values of all parameters, as they are written on a command line."""
    ball = load(written(BALL), assigned("A=1.2,e=2/5"))
    assert ball.settings() == "A=6/5,e=2/5,g=1"
    assert ball.settings(but=("A",)) == "e=2/5,g=1"
    assert read(ball.path, assigned(ball.settings())) == ball.system
