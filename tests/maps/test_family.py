"""One fixed point for each of a rectangle of parameters: against floats at random parameters."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from support import holds, rounds, seeded

from cap.errors import NotProved
from cap.floats.search.cycles import near
from cap.flow.event import TAYLOR_MODELS, Expected
from cap.flow.model import Constants
from cap.flow.strobe import oscillator
from cap.maps.family import Problem, agree
from cap.maps.fixed_point import Start, refined
from cap.parameters import PAPER
from cap.sets import interval

STORED = Path(__file__).parents[2] / "certificates/persistence.json"
START = 0.1002798898, 0.5419433068
CORNER = (Fraction(0), Fraction(1, 100)), (Fraction(0), Fraction(1, 200))


def at(epsilon, mu):
    """Return the paper's parameters with e = 1 - ε and μ."""
    return replace(PAPER, e=1 - epsilon, mu=mu)


def constants(epsilon, mu):
    """Return the constants for Taylor models of ε and μ."""
    return Constants.of(PAPER, interval.ball)._replace(e=1 - epsilon, mu=mu)


def problem(rectangle, *, turned=False):
    """Return the problem over a rectangle, around the orbit in its middle."""
    (a, b), (c, d) = rectangle
    p = at((a + b) / 2, (c + d) / 2)
    cycle = near(p, *START)
    hint, events = refined(oscillator(p), Start(cycle.x, cycle.v, cycle.events), [9, 9])
    events = tuple(reversed(events)) if turned else events
    return Problem(constants, rectangle, hint, events)


def within(random, pair):
    """Return a random rational of an interval; its ends are among them."""
    low, high = pair
    return low + (high - low) * Fraction(random.randint(0, 6), 6)


@pytest.mark.parametrize(
    "rectangle",
    [
        CORNER,
        ((Fraction(1, 100), Fraction(3, 200)), (Fraction(1, 50), Fraction(9, 400))),
        ((Fraction(1, 1000), Fraction(1, 1000)), (Fraction(0), Fraction(1, 500))),
        ((Fraction(1, 50), Fraction(21, 1000)), (Fraction(1, 30), Fraction(1, 30))),
    ],
    ids=["corner", "inside", "only mu", "only epsilon"],
)
def test_float_fixed_points_lie_in_the_boxes(rectangle):
    """In the image and so in the box, which is their interior's; their events in the windows."""
    random = seeded(6)
    with interval.workprec(64):
        cell = problem(rectangle).prove()
    assert cell.rectangle == rectangle
    assert cell.hint.contains(cell.image, cell.reach)
    for _ in range(rounds(8)):
        p = at(within(random, rectangle[0]), within(random, rectangle[1]))
        cycle = near(p, *START)
        for side, q in zip(cell.image, (cycle.x, cycle.v), strict=True):
            assert holds(side, q, 1e-9)
        for expected, (word, time) in zip(cell.expected, cycle.events, strict=True):
            assert expected.word == word
            assert holds(expected.window, time, 0)
        for row, values in zip(cell.orbit.monodromy, cycle.path.monodromy, strict=True):
            for entry, value in zip(row, values, strict=True):
                assert holds(TAYLOR_MODELS.bound(entry), value, 1e-7)


def test_boxes_are_tight():
    """The image is not ten times what the fixed points at the corners and the middle span."""
    with interval.workprec(64):
        cell = problem(CORNER).prove()
    points = [near(at(a, b), *START) for a in CORNER[0] for b in CORNER[1]]
    for side, name in zip(cell.image, "xv", strict=True):
        values = [getattr(point, name) for point in points]
        assert 2 * float(side.rad()) < 10 * (max(values) - min(values))


def test_what_is_refused():
    """A rectangle too large; events of other orbits, too few, none; a centre elsewhere."""
    with interval.workprec(64):
        good = problem(CORNER)
        hint, events = good.hint, good.events
        wide = (Fraction(0), Fraction(1, 2)), (Fraction(0), Fraction(1, 2))
        far = replace(hint, centre=(hint.centre[0] + Fraction(1, 10), hint.centre[1]))
        swapped = tuple(
            Expected(a.word, b.window) for a, b in zip(events, events[::-1], strict=True)
        )
        zero = replace(hint, matrix=((Fraction(0),) * 2,) * 2)
        for rectangle, guess, itinerary in (
            (wide, hint, events),
            (CORNER, hint, events[:1]),
            (CORNER, hint, ()),
            (CORNER, hint, events[::-1]),
            (CORNER, hint, swapped),
            (CORNER, hint, (*events, events[0])),
            (CORNER, far, events),
            (CORNER, zero, events),
            ((CORNER[0], (Fraction(-3), Fraction(-2))), hint, events),
        ):
            with pytest.raises(NotProved):
                Problem(constants, rectangle, guess, itinerary).prove()


