"""The theorem ``inventory``: what the checker says of launches, and certificates that lie."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from mpmath import mp, mpf
from oracle_flow import orbit
from scipy.integrate import trapezoid
from support import rounds, seeded

from cap.certificate.latex import macros
from cap.checker.flow import launches
from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.inventory import Inventory, leaves
from cap.checker.verdict import check, words
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.altered import leaves as enclosures
from checker.tampered import accepted, malformed, moved

STORED = Path(__file__).parents[2] / "certificates"
BITS = 80


@pytest.fixture(scope="module")
def inventory():
    """Return the stored certificate."""
    return json.loads((STORED / "inventory.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def small(inventory):
    """Return a certificate without a tree: there can be only one hit of each wall, and is none."""
    parameters = inventory["parameters"] | {"f": "9/10"}
    claims = {
        "fixed_points": [],
        "families": [],
        "undecided": {"boxes": "0", "size": "0"},
        "highest_speed": "9/10",
        "most_hits": "1",
    }
    hints = {"bits": "80", "asymmetry": "none", "tree": "none", "flights": []}
    return inventory | {"parameters": parameters, "claims": claims, "hints": hints}


def test_it_is_verified(inventory, small):
    """In steps; the schema describes it; the line says what was proved."""
    assert len(verify(inventory)) == 5
    fits_the_schema(small)
    certificate = read(encode(inventory))
    line = words(certificate)
    for part in ("exactly 4 fixed points", "velocity never vanishes", "are not counted"):
        assert part in line
    assert any("capAFixedPointsOneTrace" in macro for macro in macros(certificate, "a", 6))


def test_the_fixed_points_return(inventory):
    """After a period, as the independent simulator has it; the velocity never vanishes."""
    system = type("System", (), {k: Fraction(v) for k, v in inventory["parameters"].items()})
    system.e, system.mu = 1, 0
    for point in inventory["claims"]["fixed_points"]:
        x, v = (Fraction(point[key][0]) for key in "xv")
        with mp.workdps(40):
            events, end = orbit(system, 0, x, v, 2 * mp.pi)
            assert all(abs(a - mpf(b.numerator) / b.denominator) < mpf(10) ** -20
                       for a, b in zip(end, (x, v), strict=True))  # fmt: skip
        assert [event.word[:3] for event in events] == ["hit"] * 2


@pytest.fixture
def without_launches(monkeypatch):
    """Leave out what takes most of the time."""
    monkeypatch.setattr(Inventory, "launches", lambda _: None)


def test_every_number(inventory, without_launches):
    """No enclosure can be moved or widened; none is left out or twice; bounds are bounds."""
    for path, pair in enclosures(inventory["claims"]["fixed_points"]):
        for ends in moved(pair):
            value = [str(end) for end in ends]
            assert not accepted(changed(inventory, "claims", "fixed_points", *path, value)), path
    points = inventory["claims"]["fixed_points"]
    for k in range(4):
        rejected(changed(inventory, "claims", "fixed_points", points[:k] + points[k + 1 :]), "of 4")
    rejected(changed(inventory, "claims", "fixed_points", points[::-1]), "does not contain")
    rejected(changed(inventory, "claims", "fixed_points", [*points[:3], points[2]]), "contain")
    rejected(changed(inventory, "claims", "fixed_points", 0, "hits", "4"), "not between")
    rejected(changed(inventory, "claims", "families", []), "families")
    rejected(changed(inventory, "claims", "most_hits", "4"), "may be more than most_hits")
    rejected(changed(inventory, "claims", "most_hits", "6"), "more than the bound")
    rejected(changed(inventory, "claims", "highest_speed", "3618/1000"), "too low")
    rejected(changed(inventory, "claims", "highest_speed", "1"), "too low")


def test_what_bounds_the_least_speed(inventory):
    """The two integrations by parts, on the paper's orbit; what they give holds for it."""
    claims = json.loads((STORED / "elliptic.json").read_text("utf-8"))["claims"]
    t, u = ([float(Fraction(q[0])) for q in claims[name]] for name in ("hit_times", "hit_speeds"))
    alpha, rho = 0.4, 2.0
    once = twice = 0.0
    least = math.inf
    for s, begin, end, v in ((-1, t[0], t[1], u[0]), (1, t[1], t[0] + math.tau, u[1])):
        x = np.linspace(begin, end, 20_001)
        w = v + s * (np.sin(x) - math.sin(begin)) - alpha * (x - begin)
        way = (v - s * math.sin(begin)) * (x - begin) - s * (np.cos(x) - math.cos(begin))
        X = s * (way - alpha * (x - begin) ** 2 / 2 - rho / 2)
        cos, sin, force = np.cos(x), np.sin(x), s * np.cos(x) - alpha
        g = sin / w + force * cos / w**2
        Z = (X**2 - rho**2 / 4) / 2
        assert abs(Z[-1]) < 1e-9
        slope = (
            cos / w**2 - (4 * s * sin * cos - 3 * alpha * sin) / w**3 - 3 * force**2 * cos / w**4
        )
        once += trapezoid(X * g, x)
        twice -= trapezoid(s * Z * slope, x)
        least = min(least, w.min())
    assert [once, twice] == pytest.approx([math.tau * alpha] * 2, rel=1e-7)
    theorem, _ = parts(inventory)
    for speed, holds in ((least, True), (1.8, True), (1.9, False), (2.3, False)):
        excess = list(theorem.excesses(theorem.number(Fraction(speed))))
        assert any(each.is_positive() for each in excess) is not holds
    assert [e.is_positive() for e in theorem.excesses(theorem.number(2))] == [False, True]


