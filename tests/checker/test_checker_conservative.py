"""The theorem ``conservative``: arcs, cells, the ceiling, the area; what is true, and lies."""

import json
import math
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import pytest
from support import rounds, seeded

from cap.cells.listing import Run as Listed
from cap.cells.listing import listed, written
from cap.checker.flow.arc import Arc, Image, Launches, least
from cap.checker.flow.ceiling import Flights, closed, descends, returns_in_time
from cap.checker.flow.columns import Run, column, integers, lines
from cap.checker.flow.overlap import gaps, mirrored, shared
from cap.checker.flow.strips import Ceiling, World, along, fails
from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER
from checker.altered import changed, encode, fits_the_schema, rejected

FILE = Path(__file__).parents[1] / "certificates/accept/conservative_by_three_flights.json"
CERTIFICATE = json.loads(FILE.read_text())
F, R = enclosing(Fraction(2, 5)), Double(2.0)
CEILING = [Fraction(CERTIFICATE["hints"]["ceiling"][k]) for k in ("height", "phase", "level")]
LINES = lines(CERTIFICATE["hints"]["lines"])


def world(name="forward"):
    """Return the cells of the certificate."""
    a, b, c = map(enclosing, CEILING)
    columns = [column(text) for text in CERTIFICATE["hints"][name]]
    if name == "forward":
        return World(F, R, Ceiling(a, b, c), LINES, columns)
    return World(-F, R, Ceiling(a, -b, c), [-t for t in reversed(LINES)], columns)


def hit(t, E):
    """Return the time and the speed of the next hit of a launch from the left, in floats."""
    return itinerary(PAPER, -1 + 1e-13, math.sqrt(2 * E), t + 9, start=t).events[0]


def test_images_contain_flights():
    """Along random arcs, at random places; many of them are followed."""
    random, followed = seeded(3), 0
    for _ in range(rounds(60)):
        t, e = random.uniform(3.3, 4.6), random.uniform(0.5, 0.9)
        e1, e2 = random.uniform(-0.02, 0.02), random.uniform(-1e-3, 1e-3)
        arc = Arc(Double(t), Double(0.01), Double(e), Double(e1), Double(e2))
        try:
            image = Image(Launches(arc, F, R))
        except Rejected:
            continue
        followed += 1
        s = random.uniform(-1, 1)
        event = hit(t + 0.01 * s, e + s * (e1 + s * e2))
        assert event.word == "hit r"
        a, b, c = image.T
        low, high = (a.mid + s * b.mid + s * s * end / 2 for end in (c.lower, c.upper))
        assert low - 1e-9 <= event.time <= high + 1e-9
    assert followed > 20


def test_the_least_value():
    """It is below all values, and little below the least one."""
    z = Double(1.0), Double(-0.3), Double(-0.2, 0.01)
    values = [1 - 0.3 * s - 0.105 * s * s for s in (-1, 0, 1)]
    assert least(z) <= min(values)
    assert least(z) > min(values) - 0.01


NAN = Double(math.nan)


@pytest.mark.parametrize("k", range(3))
def test_what_is_no_number_is_not_the_least(k):
    """Wherever NaN is, the least value is above nothing, and below nothing."""
    z = [Double(1.0)] * 3
    z[k] = NAN
    assert math.isnan(least(tuple(z)))


@pytest.mark.parametrize(("velocity", "stops"), [(Double(-1e-3), True), (NAN, False)])
def test_a_fall_that_is_no_number(velocity, stops):
    """How far a mass falls back before it stops is known, or nothing is proved."""
    zero, T = Double(0.0), Double(2.0)

    def of(z):
        return z, zero, zero

    launches = SimpleNamespace(
        all=SimpleNamespace(t=zero),
        minima=lambda *_: [Double(1.0)],
        velocity=lambda at: of(Double(-1e-3) if at is T else velocity),
        place=lambda _: of(Double(0.5)),
    )
    assert world()._stops_by(launches, zero, T) is stops


@pytest.mark.parametrize(("speed", "holds"), [(Double(0.1), True), (NAN, False)])
def test_a_speed_that_is_no_number(speed, holds):
    """A hit of no known speed is not below the ceiling."""
    top = Ceiling(*map(Double, (0.8, 0.1, 0.64)))
    flight = SimpleNamespace(T=Double(0.0), t=Double(0.0), V=speed, sum=NAN, difference=NAN)
    flights = SimpleNamespace(
        never=lambda _: False, shortest=0, longest=1, examine=lambda *given: given[-1](flight)
    )
    assert descends(flights, top) is holds


def test_columns_as_text():
    """Integers are read as they are written; what cannot be read is rejected."""
    numbers = [0, -1, 1, 31, -32, 10**9, -(10**12)]
    assert integers(written(numbers)) == numbers
    for wrong in ("g", "?", "A", "AAAA", ""):
        with pytest.raises(Rejected):
            column(wrong)
    with pytest.raises(Rejected):
        lines("A")


