"""The theorem ``capture``: hits accumulate at a wall, which holds the mass until a known time."""

from __future__ import annotations

import copy
from fractions import Fraction
from itertools import pairwise

import pytest
from mpmath import mp, mpf
from support import number, rational, rounds, seeded

from cap.certificate.latex import macros
from cap.checker.flow.hits import Hit
from cap.checker.flow.losses import Lossy as Mechanics
from cap.checker.flow.stops import Event
from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import words
from checker.altered import changed, decimal, encode, fits_the_schema, rejected, verify
from checker.forge_capture import PAPER, forcing, forge_capture, lemma
from checker.hybrid import Flow
from checker.parts import Interval, Parameters, bounces, capture

LOSSY = PAPER | {"e": "4/5", "mu": "1/10"}
CASES = {
    "at once": {},
    "viscous": {"parameters": LOSSY, "box": (("0.996", "1"), ("-0.03", "0.03"))},
    "after hits": {
        "parameters": LOSSY,
        "box": (("0.9745", "0.9746"), ("0.042", "0.0421")),
        "held": ("0.85",),
        "speed": "0.04",
    },
    "left": {
        "parameters": PAPER | {"e": "3/10", "mu": "0", "l": "-3/20", "r": "3/20"},
        "box": (("0.0437", "0.0438"), ("0.4528", "0.4529")),
        "wall": "l",
        "held": ("0.7", "3.85"),
        "speed": "0.05",
    },
}


@pytest.fixture(scope="module")
def forged():
    """Return the valid certificates."""
    return {name: forge_capture(**case) for name, case in CASES.items()}


def hit(word, moment, forcing, speed):
    """Return a hit, of which it does not matter on what flight it is."""
    return Hit(word, moment, forcing, speed, None)


@pytest.mark.parametrize("name", CASES)
def test_accepts(forged, name):
    """From a box that touches the wall, and after hits and turns; with and without losses."""
    assert len(verify(forged[name])) == 3


@pytest.mark.slow
@pytest.mark.parametrize("name", ["at once", "viscous"])
def test_orbits_of_the_box_are_captured(forged, name):
    """In mpmath, until the bounces are very small: all before the bound, with its ratios."""
    claims, rng = forged[name]["claims"], seeded(2)
    bound = Fraction(claims["ratio"])
    with mp.workdps(30):
        flow = Flow(forged[name]["parameters"])
        for _ in range(rounds(8)):
            x = mpf(1) - mpf(rng.randint(1, 100)) / 100 * (1 - mpf(claims["box"]["x"][0]))
            v = mpf(rng.randint(-100, 100) or 1) / 100 * mpf(claims["box"]["v"][1])
            hits = [e for e in flow.run(x, v, 1, mpf("1e-6"))[0] if e.word == "hit r"]
            assert all(rational(e.t) < Fraction(claims["accumulation_time"][1]) for e in hits)
            assert len(hits) > 8
            for one, two in pairwise(hits):
                assert rational(two.speed) <= rational(one.speed) * bound


@pytest.mark.parametrize("name", CASES)
def test_each_claim_counts(forged, name):
    """Under a force that varies, every number moved inwards by little at either end is refused."""
    certificate = forged[name]
    claims, little = certificate["claims"], Fraction(3, 10**9)
    late = little if len(claims["itinerary"]) == 2 else Fraction(2, 10**4)
    a, b = map(Fraction, claims["release_time"])
    steps = {"forcing": little, "accumulation_time": late, "release_time": (b - a) * 5 / 8}
    for path, step in steps.items():
        a, b = map(Fraction, claims[path])
        for ends in ((a + step, b), (a, b - step), (b + 1, b + 2), (a - 2, a - 1)):
            value = [decimal(q) for q in ends]
            rejected(changed(certificate, "claims", path, value), f"{path} does not contain")
    for n, ends in enumerate(claims["event_times"]):
        a, b = map(Fraction, ends)
        step = min(max((b - a) / 20, little), (b - a) * 3 / 4)
        for value in ([decimal(a + step), decimal(b)], [decimal(a), decimal(b - step)]):
            altered = changed(certificate, "claims", "event_times", n, value)
            if not claims["itinerary"][n].startswith(("capture", "release")):
                rejected(altered, rf"event_times\[{n}\] does not contain")


def test_the_ratio(forged):
    """A ratio below the true bound, and one of 1, are refused; one between is accepted."""
    for certificate in forged.values():
        ratio = Fraction(certificate["claims"]["ratio"])
        lower = decimal(ratio - Fraction(3, 10**9))
        rejected(changed(certificate, "claims", "ratio", lower), "larger than claimed")
        rejected(changed(certificate, "claims", "ratio", "1"), "not below 1")
        verify(changed(certificate, "claims", "ratio", decimal((ratio + 1) / 2)))


