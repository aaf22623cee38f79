"""The commands of `cap.explore` about a model: what they print, draw and refuse."""

import re
import shlex
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.figure import Figure

from cap.command import prover
from cap.explore import explorer
from cap.explore.arrays import load
from cap.floats.models import engine
from cap.floats.models.attractor import ends_of
from cap.floats.models.closing import Start, closing, logged, product
from cap.floats.models.continuation import ModelBranch, ModelSpecial
from cap.floats.models.engine import Engine
from cap.floats.models.legs import Legs
from cap.floats.models.resting import resting
from cap.floats.models.samples import exponents
from cap.floats.models.subject import Subject
from cap.floats.models.walls import walls
from cap.pictures import model_states, models
from cap.system.files import load as load_model
from cap.system.files import load as read_model

EXAMPLES = Path(__file__).parents[2] / "examples"
PAIR = "--model", str(EXAMPLES / "harvester.py")


def run(capsys, *words):
    """Return the exit status, what is printed, and what is complained of."""
    try:
        status = explorer.main(words)
    except SystemExit as end:
        status = end.code
    out, err = capsys.readouterr()
    return status, out, err


def test_an_orbit(capsys, tmp_path):
    """It is closed, its events are told with what jumps; there is a wall on each side."""
    files = [tmp_path / name for name in ("orbit.svg", "orbit.npz", "orbit.csv")]
    out = [word for file in files for word in ("--out", str(file))]
    status, text, _ = run(capsys, "orbit", *PAIR, "--set", "s=1/2,e=0.5", *out)
    assert status == 0
    assert re.search(r"top +free -> free  z = 0.25, v = 0.930820\d+ -> -0.46541", text)
    assert "it closes after 1 period of the clock; multipliers -0.242" in text
    assert "it attracts" in text
    found = load(files[1])
    assert found["values"] == {"s": "1/2", "e": "1/2", "G": "1/10"}
    assert found["words"].tolist() == ["top", "bottom"]
    assert [found["walls"][k]["place"][0] for k in (0, 1)] == [0.25, -0.25]
    assert np.abs(found["states"][:, 0]).max() == pytest.approx(0.25)
    assert files[2].read_text("utf-8").startswith("# model = ")
    assert files[0].read_text("utf-8").count("<path") > 10


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("orbit", "--model", "none.py"), "cannot read none.py"),
        (("orbit", *PAIR, "--set", "E=1"), "no parameter E: there are s = 1/2, e = 1/2, G = 1/10"),
        (("orbit", *PAIR, "--set", "e=x"), "e: not a number: 'x' .*the parameters are s = 1/2"),
        (
            ("orbit", *PAIR, "--set", "e=2"),
            r"harvester.py:\d+: the restitution .* not .* in \[0, 1\]",
        ),
        (("orbit", *PAIR, "--set", "e"), "write values of parameters as NAME=VALUE"),
        (("orbit", *PAIR, "--state", "1"), "--state takes 2 numbers, z, v: 1 given"),
        (
            ("orbit", *PAIR, "--state", "9", "1"),
            "the state z = 9, v = 1 lies in no mode .*: in free the guard top is -8.75 ",
        ),
        (("orbit", *PAIR, "--state", "0", "1", "--mode", "fly"), "no mode 'fly': there are free"),
        (("orbit", *PAIR, "--plane", "z", "w"), "no variable w: the state is z, v"),
        (("orbit", *PAIR, "--plane", "v", "v"), "--plane is of two variables: v is one"),
        (("orbit", *PAIR, "--F", "3"), "unrecognized arguments: --F 3"),
        (("sali", *PAIR), "invalid choice: 'sali'"),
        (("search",), "search is about a model: --model FILE"),
        (("continuation", *PAIR), "say what varies, between which values"),
        (("continuation", *PAIR, "--parameter", "s", "--range", "1", "2"), "s = 0.5 is not in"),
        (("attractor", *PAIR, "--parameter", "s"), "--parameter NAME needs --range A B"),
        (
            ("attractor", *PAIR, "--parameter", "S", "--range", "1", "2"),
            "no parameter S: the model",
        ),
        (("basin", *PAIR, "--box", "0", "1"), "--box takes 4 numbers, z from, z to, v from, v to"),
    ],
)
def test_refusals(capsys, words, message):
    """One line, exit status 2."""
    status, _, err = run(capsys, *words)
    assert status == 2
    assert re.search(message, err)
    assert err.count("\n") == 1


