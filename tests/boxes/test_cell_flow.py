"""The flow of cells: every orbit of a cell is in what is said of it."""

from collections import Counter
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from flows import expected
from support import holds, rounds, seeded

from boxes.drawn import ALMOST, DAMPED, SHIFTED, cells, followed, states, system
from cap.boxes.flow import OPEN, SMOOTH, UNION, Goals, Region, flow, number_of, words_of
from cap.boxes.motion import STOPPED
from cap.errors import BadInput, NotProved
from cap.floats.engine import swarm
from cap.flow.event import BALLS
from cap.flow.itinerary import itinerary
from cap.flow.strobe import oscillator, strobe
from cap.flow.windows import windows_for
from cap.flow.words import WORDS
from cap.parameters import PAPER
from cap.sets import interval

# compiled anew in a fresh clone: tens of seconds; no theorem uses it
pytestmark = pytest.mark.slow

ELLIPTIC = 0.1002798898441954, 0.5419433067664584
MEETING = Fraction(1, 10**25)  # of enclosures that are known to 80 bits


def around(state, half):
    """Return the cell around a state."""
    (x, v) = state
    return [x - half, x + half, v - half, v + half]


def balls(p, cell):
    """Return the orbits from a cell for a period, proved in balls, or None."""
    ends = [interval.ball(Fraction(end)) for end in cell]
    osc, box = oscillator(p), (interval.hull(*ends[:2]), interval.hull(*ends[2:]))
    path = itinerary(p, (cell[0] + cell[1]) / 2, (cell[2] + cell[3]) / 2, float(osc.T.mid()))

    def attempt(events):
        return strobe(osc, box, events, BALLS)

    try:
        return windows_for(attempt, expected(path), BALLS.bound)[1]
    except NotProved:
        return None


def meets(ends, ball):
    """Return whether two enclosures of one set have a point in common."""
    lower, upper = interval.ends(ball)
    return Fraction(ends[0]) <= upper + MEETING and lower - MEETING <= Fraction(ends[1])


def names(bits):
    """Return the words of bits."""
    return {word for k, word in enumerate(WORDS) if bits >> k & 1}


def compared(random):
    """Check that both flows agree on a random cell; return (verdict, whether balls prove it)."""
    p = system(random)
    (cell,) = cells(random, p, 1, 10.0 ** random.uniform(-12, -4))
    images = flow(p, [cell], 1)
    with interval.workprec(80):
        image = balls(p, cell)
    verdict = int(images.verdict[0])
    if image is None or verdict == OPEN:
        return verdict, image is not None
    assert all(meets(*pair) for pair in zip(images.states[0], image.end, strict=True))
    words = [event.word for event in image.events]
    captured = any(word.startswith("capture") for word in words)
    if not captured:
        assert names(images.surely[0]) <= set(words) <= names(images.possibly[0])
    if verdict == SMOOTH:
        entries = zip(images.derivative[0].reshape(4, 2), sum(image.monodromy, ()), strict=True)
        assert all(meets(*pair) for pair in entries)
        assert captured or images.itinerary[0] in (number_of(words), -1)
    return verdict, True


def test_agreement_with_balls():
    """Two flows with nothing in common but the mechanics prove the same of the same cells."""
    random, found = seeded(3), Counter()
    for _ in range(rounds(150)):
        found[compared(random)] += 1
    assert found[SMOOTH, True] > 0.6 * sum(found.values())


@pytest.mark.parametrize("width", [1e-3, 3e-2, 0.3])
def test_unions_contain_orbits_in_floats(width):
    """Large cells: each orbit ends in the box, with the events that are sure, and no others."""
    random, verdicts = seeded(4), Counter()
    for _ in range(rounds(60)):
        p, periods = system(random), random.choice((1, 1, 3))
        boxes = cells(random, p, 8, width)
        images = flow(p, boxes, periods)
        verdicts.update(images.verdict.tolist())
        for k in np.flatnonzero(images.verdict != OPEN):
            orbits, safe = followed(p, states(random, p, boxes[k], 12), periods)
            for i in np.flatnonzero(safe):
                check_orbit(p, images, k, orbits, i)
    assert verdicts[UNION] > 20
    assert verdicts[OPEN] < 0.9 * sum(verdicts.values())