def test_the_release(forged):
    """A period later, half a period later, or too wide for its digits, it is refused."""
    certificate = forged["at once"]
    lower, upper = map(Fraction, certificate["claims"]["release_time"])
    for step in (Fraction("6.283185307179586476925"), Fraction("3.14159265358979323846")):
        later = [decimal(lower + step), decimal(upper + step)]
        altered = changed(certificate, "claims", "release_time", later)
        rejected(altered, "release_time does not contain")
        rejected(changed(altered, "hints", "events", 1, later), "not in its window")
    wide = [decimal(lower), decimal(upper + Fraction(1, 10**18))]
    rejected(changed(certificate, "claims", "release_time", wide), "wider")


def test_the_box(forged):
    """Too far from the wall, too fast, beyond the wall, without interior: refused."""
    certificate = forged["at once"]
    path = "claims", "box"
    rejected(changed(certificate, *path, "x", ["0.8", "1"]), "accumulate")
    rejected(changed(certificate, *path, "v", ["-0.3", "0.02"]), "accumulate")
    rejected(changed(certificate, *path, "v", ["-0.02", "0.3"]), "accumulate")
    rejected(changed(certificate, *path, "v", ["-3", "3"]), "other wall")
    rejected(changed(certificate, *path, "x", ["0.998", "1.0001"]), "not between the walls")
    rejected(changed(certificate, *path, "x", ["-1.1", "1"]), "not between the walls")
    rejected(changed(certificate, *path, "x", ["1", "1"]), "no interior")
    rejected(changed(certificate, *path, "v", ["0", "0"]), "no interior")
    prelude = forged["after hits"]
    rejected(changed(prelude, *path, "x", ["0.97", "1"]), "between the walls")
    rejected(changed(prelude, *path, "v", ["0", "0.05"]), "velocity vanishes")
    rejected(changed(prelude, *path, "x", ["0.95", "0.98"]), "window|wall|velocity|accumulate")


def test_the_window_of_the_lemma(forged):
    """It begins at 0 and ends while the force holds the mass, after the hits have accumulated."""
    path = "hints", "events", 0
    certificate = forged["at once"]
    rejected(changed(certificate, *path, ["0", "0.1"]), "accumulate")
    rejected(changed(certificate, *path, ["0", "1.16"]), "too weak to hold")
    rejected(changed(certificate, *path, ["0.001", "0.5"]), "begin at 0")
    rejected(changed(certificate, *path, ["-0.001", "0.5"]), "begin at 0")


def test_every_word_counts(forged):
    """Another wall, another side, no release, or a hit left out."""
    certificate = forged["at once"]
    for n, word in ((0, "capture l"), (1, "release right"), (0, "hit r"), (1, "turn left")):
        rejected(changed(certificate, "claims", "itinerary", n, word), "does not end")
    left = copy.deepcopy(certificate)
    left["claims"] |= {"wall": "l", "itinerary": ["capture l", "release right"]}
    rejected(left, "too weak to hold")
    prelude = forged["after hits"]
    for n, right in enumerate(prelude["claims"]["itinerary"][:-2]):
        for word in {"hit r", "hit l", "turn right", "turn left", "stick"} - {right}:
            with pytest.raises(Rejected):
                verify(changed(prelude, "claims", "itinerary", n, word))
    shorter = copy.deepcopy(prelude)
    for part in (*(shorter["claims"][k] for k in ("itinerary", "event_times")),):
        del part[4]
    del shorter["hints"]["events"][4]
    rejected(shorter, "not after its hit")


@pytest.mark.parametrize(
    ("name", "value", "why"),
    [
        ("f", "0.9", "too weak to hold"),
        ("f", "0", "may not decrease"),
        ("F", "2", "forcing|accumulate"),
        ("omega", "2", "hold|forcing|accumulate"),
        ("e", "0.5", ""),
        ("mu", "20", "held off"),
        ("r", "1.01", "accumulate"),
        ("l", "0.9985", "not between"),
    ],
)
def test_other_parameters(forged, name, value, why):
    """A weaker force, a viscosity that carries the mass, other walls; e may only help."""
    certificate = changed(forged["at once"], "parameters", name, value)
    if why:
        rejected(certificate, why)
    else:
        verify(certificate)


def test_a_narrow_pair_of_walls(forged):
    """Between walls a thousandth apart, the mass may reach the other one."""
    narrow = changed(forged["at once"], "parameters", "l", "0.998")
    rejected(narrow, "other wall")


@pytest.mark.parametrize(
    ("l", "speed", "word", "why"),
    [
        ("-1", "2", "hit r", None),
        ("0.5", "2", "hit r", "reached from this one"),
        ("-1", "5", "hit r", "reached from this one"),
        ("-1", "2", "hit l", "not after its hit"),
        ("-1", "2", "turn right", "not after its hit"),
    ],
)
def test_the_hit_before_a_capture(l, speed, word, why):
    """With e = 1/100, a hit of the speed 2 at 1/10 is captured, unless the other wall is near."""
    parameters = PAPER | {"l": l, "e": "1/100", "mu": "0"}
    state = [Interval.enclosing(q, q, 64) for q in (Fraction(9, 10), Fraction(1))]
    M = Mechanics(Parameters(**{k: Fraction(q) for k, q in parameters.items()}), state, state, 2)
    moment = M.moment(M.constant(M.number(Fraction(1, 10))))
    before = hit(word, moment, M.F, M.constant(M.number(Fraction(speed))))
    if word.startswith("turn"):
        before = Event(word, moment, M.F)
    window = Fraction(0), Fraction(1, 2)
    if why is None:
        event, rest = capture(M, before, "capture r", window)
        assert event.moment.t.value.upper < Fraction(1, 5)
        assert rest.sides == (-1,)
    else:
        with pytest.raises(Rejected, match=why):
            capture(M, before, "capture r", window)


