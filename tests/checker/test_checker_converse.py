"""The theorem ``converse``: what is true is verified; each lie, and each guard, is noticed."""

import cmath
import json
import random
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.doubles import Double, enclosing
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems import converse
from cap.checker.theorems.converse import Converse, flights, pieces
from cap.checker.tori import segments
from cap.checker.tori.rings import Ring, offsets
from cap.checker.tori.segments import Segment, Sense
from cap.checker.verdict import words
from cap.floats.search.tori import HalfPeriod
from checker.altered import SMALL_LOSSES, changed, encode, fits_the_schema, rejected, verify

ROOT = Path(__file__).parents[2]
GOOD = json.loads((ROOT / "tests/certificates/accept/converse_small.json").read_text("utf-8"))
STORED = json.loads((ROOT / "certificates/converse.json").read_text("utf-8"))
CLAIMS, HINTS = GOOD["claims"], GOOD["hints"]
ORIGIN = Fraction(0), Fraction(0)
SQUARE = [(10**8, 10**8), (-(10**8), 10**8), (-(10**8), -(10**8)), (10**8, -(10**8))]
AT = Fraction(2, 5), Fraction(1)


def part(text, k, new):
    """Return a list in words with another item."""
    items = text.split(",")
    items[k] = new
    return ",".join(items)


def test_it_is_verified():
    """All steps; the schema describes it; the sentence has the numbers claimed."""
    assert len(verify(GOOD)) == 6
    fits_the_schema(GOOD)
    said = words(read(encode(GOOD)))
    for each in (CLAIMS["area"], "connected", "never vanishes", "no invariant disk"):
        assert each in said


FIRST, SECOND = CLAIMS["rings"]
HOW = HINTS["flights"]
LIES = {
    "the area": ("claims", "area", str(Fraction(CLAIMS["area"]) * 999 / 1000), "larger"),
    "sigma": ("claims", "map", "sigma", "inside|wall|vanish"),
    "a vertex far in": ("claims", "rings", 0, part(FIRST, 3, "1000 700"), "farther|stop|P\\*"),
    "the last ring smaller": (
        "claims",
        "rings",
        1,
        ",".join(f"{int(a) * 9 // 10} {int(b) * 9 // 10}" for a, b in offsets(SECOND)),
        "leave the ring before|hit|stop|speed",
    ),
    "no flight": ("hints", "flights", 0, part(HOW[0], 0, "1 1"), "may not stop"),
    "the other sense": (
        "hints",
        "flights",
        0,
        ",".join(f"{-a} {b}" for a, b in flights(HOW[0])),
        "stop|hit|wall|positive",
    ),
    "an odd number": ("hints", "flights", 1, part(HOW[1], 0, "3 1"), "may not stop|hit"),
    "an edge less": ("hints", "flights", 0, HOW[0].rpartition(",")[0], "one flight for each"),
    "a ring less": ("hints", "flights", HOW[:1], "for each ring"),
    "too long": ("hints", "flights", 0, ",".join(["99 99"] * 3000), "more than"),
    "words": ("hints", "flights", 0, "a b", "no list"),
    "no steps": ("hints", "flights", 0, part(HOW[0], 0, "0 1"), "no list"),
    "bits": ("hints", "bits", "4096", "bits"),
    "no polygon": ("claims", "rings", 0, "1 2 3", "no list of vertices"),
    "middle": ("hints", "middle", 0, "0.2", "lie inside|vanish|wall|elsewhere"),
    "radius": ("hints", "radius", "0", "radius"),
    "preconditioner": ("hints", "preconditioner", [["0", "0"], ["0", "0"]], "lie inside"),
}


@pytest.mark.parametrize("name", LIES)
def test_lies(name):
    """Each is rejected, by what it contradicts."""
    *path, value, why = LIES[name]
    rejected(changed(GOOD, *path, value), why)


def test_enclosures_are_moved():
    """P*."""
    for name in ("x", "v"):
        low, high = map(Fraction, CLAIMS[name])
        width = high - low
        for ends in ((low - width, low), (high, high + width), (high, low)):
            rejected(changed(GOOD, "claims", name, [str(e) for e in ends]), "contain|lower > upper")


