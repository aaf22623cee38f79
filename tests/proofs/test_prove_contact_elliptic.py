"""Elliptic orbits of one's own system: the twist, beside that of other formulas, and refusals."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from cap.command.own import main
from cap.errors import BadInput, NotProved
from cap.floats.models.periodic import near
from cap.orbits.conserved import why_lost
from cap.proofs import contact_elliptic
from cap.system.files import read

ELLIPTIC = json.loads(Path("certificates/elliptic.json").read_text("utf-8"))["claims"]


def orbit(file, mode, state, values=(), periods=1):
    """Return the orbit near that of a state, in floats."""
    return near(read(f"examples/{file}.py", dict(values)), state, mode, periods)


def meets(one, other):
    """Return whether two enclosures have a point in common."""
    (a, b), (c, d) = (map(Fraction, pair) for pair in (one, other))
    return a <= d and c <= b


def test_the_twist_is_that_of_the_other_theorem():
    """The oscillator as data, at the phase 0, has what `elliptic` proves of Φ with its formulas."""
    found = orbit("oscillator", "right", [0.10028, 0.541943])
    claims = contact_elliptic.prove(found.itinerary, found.guess, 12)["claims"]
    assert claims["phase"] == "0"
    for z, q in zip(("x", "v"), claims["point"], strict=True):
        assert meets(ELLIPTIC[z], q)
    for key in ("twist", "rotation_angle", "rotation_number"):
        assert meets(ELLIPTIC[key], claims[key])
        assert Fraction(claims[key][1]) - Fraction(claims[key][0]) < Fraction(1, 10**11)
    for q, distance in ELLIPTIC["resonance_distances"].items():
        assert meets(distance, claims["resonance_distances"][q])


def test_the_phase_does_not_matter(monkeypatch):
    """Twist and angle are those of the orbit, wherever between two contacts the map begins."""
    found = orbit("ball", "fly", [4.1011, -1.5708], {"A": "2/5", "e": "1"})
    twists = []
    for s in ("0", "-3/2", "3/2"):
        monkeypatch.setattr(contact_elliptic, "phase", lambda *_, s=s: Fraction(s))
        claims = contact_elliptic.prove(found.itinerary, found.guess)["claims"]
        twists.append((claims["twist"], claims["rotation_angle"]))
    assert len({claims["point"][0][0]}) == 1
    assert all(meets(a[0], twists[0][0]) and meets(a[1], twists[0][1]) for a in twists)
    monkeypatch.setattr(contact_elliptic, "phase", lambda *_: Fraction(8, 5))
    with pytest.raises(NotProved, match="not between two contacts"):
        contact_elliptic.prove(found.itinerary, found.guess)


@pytest.mark.slow
def test_a_resonance_is_refused():
    """At A = 1/2 the multipliers are ±i."""
    found = orbit("ball", "fly", [4.2011, -1.5708], {"A": "1/2", "e": "1"})
    with pytest.raises(NotProved, match="the rotation number may be 1/4"):
        contact_elliptic.prove(found.itinerary, found.guess)


def test_a_saddle_is_refused():
    """The other orbit of one bounce has real multipliers."""
    found = orbit("ball", "fly", [5.0, 1.5708], {"A": "2/5", "e": "1"})
    with pytest.raises(NotProved, match="not in \\(-2, 2\\)"):
        contact_elliptic.prove(found.itinerary, found.guess)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "mode", "state", "values", "why"),
    [
        ("ball", "fly", [2.0, -2.6], {}, "table of fly multiplies area by 1/4"),
        ("impact_oscillator", "free", [0.0, 0.5], {"e": "1"}, "flights of the mode free do not"),
    ],
)
def test_what_loses_area(file, mode, state, values, why):
    """It is told in one line what does not preserve area."""
    found = orbit(file, mode, state, values)
    assert why_lost(found.itinerary).startswith(why)
    with pytest.raises(NotProved, match=why):
        contact_elliptic.prove(found.itinerary, found.guess)


@pytest.mark.parametrize(("file", "why"), [("coupled_masses", "4 variables"), ("clock", "clock")])
def test_what_it_does_not_apply_to(file, why):
    """Other systems are refused before anything is searched."""
    with pytest.raises(BadInput, match=why):
        contact_elliptic.refuse(read(f"examples/{file}.py", {}))


def test_the_command(capsys, tmp_path):
    """It proves the orbit near a state, and names the certificate after the theorem."""
    words = ["elliptic", "--model", "examples/ball.py", "--set", "A=2/5,e=1", "--mode", "fly"]
    assert main([*words, "--orbit", "4.1011", "-1.5708", "--out", str(tmp_path)]) == 0
    (path,) = tmp_path.iterdir()
    assert path.name.startswith("contact_elliptic-ball-A=2_5-e=1-t=1.5708")
    kept = json.loads(Path("certificates/contact_elliptic-1.json").read_text("utf-8"))
    assert json.loads(path.read_text("utf-8"))["claims"] == kept["claims"]
    assert "tau_1 per |z|^2" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["examples/coupled_masses.py"], "the state has 4 variables"),
        (["examples/clock.py"], "nothing depends on the clock"),
        (["examples/ball.py"], "is elliptic: table of fly multiplies area by 1/4"),
        (["examples/ball.py", "--table", "rows.csv"], "--table goes with none of"),
    ],
)
def test_the_command_refuses(capsys, tmp_path, words, why):
    """In one line, with the reason."""
    assert main(["elliptic", "--model", *words, "--out", str(tmp_path)]) == 2
    assert why in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
