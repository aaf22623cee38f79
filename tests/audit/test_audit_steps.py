"""Steps that are data: each line can fail, and what is written follows from them."""

import tomllib
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest

from cap.audit import given, steps, subject
from cap.audit.decide import decided
from cap.audit.filled import filled
from cap.audit.means import stored
from cap.audit.papers.mixed_dynamics.means.itineraries import around_turns
from cap.audit.verdict import Outcome, Strength
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved

pytest_plugins = ["audit_fixtures"]
MEANS = "cap.audit.papers.mixed_dynamics.means"
LINEAR = f"{MEANS}.linear"
HOLD = [
    "sin(t)**2 + cos(t)**2 == 1",
    "[1, t] == [1, t]",
    "2*f != f",
    "pi/2 > 1",
    "-f < 0",
    "f + t**2 > 0",
    "elliptic.twist > 1/10",
    "elliptic.at == paper",
    "elliptic.at.f == 2/5",
    'periodic-1.type == "sink focus"',
    "hit(1).det() == 1",
    "elliptic.hit_forcing > 0",
    "elliptic.resonance_distances > 0",
    '"capture r" in capture.itinerary',
    "capture.box.x.lower < capture.box.x.upper",
    "elliptic.twist != 0",
    "paper.r == -paper.l",
    "periodic-1.at == periodic-3.at",
    "particles.at.masses == [1, Rational(9, 10)]",
]
FAIL = [
    "sin(t)**2 - cos(t)**2 == 1",
    "[1, t] == [1, f]",
    "f != f",
    "pi/2 > 2",
    "t < 1",
    "f - t**2 > 0",
    "elliptic.twist > 12/100",
    "elliptic.twist < 1/10",
    "periodic-1.at == paper",
    "elliptic.at.f == 1/2",
    'periodic-1.type == "saddle"',
    "hit(1).det() == 2",
    "elliptic.hit_forcing > 1/10",
    "elliptic.resonance_distances > 1/10",
    "elliptic.taylor > 0",
    "segment-2.itinerary > 0",
    '"turn left" in capture.itinerary',
    "capture.box.x.upper < capture.box.x.lower",
    "elliptic.determinant != 1",
    "paper.r == paper.l",
    "periodic-1.at == elliptic.at",
    "particles.at.masses == [1, 1]",
]


def made(lines):
    """Make steps with f > 0 and a real t."""
    return steps.Steps({"positive": "f", "real": "t", "steps": lines}, used=[LINEAR])


@pytest.mark.slow
@pytest.mark.parametrize("line", HOLD)
def test_what_holds(line):
    """Identities, differences, signs, what certificates claim."""
    made(line)


@pytest.mark.parametrize("line", FAIL)
def test_what_does_not_hold(line):
    """The line is named."""
    with pytest.raises(NotProved):
        made(line)


def test_what_is_no_step():
    """A line without a relation; a claim that the certificate does not make; an unknown number."""
    for line in ("pi", "elliptic.nothing > 0", "elliptic.box.9 > 0"):
        with pytest.raises(NotProved, match=r"no step|claims no"):
            made(line)


def test_names_are_defined_in_order():
    """A later step uses what an earlier one defined; a common part comes first."""
    done = steps.Steps({"positive": "a", "steps": "b = 2*a"}, {"steps": "c = b + a\nc == 3*a"})
    assert str(done.names["c"]) == "3*a"


CALLED = """
kept(4, 1/5) == [[0, 4]]
theta = roots(1/2, 2)
theta[0] + theta[1] > 314/100
theta[0] + theta[1] < 315/100
late = until([elliptic.x, elliptic.v], 2*pi)
late.stops == []
late.words == ["hit r", "hit l"]
overlap(late.state[0], elliptic.x) == True
labels.cited > 0
"""


def test_functions_that_are_used():
    """They are given exact numbers and balls; what they find has parts, which are numbers again."""
    used = [f"{MEANS}.{name}" for name in ("resonances", "equation", "orbits")]
    done = steps.Steps({"steps": CALLED}, used=used)
    shown = filled("{late.words}: {late.times.0:2}, {theta.0:2}", done.names, done.balls)
    assert shown == "hit r, hit l: [1.09, 1.10], [0.96, 0.97]"
    assert "Fraction" not in done.names
    for wrong in ("kept(4, 1/5) == []", "late.state[0] < 0", "theta[0] > theta[1]"):
        with pytest.raises(NotProved):
            steps.Steps({"steps": f"{CALLED}\n{wrong}"}, used=used)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{x}, {b}", "one, 2 a"),
        ("{third:4}", "[0.3333, 0.3334]"),
        ("{many:,1}", "1,234.7"),
        ("{1, 3}, {±a}", "{1, 3}, {±a}"),
        ("{elliptic.twist:5}", "[0.11347, 0.11348]"),
        ("{elliptic.twist:<3}, {elliptic.twist:>3}", "0.113, 0.114"),
    ],
)
def test_words_are_filled(text, words):
    """Names, numbers rounded outwards, certificates; other braces stay."""
    lines = "b = 2*a", "third = Rational(1, 3)", "many = Rational(12347, 10)"
    names = steps.Steps({"positive": "a", "steps": "\n".join(lines)}).names
    assert filled(text, {**names, "x": "one"}) == words