def test_other_parameters():
    """No friction is refused; losses are no parameters; at others there is no such ring."""
    rejected(changed(GOOD, "parameters", "f", "0"), "0 < f")
    for loss in ({"mu": "0"}, *SMALL_LOSSES):
        rejected({**GOOD, "parameters": GOOD["parameters"] | loss}, "unknown fields")
    with pytest.raises(Rejected):
        verify(changed(GOOD, "parameters", "f", "2/5"))


@pytest.mark.parametrize(
    ("w", "why"),
    [
        (SQUARE[::-1], "farther around"),
        (SQUARE[1:] + SQUARE[:1], "once, from the axis"),
        (SQUARE * 2, "once, from the axis"),
        (SQUARE[:3], "farther around"),
        ([*SQUARE, (0, 1)], "farther around"),
    ],
)
def test_what_is_no_ring(w, why):
    """Clockwise, another beginning, twice around, not around."""
    with pytest.raises(Rejected, match=why):
        Ring(ORIGIN, w)


def test_rings_are_bounded():
    """A list of too many vertices is refused before it is read."""
    with pytest.raises(Rejected, match="more than"):
        offsets(",".join(["1 1"] * 20_001))


def test_a_ring():
    """Its area, what it surrounds."""
    ring = Ring(ORIGIN, SQUARE)
    assert ring.area == Fraction(4, 100)
    assert ring.surrounds(Fraction(9, 100))
    assert not ring.surrounds(Fraction(11, 100))


def test_the_area_in_units_of_the_system():
    """That of a ring times F^2/omega^3."""
    theorem = Converse(read(encode(GOOD)), lambda _: None)
    theorem.p = theorem.p._replace(F=Fraction(3), omega=Fraction(2))
    area = Fraction(4, 100) * 9 / 8
    for claimed in (area, area - Fraction(1, 10**9)):
        theorem.claims["area"] = claimed
        if claimed == area:
            theorem.area(Ring(ORIGIN, SQUARE))
        else:
            with pytest.raises(Rejected, match="area inside the last ring is larger"):
                theorem.area(Ring(ORIGIN, SQUARE))


def test_a_ring_that_is_no_square():
    """The largest square about O that lies inside of a triangle, beside its corners."""
    w = [(8, 1), (-3, 7), (-2, -5)]
    ring = Ring(ORIGIN, [(a * 10**7, b * 10**7) for a, b in w])
    for n in range(1, 400):
        corners = [(x * n / 100, y * n / 100) for x in (-1, 1) for y in (-1, 1)]
        inside = all(
            (c - a) * (y - b) > (d - b) * (x - a)
            for (a, b), (c, d) in pairwise([*w, w[0]])
            for x, y in corners
        )
        assert ring.surrounds(Fraction(n, 100) * Fraction(10**7, 10**9)) == inside


def test_points_on_a_triangle():
    """On its edges, rounded or not, they are not certainly beyond it."""
    rng = random.Random(13)  # noqa: S311
    for _ in range(100):
        places = [cmath.rect(rng.uniform(0.1, 1), x) * 10**9 for x in (0.2, 2.3, 4.4)]
        w = [(round(z.real), round(z.imag)) for z in places]
        ring, i = Ring(ORIGIN, w), rng.randrange(3)
        part, beyond = Fraction(rng.randrange(1, 10**6), 10**6), 1 + Fraction(1, 10**9)
        (a, b), (c, d) = w[i], w[(i + 1) % 3]
        across = a + part * (c - a), b + part * (d - b)
        for q, far in (
            (across, False),
            ((part * a, part * b), False),
            ((part * c, part * d), False),
            ((beyond * across[0], beyond * across[1]), True),
        ):
            x, y = (enclosing(Fraction(n) / 10**9) for n in q)
            assert ring._beyond(i, (x, y)) == far


