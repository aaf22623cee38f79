"""The theorem ``conservative``: arcs, cells, the ceiling, the area; what is true, and lies."""

import base64
import json
import math
import zlib
from fractions import Fraction
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from support import rounds, seeded

from cap.areas.listing import Run as Listed
from cap.areas.listing import listed, written
from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.parabolas import BYTES, integers
from cap.checker.kernel.processes import Work
from cap.checker.kernel.rejection import Rejected
from cap.checker.strips import overlap, strips
from cap.checker.strips.arc import Arc, Launches, least
from cap.checker.strips.ceiling import Flights, closed, descends, returns_in_time
from cap.checker.strips.columns import LINE, Run, columns, lines
from cap.checker.strips.images import image
from cap.checker.strips.landing import Place, positive
from cap.checker.strips.overlap import gaps, left, mirrored, shared
from cap.checker.strips.stopping import stops_by
from cap.checker.strips.strips import Ceiling, TooLong, World, along
from cap.checker.theorems.conservative import Conservative
from cap.checker.verdict import check
from cap.flow.itinerary import itinerary
from cap.parameters import PAPER
from checker.altered import changed, encode, fits_the_schema, rejected

FILE = Path(__file__).parents[1] / "certificates/accept/conservative_by_three_flights.json"
CERTIFICATE = json.loads(FILE.read_text("utf-8"))
F, R = enclosing(Fraction(2, 5)), Double(2.0)
CEILING = [Fraction(CERTIFICATE["hints"]["ceiling"][k]) for k in ("height", "phase", "level")]
NAN = Double(math.nan)
LISTED = {
    name: [
        [Listed(run.edges, run.levels, run.bottom + 2 * run.top) for run in runs]
        for runs in columns(CERTIFICATE["hints"][name])
    ]
    for name in ("forward", "backward")
}
LINES = lines(CERTIFICATE["hints"]["lines"])


def world(name="forward"):
    """Return the cells of the certificate."""
    a, b, c = map(enclosing, CEILING)
    cells = columns(CERTIFICATE["hints"][name])
    if name == "forward":
        return World(F, R, Ceiling(a, b, c), LINES, cells)
    return World(-F, R, Ceiling(a, -b, c), [-t for t in reversed(LINES)], cells)


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
            found = image(Launches(arc, F, R))
        except Rejected:
            continue
        followed += 1
        s = random.uniform(-1, 1)
        event = hit(t + 0.01 * s, e + s * (e1 + s * e2))
        assert event.word == "hit r"
        a, b, c = found.T
        low, high = (a.mid + s * b.mid + s * s * end / 2 for end in (c.lower, c.upper))
        assert low - 1e-9 <= event.time <= high + 1e-9
    assert followed > 20


def test_the_least_value():
    """It is below all values, and little below the least one."""
    z = Double(1.0), Double(-0.3), Double(-0.2, 0.01)
    values = [1 - 0.3 * s - 0.105 * s * s for s in (-1, 0, 1)]
    assert least(z) <= min(values)
    assert least(z) > min(values) - 0.01


def test_what_is_positive_on_a_part():
    """A quadratic is, if its least value there is; near that nothing is refused."""
    random, found = seeded(5), set()
    for _ in range(rounds(300)):
        part = sorted(random.uniform(-1, 1) for _ in range(2))
        a, b, c = (random.uniform(-1, 1) for _ in range(3))
        values = [a + r * (b + r * c / 2) for r in np.linspace(*part, 200)]
        holds = positive((Double(a), Double(b), Double(c, 1e-12)), part)
        found.add(holds)
        assert min(values) >= 0 if holds else min(values) < 1e-3
    assert found == {True, False}


@pytest.mark.parametrize("k", range(3))
def test_what_is_no_number_is_not_positive(k):
    """Wherever NaN is, and at whatever end."""
    z = [Double(1.0)] * 3
    z[k] = NAN
    for part in ((-1.0, 1.0), (-0.5, 0.7), (0.25, 1.0)):
        assert positive([Double(1.0)] * 3, part)
        assert not positive(z, part)


def test_the_part_in_a_column():
    """It has all places of the arc at which the column is met, and may be none."""
    arc = Arc(Double(4.2), Double(0.005), Double(0.7), Double(0.02), Double(0.001))
    found, met = image(Launches(arc, F, R)), set()
    first = round(found.T[0].mid * 64) - 32
    for k in range(first, first + 64):
        low, high = k / 64, (k + 1) / 64
        part = Place(found, (low, high)).part
        met.add(part is None)
        for r in np.linspace(-1, 1, 41):
            time = hit(4.2 + 0.005 * r, 0.7 + r * (0.02 + 0.001 * r)).time
            if low <= time <= high:
                assert part[0] - 1e-9 <= r <= part[1] + 1e-9
    assert met == {True, False}


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
        R=R,
        all=SimpleNamespace(t=zero),
        near=SimpleNamespace(t=zero),
        minima=lambda *_: [Double(1.0)],
        velocity=lambda at: of(Double(-1e-3) if at is T else velocity),
        place=lambda _: of(Double(0.5)),
    )
    assert stops_by(launches, zero, T) is stops


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
    numbers = [0, -1, 1, 63, -64, 10**9, -(10**12)]
    assert list(integers(written(numbers))) == numbers
    good = written([2, 10, 5, 6, 100, 7, 100, -2, 2, 3, 0, 0, 0])
    assert columns(good) == [
        [Run([(100, -2, 0), (107, 0, 0)], [5], bottom=False, top=True)],
        [Run([(100, 3, 0)], [], bottom=False, top=True)],
    ]
    for wrong in ("g", '"', "é", "AAAA", "", good[:-5], good + good):
        with pytest.raises(Rejected):
            columns(wrong)
    with pytest.raises(Rejected):
        lines("A")