def test_the_hint_of_the_pair(inventory, without_launches):
    """It must hold delta, and be there."""
    low, high = inventory["hints"]["asymmetry"]
    for hint, why in (
        ("none", "against the formulas"),
        ([high, low], "not in"),
        (["0", high], "not in"),
        ([low, "3/2"], "not in"),
        (["1/5", low], "elsewhere"),
        ([high, "2/5"], "elsewhere"),
        (["1/5", "2/5"], "does not contain|not decided|zero"),
    ):
        rejected(changed(inventory, "hints", "asymmetry", hint), why)


def test_every_parameter(inventory, without_launches):
    """The claims hold at no other parameters."""
    for name, value in inventory["parameters"].items():
        other = str(Fraction(value) + Fraction(1, 10**12))
        assert not accepted(changed(inventory, "parameters", name, other)), name
    rejected(changed(inventory, "parameters", "f", "0"), "0 < f")


def test_the_tree():
    """No leaf can be left out, added, merged with another, or left open and not told."""
    inventory = json.loads((STORED / "inventory-2.json").read_text("utf-8"))
    tree, flights = inventory["hints"]["tree"], inventory["hints"]["flights"]
    first = tree.index(".")
    late = tree[:first] + "?" + tree[first + 1 :]
    for other, windows, why in (
        (tree[:-1], flights, "ends before its end|more boxes"),
        (tree + ".", [*flights, flights[-1]], "after its end"),
        (late, flights[1:], "undecided is more"),
        (".", flights[:1], "window|empty|close"),
        ("none", [], "missing"),
        ("t" * 70, flights, "too deep"),
    ):
        lie = changed(inventory, "hints", "tree", other)
        rejected(changed(lie, "hints", "flights", windows), why)
    rejected(changed(inventory, "hints", "flights", flights[1:]), "window|empty|close|fall")
    rejected(changed(inventory, "claims", "undecided", "boxes", "1"), "undecided")
    open_ = changed(inventory, "hints", "tree", "?")
    open_ = changed(open_, "hints", "flights", [])
    whole = Fraction(62832, 10**4) * Fraction(inventory["claims"]["highest_speed"]) ** 2 / 2
    open_ = changed(open_, "claims", "undecided", {"boxes": "1", "size": str(whole)})
    assert "at least 0 fixed points" in words(check(encode(open_), lambda _: None))
    rejected(changed(open_, "claims", "undecided", "size", str(whole - 1)), "more than claimed")


def test_every_window(inventory):
    """Windows moved or narrowed, flights left out: what they claim is decided, not believed."""
    theorem, gap = parts(inventory)
    tree, speed = inventory["hints"]["tree"], Fraction(inventory["claims"]["highest_speed"])
    boxes = [(t, u) for word, t, u in leaves(tree, speed) if word == "."]
    source, noticed, tried = seeded(1), 0, 0
    for _ in range(rounds(60)):
        k = source.randrange(len(boxes))
        box = [theorem.between(side) for side in boxes[k]]
        parts_of = inventory["hints"]["flights"][k].split(",")
        told = [list(map(int, part.split())) for part in parts_of]
        launches.empty(gap, *box, theorem.windows(text(told)))
        flight = source.choice(told)
        lies = [told[:-1]] if len(told) > 1 else []
        flight[0] += 20_000
        lies.append([list(part) for part in told])
        flight[0] -= 20_000
        if len(flight) > 1:
            flight[1] //= 4
            lies.append(told)
        for lie in lies:
            tried += 1
            try:
                launches.empty(gap, *box, theorem.windows(text(lie)))
            except Rejected:
                noticed += 1
    assert noticed > 0.9 * tried > 50


def test_the_middle_of_a_window(inventory):
    """From a point outside of the window its speeds would be wrong: it is refused."""
    theorem, gap = parts(inventory)
    tree, speed = inventory["hints"]["tree"], Fraction(inventory["claims"]["highest_speed"])
    boxes = [(t, u) for word, t, u in leaves(tree, speed) if word == "."]
    every = [
        [list(map(int, part.split())) for part in flights.split(",")]
        for flights in inventory["hints"]["flights"]
    ]
    k = next(k for k, told in enumerate(every) if len(told[0]) == 3)
    told, sides = every[k], [theorem.between(side) for side in boxes[k]]
    for more in (1, 1000):
        told[0][2] = told[0][1] + more
        with pytest.raises(Rejected, match="not in it"):
            launches.empty(gap, *sides, theorem.windows(text(told)))


