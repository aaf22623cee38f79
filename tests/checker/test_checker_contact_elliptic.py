"""The theorem ``contact_elliptic``: what is true, what its jets are, and lies."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.system.strobe import Strobe
from cap.checker.theorems import contact_elliptic
from cap.checker.theorems.contact_elliptic import ContactElliptic
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected, verify

STORED = Path(__file__).parents[2] / "certificates"
BALL, SPRING = (
    json.loads((STORED / f"contact_elliptic-{n}.json").read_text("utf-8")) for n in (1, 2)
)
FAR = "1/10000"


def lie(given, *path):
    """Return the certificate with both ends of a claim moved by a little."""
    ends = given["claims"]
    for key in path:
        ends = ends[key]
    moved = [str(Fraction(q) + Fraction(FAR)) for q in ends]
    return changed(given, "claims", *path, moved)


@pytest.mark.parametrize("given", [BALL, SPRING])
def test_it_is_verified(given):
    """Its steps are told; the schema describes it; the sentence has the names of the variables."""
    assert len(verify(given)) == 7
    fits_the_schema(given)
    line = words(read(encode(given)))
    x, v = given["parameters"]["state"]
    for part in (
        f"with d{x}^d{v} = (i/2) dz^dz^- there (so that positive angles turn from {x} to {v})",
        "no resonance of order at most four",
        f"the map Phi from the state ({x}, {v}) at t = {Fraction(given['claims']['phase'])} to",
        "and tau_1 in [{}, {}], which is not zero".format(*given["claims"]["twist"]),
    ):
        assert part in line


@pytest.mark.parametrize("given", [BALL, SPRING])
@pytest.mark.parametrize(
    "path",
    [
        ("twist",),
        ("rotation_angle",),
        ("rotation_number",),
        ("point", 0),
        ("point", 1),
        ("times", 0),
        ("states", 0, 0),
        ("states", 0, 1),
        ("symmetric", 0),
        ("symmetric", 1),
        *(("resonance_distances", q) for q in ("0", "1/4", "1/3", "1/2")),
    ],
)
def test_each_number(given, path):
    """No number claimed may be another one, nor wider than its digits."""
    rejected(lie(given, *path), "does not contain the enclosure computed")
    ends = given["claims"]
    for key in path:
        ends = ends[key]
    wide = [str(Fraction(ends[0]) - 1), str(Fraction(ends[1]) + 1)]
    rejected(changed(given, "claims", *path, wide), "wider than its digits allow")


@pytest.mark.parametrize(("phase", "far"), [("8/5", 0), ("-5", 0), ("1000", 0), ("1/10", 1)])
def test_the_phase(phase, far):
    """It lies between the last contact and the first one; the state is that at this time."""
    why = "does not contain" if far else "not certainly between the last contact and the first"
    rejected(changed(BALL, "claims", "phase", phase), why)


def test_a_twist_that_may_vanish(monkeypatch):
    """An enclosure that is as narrow as its digits, but has 0 in it, is not enough."""
    tiny = Interval.enclosing(Fraction(-1, 10**15), Fraction(1, 10**15), 176)
    monkeypatch.setattr(contact_elliptic.normal_form, "twists", lambda _: [tiny])
    near = [f"{sign}0.00000000001" for sign in ("-", "")]
    rejected(changed(SPRING, "claims", "twist", near), "twist does not exclude 0")


def test_area_that_is_lost():
    """An orbit of a ball that loses speed, with all else told as if it were elliptic."""
    lossy = json.loads((STORED / "contacts-1.json").read_text("utf-8"))
    told = {key: lossy["claims"][key] for key in BALL["claims"].keys() & lossy["claims"].keys()}
    hints = {key: lossy["hints"][key] for key in BALL["hints"]}
    given = BALL | {"parameters": lossy["parameters"], "claims": BALL["claims"] | told}
    given |= {"hints": hints}
    rejected(given, "the product of the multipliers is not found to be 1")


def test_three_variables():
    """A state of another number of variables is none of this theorem."""
    given = changed(BALL, "parameters", "state", ["y", "v", "w"])
    given["parameters"]["modes"]["fly"]["field"]["w"] = []
    given["parameters"]["modes"]["rest"]["field"]["w"] = []
    rejected(given, "the state has not two variables")


def test_another_mode_that_is_open():
    """If a guard leads to two modes that are open, motions near the orbit have no one map."""
    given = json.loads(encode(BALL))
    modes = given["parameters"]["modes"]
    modes["also"] = json.loads(json.dumps(modes["fly"]))
    modes["fly"]["guards"]["table"]["to"] = ["fly", "also"]
    rejected(given, "another mode may be open")


@pytest.mark.parametrize(
    ("part", "value", "why"),
    [
        ("centre", [["2", "3/8", "-3"]], "the centre is not in the box"),
        ("preconditioner", [["1"] * 3] * 3, "K does not lie in the interior"),
        ("cuts", [{"leave": []}], "cuts of a guard that its mode has not"),
        ("cuts", [{}], "no cuts, and no Lemma M"),
    ],
)
def test_hints(part, value, why):
    """A hint that is wrong proves nothing."""
    rejected(changed(BALL, "hints", part, value), why)


# the jets


def jets(given):
    """Return those of Phi at the fixed point, as middles, with that point."""
    theorem = ContactElliptic(read(encode(given)), lambda _: None)
    zero, steps = theorem.located()
    strobe = Strobe(theorem.equations, zero, steps, theorem.number(theorem.claims["phase"]))
    point = [middle(z) for z in strobe.point]
    found = [{p: middle(c) for p, c in jet.coefficients.items()} for jet in strobe.jet(3)]
    return point, found


def middle(x: Interval) -> float:
    """Return a double in the middle."""
    return float((x.lower + x.upper) / 2)


def ball(y, v, t=0.0):
    """Return the state of the elastic ball of A = 2/5 a period later, after one bounce."""
    first, last = 0.2, 3.0
    height = lambda s: y + v * s - s * s / 2 - 0.4 * math.sin(t + s)  # noqa: E731
    s = root(height, first, last)
    y, v = y + v * s - s * s / 2, v - s
    v, rest = 0.8 * math.cos(t + s) - v, 2 * math.pi - s
    return y + v * rest - rest * rest / 2, v - rest


def spring(x, v, s=0.0, w=1.5, gap=0.5):
    """Return the state a period later of x'' = cos wt - x, after one hit of the wall."""
    start, end = s, s + 2 * math.pi / w
    k = 1 / (1 - w * w)

    def flight(x, v, t, to):
        a, b = x - k * math.cos(w * t), v + k * w * math.sin(w * t)
        c, d = math.cos(to - t), math.sin(to - t)
        return a * c + b * d + k * math.cos(w * to), b * c - a * d - k * w * math.sin(w * to)

    t = root(lambda q: gap - flight(x, v, start, q)[0], start + 1e-3, end - 1e-3)
    x, v = flight(x, v, start, t)
    return flight(x, -v, t, end)


def root(f, a, b):
    """Return where a function falls from above 0 first, in steps, then by halving."""
    steps = [a + (b - a) * k / 2000 for k in range(2001)]
    a, b = next((p, q) for p, q in pairwise(steps) if f(p) > 0 >= f(q))
    for _ in range(60):
        m = (a + b) / 2
        a, b = (m, b) if f(m) > 0 else (a, m)
    return (a + b) / 2


@pytest.mark.parametrize(("given", "system"), [(BALL, ball), (SPRING, spring)])
def test_the_jet_is_that_of_the_map(given, system):
    """Beside the fixed point the polynomial is as near to the map, in floats, as order 3 says."""
    (x, v), (X, V) = jets(given)
    s = float(Fraction(given["claims"]["phase"]))
    for far in (0.02, 0.01):
        for k in range(6):
            dx, dv = far * math.cos(k), far * math.sin(k)
            image = system(x + dx, v + dv, s)
            for jet, q in zip((X, V), image, strict=True):
                value = sum(c * dx**i * dv**j for (i, j), c in jet.items())
                assert abs(value - q) < 20 * far**4, (far, k)
                without = sum(c * dx**i * dv**j for (i, j), c in jet.items() if i + j < 3)
                assert abs(without - q) < 20 * far**3
    cubic = max(abs(c) for jet in (X, V) for (i, j), c in jet.items() if i + j == 3)
    assert cubic > 1e-3