def test_attractors(capsys, tmp_path):
    """All seeds end at the orbit above; its exponents are those of its multipliers."""
    picture = tmp_path / "attractor.png"
    words = ("attractor", *PAIR, "--points", "40", "--transient", "200", "--out", str(picture))
    status, text, _ = run(capsys, *words)
    assert status == 0
    assert re.search(r"1  100.00%  period 1 T: 1 top, 1 bottom per T; exponents -0.693\d+", text)
    assert re.search(
        r"python -m cap.prove periodic --model \S+ --set s=1/2,e=1/2,G=1/10 --orbit", text
    )
    assert picture.stat().st_size > 5000


def test_a_diagram(capsys, tmp_path):
    """Over a parameter; the exponents add up to the divergence: here there is only restitution."""
    file = tmp_path / "diagram.npz"
    words = ("--parameter", "s", "--range", "0.3", "0.5", "--points", "8", "--transient", "100")
    status, text, _ = run(capsys, "attractor", *PAIR, *words, "--out", str(file))
    assert status == 0
    assert "attractors over s = 0.31" in text
    found = load(file)
    assert found["states"].shape == (8, 8, 64, 2)
    assert np.isfinite(found["exponent"]).all()


def test_exponents_add_up():
    """Sum of exponents: 2 log(e) at each contact, as flights of the pair keep areas."""
    pair = Subject(read_model(PAIR[1], {"s": "2/5", "e": "7/10"}))
    states = pair.seeds(6, pair.box)
    settled = pair.engine.follow(states, periods=100)
    rates, _ = exponents(pair, settled.states, settled.modes, 200)
    hits = pair.engine.follow(settled.states, settled.modes, periods=200).counts.sum(axis=1)
    assert rates.sum(axis=1) == pytest.approx(2 * np.log(0.7) * hits / (200 * pair.period))


def test_saltation():
    """The derivative over two periods is that by differences."""
    pair = Subject(read_model(PAIR[1], {}))
    start = Start(np.array([0.07, 0.71]), 0)
    ends = logged(pair.engine, start.states, start.modes, 2)
    legs = Legs.of(pair.engine, start.states, start.modes, ends, 2 * pair.period)
    step = 1e-6
    near = start.state + step * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
    found = pair.engine.follow(near, periods=2).states
    differences = np.stack([found[0] - found[1], found[2] - found[3]], axis=1) / (2 * step)
    assert len(ends.log) == 4
    assert product(legs.derivatives()) == pytest.approx(differences, abs=1e-7)


def test_a_basin(capsys, tmp_path):
    """The states outside are no states of a mode; the others end at one orbit."""
    file = tmp_path / "basin.npz"
    words = ("--box", "-0.5", "0.5", "-1", "1", "--points", "10", "--transient", "100")
    status, text, _ = run(capsys, "basin", *PAIR, *words, "--out", str(file))
    assert status == 0
    assert "40 states of the plane (z, v)" in text
    label = load(file)["label"]
    assert (label[:, [0, 1, 2, 7, 8, 9]] == -2).all()
    assert (label[:, 3:7] == 0).all()


def test_why_each_state_is_followed(capsys, tmp_path):
    """Where the sweep of states that rest does not apply, a line says why."""
    words = ("--box", "-0.5", "0.5", "-1", "1", "--points", "4", "--transient", "5")
    status, text, _ = run(capsys, "basin", *PAIR, *words, "--out", str(tmp_path / "basin.npz"))
    assert status == 0
    assert "each state is followed, for" in text


@pytest.mark.slow
def test_states_that_rest_end_together():
    """They end where they end if each is followed, and are told with their shares."""
    subject = Subject(load_model(str(EXAMPLES / "ball.py"), {"A": "6/5"}))
    y, v = (z.ravel() for z in np.meshgrid(np.linspace(0, 4, 30), np.linspace(-4, 4, 30)))
    states = np.stack([y, v], axis=1)
    alike, told = resting(subject, states)
    assert 400 < alike.sum() < 500  # 469 come to rest in floats
    assert f"{alike.sum()} states are seen to come to rest before t = 101" in told[0]
    each, once = (ends_of(subject, states, 60, known) for known in (None, alike))
    assert (each[0] == once[0]).all()
    assert [a.share for a in each[1]] == [a.share for a in once[1]]
    assert len(set(once[0][alike])) == 1


def test_a_portrait(capsys, tmp_path):
    """After a transient all states are the one of the orbit."""
    words = ("--orbits", "5", "--transient", "300", "--periods", "4")
    out = [str(tmp_path / name) for name in ("portrait.npz", "portrait.svg")]
    status, _, _ = run(capsys, "portrait", *PAIR, *words, "--out", out[0], "--out", out[1])
    assert status == 0
    states = load(out[0])["states"]
    assert states.shape == (5, 4, 2)
    assert states == pytest.approx(np.tile([0.073717988, 0.711477683], (5, 4, 1)))


