"""`cap.prove periodic --model`: an orbit of a file, proved from nothing; refusals in one line."""

import json

import pytest

from cap.checker.verdict import check
from cap.command.own import _others
from cap.command.prover import main
from cap.errors import NotProved
from cap.floats.models.contacts import meets
from cap.floats.models.engine import Engine
from cap.floats.models.periodic import closed, search
from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.leg import Kinds
from cap.proofs import contacts, symbolic
from cap.proofs.theorems import THEOREMS
from cap.system.files import read

MODEL = "examples/impact_oscillator.py"


def prove(*words, model=MODEL):
    """Run the command and return its status."""
    return main(["periodic", "--model", model, *map(str, words)])


def test_from_a_file_to_a_certificate(tmp_path, capsys):
    """It finds the orbit, proves it, and names a certificate that stands by itself."""
    assert prove("--set", "e=1/2", "--all", "--out", tmp_path) == 0
    said = capsys.readouterr().out
    assert "Theorem (contacts)." in said
    (path,) = tmp_path.glob("*.json")
    assert path.name.startswith("contacts-impact_oscillator-e=1_2-t=")
    assert json.loads(path.read_bytes())["claims"]["unstable"] == "0"
    check(path.read_bytes(), lambda _: None)
    assert prove("--set", "e=1/2", "--out", tmp_path) == 0
    assert "(unchanged;" in capsys.readouterr().out
    path.write_text("{}")
    assert prove("--set", "e=1/2", "--out", tmp_path) == 2
    assert "there is another file at" in capsys.readouterr().err


def test_from_a_state(tmp_path, capsys):
    """Newton's method leads from a state at t = 0 to the orbit, here from where orbits settle."""
    engine, out = Engine(read(MODEL)), tmp_path / "one.json"
    ends = engine.follow([[0.0, 0.5]], periods=200)
    state = [f"{z:.3f}" for z in ends.states[0]]
    mode = engine.modes[ends.modes[0]]
    assert prove("--orbit", *state, "--mode", mode, "--digits", "12", "--out", out) == 0
    assert capsys.readouterr().out.startswith("Newton's method leads to:\n  1 x wall;")
    assert json.loads(out.read_bytes())["digits"] == "12"


def test_orbits_are_listed_once_and_by_their_least_period():
    """Of period 1 there is the one that attracts; it is none of period 2."""
    system = read(MODEL)
    (one,) = search(system, 1, lambda *_: None).orbits
    assert one.attracts
    assert [c.guard for c in one.itinerary.contacts] == ["wall"]
    met = search(system, 2, lambda *_: None)
    assert one.itinerary.contacts not in [orbit.itinerary.contacts for orbit in met.orbits]
    assert met.periods[1] == met.settled - met.captured
    told = "states end at orbits that attract and close after 1 period (--period 1)"
    assert next(iter(_others(met))) == f"{met.periods[1]} {told}"


def test_a_solution_that_does_not_happen():
    """The wall is hit from behind: the equations of the contact have it, floats do not."""
    system = read(MODEL)
    itinerary = Itinerary(system, [Contact("free", "wall", "free")])
    good, bad = (
        closed(itinerary, guess, Kinds(system))
        for guess in ([0.9151, 0.1, 3.697], [2.1806, 0.1, -3.7454])
    )
    assert good.falling < 0 < bad.falling
    assert bad.attracts
    assert meets(Engine(system), itinerary, good.guess)
    assert not meets(Engine(system), itinerary, bad.guess)


def test_saddles_beside_what_attracts():
    """All states settle on one orbit; others that nearly close lead to saddles."""
    orbits = search(read("examples/harvester.py"), 1, lambda *_: None).orbits
    assert [orbit.attracts for orbit in orbits] == [True, False, False]
    assert all(orbit.falling < -0.1 for orbit in orbits)


def test_a_branch_goes_where_the_same_is(tmp_path, capsys):
    """A file about the same system may be written over, any other is not; ends may be negative."""
    words = ("--parameter", "gap", "--range", "-1/20", "1/8", "--out", str(tmp_path))
    words = ("branch", "--model", MODEL, *words)
    (tmp_path / "contacts_branch-impact_oscillator-gap--1_20-1_8.json").write_text("{}", "utf-8")
    with pytest.raises(SystemExit) as end:
        raise SystemExit(main(words))
    assert end.value.code == 2
    assert "there is another file at" in capsys.readouterr().err
    (tmp_path / "contacts_branch-impact_oscillator-gap--1_20-1_8.json").unlink()
    for word in ("written", "unchanged"):
        assert main(words) == 0
        assert f'gap--1_20-1_8.json" ({word};' in capsys.readouterr().out


