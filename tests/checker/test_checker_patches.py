"""Patches of the checker: where all launches between two arcs land, and how that is shown."""

import json
import math
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import pytest
from support import rounds, seeded

from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.rejection import Rejected
from cap.checker.strips.arc import Arc, Launches
from cap.checker.strips.columns import columns, lines
from cap.checker.strips.images import image
from cap.checker.strips.landing import Place
from cap.checker.strips.patches import Patch, Spread
from cap.checker.strips.strips import Ceiling, World
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER

F, R = enclosing(Fraction(2, 5)), Double(2.0)
UNIT = 2**24
NONE = Double(0.0)
FILE = Path(__file__).parents[1] / "certificates/accept/conservative_by_three_flights.json"


def value(arc, s):
    """Return the energy of an arc at a place."""
    return arc.e.mid + s * (arc.e1.mid + s * arc.e2.mid)


def hit(t, E):
    """Return the time and the energy of the next hit of a launch from the left, in floats."""
    event = itinerary(PAPER, -1 + 1e-13, math.sqrt(2 * E), t + 9, start=t).events[0]
    assert event.word == "hit r"
    return event.time, event.velocity**2 / 2


def drawn(random):
    """Return a patch, and its image."""
    while True:
        numbers = random.uniform(3.3, 4.6), random.uniform(0.5, 0.9)
        t, e, e1 = *numbers, random.uniform(-0.02, 0.02)
        rise = [random.uniform(1e-6, 2e-3), random.uniform(-4e-7, 4e-7), random.uniform(0, 1e-7)]
        low = Arc(Double(t), Double(0.002), Double(e), Double(e1), Double(1e-4))
        high = Arc(*low[:2], *(p + q for p, q in zip(low[2:], rise, strict=True)))
        try:
            return Patch(low, high), Spread(Patch(low, high), F, R).roughly(NONE)
        except Rejected:
            continue


def test_all_of_a_patch_lands_between_its_arcs():
    """Earlier than the lower arc and later than the upper one, by no more than is said."""
    random = seeded(6)
    for _ in range(rounds(25)):
        patch, spread = drawn(random)
        s = random.uniform(-1, 1)
        t, (e, E) = patch.low.t.mid + 0.002 * s, (value(arc, s) for arc in patch)
        late, between, early = (hit(t, e + part * (E - e))[0] for part in (0, random.random(), 1))
        assert spread.times.lower - 1e-9 <= early <= between <= late <= spread.times.upper + 1e-9
        assert late - early <= spread.wait
        assert spread.wait < 3 * (late - early) + 1e-6


