"""The theorem ``horseshoe``: its map, coverings, overlaps, diamonds; what is true, and lies."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest
from support import rounds, seeded

from cap.checker.coverings import half_period
from cap.checker.coverings.covering import Parallelogram, covers
from cap.checker.coverings.graph import (
    confirm_entropy,
    confirm_no_diamond,
    confirm_paths,
    overlaps,
)
from cap.checker.coverings.half_period import HalfPeriod
from cap.checker.kernel.certificate import read
from cap.checker.kernel.doubles import Double
from cap.checker.kernel.growth import confirm_growth
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import words
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.linear import Linear

FILE = Path(__file__).parents[2] / "certificates/horseshoe-2.json"
CERTIFICATE = json.loads(FILE.read_text("utf-8"))
SETS, EDGES = CERTIFICATE["hints"]["sets"], CERTIFICATE["hints"]["coverings"]
SIGMA = HalfPeriod(Fraction(2, 5), Fraction(1))


def test_it_is_verified():
    """The steps are told; the schema describes it; the sentence has its numbers."""
    assert len(verify(CERTIFICATE)) > 4
    fits_the_schema(CERTIFICATE)
    line = words(read(encode(CERTIFICATE)))
    for part in ("f = 2/5", "e = 1", CERTIFICATE["claims"]["entropy"], f"{len(SETS)} parallelo"):
        assert part in line


def test_sigma_contains_motions():
    """Of random states of small boxes, against the float flow; a period is two half-periods."""
    random, seen = seeded(7), 0
    for _ in range(rounds(40)):
        x, v = random.uniform(-0.2, 0.6), random.uniform(0.45, 1.2)
        r = random.choice([0.0, 1e-6, 1e-3])
        try:
            found = SIGMA.image(Double(x, r), Double(v, r))
        except Rejected:
            continue
        seen += 1
        end = itinerary(PAPER, x + r / 2, v - r / 3, 3.141592653589793).end
        for box, value in ((found.x, -end[0]), (found.y, -end[1])):
            assert box.lower - 1e-8 <= value <= box.upper + 1e-8
            assert box.rad < 1e-12 + 40 * r
    assert seen > 10


def test_the_derivative_of_sigma():
    """It is that of differences, and has the determinant 1."""
    x, v, h = 0.34, 0.77, 1e-5
    (a, b), (c, d) = SIGMA.image(Double(x), Double(v)).derivative
    for column, (dx, dv) in zip(((a, c), (b, d)), ((h, 0.0), (0.0, h)), strict=True):
        up = SIGMA.image(Double(x + dx), Double(v + dv))
        down = SIGMA.image(Double(x - dx), Double(v - dv))
        for entry, one, other in zip(column, up[:2], down[:2], strict=True):
            assert abs((one.mid - other.mid) / (2 * h) - entry.mid) < 1e-6
    assert abs((a * d - b * c).mid - 1) < 1e-12


@pytest.mark.parametrize(
    ("x", "v", "why"),
    [
        (Double(1.0), Double(0.7), "a state beyond a wall"),
        (Double(0.3), Double(0.0, 0.1), "a velocity that is not positive"),
        (Double(-0.9), Double(0.05), "a mass that may not reach the wall"),
        (Double(0.803), Double(0.092), "the velocity may vanish after the hit"),
        (Double(0.3), Double(9.0), "a second hit within half a period"),
        (Double(0.675, 0.2), Double(1.669), "a hit that may be too early or late"),
        (Double(0.32, 0.2), Double(1.279, 0.2), "no certain hit"),
        (Double(-0.128, 0.05), Double(0.256, 0.05), "the velocity may vanish before the hit"),
    ],
)
def test_where_sigma_is_not_defined(x, v, why):
    """Each condition refuses something, for its own reason."""
    with pytest.raises(Rejected) as refused:
        SIGMA.image(x, v)
    assert str(refused.value) == why


def test_a_hit_that_may_be_after_half_a_period():
    """Some of these masses fly longer than pi, without friction, between walls far apart."""
    with pytest.raises(Rejected, match="too early or late"):
        HalfPeriod(Fraction(0), Fraction(3)).image(Double(-2.9, 0.01), Double(1.27, 0.02))


def test_a_guess_that_is_wrong(monkeypatch):
    """A time at which a mass would fly back is no guess of a hit."""
    monkeypatch.setattr(half_period, "_guess", lambda *_: 3.0)
    with pytest.raises(Rejected, match="may not reach the wall"):
        SIGMA.image(Double(0.3), Double(0.7))


def square(x=0, y=0, a=1, b=1):
    """Return a parallelogram with axes along the coordinates."""
    return Parallelogram([Fraction(n) for n in (x, y, a, 0, 0, b)])


@pytest.mark.parametrize(
    ("g", "target", "why"),
    [
        (Linear(), square(5), "the same side"),
        (Linear(), square(y=2), "more than"),
        (Linear(0.5, 0.0, 0.0, 0.25), square(), "more than"),
        (Linear(3.0, 0.0, 0.0, 2.0), square(), "more than"),
        (Linear(0.0, 3.0, 0.3, 0.0), square(), "both sides|more than"),
    ],
)
def test_what_is_no_covering(g, target, why):
    """The image passes by, does not reach across, or is too thick."""
    with pytest.raises(Rejected, match=why):
        covers(g, square(), [target])


def test_axes_that_are_parallel():
    """A segment is no set, nor is a point."""
    for numbers in ((0, 0, 1, 1, 2, 2), (0, 0, 1, 0, 0, 0)):
        with pytest.raises(Rejected, match="parallel"):
            Parallelogram([Fraction(n) for n in numbers])


def test_what_is_a_covering():
    """One long set covers several, also mirrored ones."""
    assert covers(Linear(), square(), [square(), square(Fraction(3, 2)), square(-1)]) > 3
    assert covers(Linear(-3.0, 0.0, 0.0, -0.25), square(), [square()]) > 1


def arcs(k, copies=1):
    """Return the dyadic arcs of length 2^-k, a little enlarged, and what they cover by 2x mod 1.

    Arcs as sets of integers modulo 2^k that are neighbours: which overlap.
    """
    n = 2**k
    names = [(i, c) for i in range(n) for c in range(copies)]
    number = {name: m for m, name in enumerate(names)}
    edges = [[number[(2 * i + s) % n, c] for s in (0, 1) for c in range(copies)] for i, _ in names]
    overlapping = [
        {number[(i + s) % n, c] for s in (-1, 0, 1) for c in range(copies)} - {m}
        for m, (i, _) in enumerate(names)
    ]
    return edges, overlapping


def test_doubling_without_diamonds():
    """The lemma is sharp: 2^k arcs overlap with their neighbours, and rho = 2."""
    edges, overlapping = arcs(4)
    assert confirm_no_diamond(edges, overlapping) > 0
    confirm_growth(edges, [1] * 16, [Fraction(2)] * 16)
    with pytest.raises(Rejected):
        confirm_growth(edges, [1] * 16, [Fraction(2) + Fraction(1, 10**9)] * 16)


def test_doubling_with_a_diamond():
    """Each arc twice: rho = 4, and it proves nothing; three copies of one arc around 0 neither."""
    edges, overlapping = arcs(4, 2)
    confirm_growth(edges, [1] * 32, [Fraction(4)] * 32)
    three = [[0, 1, 2]] * 3, [{1, 2}, {0, 2}, {0, 1}]
    for wrong in ((edges, overlapping), three):
        with pytest.raises(Rejected, match="diamond"):
            confirm_no_diamond(*wrong)


def test_overlaps_are_exact():
    """What touches is not disjoint; what is 10^-30 apart is; a turned square fits in a corner."""
    tiny = Fraction(1, 10**30)

    def found(*numbers):
        return overlaps([[Fraction(n) for n in (0, 0, 1, 0, 0, 1)], [Fraction(n) for n in numbers]])

    assert found(2, 0, 1, 0, 0, 1) == [{1}, {0}]
    assert found(2 + tiny, 0, 1, 0, 0, 1) == [set(), set()]
    assert found(0, -2 - tiny, 1, 0, 0, 1) == [set(), set()]
    near = Fraction(19, 10)
    assert found(near, near, near - 1, -(near - 1), Fraction(1, 100), Fraction(1, 100)) == [
        set(),
        set(),
    ]
    assert found(0, 0, Fraction(1, 9), 0, 0, Fraction(1, 9)) == [{1}, {0}]


def test_too_many_overlaps(monkeypatch):
    """They are counted while they are found: many copies of one set need no more memory."""
    monkeypatch.setattr("cap.checker.coverings.graph.MOST_PAIRS", 5)
    sets = [[Fraction(n) for n in (0, 0, 1, 0, 0, 1)]] * 4
    with pytest.raises(Rejected, match="too many"):
        overlaps(sets)
    assert overlaps(sets[:3]) == [{1, 2}, {0, 2}, {0, 1}]


@pytest.mark.parametrize(
    ("edges", "why"),
    [
        ([[0], [0]], "covered by none"),
        ([[0, 1], []], "covers none"),
        ([[0, 0]], "twice"),
        ([[0, 1]], "leads nowhere"),
    ],
)
def test_what_is_no_graph(edges, why):
    """Each vertex lies on a path without end, in both directions; edges are counted once."""
    with pytest.raises(Rejected, match=why):
        confirm_paths(edges)


def test_the_tail_of_the_exponential_counts():
    """The sum of the first terms is below exp(1/2)."""
    terms = sum(Fraction(1, 2**n * math.factorial(n)) for n in range(41))
    confirm_entropy(Fraction(1, 2), terms + Fraction(1, 10**60), 1)
    with pytest.raises(Rejected, match="more than the growth"):
        confirm_entropy(Fraction(1, 2), terms, 1)


def test_entropy_and_growth():
    """2 log(growth) to nine digits, and no more; nothing negative."""
    confirm_entropy(Fraction("0.693147180"), Fraction("1.41421356238"), 2)
    for wrong in ("0.693147182", "-0.1", "2"):
        with pytest.raises(Rejected):
            confirm_entropy(Fraction(wrong), Fraction("1.41421356237"), 2)


def test_a_covering_invented():
    """From a set to one that it does not cover."""
    for i, targets in enumerate(EDGES):
        for j in range(len(SETS)):
            if str(j) not in targets:
                lie = changed(CERTIFICATE, "hints", "coverings", i, [*targets, str(j)])
                rejected(lie, "side|boxes|diamond|defined|vanish|hit")
                return


def test_a_covering_reversed():
    """The first one between different sets, once both ways."""
    i, j = next((i, int(j)) for i, to in enumerate(EDGES) for j in to if int(j) != i)
    assert str(i) not in EDGES[j]
    rejected(changed(CERTIFICATE, "hints", "coverings", j, [*EDGES[j], str(i)]), "side|boxes|diam")


@pytest.mark.parametrize("k", range(6))
def test_a_set_moved(k):
    """By three half-axes, along each of them; or with another axis."""
    numbers = [Fraction(n) for n in SETS[0]]
    by = 3 * max(map(abs, numbers[2:])) if k < 2 else 4 * numbers[k]
    lie = changed(CERTIFICATE, "hints", "sets", 0, k, str(numbers[k] + by))
    rejected(lie, ".")


def test_a_set_doubled():
    """With its coverings, which all hold: the matrix grows faster, and there is a diamond."""
    n = str(len(SETS))
    lie = changed(CERTIFICATE, "hints", "sets", [*SETS, SETS[0]])
    lie["hints"]["coverings"] = [[*to, n] if "0" in to else list(to) for to in (*EDGES, EDGES[0])]
    lie["hints"]["vector"].append(lie["hints"]["vector"][0])
    lie["claims"]["together"] = n
    rejected(lie, "diamond")


@pytest.mark.parametrize("name", ["growth", "entropy"])
def test_a_unit_more(name):
    """Both claims are as large as their last digits allow."""
    value = CERTIFICATE["claims"][name]
    unit = Fraction(1, 10 ** len(value.partition(".")[2]))
    rejected(changed(CERTIFICATE, "claims", name, str(Fraction(value) + unit)), "grow")


@pytest.mark.parametrize("by", [-1, 1, 2])
def test_other_overlaps(by):
    """With more than there are the sentence would say that some overlap, where all are disjoint."""
    together = str(int(CERTIFICATE["claims"]["together"]) + by)
    rejected(changed(CERTIFICATE, "claims", "together", together), "together")


@pytest.mark.parametrize(("name", "value"), [("e", "9/10"), ("mu", "1/10"), ("e", "1")])
def test_losses(name, value):
    """The certificate has no place for them."""
    rejected(changed(CERTIFICATE, "parameters", name, value), "unknown fields")


def test_other_units():
    """The same system in other units of length and time has these sets."""
    other = {"F": "8", "omega": "2", "f": "16/5", "l": "-2", "r": "2"}
    assert len(verify(changed(CERTIFICATE, "parameters", other))) > 4


@pytest.mark.parametrize("f", ["0.41", "0.39", "0"])
def test_other_friction(f):
    """These sets are for one system."""
    rejected(changed(CERTIFICATE, "parameters", "f", f), ".")


def test_what_is_not_of_the_form():
    """Vectors with fractions, lists that do not fit, numbers that are too large."""
    rejected(changed(CERTIFICATE, "hints", "vector", 0, "1/2"), "integers")
    rejected(changed(CERTIFICATE, "hints", "sets", SETS[:-1]), "one list")
    for k in (0, len(SETS) - 1):
        rejected(changed(CERTIFICATE, "hints", "sets", k, 0, "1" + "0" * 31), "larger")
        for long in ("1/3", "0." + "1" * 41):
            rejected(changed(CERTIFICATE, "hints", "sets", k, 0, long), "no decimal")
    rejected(
        changed(CERTIFICATE, "hints", "sets", 0, [*SETS[0][:4], *SETS[0][2:4]]), "parallel|together"
    )


def test_certain_ends_of_sets():
    """No two vertices of the certificate are the same set."""
    assert all(one != other for one, other in pairwise(sorted(SETS)))