def test_names_of_velocities_are_above_their_curves():
    """Two of them share a panel, whose legend covers no curve, low as the panel is."""
    t = np.linspace(0, 1, 50)
    states = np.stack([np.cos(6 * t), np.sin(6 * t)], axis=1)
    none = np.zeros(0)
    given = {"t": t, "states": states, "state": ("v", "w"), "words": none, "walls": ()}
    findings = SimpleNamespace(**given, autonomous=True)
    figure = Figure(figsize=(4, 1.8), layout="constrained")
    axes = figure.subplots()
    models._row(axes, findings, ("v", "w"), last=True)
    figure.draw_without_rendering()
    low = axes.get_legend().get_window_extent().y0
    assert axes.transData.inverted().transform((0, low))[1] > states.max()


def test_a_portrait_of_one_state_is_not_one_of_rounding():
    """Limits that differ by rounding are widened; others are as they were."""
    axes = Figure().subplots()
    axes.plot([1.25, 1.25 + 1e-13], [0, 2])
    usual = axes.get_ylim()
    model_states._no_closer(axes)
    low, high = axes.get_xlim()
    assert high - low == pytest.approx(model_states.LEAST * 1.25)
    assert low < 1.25 < high
    assert axes.get_ylim() == usual


@pytest.mark.slow
def test_a_search_and_its_proof(capsys, tmp_path):
    """What is found has a command that proves it."""
    ball = "--model", str(EXAMPLES / "ball.py")
    status, text, _ = run(capsys, "search", *ball, "--out", str(tmp_path / "orbits.png"))
    assert status == 0
    line = next(line for line in text.splitlines() if "cap.prove" in line)
    words = [*shlex.split(line)[3:], "--out", str(tmp_path / "orbit.json")]
    assert prover.main(words) == 0
    assert "the independent checker accepts it" in capsys.readouterr().out


SPRING = """
from fractions import Fraction
from cap import Bounce, Guard, Mode, System, variables
x, v, cos, sin = variables("x v cos sin")
def spring(F=2, k=4, c=0, e=Fraction(4, 5)):
    walls = {"left": Guard(x + 1, "fly", Bounce(e)), "right": Guard(1 - x, "fly", Bounce(e))}
    return System("x v", 1, {"fly": Mode({"x": v, "v": -k * x - c * v + F * cos}, walls)})
"""


@pytest.fixture
def spring(tmp_path):
    """Return the words that name a spring between two walls, which a cosine drives."""
    file = tmp_path / "spring.py"
    file.write_text(SPRING, "utf-8")
    return "--model", str(file)


def test_a_continuum(capsys, spring):
    """Without damping and at twice the frequency of the force, all that hits no wall closes."""
    status, text, _ = run(capsys, "attractor", *spring, "--points", "60", "--transient", "300")
    assert status == 0
    first = text.splitlines()[1]
    found = re.search(r"1 +([0-9.]+)%  a continuum of period 1 T: (\d+) cycles met", first)
    assert float(found.group(1)) > 90
    assert int(found.group(2)) > 30
    assert text.count("\n") < 10
    assert "cap.prove" not in text


@pytest.mark.slow
def test_it_is_followed_from_where_a_state_leads(capsys, spring):
    """No orbit closes near rest; where an event comes to t = 0 the branch ends, without a fold."""
    words = ("--set", "k=2,c=0.1,F=1.6", "--parameter", "F", "--range", "1.4", "1.6")
    status, text, _ = run(capsys, "continuation", *spring, *words, "--state", "0", "1")
    assert status == 0
    head, *special = text.splitlines()
    assert re.search(r"followed over F = 1\.508\d* \.\. (1\.6|1\.5999)", head)
    assert len(special) == 1
    assert "an event at t = 0" in special[0]


def test_what_is_lost_says_why(capsys, tmp_path):
    """Contacts accumulate, and no mode of rest is named."""
    file = tmp_path / "ball.py"
    text = (EXAMPLES / "ball.py").read_text("utf-8")
    file.write_text(text.replace(', rest="rest"', ""), "utf-8")
    status, text, _ = run(capsys, "attractor", "--model", str(file), "--points", "20")
    assert status == 0
    assert re.search(r"\n  \d+ were lost: too many events in a period: they accumulate", text)