def test_cells_agree_if_one_image_lies_in_the_other_box():
    """Neighbours agree in either order; cells whose boxes are elsewhere do not."""
    (_, b), below = CORNER
    with interval.workprec(64):
        one = problem(CORNER).prove()
        agree(one, one)
        other = problem(((b, b + Fraction(1, 200)), below)).prove()
        agree(one, other)
        agree(other, one)
        remote = problem(((Fraction(1, 20), Fraction(51, 1000)), below)).prove()
        for pair in ((one, remote), (remote, one)):
            with pytest.raises(NotProved, match="may differ"):
                agree(*pair)
        # boxes that overlap are not enough: the image must lie inside
        narrow = replace(one, reach=tuple(q / 100 for q in one.reach))
        shifted = replace(
            one.hint, centre=(one.hint.centre[0] + one.reach[0], one.hint.centre[1] + one.reach[1])
        )
        for odd in (narrow, replace(one, hint=shifted)):
            with pytest.raises(NotProved):
                agree(replace(one, reach=(Fraction(0),) * 2), odd)


@pytest.fixture(scope="module")
def claims():
    """The claims of the stored certificate."""
    return json.loads(STORED.read_text("utf-8"))["claims"]


def cells(claims):
    """Give the rectangles of the stored grid and their boxes."""
    epsilon, mu = ([Fraction(q) for q in claims["range"][key]] for key in ("epsilon", "mu"))
    boxes = iter(claims["range"]["boxes"])
    for i in range(len(epsilon) - 1):
        for j in range(len(mu) - 1):
            yield (epsilon[i], epsilon[i + 1]), (mu[j], mu[j + 1]), next(boxes)
    assert next(boxes, None) is None


def test_the_stored_boxes_contain_the_float_fixed_points(claims):
    """At random (ε, μ) of each cell, continued from the cell before; sinks all of them."""
    random, z = seeded(7), START
    for epsilon, mu, box in cells(claims):
        centre = [float(sum(map(Fraction, box[name])) / 2) for name in "xv"]
        p = at(within(random, epsilon), within(random, mu))
        cycle = near(p, *centre)
        for name in "xv":
            low, high = map(Fraction, box[name])
            assert low < Fraction(getattr(cycle, name)) < high
        assert [word for word, _ in cycle.events] == claims["itinerary"]
        if not p.conserves:
            assert cycle.kind(conserves=False).startswith("sink")
    z = START
    for k in range(21):  # the family is that of the elliptic orbit: in small steps to the corner
        part = Fraction(k, 20)
        ends = [Fraction(claims["range"][key][-1]) * part for key in ("epsilon", "mu")]
        cycle = near(at(*ends), *z)
        z = cycle.x, cycle.v
        (box, *_) = [
            c[2]
            for c in cells(claims)
            if c[0][0] <= ends[0] <= c[0][1] and c[1][0] <= ends[1] <= c[1][1]
        ]
        assert all(
            Fraction(box[n][0]) < Fraction(q) < Fraction(box[n][1])
            for n, q in zip("xv", z, strict=True)
        )


def test_the_stored_numbers_are_those_of_floats(claims):
    """x, v, events, trace, determinant and multipliers at ε = μ = 1/1000."""
    cycle = near(at(Fraction(1, 1000), Fraction(1, 1000)), *START)
    values = {"x": cycle.x, "v": cycle.v, "trace": cycle.trace, "determinant": cycle.determinant}
    for name, value in values.items():
        low, high = map(Fraction, claims[name])
        assert low - Fraction(1, 10**9) < Fraction(value) < high + Fraction(1, 10**9)
    for pair, (_, time) in zip(claims["event_times"], cycle.events, strict=True):
        assert abs(float(pair[0]) - time) < 1e-9
    re, im = (float(claims["multipliers"][0][part][0]) for part in ("re", "im"))
    assert abs(re * re + im * im - cycle.determinant) < 1e-9
    assert abs(2 * re - cycle.trace) < 1e-9
    assert im > 0