def test_what_is_outside():
    """Segments of random size against a star: never said to be outside if a point is not."""
    rng = random.Random(3)  # noqa: S311
    angles = sorted(rng.uniform(-3.1, 3.1) for _ in range(24))
    star = [cmath.rect(rng.uniform(0.05, 0.2), a) * 10**9 for a in angles]
    w = [(round(z.real), round(z.imag)) for z in star]
    begin = next(k for k, (_, v) in enumerate(w) if v >= 0)
    ring = Ring(ORIGIN, w[begin:] + w[:begin])
    corners = [complex(a, b) / 1e9 for a, b in ring.w]

    def inside(z):
        for p, q in zip(corners, corners[1:] + corners[:1], strict=True):
            s = (p.conjugate() * z).imag, (z.conjugate() * q).imag
            if min(s) >= 0 and ((q - p).conjugate() * (z - p)).imag >= 0:
                return True
        return False

    told = [0, 0]
    for _ in range(1500):
        sign = rng.choice([1.0, -1.0])
        y, v, size = (
            rng.uniform(-0.3, 0.3),
            rng.uniform(-0.3, 0.3),
            rng.choice([0.003, 0.03]),
        )
        dy, dv, r = (rng.uniform(-size, size) for _ in range(3))
        z = Segment(y, v, dy, dv, 0.8, 0.6, abs(r), abs(r) / 3)
        out = ring.excludes(z, sign)
        points = [
            complex(
                sign * (y + dy * s + 0.8 * a * z.r1 - 0.6 * b * z.r2),
                v + dv * s + 0.6 * a * z.r1 + 0.8 * b * z.r2,
            )
            for s in (-1, -0.3, 0.3, 1)
            for a in (-1, 0, 1)
            for b in (-1, 0, 1)
        ]
        some = any(map(inside, points))
        assert not (out and some)
        told[out] += not some
    assert told[1] > 0.6 * sum(told)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_states_are_carried(sign):
    """Random states of a segment are in its image, as doubles compute them, and go back."""
    rng = random.Random(5)  # noqa: S311
    sense, sigma = Sense(*AT, sign), HalfPeriod(0.4, 1.0)
    for _ in range(200):
        x, v = 0.1 + rng.uniform(-0.02, 0.02), 0.54 + rng.uniform(-0.02, 0.02)
        dy, dv = rng.uniform(-1e-3, 1e-3), rng.uniform(-1e-3, 1e-3)
        z = Segment(sign * x, v, dy, dv, 0.8, 0.6, 1e-4, 2e-5)
        image = sense.after(z)
        low = Double(image.y, image.reach(1.0, 0.0)), Double(image.v, image.reach(0.0, 1.0))
        for _ in range(5):
            s, a, b = (rng.uniform(-1, 1) for _ in range(3))
            y = z.y + dy * s + 0.8 * 1e-4 * a - 0.6 * 2e-5 * b
            u = v + dv * s + 0.6 * 1e-4 * a + 0.8 * 2e-5 * b
            if sign > 0:
                found = sigma(y, u)
            else:
                found = low[0].mid, low[1].mid
                for _ in range(40):  # the state that sigma takes there, by Newton's method
                    miss = np.array(sigma(-found[0], found[1])) - [-y, u]
                    D = sigma.derivative(-found[0], found[1])
                    step = np.linalg.solve(D, miss)
                    found = found[0] + step[0], found[1] - step[1]
            for value, where in zip(found, low, strict=True):
                assert where.lower - 1e-12 <= value <= where.upper + 1e-12


def test_segments_between_two_regions():
    """They contain the corners of both, of which one may be known better."""
    wide, sharp = (Double(0.1, 1e-3), Double(0.5, 1e-4)), (Double(0.25), Double(0.75))
    for first, second in ((wide, sharp), (sharp, wide)):
        z = Segment.between(first, second)
        for region, end in ((first, -1), (second, 1)):
            for a, m, T in zip(region, (z.y, z.v), (z.dy, z.dv), strict=True):
                for corner in (a.lower, a.upper):
                    away = Fraction(corner) - Fraction(m) - end * Fraction(T)
                    assert abs(away) <= min(z.r1, z.r2)
    assert max(z.r1, z.r2) < 1.001e-3


def test_the_reach_of_a_segment():
    """Not less than in fractions, also where the parts cancel and nothing is added across."""
    rng = random.Random(17)  # noqa: S311
    for n in range(300):
        a, b, dy, p, q = (rng.uniform(-1, 1) for _ in range(5))
        dv = -a * dy / b if n % 2 else rng.uniform(-1, 1)
        r1, r2 = rng.choice([(0.0, 0.0), (rng.random(), rng.random())])
        found = Segment(0.0, 0.0, dy, dv, p, q, r1, r2).reach(a, b)
        a, b, dy, dv, p, q, r1, r2 = map(Fraction, (a, b, dy, dv, p, q, r1, r2))
        exact = abs(a * dy + b * dv) + abs(a * p + b * q) * r1 + abs(b * p - a * q) * r2
        assert 0 <= found - exact < Fraction(1, 10**12)