def test_lines_that_are_none():
    """They begin at 0 or later, and widths are powers of 2."""
    assert lines(written([0, 2, 4])) == [0, 2 * LINE, 6 * LINE]
    for numbers, why in (
        ([-1, 2, 4], "too far away"),
        ([0, 3], "power of 2"),
        ([0, 0], "power of 2"),
        ([0], "no columns"),
        ([], "no columns"),
    ):
        with pytest.raises(Rejected, match=why):
            lines(written(numbers))


@pytest.mark.parametrize(
    ("numbers", "why"),
    [
        ([], "no columns"),
        ([5000], "too many"),
        ([1, 4, 1, 1, 1], "to the top|end at the top"),
        ([1, 2, 1, 0, 0], "no edge"),
        ([1, 10, 0, 1, 1, 0, 0, 0, 0], "no level"),
        ([1, 6, 1, 0], "missing"),
        ([1, 6, 1, 0, 0, 0], "goes on"),
        ([1, 6, 1 << 50, 0, 0], "too far"),
        ([1, 10, 1, 1, -1, 0, 0, 0, 0], "not below"),
        ([1, 4, 7, 1, 1, 0, 0, 0, 0], "has the bottom"),
    ],
)
def test_columns_that_are_none(numbers, why):
    """Each is rejected for its reason."""
    with pytest.raises(Rejected, match=why):
        columns(written(numbers))


def test_what_is_packed_too_well():
    """Of a text that would fill the memory no more is unpacked than is allowed."""
    data = zlib.compress(bytes(BYTES + 1), 9)
    assert len(data) < 20_000
    with pytest.raises(Rejected, match="too long"):
        columns(base64.b85encode(data).decode())
    with pytest.raises(Rejected, match="an integer is too long"):
        columns(base64.b85encode(zlib.compress(b"\xff" * 100)).decode())


def test_the_cells_hold():
    """Of some columns all is proved again."""
    for name in ("forward", "backward"):
        whole = world(name)
        for j in (60, 100, 110):
            whole.prove(j)


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
        return [runs[0]._replace(edges=[(a + 20_000, b, c), *rest]), *runs[1:]]

    altered(90, raised)


def test_a_top_that_is_not_above():
    """It is lowered by a thousandth."""

    def lowered(runs):
        *rest, (a, b, c) = runs[-1].edges
        return [*runs[:-1], runs[-1]._replace(edges=[*rest, (a - 20_000, b, c)])]

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
                edges[end] = (a + (40_000 if end else -40_000), b, c)
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
    with pytest.raises(Rejected, match="too many edges"):
        columns(written([1, 4 * (1 << 40) + 2]))


def test_a_column_that_is_too_long():
    """Gaps may all meet each other, as curved ones do: their number is bounded."""
    few, many = ([1, *[4] * (n - 1), 6, *[9] * n, *[0] * 2 * n] for n in (1001, 2101))
    assert len(gaps(*columns(written(few)))) == 1001
    with pytest.raises(Rejected, match="too many edges"):
        columns(written(many))


def test_pairs_of_gaps_are_bounded(monkeypatch):
    """Four gaps that meet four others are sixteen pairs, in each part."""
    four = [((1 << 20, 0, 0), (1 << 21, 0, 0))] * 4
    monkeypatch.setattr(overlap, "MOST", 16)
    assert shared(four, four) == pytest.approx(16 / 16, rel=1e-6)
    monkeypatch.setattr(overlap, "MOST", 15)
    with pytest.raises(Rejected, match="too many gaps"):
        shared(four, four)


@pytest.mark.parametrize("free", ["ARC", "columns"])
def test_arcs_and_columns_are_bounded(monkeypatch, free):
    """Either is too much alone: arcs, and the columns that they meet."""
    if free == "ARC":
        monkeypatch.setattr(strips, "ARC", 0)
    else:
        monkeypatch.setattr(World, "crossed", lambda *_: range(0))
    whole = world()
    j = next(j for j, runs in enumerate(whole.columns) if any(run.levels for run in runs))
    whole.prove(j)
    monkeypatch.setattr(strips, "MOST", whole.work - 1)
    assert whole.work > 0
    again = world()
    with pytest.raises(TooLong, match="too many columns"):
        again.prove(j)