@pytest.mark.slow
def test_a_picture_of_none(capsys, tmp_path):
    """It says what was met instead; its axes have no numbers."""
    picture = tmp_path / "none.svg"
    words = ("--model", str(EXAMPLES / "ball.py"), "--period", "2", "--out", str(picture))
    status, text, _ = run(capsys, "search", *words)
    assert status == 0
    assert "\nbesides, 69 that attract have the period 1 T" in text
    assert "xtick" not in picture.read_text("utf-8")


def test_it_is_kept():
    """A process that comes later loads what was compiled, and compiles nothing."""
    system = Subject(read_model(PAIR[1], {})).system
    engine._compiled.cache_clear()
    again = Engine(system)
    again.follow([[0.0, 0.7]])
    assert again._follow._compiled.stats.cache_hits.total() == 1


def test_a_branch_is_drawn_up_to_its_flip():
    """Not only up to the orbits beside it."""
    ones = np.ones((4, 2), complex)
    flip = ModelSpecial("flip", 0.6, np.array([5.5, 0.0]), ones[0])
    branch = ModelBranch(
        model="m.py", values={}, state=("x", "v"), period=1.0, autonomous=False, parameter="s",
        periods=1, value=np.array([0.2, 0.4, 0.8, 0.9]), multipliers=ones,
        states=np.array([[3.0, 0], [4, 0], [7, 0], [8, 0]]), itinerary=np.zeros(4, int),
        stable=np.array([True, True, False, False]), special=(flip,),
    )  # fmt: skip
    solid, dashed = model_states._parts(branch)
    assert (solid[0].tolist(), solid[1]) == ([[0.2, 3], [0.4, 4], [0.6, 5.5]], True)
    assert (dashed[0].tolist(), dashed[1]) == ([[0.6, 5.5], [0.8, 7], [0.9, 8]], False)


@pytest.mark.slow
def test_a_branch(capsys, tmp_path):
    """It flips where a multiplier is -1, and is seen to attract on one side alone."""
    file = tmp_path / "branch.npz"
    words = ("--set", "s=6/25", "--parameter", "s", "--range", "0.23", "0.26", "--points", "25")
    out = ("--out", str(file), "--out", str(tmp_path / "branch.png"))
    status, text, _ = run(capsys, "continuation", *PAIR, *words, *out)
    assert status == 0
    at = float(re.search(r"s = (0\.23\d+) +flip", text).group(1))
    found = load(file)
    stable = found["value"][found["stable"]]
    assert stable.min() > at - 1e-9
    assert found["value"][~found["stable"]].max() < at + 1e-9
    pair = Subject(read_model(PAIR[1], {"s": f"{at:.10f}"}))
    state = (
        found["special"]["state"] if "state" in found["special"] else found["special"][0]["state"]
    )
    orbit = closing(pair, Start(np.array(state), 0), 1e-2)
    assert orbit.multipliers.real.min() == pytest.approx(-1, abs=1e-5)


@pytest.mark.slow
def test_a_clock(capsys):
    """Without friction at rest its swing is known in closed form."""
    clock = "--model", str(EXAMPLES / "clock.py"), "--set", "f=0,k=1/3,d=1/10"
    status, text, _ = run(capsys, "orbit", *clock)
    assert status == 0
    period = 2 * np.pi / np.sqrt(1 - 0.01)
    q = np.exp(-0.1 * period)
    assert f"it closes after t = {period:.9f}" in text
    assert f"multipliers {q:.6g}: it attracts" in text
    assert f"v = {1 / 3 / (1 - q):.9f}" in text


@pytest.mark.slow
def test_saltation_in_four_dimensions():
    """Of a billiard, whose reset is a rational function, by differences; the wall is solid."""
    billiard = Subject(read_model(EXAMPLES / "billiard.py"))
    start = Start(np.array([0.794026, 2.28887, -4.23983, -1.711676]), 0)
    orbit = closing(billiard, start, 1e-2)
    assert np.prod(orbit.multipliers).real == pytest.approx(0.75**4)
    step = 1e-6 * np.eye(4)
    near = np.concatenate([orbit.start.state + step, orbit.start.state - step])
    ends = billiard.engine.follow(near).states
    differences = ((ends[:4] - ends[4:]) / 2e-6).T
    values = np.linalg.eigvals(differences)
    assert np.sort(values.real) == pytest.approx(np.sort(orbit.multipliers.real), abs=1e-4)
    (wall,) = walls(billiard.system, np.zeros(1), start.states)
    assert (wall.variable, wall.solid, wall.side) == ("y", True, 1)
    assert wall.place[0] == pytest.approx(1.8 * 0.794026**2)