def test_where_masses_stop():
    """The bounds that are added to Y - V pi and to Y, by sums over the time in which they stop."""
    alpha = float(AT[0])
    forward, backward = Sense(*AT, 1.0), Sense(*AT, -1.0)
    b = float(np.arccos(alpha))
    s = (np.arange(2000) + 0.5) * b / 2000
    gained = np.sin(s) - alpha * s
    k, c = b * gained.mean(), gained.max()
    for sense in (forward, backward):
        assert sense.b.mid == pytest.approx(b)
        assert sense.c.mid == pytest.approx(c, abs=1e-6)
    assert forward.ahead.mid == pytest.approx(k + c * (np.pi - b), abs=1e-6)
    assert backward.behind.mid == pytest.approx(c * b - k, abs=1e-6)


def test_guards_of_a_segment():
    """Beyond a wall, too slow, too wide, a second wall, no positive velocity: refused."""
    forward, backward = Sense(*AT, 1.0), Sense(*AT, -1.0)
    for sense, z, why in (
        (forward, Segment(1.1, 0.5, 0.0, 0.0), "beyond a wall"),
        (forward, Segment(-1.1, 0.5, 0.0, 0.0), "beyond a wall"),
        (backward, Segment(0.85, 0.3, 0.0, 0.0), "before a stop"),
    ):
        with pytest.raises(Rejected, match=why):
            sense.begin(z)
    for sense, z, why in (
        (forward, Segment(0.1, 0.54, 0.3, 0.3), "a speed at a hit"),
        (forward, Segment(-0.9, 1.0, 0.0, 0.0), "second wall"),
        (forward, Segment(0.1, -0.1, 0.0, 0.0), "not one with a positive"),
        (backward, Segment(-0.9, 0.05, 0.0, 0.0), "no hit is found"),
        (forward, Segment(0.8, 0.2, 0.05, 0.05), "a hit may be elsewhere"),
        (backward, Segment(-0.1, 3.0, 0.0, 0.0), "second wall"),
        (backward, Segment(-0.1, 0.2, 0.0, 0.0), "not be in"),
        (backward, Segment(0.4, 1.0, 0.3, -0.3), "a hit may be elsewhere"),
    ):
        with pytest.raises(Rejected, match=why):
            sense.after(z)
    at_rest = Segment(1.0, 0.0, 0.0, 0.0)
    with pytest.raises(Rejected, match="no hit is found"):
        forward._hit(at_rest, at_rest.ranges()[1], 0.0)


def test_guards_of_axes_and_of_the_arccosine():
    """A derivative that is 0; numbers so far apart that Newton's step leaves the guess."""
    zero = Double(0.0), Double(0.0)
    with pytest.raises(Rejected, match="no number"):
        segments._axis(zero, 1.0, zero, 1.0)
    assert segments._arccos(Double(0.98, 0.006)).rad > 0
    with pytest.raises(Rejected, match="arccosine"):
        segments._arccos(Double(0.98, 0.008))


def test_all_edges_are_tasks(monkeypatch):
    """However many there are in each, with their flights, and the ring before."""
    theorem = Converse(read(encode(GOOD)), lambda _: None)
    rings = [Ring(ORIGIN, SQUARE), Ring(ORIGIN, [(3 * a, 3 * b) for a, b in SQUARE])]
    words = [",".join(f"{n} {k}" for k in range(1, 5)) for n in (1, 2)]
    theorem.hints["flights"] = words
    for size in (1, 2, 3, 4, 5):
        monkeypatch.setattr(converse, "EDGES", size)
        found = theorem.tasks(rings)
        assert list(found) == [1, 2]
        for ring, before, word, parts in zip(
            rings, (None, rings[0]), words, found.values(), strict=True
        ):
            assert [edge for part in parts for edge in part[0]] == ring.edges()
            assert [each for part in parts for each in part[1]] == list(flights(word))
            assert all(part[2] is before for part in parts)


def test_a_centre_that_may_be_outside():
    """P* is known so roughly that the first ring may not be around it."""
    theorem = Converse(read(encode(GOOD)), lambda _: None)
    assert len(theorem.rings()) == 2
    theorem.hints["radius"] = Fraction(1, 10)
    with pytest.raises(Rejected, match="may not be inside of a ring"):
        theorem.rings()