@pytest.mark.parametrize("side", [1, -1])
def test_a_wall_that_is_no_binary_number(side):
    """A box that touches it is captured, although its enclosure may lie beyond the wall's."""
    parameters = PAPER | {"e": "1/2", "mu": "1/10", "l": "-1/3", "r": "1/3"}
    place, start = Fraction(side, 3), Fraction(0) if side > 0 else Fraction(3)
    state = [Interval.enclosing(q - d, q + d, 64) for q, d in ((place, 0), (0, Fraction(1, 1000)))]
    M = Mechanics(Parameters(**{k: Fraction(q) for k, q in parameters.items()}), state, state, 2)
    assert (M.walls[side] - M.variables[0].value).contains_zero()
    moment = M.moment(M.constant(M.number(start)))
    before = hit(
        "hit r" if side > 0 else "hit l", moment, M.F, M.constant(M.variables[1].value.magnitude())
    )
    word = "capture r" if side > 0 else "capture l"
    event, _ = capture(M, None if side > 0 else before, word, (start, start + Fraction(1, 2)))
    assert start < event.moment.t.value.upper < start + Fraction(1, 10)


def some_system(rng):
    """Return random parameters, a window in which the force holds the mass at r, and a speed."""
    F, omega = Fraction(rng.randint(5, 30), 10), Fraction(rng.randint(5, 30), 10)
    parameters = {
        "F": F,
        "omega": omega,
        "f": F * rng.randint(0, 4) / 10,
        "l": Fraction(-2),
        "r": Fraction(1),
        "e": Fraction(rng.randint(1, 7), 10),
        "mu": Fraction(rng.randint(0, 3), 10),
    }
    window = Fraction(0), Fraction(rng.randint(4, 7), 10) / omega
    return parameters, window, Fraction(rng.randint(1, 9), 1000)


def in_time(parameters, window, *sets):
    """Return the mechanics at these parameters, over a box."""
    return Mechanics(Parameters(**parameters), sets, [q.midpoint() for q in sets], 2)


def short(low, high):
    """Return an interval of 128 bits."""
    return Interval.enclosing(Fraction(low), Fraction(high), 128)


@pytest.mark.parametrize("side", [1, -1])
def test_the_lemma_for_random_systems(side):
    """The time is that of the formula, for the weakest force that holds and the strongest pull."""
    rng, walls = seeded(side), {1: "r", -1: "l"}
    word, little = f"capture {walls[side]}", Fraction(1, 10**20)
    for _ in range(rounds(20)):
        parameters, (a, b), u = some_system(rng)
        if side < 0:  # half a period later
            half = round(3217 / parameters["omega"])
            a, b = a + Fraction(half, 1024), b + Fraction(half, 1024)
        x = parameters[walls[side]] - side * u / 10
        with mp.workdps(40):
            flow = Flow(parameters)
            force = forcing(flow, side, (a, b))
            late = lemma(flow, force, number(u), start=number(a + u))
            high = lemma(flow, force, number(u), height=number(u) / 10)
        M = in_time(parameters, (a, b), short(x, x), short(-u, u / 2))
        moment = M.moment(M.constant(short(a, a + u)))
        before = hit(f"hit {walls[side]}", moment, M.F, M.constant(short(u / 2, u)))
        event, rest = capture(M, before, word, (a, b))
        assert event.moment.t.value.lo == moment.t.value.lo
        assert 0 <= event.moment.t.value.upper - rational(late[0]) < Fraction(1, 10**6)
        assert (
            0
            <= bounces(M, before, word, (a, b)).ratio.upper - rational(late[1])
            < Fraction(1, 10**6)
        )
        assert rest.since.lower <= b <= rest.since.upper
        assert rest.x.value.lower <= parameters[walls[side]] <= rest.x.value.upper
        with pytest.raises(Rejected, match="begins after the hit before it"):
            capture(M, before, word, (a + little, b))
        if side > 0:
            event, _ = capture(M, None, word, (a, b))
            assert event.moment.t.value.lo == 0
            assert 0 <= event.moment.t.value.upper - rational(high[0]) < Fraction(1, 10**6)


def test_words_and_macros(forged):
    """One line with the box as it is, the wall and the times."""
    certificate = read(encode(forged["at once"]))
    line = words(certificate)
    assert "[0.998, 1] x [-0.02, 0.02]" in line
    assert "capture r, release left" in line
    printed = list(macros(certificate, "a", 4))
    assert "\\newcommand{\\capABoxX}{[0.998, 1]}" in printed
    assert "\\newcommand{\\capAWall}{r}" in printed


def test_the_schema(forged):
    """The JSON Schema describes these certificates exactly."""
    for certificate in forged.values():
        fits_the_schema(certificate)
