"""The release map in balls: against orbits in floats, and against its own divided differences."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from support import holds, rounds, seeded, width

from cap.errors import BadInput, NotProved
from cap.floats.engine.releases import images
from cap.flow.event import BALLS, TAYLOR_MODELS, Expected
from cap.flow.strobe import oscillator
from cap.parameters import PAPER
from cap.release.cell import cell
from cap.release.jet import release_jet
from cap.release.passage import arrival, foreseen, image, passage, resting, windows, words
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain

SYSTEMS = {
    "paper": PAPER,
    "with losses": replace(PAPER, e=Fraction(9, 10), mu=Fraction(1, 20)),
    "other units": replace(
        PAPER, F=Fraction(3), omega=Fraction(2), f=Fraction(6, 5), r=Fraction(1, 2)
    ),
    "walls not symmetric": replace(PAPER, l=Fraction(1), r=Fraction(7, 2), f=Fraction(1, 2)),
}

SLIPPERY = replace(PAPER, f=Fraction(1, 1000))


def places(p, count, seed=3):
    """Return random places of which the next release is foreseen."""
    random, found = seeded(seed), []
    while len(found) < count:
        x = float(p.l) + float(p.R) * random.uniform(0.02, 0.98)
        try:
            found.append((x, foreseen(p, x)))
        except BadInput:
            continue
    return found


@pytest.mark.parametrize("name", SYSTEMS)
def test_many_at_once(name):
    """The compiled map, of arrays, is that which follows one orbit."""
    p = SYSTEMS[name]
    known = places(p, rounds(60))
    found = images(p, [x for x, _ in known])
    for k, (_, (_, value, slope)) in enumerate(known):
        assert found.value[k] == pytest.approx(value, abs=1e-6 * max(1, abs(slope)))
        assert found.slope[k] == pytest.approx(slope, rel=1e-4, abs=1e-6)


@pytest.mark.parametrize("name", SYSTEMS)
def test_points(name):
    """Enclosures of G and G' at a point contain what floats say, and the number of half-periods."""
    p = SYSTEMS[name]
    known = [(x, f) for x, f in places(p, rounds(25)) if "capture r" not in words(f[0])]
    found = images(p, [x for x, _ in known])
    with interval.workprec(80):
        osc = oscillator(p)
        for k, (x, (events, value, slope)) in enumerate(known):
            try:
                proved = passage(osc, Ball(x), windows(osc, Ball(x), events, BALLS), BALLS)
            except NotProved:  # almost a graze
                continue
            close = Fraction(1, 10**7) * (1 + abs(Fraction(slope)))
            assert holds(proved.value, value, close)
            assert len(events) > 6 or width(proved.value) < 1e-12
            assert float(proved.slope) == pytest.approx(slope, rel=1e-6, abs=1e-9)
            assert proved.half_periods == found.half_periods[k]


def test_jets_against_differences():
    """The coefficients up to order 3 are divided differences of G."""
    with interval.workprec(400):
        osc, step = oscillator(PAPER), Fraction(1, 10**20)
        for x in ("-0.7", "-0.6", "-0.5", "0.45", "0.6"):
            centre = Fraction(x)
            events = foreseen(PAPER, float(x))[0]
            m = interval.ball(centre)
            proved = passage(osc, m, windows(osc, m, events, BALLS), BALLS)
            jet = release_jet(osc, m, proved.events, 3)
            G = [image(osc, interval.ball(centre + k * step), events)[0] for k in (-2, -1, 0, 1, 2)]
            h = interval.ball(step)
            differences = (
                G[2],
                (G[3] - G[1]) / (2 * h),
                (G[3] - 2 * G[2] + G[1]) / (2 * h * h),
                (G[4] - 2 * G[3] + 2 * G[1] - G[0]) / (12 * h * h * h),
            )
            for k, difference in enumerate(differences):
                assert float(abs(jet[(k,)] - difference)) < 1e-12 * (1 + abs(float(difference)))


LOSSY = replace(PAPER, e=Fraction(199, 200), mu=Fraction(1, 200))