def test_each_condition_of_a_stop():
    """Each is broken once."""
    forward, backward = Sense(*AT, 1.0), Sense(*AT, -1.0)
    t = Double(1.0)
    for sense, Y, V, time, why in (
        (forward, 1.01, 0.5, t, "second wall"),
        (forward, 0.0, 0.4, Double(2.5), "too late"),
        (forward, 0.9, 0.1, t, "before a stop"),
        (backward, 0.9, 0.4, t, "before a stop"),
        (backward, 0.7, -0.3, t, "a wall may be hit"),
    ):
        with pytest.raises(Rejected, match=why):
            sense._stop(Double(Y), Double(V), time)
    forward._stop(Double(0.0), Double(0.4), t)
    backward._stop(Double(0.0), Double(0.4), t)


def test_a_guess_of_the_hit_is_not_trusted(monkeypatch):
    """Another time is refused, or makes no difference."""
    sense, z = Sense(*AT, 1.0), Segment(0.1, 0.54, 1e-4, 0.0)
    guess = sense._guess(z)
    for other in (guess + 0.3, guess - 0.3):
        monkeypatch.setattr(Sense, "_guess", lambda *_, other=other: other)
        with pytest.raises(Rejected):
            sense.after(z)


def test_pieces_cover_an_edge():
    """They follow each other from the first end to the last, in both senses."""
    ends = [
        tuple(map(enclosing, map(Fraction, pair))) for pair in (("1/10", "1/2"), ("1/5", "2/3"))
    ]
    for sign in (1.0, -1.0):
        found = pieces(*ends, 3, sign)
        assert found[0].y - found[0].dy == pytest.approx(sign * 0.1, abs=1e-15)
        assert found[-1].v + found[-1].dv == pytest.approx(2 / 3, abs=1e-15)
        for one, two in pairwise(found):
            assert one.y + one.dy == pytest.approx(two.y - two.dy, abs=1e-15)


def test_the_ratio_to_the_curve():
    """The largest invariant disk around P*: from below and from above, about one point."""
    curve = json.loads((ROOT / "certificates/island-2.json").read_text("utf-8"))
    assert curve["parameters"] == STORED["parameters"]
    assert curve["claims"]["map"] == STORED["claims"]["map"]
    for name in ("x", "v"):
        (a, b), (c, d) = (map(Fraction, each["claims"][name]) for each in (curve, STORED))
        assert max(a, c) <= min(b, d)
        middle, radius = curve["hints"]["middle"], Fraction(curve["hints"]["radius"])
        at = Fraction(middle["xv".index(name)])  # Krawczyk: one fixed point so near
        assert at - radius < c
        assert d < at + radius
    m, M = Fraction(curve["claims"]["area"][0]), Fraction(STORED["claims"]["area"])
    assert Fraction(93, 100) < m / M < 1


def test_where_the_orbit_is_its_own_image():
    """Half a period and the symmetry, about the point of an island, which is smaller."""
    stored = json.loads((ROOT / "certificates/converse-2.json").read_text("utf-8"))
    given = json.loads((ROOT / "certificates/islands.json").read_text("utf-8"))["claims"]["islands"]
    f = Fraction(stored["parameters"]["f"])
    island = next(each for each in given if Fraction(each["f"]) == f)
    assert island["map"] == stored["claims"]["map"] == "sigma"
    for name in ("x", "v"):
        (a, b), (c, d) = (map(Fraction, each[name]) for each in (island, stored["claims"]))
        assert max(a, c) <= min(b, d)
    assert Fraction(island["area"][0]) < Fraction(stored["claims"]["area"])
    said = words(read(encode(stored)))
    assert "the map sigma over half a period" in said


def test_the_curve_is_inside_of_the_rings():
    """In floats: no point of the proved curve is outside of the last ring."""
    theorem = Converse(read(encode(STORED)), lambda _: None)
    last = theorem.rings()[-1]
    assert Fraction(STORED["claims"]["area"]) >= last.area
    assert last.area > Fraction("0.0042412")


@pytest.mark.slow
def test_the_stored_certificate():
    """It is verified, in two processes."""
    theorem = Converse(read(encode(STORED)), lambda _: None)
    theorem.jobs = 2
    theorem.prove()