def check_orbit(p, images, k, orbits, i):
    """Check that an orbit in floats is in what is said of its cell."""
    scale = float(p.R), float(p.F / p.omega)
    for (low, high), value, unit in zip(images.states[k], orbits.states[i], scale, strict=True):
        assert low - ALMOST * unit <= value <= high + ALMOST * unit
    happened = {word for word, n in zip(WORDS, orbits.counts[i], strict=True) if n}
    if not any("capture" in word for word in names(images.possibly[k])):
        assert names(images.surely[k]) <= happened <= names(images.possibly[k])


@pytest.mark.parametrize("width", [1e-6, 1e-3, 1e-2])
def test_derivatives(width):
    """On a smooth cell the derivative in floats is in the enclosure, and itineraries are one."""
    random, smooth = seeded(5), 0
    for _ in range(rounds(40)):
        p, periods = system(random), random.choice((1, 2))
        boxes = cells(random, p, 6, width)
        images = flow(p, boxes, periods)
        for k in np.flatnonzero(images.verdict == SMOOTH):
            orbits, safe = followed(p, states(random, p, boxes[k], 5), periods)
            low, high = images.derivative[k, :, :, 0], images.derivative[k, :, :, 1]
            for value in orbits.monodromy[safe]:
                error = 1e-5 * (1 + abs(low) + abs(high)) * np.array([[1, 9], [9, 1]])
                assert ((low - error <= value) & (value <= high + error)).all()
                smooth += 1
    assert smooth > 60


@pytest.mark.parametrize("p", [PAPER, SHIFTED, DAMPED])
def test_a_span_in_parts(p):
    """Half a period, then the other half from there: the whole period, enclosed."""
    random, half = seeded(6), Fraction(1, 2)
    boxes = cells(random, p, 200, 1e-5)
    whole, first = flow(p, boxes, 1), flow(p, boxes, half)
    inside = (first.verdict == SMOOTH) & (abs(first.states[:, 1]).min(axis=1) > 1e-3)
    boxes = np.clip(first.states[inside].reshape(-1, 4), [float(p.l)] * 2 + [-99] * 2, None)
    boxes = np.minimum(boxes, [float(p.r)] * 2 + [99] * 2)
    second = flow(p, boxes, half, start=half)
    both = (second.verdict == SMOOTH) & (whole.verdict[inside] == SMOOTH)
    assert both.sum() > 100
    one, other = whole.states[inside][both], second.states[both]
    assert (one[..., 0] <= other[..., 1]).all()
    assert (other[..., 0] <= one[..., 1]).all()


@pytest.mark.parametrize(("half", "periods", "factor"), [(1e-9, 400, 1.5), (1e-6, 100, 1.5)])
def test_sets_are_not_wrapped(half, periods, factor):
    """Many periods around the elliptic orbit: not much wider than the orbits of the corners."""
    images = flow(PAPER, [around(ELLIPTIC, half)], periods)
    assert images.verdict[0] == SMOOTH
    width = images.states[0, :, 1] - images.states[0, :, 0]
    (x, v) = ELLIPTIC
    corners = [(x + a * half, v + b * half) for a in (-1, 1) for b in (-1, 1)]
    spread = np.ptp(swarm.follow(PAPER, corners, periods).states, axis=0)
    assert (width > 0.99 * spread).all()
    assert (width < factor * spread).all()


def test_cells_are_independent_of_the_others():
    """To the last bit; and the time from the start of the array is no matter."""
    random = seeded(7)
    boxes = cells(random, DAMPED, 60, 0.02)
    together = flow(DAMPED, boxes, 2)
    for k in range(0, 60, 7):
        alone = flow(DAMPED, boxes[k : k + 1], 2)
        assert np.array_equal(alone.states[0], together.states[k], equal_nan=True)
        assert np.array_equal(alone.derivative[0], together.derivative[k], equal_nan=True)
        assert alone.branches[0] == together.branches[k]