def test_the_cells_hold():
    """Of some columns all is proved again."""
    for name in ("forward", "backward"):
        whole = world(name)
        for j in (60, 100, 110):
            whole.prove(j)
            assert fails(whole, j, 1) == []


def altered(j, change):
    """Prove the first column from j on of which ``change`` makes another; return what fails."""
    whole = world()
    for k in range(j, len(whole.columns)):
        other = change(whole.columns[k])
        if other is not None:
            whole.columns[k] = other
            with pytest.raises(Rejected):
                whole.prove(k)
            return
    pytest.fail("nothing was changed")


def test_a_bottom_that_does_not_stop():
    """It is raised by a thousandth."""

    def raised(runs):
        if not runs[0].bottom:
            return None
        (a, b, c), *rest = runs[0].edges
        return [runs[0]._replace(edges=[(a + 300_000, b, c), *rest]), *runs[1:]]

    altered(90, raised)


def test_a_top_that_is_not_above():
    """It is lowered by a thousandth."""

    def lowered(runs):
        *rest, (a, b, c) = runs[-1].edges
        return [*runs[:-1], runs[-1]._replace(edges=[*rest, (a - 300_000, b, c)])]

    altered(90, lowered)


def test_a_level_that_is_too_low():
    """A cell of level 2 says 1, or 3 says 2."""

    def cheated(runs):
        for k, run in enumerate(runs):
            if run.levels and max(run.levels) > 1:
                levels = [max(1, level - 1) for level in run.levels]
                return [*runs[:k], run._replace(levels=levels), *runs[k + 1 :]]
        return None

    altered(90, cheated)


@pytest.mark.parametrize("end", [0, -1])
def test_a_cell_that_is_too_large(end):
    """An edge is moved outwards."""

    def enlarged(runs):
        for k, run in enumerate(runs):
            if run.levels and not (run.top or run.bottom):
                edges = list(run.edges)
                a, b, c = edges[end]
                edges[end] = (a + (600_000 if end else -600_000), b, c)
                return [*runs[:k], run._replace(edges=edges), *runs[k + 1 :]]
        return None

    altered(90, enlarged)


@pytest.mark.parametrize("level", [1 << 29, 1 << 31])
def test_no_level_is_above_a_gap(level):
    """However high the level of a cell, it may not fly to where there is none."""
    whole, j, n = world(), 114, 1
    before, run = whole.columns[j][n - 1 : n + 1]
    pairs = zip(before.edges[-1], run.edges[0], strict=True)
    low = tuple(round(0.05 * p + 0.95 * q) for q, p in pairs)  # most of the gap below the run
    other = run._replace(edges=[low, *run.edges], levels=[level, *run.levels])
    whole.columns[j] = [*whole.columns[j][:n], other, *whole.columns[j][n + 1 :]]
    with pytest.raises(Rejected):
        whole.falls(j, level, low, run.edges[0])


def test_a_run_of_too_many_edges():
    """It is rejected before anything is made of their number."""
    with pytest.raises(Rejected, match="more edges than are listed"):
        column(written([4 * (1 << 40) + 2]))


def test_a_column_that_is_too_long():
    """Gaps may all meet each other, as curved ones do: their number is bounded."""
    few, many = (written([*([4, n, 0, 0] * n), 6, n, 0, 0]) for n in (1000, 2000))
    assert len(gaps(column(few))) == 1001
    with pytest.raises(Rejected, match="too many edges"):
        column(many)


def test_an_arccosine_that_is_wrong(monkeypatch):
    """The times of the minima are not believed of the library."""
    launches = Launches(Arc(Double(4.0), Double(0.01), Double(0.7), Double(0.0), Double(0.0)), F, R)
    assert launches.minima(4.0, 20.0)
    exact = math.acos
    monkeypatch.setattr("math.acos", lambda y: exact(y) + 1e-8)
    with pytest.raises(Rejected):
        launches.minima(4.0, 20.0)


def test_an_island_is_no_cell():
    """A disk around the elliptic orbit is mapped to where no cell is."""
    whole = world()
    t = next(j for j, line in enumerate(LINES) if line > 4.2)
    disk = [(a, 0, 0) for a in (round(0.49 * 2**28), round(0.5 * 2**28))]
    whole.columns[t] = [Run(disk, [9], bottom=False, top=False), whole.columns[t][-1]]
    with pytest.raises(Rejected):
        whole.prove(t)


def test_the_ceiling():
    """It is one, and a lower one or another function are not."""
    a, b, c = map(enclosing, CEILING)
    flights = Flights(F, R)
    assert descends(flights, Ceiling(a, b, c)) > 1000
    closed(Ceiling(a, b, c), LINES[0], LINES[-1])
    returns_in_time(flights, LINES[0], LINES[-1])
    with pytest.raises(Rejected, match="miss some times"):
        closed(Ceiling(a, b, c), LINES[1], LINES[-1])
    with pytest.raises(Rejected):
        returns_in_time(flights, LINES[0] - 6, LINES[-1])