def test_what_lands_lowest():
    """Of the orbits at one time, above an edge: the slowest or the fastest, as is said."""
    random, found = seeded(7), set()
    for _ in range(rounds(40)):
        patch, spread = drawn(random)
        t, energies = patch.low.t.mid, [value(arc, 0) for arc in patch]
        first = math.floor(spread.times.mid * 64) / 64
        between = first, first + 1 / 64
        edge = (UNIT // 2, round(random.uniform(-1, 1) * UNIT / 256), round(random.uniform(0, 100)))
        low, _ = spread.places(between)
        try:
            is_low = spread.gain(edge, low) < 0
        except Rejected:
            continue
        images = [hit(t, energies[0] + k / 4 * (energies[1] - energies[0])) for k in range(5)]
        rest = []
        for T, E in images:
            s = (T - first) * 128 - 1
            rest.append(E - sum(q * s**k for k, q in enumerate(edge)) / UNIT)
        found.add(is_low)
        assert rest == sorted(rest, reverse=not is_low)
    assert found == {True, False}


def test_an_edge_along_a_patch_decides_nothing():
    """Its orbits land along an edge at one slope; there neither of them is the lowest for sure."""
    patch, spread = drawn(seeded(8))
    t, (e, E) = patch.low.t.mid, (value(arc, 0) for arc in patch)
    (late, slow), (early, fast) = hit(t, e), hit(t, E)
    slope = (fast - slow) / (early - late)
    with pytest.raises(Rejected, match="along"):
        spread.gain((UNIT // 2, round(slope / 128 * UNIT), 0), Place(spread.low, (0, 1 / 64)))


def test_places_reach_beyond_the_lines():
    """By as much as orbits of a patch may be apart: later for the slow, earlier for the fast."""
    _, spread = drawn(seeded(9))
    end = spread.low.T[0].mid
    for arc, by in ((spread.low, -0.5), (spread.high, 0.5)):
        line = arc.T[0].mid + by * spread.wait
        column = (line - 1 / 64, line) if by < 0 else (line, line + 1 / 64)
        low, high = spread.places(column)
        reached, plain = (low if by < 0 else high).part, Place(arc, column).part
        assert reached[0] <= plain[0] if plain else True
        assert reached[1] - reached[0] > (plain[1] - plain[0] if plain else 0)
    assert end > spread.high.T[0].mid


def test_a_patch_that_stops():
    """Its lower arc does not reach the wall."""
    low = Arc(Double(4.0), Double(0.002), Double(0.02), NONE, NONE)
    with pytest.raises(Rejected):
        Spread(Patch(low, low._replace(e=Double(0.021))), F, R)


def slices(level):
    """Yield a thin slice of each cell above a level, with its world and level."""
    hints = json.loads(FILE.read_text("utf-8"))["hints"]
    top = Ceiling(*(enclosing(Fraction(hints["ceiling"][k])) for k in ("height", "phase", "level")))
    world = World(F, R, top, lines(hints["lines"]), columns(hints["forward"]))
    for j, runs in enumerate(world.columns):
        for run in runs:
            for (low, high), each in zip(pairwise(run.edges), run.levels, strict=True):
                over = tuple(round(0.99 * p + 0.01 * q) for p, q in zip(low, high, strict=True))
                if each > level:
                    yield world, Patch(world.arc(j, low), world.arc(j, over)), each


def test_slices_of_cells():
    """Many are accepted at once; few of these at a level that is too low, none at the lowest."""
    accepted = [(world, patch) for world, patch, level in slices(1) if world.spreads(patch, level)]
    assert len(accepted) > 60
    assert sum(world.spreads(patch, 1) for world, patch in accepted) < len(accepted) / 3
    assert not any(world.spreads(patch, 0) for world, patch in accepted)


def test_where_a_line_is_crossed():
    """On the arc a time is passed in both intervals; the sharp one is smaller."""
    random = seeded(10)
    for _ in range(rounds(20)):
        patch, _ = drawn(random)
        found = image(Launches(patch.low, F, R))
        r = random.uniform(-0.9, 0.9)
        T = hit(patch.low.t.mid + 0.002 * r, value(patch.low, r))[0]
        if abs(found.dT.mid) <= 2 * found.dT.rad:
            continue
        rough, sharp = found.crossing(T), found.sharp_crossing(T)
        for z in (rough, sharp):
            assert z.lower - 1e-6 <= r <= z.upper + 1e-6
        assert sharp.rad < rough.rad


def test_a_line_that_is_not_crossed():
    """It is passed beyond an end, or nothing is said of it."""
    found = image(Launches(drawn(seeded(11))[0].low, F, R))
    early, late = found.times.lower - 0.01, found.times.upper + 0.01
    rising = found.dT.mid > 0
    for z in (found.crossing, found.sharp_crossing):
        first, last = (z(early), z(late)) if rising else (z(late), z(early))
        assert first.lower < -1
        assert last.upper > 1


def side():
    """Return a side, its energies and its image: faster launches hit earlier."""
    arc = Arc(Double(3.9), NONE, Double(0.7), Double(0.001), NONE)
    return image(Launches(arc, F, R))


def test_the_ends_of_a_side():
    """They hit when their flights do."""
    found = side()
    for s in (-1.0, 1.0):
        T = found.end(s)
        assert abs(T.mid - hit(3.9, 0.7 + 0.001 * s)[0]) < 1e-9
        assert T.rad < 1e-9
        assert found.times.lower <= T.mid <= found.times.upper


def test_what_grows_from_an_end():
    """It is not negative, if the end is in the column and known not to be; else that is open."""
    found = side()
    line = math.floor(found.end(-1.0).mid * 64) / 64
    z = Double(1e-4 - 1e-9), Double(1e-4), NONE  # -1e-9 at r = -1
    here, after = (Place(found, (low, low + 1 / 64)) for low in (line, line + 1 / 64))
    assert here.grows(z, (True, False))
    assert not after.grows(z, (True, False))
    assert not here.grows(z, (False, True))
    assert not here.grows((z[0], z[1], Double(0.0, 2e-4)), (True, False))
    assert not here.grows((z[0], Double(math.nan), NONE), (True, True))
    assert not here.clear(z, (False, False))


def test_energies_of_a_part():
    """They contain those of flights, and little more."""
    found = side()
    line = math.floor(found.end(1.0).mid * 64) / 64
    least, most = Place(found, (line, line + 1 / 64)).energies(-0.5, 0.25)
    energies = [hit(3.9, 0.7 + 0.001 * r)[1] for r in (-0.5, -0.2, 0.25)]
    assert least <= min(energies) < max(energies) <= most
    assert most - least < 1.2 * (max(energies) - min(energies))


def test_the_gap_to_an_edge():
    """Along a side, against flights: E - q, q = a + b s + c s^2 at the place s of their times."""
    found, edge = side(), (UNIT // 2, UNIT // 8, -UNIT // 4)
    line = math.floor(found.T[0].mid * 64) / 64
    z = Place(found, (line, line + 1 / 64)).gap(edge)
    for r in (-1, -0.5, 0, 0.5, 1):
        T, E = hit(3.9, 0.7 + 0.001 * r)
        s = (T - line) * 128 - 1
        gap = E - sum(q * s**k for k, q in enumerate(edge)) / UNIT
        told = z[0] + z[1] * float(r) + z[2] * (r * r / 2)
        assert told.lower - 1e-9 <= gap <= told.upper + 1e-9
        assert told.upper - told.lower < 1e-2 * (abs(z[1].mid) + 1e-3)