def test_goals():
    """A cell ends at the first stop; at a region of states; where it is released."""
    random, stops = seeded(8), 0
    boxes = cells(random, PAPER, 300, 1e-3)
    goals = Goals(stops=2, regions=[Region(ELLIPTIC, ((50, 0), (0, 50)), 1, round=True)])
    images = flow(PAPER, boxes, 5, goals=goals)
    plain = flow(PAPER, boxes, 1)
    for k in np.flatnonzero(images.verdict != OPEN):
        orbits = swarm.follow(PAPER, states(random, PAPER, boxes[k], 4), 5, every=True)
        stopped = sum(orbits.count(kind) for kind in ("turn", "stick", "capture")) > 0
        near = (np.hypot(*(orbits.states[:, 1:] - ELLIPTIC).T) < 0.02).T.any(axis=1)
        if images.alive[k] == 0:
            assert (near if images.label[k] == 1 else stopped | near).all()
            stops += 1
        if images.label[k] == 0:
            assert images.alive[k] > 0
        if plain.surely[k] >> STOPPED & 1:
            assert images.label[k] == 2
            assert images.periods[k] == 1
    assert stops > 200
    released = Goals(right=([-1.0, 1.0], [4]), left=([-1.0, 1.0], [8]))
    images = flow(PAPER, boxes, 5, goals=released)
    assert set(images.label.tolist()) == {0, 4, 8, 12}


def test_what_is_no_cell():
    """One line each."""
    for bad, words in (
        ([[0, 1, 2]], "rows"),
        ([[0, 1, 2, float("nan")]], "finite"),
        ([[0.5, 0.4, 0, 0]], "order"),
        ([[2, 3, 0, 0]], "between the walls"),
    ):
        with pytest.raises(BadInput, match=words):
            flow(PAPER, bad, 1)
    good = [[0.1, 0.2, 0.1, 0.2]]
    for periods in (-1, Fraction(3, 2)):
        with pytest.raises(BadInput, match="periods"):
            flow(PAPER, good, periods)
    with pytest.raises(BadInput, match="start"):
        flow(PAPER, good, 1, start=Fraction(1))
    with pytest.raises(BadInput, match="label"):
        Goals(stops=-1)
    with pytest.raises(BadInput, match="in order"):
        Goals(right=([0.0, 0.0], [1]))


def test_itineraries_as_numbers():
    """There and back; too long ones have no number."""
    words = ("hit r", "turn left", "stick", "release right")
    assert words_of(number_of(words)) == words
    assert number_of(words * 4) == -1
    assert holds(interval.ball(len(WORDS)), 9)


@pytest.mark.parametrize("f", [Fraction(1, 2), Fraction(7, 10)])
def test_slow_at_a_wall_when_it_lets_go(f):
    """Where a mass grazes a wall as the forcing away from it reaches f: small cells are decided."""
    p, random = replace(PAPER, f=f), seeded(10)
    slow = np.pi - np.arccos(float(f))  # then F cos t = -f: who is at rest at r leaves
    before = slow + np.array([random.uniform(-0.08, 0.02) for _ in range(120)])
    speeds = np.array([random.uniform(0, 4e-3) for _ in before])
    v = speeds - np.sin(before) + float(f) * before  # at t = 0, of the flight that arrives so
    x = 1 - (v * before + 1 - np.cos(before) - float(f) * before**2 / 2)
    good = (abs(x) < 1) & (v > 0)
    assert good.sum() > 20
    half = 2e-6
    boxes = np.stack([x - half, x + half, v - half, v + half], axis=1)[good]
    images = flow(p, boxes, 1)
    assert (images.verdict != OPEN).mean() > 0.97
    for k in np.flatnonzero(images.verdict == UNION):
        orbits, _ = followed(p, states(random, p, boxes[k], 20), 1)
        for i in range(20):
            check_orbit(p, images, k, orbits, i)