def test_an_arccosine_that_is_wrong(monkeypatch):
    """The times of the minima are not believed of the library."""
    arc = Arc(Double(4.0), Double(0.01), Double(0.7), Double(0.0), Double(0.0))
    assert Launches(arc, F, R).minima(4.0, 20.0)
    exact = math.acos
    monkeypatch.setattr("math.acos", lambda y: exact(y) + 1e-8)
    with pytest.raises(Rejected):
        Launches(arc, enclosing(Fraction(2, 5)), R).minima(4.0, 20.0)


def test_a_velocity_that_is_zero_at_a_minimum(monkeypatch):
    """A flight on which it is does not move on."""
    launches = Launches(Arc(*map(Double, (4.0, 0.01, 0.7, 0.0, 0.0))), F, R)
    for v, moves in ((1e-9, True), (0.0, False), (-1e-9, False)):
        monkeypatch.setattr("cap.checker.strips.arc.least", lambda _, v=v: v)
        assert launches.moves(20.0) == moves


def test_an_island_is_no_cell():
    """A disk around the elliptic orbit is mapped to where no cell is."""
    whole = world()
    t = next(j for j, line in enumerate(LINES) if line > 4.2)
    disk = [(a, 0, 0) for a in (round(0.49 * 2**24), round(0.5 * 2**24))]
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
    monkeypatch.setattr("cap.checker.strips.ceiling.MOST", 20_000)
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
    unit = 2**24
    top = Run([(unit, 0, 0)], [], bottom=False, top=True)
    low = Run([(unit // 4, 0, 0)], [], bottom=True, top=False)
    assert shared(gaps([low, top]), gaps([top])) == pytest.approx(0.75, abs=1e-6)
    assert shared(gaps([low, top]), gaps([low, top])) == pytest.approx(0.75, abs=1e-6)
    one = [((unit // 2, unit // 8, 0), (unit // 2 + unit // 64, unit // 8, 0))]
    crossing = shared(one, mirrored(one))
    assert crossing == pytest.approx((1 / 64) ** 2 / (2 / 8) / 2, rel=1e-3)
    assert shared(one, mirrored(one)) >= (1 / 64) ** 2 / (2 / 8) / 2


def test_areas_in_processes():
    """Of the columns of the second family the last one is the mirror image of the first."""
    gap = ((1 << 20, 1 << 15, 0), (1 << 21, 1 << 15, 1 << 10))
    forward, backward = [[gap], []], [[], mirrored([gap])]

    def work(jobs, told=lambda *_: None):
        return partial(Work(jobs, told, {"before": 6, "gaps": 2}), words="gaps")

    for jobs in (1, 2):
        told = []
        areas = left(work(jobs, lambda *each: told.append(each)), forward, backward)  # noqa: B023
        assert areas == [shared([gap], [gap]), 0.0]
        assert told == [("gaps", part) for part in (0.75, 0.875, 1.0)]
    with pytest.raises(ValueError, match="shorter"):
        left(work(1), forward, backward[1:])


def test_curved_gaps_are_not_lost():
    """The bound is above the area, and near it."""
    unit = 2**24
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
        (("hints", "forward"), listed(LISTED["forward"][1:]), "not one entry"),
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
        fewer = [*LISTED[name]]
        *_, top = fewer[80]
        fewer[80] = [Listed(top.edges[-1:], [], 2)]
        rejected(changed(CERTIFICATE, "hints", name, listed(fewer)), "more area is left")


def test_the_unit_of_the_area(monkeypatch):
    """It is F^2/omega^3, in which one is left."""
    conservative = "cap.checker.theorems.conservative"
    for name, value in (("left", lambda *_: [1.0]), ("gaps", list), ("_LEFT", "left")):
        monkeypatch.setattr(f"{conservative}.{name}", value)
    theorem = SimpleNamespace(
        work=print,
        phases=lambda: {"left": 1.0},
        p=SimpleNamespace(F=Fraction(2), omega=Fraction(3)),
        claims={"area": Fraction("0.1481482")},
        step=lambda _: None,
    )
    Conservative.compare_area(theorem, [0.0, 1.0], [[]], [])
    theorem.claims["area"] = Fraction("0.1481481")  # less than 4/27
    with pytest.raises(Rejected, match="more area is left"):
        Conservative.compare_area(theorem, [0.0, 1.0], [[]], [])


def test_processes(monkeypatch):
    """They prove what holds, and refuse what does not."""
    monkeypatch.setattr("cap.checker.theorems.conservative.descends", lambda *_: 0)
    other = [*LISTED["backward"]]
    *runs, top = other[80]
    lower = [(a - 20_000, b, c) for a, b, c in top.edges[-1:]]
    other[80] = [*runs, top._replace(edges=[*top.edges[:-1], *lower])]
    wrong = changed(CERTIFICATE, "hints", "backward", listed(other))
    steps = []
    with pytest.raises(Rejected, match="above the ceiling"):
        check(encode(wrong), steps.append, jobs=2)
    assert any("forward: from" in step for step in steps)


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