def test_the_maps_of_a_window():
    """A point outside of it gives launches that are not the image: here by 0.01."""
    gap = launches.Gap(exactly("1/20"), exactly(2))
    t, u, far = Fraction("2.21856"), Fraction("2.30146"), Fraction(1, 10**5)
    n = launches.box(exactly(t - far, t + far), exactly(u - far, u + far), first=True)
    x, w = first_hit(0.05, 2, float(t), float(u))
    a, b = (launches.phase(exactly(Fraction(x) + d)) for d in (Fraction(-1, 50), Fraction(1, 50)))
    assert launches.none_before(gap, n, a)
    assert launches.over(gap, n, b)
    image = launches.flown(gap, n, launches.Window(a, b, launches.phase(exactly(Fraction(x)))))
    assert abs(float(image.centre.x.lower) - x - math.pi) < 3e-4
    assert abs(float(image.speed.lower) - w) < 3e-4
    outside = launches.phase(exactly(Fraction(x) + Fraction(1, 5)))
    with pytest.raises(Rejected, match="not in it"):
        launches.flown(gap, n, launches.Window(a, b, outside))


def text(flights):
    """Return windows as a certificate has them."""
    return ",".join(" ".join(map(str, flight)) for flight in flights)


def parts(inventory):
    """Return the theorem of a certificate, and its gap."""
    from cap.checker.kernel.certificate import read  # noqa: PLC0415

    theorem = Inventory(read(encode(inventory)), lambda _: None)
    return theorem, launches.Gap(theorem.alpha, theorem.rho)


def exactly(a, b=None):
    """Return an interval."""
    return Interval.enclosing(Fraction(a), Fraction(a if b is None else b), BITS)


def first_hit(alpha, rho, t, u):
    """Return the next launch in floats by small steps, None if the velocity vanishes before."""
    step = 1e-4
    for n in range(1, 200_000):
        x = t + n * step
        w = u + math.sin(x) - math.sin(t) - alpha * (x - t)
        y = (u - math.sin(t)) * (x - t) - math.cos(x) + math.cos(t) - alpha * (x - t) ** 2 / 2
        if y >= rho:
            return x, w
        if w < 0:
            return None
    raise AssertionError


@pytest.mark.slow
def test_windows_against_steps():
    """What is said of windows holds of single motions, followed in small steps."""
    source, seen = seeded(2), set()
    for _ in range(rounds(60)):
        alpha, rho = source.choice(((0.4, 2), (0.1, 1), (0.7, 2)))
        gap = launches.Gap(exactly(Fraction(str(alpha))), exactly(rho))
        t, u, half = source.uniform(0, 6.28), source.uniform(0, 2.5), 10 ** source.uniform(-4, -1)
        low = max(u - half, 0)
        n = launches.box(exactly(t - half, t + half), exactly(low, u + half), first=True)
        corners = [(t + a * half, b) for a in (-1, 1) for b in (max(low, 1e-12), u + half)]
        hits = [hit for hit in (first_hit(alpha, rho, *z) for z in corners) if hit]
        times = [x for x, _ in hits] or [t + 3]
        a = launches.phase(exactly(min(times) + source.choice((-1e-3, -0.1, 0.01, 0.3))))
        b = launches.phase(exactly(max(times) + source.choice((1e-3, 0.1, -0.01, 0.5))))
        try:
            before, after = launches.none_before(gap, n, a), launches.over(gap, n, b)
        except Rejected:
            continue
        if before:
            assert all(float(a.x.lower) <= x + 2e-4 for x, _ in hits)
        if after:
            assert all(x <= float(b.x.upper) + 2e-4 for x, _ in hits)
        seen |= {("before", before), ("after", after)}
        if before and after and a.x.lo < b.x.lo:
            image = launches.flown(gap, n, launches.Window(a, b, None))
            for x, w in hits:
                assert float(image.all_t.x.lower) - 3e-4 <= x + math.pi
                assert x + math.pi <= float(image.all_t.x.upper) + 3e-4
                assert float(image.all_u.lower) - 3e-4 <= w <= float(image.all_u.upper) + 3e-4
            seen.add("flown")
    assert len(seen) == 5


def test_what_is_malformed(small):
    """Fields missing, added, of another type are noticed."""
    verify(small)
    bad = [altered for _, altered in malformed(small)]
    assert len(bad) > 150
    assert not any(accepted(altered) for altered in bad)
    rejected(changed(small, "hints", "tree", "."), "missing, or needless")
    rejected(changed(small, "hints", "flights", ["1"]), "more boxes")


@pytest.mark.parametrize("told", ["1 2 3 4", "", ",", "1 ", "-1", "99999999"])
def test_what_is_no_flight(inventory, told):
    """Refused."""
    rejected(changed(inventory, "hints", "flights", 0, told), "flights")


def test_too_much_work(small):
    """Bits times flights are bounded before anything is computed."""
    hints = small["hints"] | {"bits": "4096", "flights": [",".join("1" * 150)] * 70}
    rejected(small | {"hints": hints}, "too much")