@pytest.mark.parametrize(
    ("p", "x"),
    [(PAPER, "-0.75"), (PAPER, "-0.6"), (PAPER, "-0.45"), (PAPER, "0.5"), (LOSSY, "-0.55")],
)
def test_cells(p, x):
    """G, G' and G'' of random places lie in the enclosures over their cell, which are not wide."""
    random = seeded(5)
    with interval.workprec(80):
        osc = oscillator(p)
        a, b = Fraction(x), Fraction(x) + Fraction(1, 100)
        found = cell(osc, a, b, foreseen(p, float((a + b) / 2))[0], curved=True)
        for _ in range(rounds(6)):
            place = interval.ball(a + (b - a) * Fraction(random.random()))
            inner = windows(osc, place, foreseen(p, float(place))[0], BALLS)
            proved = passage(osc, place, inner, BALLS)
            jet = release_jet(osc, place, proved.events, 2)
            pairs = (found.value, proved.value), (found.slope, jet[(1,)])
            for whole, point in (*pairs, (found.curve, 2 * jet[(2,)])):
                assert interval.subset(interval.point(point), whole)
            for known, event in zip(found.windows(), proved.events, strict=True):
                assert interval.subset(event.time, known.window)
        assert width(found.value) < 0.06
        assert len(found.pieces(osc, 3)) == 3


def test_what_is_no_passage():
    """Another word, no release at its end, an event too few, a wall in the way."""
    with interval.workprec(80):
        osc, x = oscillator(PAPER), Ball("-0.6")
        events = windows(osc, x, foreseen(PAPER, -0.6)[0], BALLS)
        assert passage(osc, x, events, BALLS).half_periods == 3
        for wrong in (
            events[:-1],
            events[1:],
            (*events[:-2], events[-2]._replace(word="turn left"), events[-1]),
            (*events[:-1], Expected("release right", Ball(0))),
            (events[0]._replace(word="hit l"), *events[1:]),
        ):
            with pytest.raises(NotProved):
                passage(osc, x, wrong, BALLS)
        with pytest.raises(NotProved, match="end with a release"):
            arrival(osc, resting(osc, x), (), BALLS)
        with pytest.raises(NotProved, match="end with a release"):
            release_jet(osc, x, passage(osc, x, events, BALLS).events[:-1], 2)


def test_a_cell_with_a_border():
    """No cell is proved across the end of a branch."""
    with interval.workprec(80):
        osc = oscillator(PAPER)
        with pytest.raises(NotProved):
            cell(osc, Fraction(-42, 100), Fraction(-38, 100), foreseen(PAPER, -0.4)[0])


def test_a_set_in_mean_value_form():
    """The image of a thin ball is as wide as the derivative says."""
    with interval.workprec(200):
        osc = oscillator(PAPER)
        x = interval.around(Fraction(-1, 2), Fraction(1, 10**20))
        value, slope = image(osc, x, foreseen(PAPER, -0.5)[0])
        assert width(value) < 1.01 * float(slope) * 2e-20


def test_no_release():
    """A mass that never stops again has no next release."""
    with pytest.raises(BadInput, match="does not stick"):
        foreseen(SLIPPERY, 0.3)
    found = images(SLIPPERY, [0.3, 2.0])
    assert np.isnan(found.value).all()
    assert (found.half_periods == 0).all()


def test_taylor_models_of_the_place():
    """Over a whole cell the Taylor model of G is close to its values."""
    with interval.workprec(80):
        osc, m = oscillator(PAPER), Ball("-0.5")
        (x,) = Domain((Ball("0.01"),), 4).variables((m,))
        events = windows(osc, x, foreseen(PAPER, -0.5)[0], TAYLOR_MODELS)
        model = passage(osc, x, events, TAYLOR_MODELS).value
        ends = [
            image(osc, m + side * Ball("0.01"), foreseen(PAPER, -0.5)[0])[0] for side in (-1, 1)
        ]
        assert width(model.bound()) < 1.2 * float(abs(ends[1] - ends[0]))