def test_a_ceiling_that_is_too_low(monkeypatch):
    """W need not decrease below."""
    monkeypatch.setattr("cap.checker.flow.ceiling.MOST", 20_000)
    a, b, _ = map(enclosing, CEILING)
    with pytest.raises(Rejected, match="too many boxes"):
        descends(Flights(F, R), Ceiling(a, b, Double(0.5)))


def test_high_speeds():
    """V_1 at the paper's parameters; random fast launches are slower after two flights."""
    flights, random = Flights(F, R), seeded(4)
    assert flights.fastest.mid == pytest.approx(math.sqrt(2.5**2 + 11.2 + 4.8))
    for _ in range(rounds(20)):
        t, u = random.uniform(0, 6.3), random.uniform(4.2, 9)
        events = itinerary(PAPER, -1 + 1e-13, u, t + 5, start=t).events[:2]
        assert [event.word for event in events] == ["hit r", "hit l"]
        assert abs(events[1].velocity) < u


def test_areas():
    """Two strips that cross; columns of which all or nothing is left."""
    unit = 2**28
    top = Run([(unit, 0, 0)], [], bottom=False, top=True)
    low = Run([(unit // 4, 0, 0)], [], bottom=True, top=False)
    assert shared(gaps([low, top]), gaps([top])) == pytest.approx(0.75, abs=1e-6)
    assert shared(gaps([low, top]), gaps([low, top])) == pytest.approx(0.75, abs=1e-6)
    one = [((unit // 2, unit // 8, 0), (unit // 2 + unit // 64, unit // 8, 0))]
    crossing = shared(one, mirrored(one))
    assert crossing == pytest.approx((1 / 64) ** 2 / (2 / 8) / 2, rel=1e-3)
    assert shared(one, mirrored(one)) >= (1 / 64) ** 2 / (2 / 8) / 2


def test_curved_gaps_are_not_lost():
    """The bound is above the area, and near it."""
    unit = 2**28
    bent = [((unit // 2, 0, unit // 100), (unit // 2 + unit // 50, 0, unit // 100))]
    flat = [((unit // 2, 0, 0), (unit // 2 + unit // 50, 0, 0))]
    exact = sum(max(0, 0.02 - 0.01 * (k / 5000 - 1) ** 2) for k in range(10001)) / 10001
    found = shared(bent, flat)
    assert exact <= found + 1e-6
    assert found < exact * 1.1


def test_the_certificate():
    """The schema describes it; that it is verified says `test_certificates.py`."""
    fits_the_schema(CERTIFICATE)


@pytest.mark.parametrize(
    ("path", "value", "why"),
    [
        (("claims", "speed"), "2.2", "speed may be larger"),
        (("hints", "ceiling", "level"), "65/100", "top is not above|miss some times"),
        (("hints", "forward"), CERTIFICATE["hints"]["forward"][1:], "not one entry"),
        (("parameters", "f"), "39/100", "may not|may stop"),
    ],
)
def test_lies(monkeypatch, path, value, why):
    """Each is rejected for its reason; the ceiling is not examined again."""
    monkeypatch.setattr("cap.checker.theorems.conservative.descends", lambda *_: 0)
    monkeypatch.setattr(World, "prove", World.prove if path[0] != "claims" else lambda *_: None)
    rejected(changed(CERTIFICATE, *path, value), why)


def test_less_area(monkeypatch):
    """The area claimed is what is left, and no less."""
    monkeypatch.setattr("cap.checker.theorems.conservative.descends", lambda *_: 0)
    monkeypatch.setattr(World, "prove", lambda *_: None)
    less = str(Fraction(CERTIFICATE["claims"]["area"]) - Fraction(1, 5000))
    rejected(changed(CERTIFICATE, "claims", "area", less), "more area is left")
    for name in ("forward", "backward"):
        fewer = [*CERTIFICATE["hints"][name]]
        *_, top = column(fewer[80])
        fewer[80] = listed([Listed(top.edges[-1:], [], 2)])
        rejected(changed(CERTIFICATE, "hints", name, fewer), "more area is left")


def test_arcs_are_halved():
    """Until it is certain, or too often."""
    arc = Arc(Double(4.0), Double(0.5), Double(0.5), Double(0.1), Double(0.01))
    assert along(arc, lambda each: each.dt.mid < 0.01)
    assert not along(arc, lambda each: each.t.mid < 4)


def test_words():
    """The line states what was proved."""
    from cap.checker.verdict import words  # noqa: PLC0415

    certificate = check.__globals__["read"](encode(CERTIFICATE))
    assert "never vanishes" in words(certificate)