@pytest.mark.slow
def test_a_continuum_is_recognised(tmp_path, capsys):
    """Den Hartog's oscillator at the frequency 1/2: orbits that are not isolated are refused."""
    model = "examples/den_hartog.py"
    words = ("--set", "omega=1/2,f=1/10", "--out", tmp_path)
    assert prove(*words, model=model) == 2
    said = capsys.readouterr().err
    assert "with a multiplier that is 1 up to rounding" in said
    assert "a family of orbits, it seems" in said
    met = search(read(model, {"omega": "1/2", "f": "1/10"}), 1, lambda *_: None)
    assert not met.orbits
    for orbit in met.neutral[:3]:
        with pytest.raises(NotProved):
            contacts.prove(orbit.itinerary, orbit.guess)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--set", "e"), "NAME=VALUE"),
        (("--set", "e=1/2,e=1/3"), "has two values"),
        (("--set", "q=1"), "no parameter q"),
        (("--orbit", "1"), "--orbit is a state: give x, v"),
        (("--mode", "fly"), "--mode is that of --orbit"),
        (("--orbit", "5", "0", "--mode", "free"), "where a guard of its mode is negative"),
        (("--all", "--orbit", "1", "2"), "--all goes neither"),
        (("--digits", "1"), "--digits must be an integer"),
        (("--period", "0"), "--period must be an integer"),
    ],
)
def test_refused_in_a_line(words, why, capsys, tmp_path):
    """Bad input is one line, and the status 2."""
    assert prove(*words, "--out", tmp_path) == 2
    said = capsys.readouterr().err
    assert why in said
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_what_is_not_for_own_systems(capsys):
    """Each other theorem says in one line why it does not apply."""
    for name in (*THEOREMS, *symbolic.NAMES, "nonsense"):
        if name in ("periodic", "elliptic", "branch", "capture", "attractor", "horseshoe"):
            continue
        assert main([name, "--model", MODEL]) == 2
        said = capsys.readouterr().err
        assert said.count("\n") == 1
        assert "`family`, `capture`, `basin`, `attractor` and `horseshoe` are proved" in said
        assert f"{name} does not apply to a model: " in said or name == "nonsense"
    assert main(["contacts"]) == 2
    assert "python -m cap.prove periodic --model FILE" in capsys.readouterr().err
    assert prove(model="nowhere.py") == 2
    assert "cannot read nowhere.py" in capsys.readouterr().err


BALL = ("branch", "--model", "examples/ball.py", "--parameter", "A")


def test_a_branch_from_a_file(tmp_path, capsys):
    """It begins at the orbit found, and the certificate stands by itself."""
    out = tmp_path / "ball.json"
    words = ("--range", "1.18", "1.22", "--orbit", "2.06", "-2.63", "--out", str(out))
    assert main([*BALL, *words]) == 0
    said = capsys.readouterr().out
    assert said.startswith("The curve begins at A = 6/5: 1 x table; table at t = 0.510164")
    assert "A takes on it all values in [1.18, 1.22]" in " ".join(said.split())
    check(out.read_bytes(), lambda _: None)


def test_a_branch_of_symmetric_orbits(tmp_path, capsys):
    """That of the oscillator goes on through its pitchfork."""
    out = tmp_path / "symmetric.json"
    words = ("--model", "examples/oscillator.py", "--parameter", "f", "--set", "f=0.466")
    words += ("--range", "0.465", "0.467", "--orbit", "0.25", "0.72", "--mode", "right")
    assert main(["branch", *words, "--symmetric", "--out", str(out)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "symmetric orbits of period 1 x 2 pi/omega" in said
    assert "a multiplier is -1, of the orbit 1" in said
    check(out.read_bytes(), lambda _: None)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--range", "1", "2", "--symmetric"), "this orbit is not symmetric"),
        (("--range", "2", "1"), "--range is LOW HIGH, LOW below HIGH"),
        (("--range", "2", "3"), "the curve begins at A = 6/5, which is not inside of the range"),
        (("--range", "1", "2", "--parameter", "B"), "has no parameter B: there are A, e, g"),
        (("--range", "1", "2", "--orbit", "1"), "--orbit is a state: give y, v"),
        (("--range", "1", "2", "--period", "0"), "--period must be an integer"),
    ],
)
def test_a_branch_refused_in_a_line(words, why, capsys, tmp_path):
    """Bad input is one line, and the status 2."""
    assert main([*BALL, *words, "--out", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert why in said
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_a_parameter_of_the_flights(capsys, tmp_path):
    """A damping multiplies the velocity: a branch is refused in a line, after the search."""
    words = ("--parameter", "d", "--range", "0", "1", "--out", str(tmp_path))
    assert main(["branch", "--model", MODEL, *words]) == 2
    assert "in the mode free d multiplies a variable or the clock" in capsys.readouterr().err