def test_words_that_are_not_there():
    """A hole that nothing fills decides nothing."""
    with pytest.raises(NotProved, match="no words for 'nothing'"):
        filled("{nothing}", {})


def claim_of(example, **data):
    """Return a claim made of data."""
    entry = {
        "id": "strobe.example",
        "verdict": "confirmed",
        "stated": "0.25",
        "found": "yes",
        "evidence": "{x:3}",
        **data,
    }
    return replace(example[0], decide=lambda: given.decided(entry, {}))


@pytest.mark.parametrize(
    ("data", "outcome"),
    [
        ({"steps": "x = Rational(1, 4)\nx > 0"}, Outcome.CONFIRMED),
        ({"steps": "x = Rational(1, 4)\nx > 1"}, Outcome.UNDECIDED),
        ({"steps": "x = Rational(1, 4)\nvalue = x", "verdict": "number"}, Outcome.CONFIRMED),
        ({"steps": "x = Rational(1, 3)\nvalue = x", "verdict": "number"}, Outcome.CORRECTED),
        ({"steps": "x = pi\nderived = x\nprinted = pi", "verdict": "formula"}, Outcome.CONFIRMED),
        ({"steps": "x = pi\nderived = x\nprinted = 3", "verdict": "formula"}, Outcome.CORRECTED),
        ({"steps": "x = pi", "verdict": "formula"}, Outcome.UNDECIDED),
    ],
)
def test_the_verdict_follows_from_the_steps(example, data, outcome):
    """Or from a rule; a step that fails, or a name that is missing, decides nothing."""
    assert decided(claim_of(example, **data), fresh=True).outcome is outcome


def test_what_makes_no_step_is_read(example):
    """Its strength says so."""
    verdict = decided(claim_of(example, evidence="The text."), fresh=True)
    assert verdict.strength is Strength.READ


CLAIMS = Path(steps.__file__).parent / "papers/mixed_dynamics/claims"


def data_of(group):
    """Return what is common to a group of claims, and the claims by the ends of their ids."""
    data = tomllib.loads((CLAIMS / f"{group}.toml").read_text(encoding="utf-8"))
    return data.get("common", {}), {each["id"].partition(".")[2]: each for each in data["claim"]}


def test_claims_on_stops_rest_on_the_equation():
    """With the friction in the other direction none of them is decided."""
    common, every = data_of("stops")
    claims = [each for each in every.values() if "right" in each.get("steps", "")]
    assert len(claims) >= 5
    wrong = {**common, "steps": common["steps"].replace("force - f*s", "force + f*s")}
    assert wrong != common
    for each in claims:
        steps.Steps(common, each)
        with pytest.raises(NotProved):
            steps.Steps(wrong, each)


@pytest.mark.parametrize(
    ("old", "new"), [("rising = q", "rising = 1 - q"), ("falling = 2 - q", "falling = q - 1")]
)
def test_claims_on_the_lift_rest_on_the_wave(old, new):
    """With one of its branches turned around none of them is decided."""
    common, claims = data_of("lifting")
    wrong = {**common, "steps": common["steps"].replace(old, new)}
    assert wrong != common
    for name in ("lift-is-unique", "signs-at-a-crossing", "walls-of-the-cover"):
        steps.Steps(common, claims[name], used=[LINEAR])
        with pytest.raises(NotProved):
            steps.Steps(wrong, claims[name], used=[LINEAR])


@pytest.mark.parametrize(
    ("group", "name", "old", "new"),
    [
        ("wellposed", "velocity-after-a-turn", "- f*s", "+ f*s"),
        ("wellposed", "velocity-after-a-turn", "v - v.subs(t, tau)", "v - v.subs(t, 0)"),
        ("strobe", "three-types", "- f*s", "+ f*s"),
        ("strobe", "three-types", "A1 = -F", "A1 = F"),
        ("strobe", "forward-invariance", "cos(omega*t)", "cos(omega*t/2)"),
        ("birkhoff", "separated-from-zero", "branch.twist_zeros.0", "branch.f_end"),
        ("birkhoff", "separated-from-zero", "1/20000", "1/40000"),
    ],
)
def test_other_data_decide_nothing(group, name, old, new):
    """The equation turned around, another constant or period, another value of f."""
    common, claims = data_of(group)
    steps.Steps(common, claims[name])
    assert old in claims[name]["steps"]
    with pytest.raises(NotProved):
        steps.Steps(common, claims[name], {"steps": claims[name]["steps"].replace(old, new)})


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("ansatz.bijection", "roots(1/2, 2)", "roots(3/10, 2)"),
        ("ansatz.zeros-on-the-first-piece", "[1]", "[0]"),
        ("birkhoff.roles-of-the-resonances", "kept(3, 1/4)", "kept(3, 1/5)"),
        ("decomposition.example-of-non-invariance", '"0.001", 2', '"0.001", 4'),
        ("enclosure.tightening-of-the-bounds", "0.1002798893", "0.1002798901"),
        ("enclosure.angle-from-the-trace", "trace[0]", "trace[1]"),
        ("gallery.orbit-at-three", "periodic-1", "periodic-4"),
        ("gallery.turns-of-the-gallery", "around_turns(periodic-4", "around_turns(periodic-5"),
        ("impulse.path-length", '"-900"', '"990"'),
        ("introduction.lift-is-called-a-theorem", "thm:lift", "thm:wellposed"),
        ("kam.pattern-of-the-gallery", '"0.11228", "0.54194"', '"-0.73", "2.08"'),
        ("linearization.smooth-rotation-number", "928/1000", "926/1000"),
        ("melnikov.sine-transform", '"sech^2 cos"', '"sech tanh sin"'),
        (
            "mirror.square-of-sigma",
            "until([-half[0], -half[1]], pi)",
            "until([half[0], half[1]], pi)",
        ),
        ("particles.invariant-form", "k.after[0]: k.before[0], ", ""),
        ("persistence.speed-bound", "[0, 100]", "[0, 10]"),
        ("roots.branch-exists", "roots(2/5, 2)", "roots(1/2, 2)"),
        ("saltation.contraction-almost-everywhere", '"0.53"', '"0.9"'),
        ("saltation.determinant-of-a-period", "focus.determinant", "focus.trace"),
        ("smoothness.forcing-at-hits", "1, 3/5", "1, 2/5"),
        ("wellposed.continuous-dependence", "before_a_hit(1/100)", "before_a_hit(-1/100)"),
        ("wellposed.rests-last", "-2/5 + 1/100", "-2/5 - 1/100"),
        ("wording.bibliography", "labels.references", "labels.cited"),
    ],
)
def test_what_is_found_elsewhere_decides_nothing(name, old, new):
    """Other states, parameters, certificates, numbers: the functions that are used find others."""
    group, _, end = name.partition(".")
    common, claims = data_of(group)
    claim = claims[end]
    used = [subject.module(f"means.{each}") for each in claim.get("uses", "").split()]
    assert old in claim["steps"]
    with pytest.raises(NotProved):
        steps.Steps(common, claim | {"steps": claim["steps"].replace(old, new)}, used=used)


def test_another_orbit_does_not_persist(monkeypatch):
    """P* must be the one that is continued, without the eigenvalue 1, and must not stop."""
    true, accepted = stored.stored("elliptic.json"), stored._accepted
    common, claims = data_of("persistence")
    claim = claims["persistence-of-the-orbit"]
    assert given.decided(claim, common).outcome is Outcome.CONFIRMED
    third = Enclosure(Fraction(1, 3), Fraction(2, 3), ("1/3", "2/3"))
    negative = Enclosure(Fraction(-1), Fraction(1), ("-1", "1"))
    two = Enclosure(Fraction(1), Fraction(2), ("1", "2"))
    for name, other in (("x", third), ("v", third), ("trace", two), ("least_speed", negative)):
        wrong = true._replace(claims={**true.claims, name: other})
        monkeypatch.setattr(
            stored,
            "_accepted",
            lambda name, wrong=wrong: wrong if name == "elliptic.json" else accepted(name),
        )
        with pytest.raises(NotProved):
            given.decided(claim, common)


@pytest.mark.parametrize(
    "words",
    [
        ["turn right", "turn left", "hit r", "hit l", "hit r"],
        ["turn right", "hit r", "hit l"],
        ["hit l", "turn left", "hit l", "turn right", "hit r"],
    ],
)
def test_turns_that_are_not_alone(words):
    """Two turns that follow each other, one between both walls: not what is found."""
    with pytest.raises(NotProved):
        around_turns(words)


def test_turns_of_the_gallery():
    """The hits around each turn, also of one that begins the period."""
    assert around_turns(["turn left", "hit l", "hit r", "turn right", "hit r", "hit l"]) == [
        "hit l",
        "hit r",
    ]
