"""The theorem ``island``: what is true is verified; each number moved, each lie, is noticed."""

import json
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.fourier import Circle, Function
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.island import Island
from cap.checker.tori import between, invariant_curve, rotation, told
from cap.checker.tori.half_period import Hit, Motion, States, cells
from cap.checker.tori.invariant_curve import Near, Sizes, near
from cap.checker.tori.written import coefficients, function
from cap.checker.verdict import words
from checker.altered import SMALL_LOSSES, changed, encode, fits_the_schema, rejected, verify
from checker.tampered import malformed

ROOT = Path(__file__).parents[2]
GOOD = json.loads((ROOT / "tests/certificates/accept/island_small.json").read_text("utf-8"))
_QUOTIENTS = "rotation_number"
UNIT = 10 ** int(GOOD["hints"]["places"])
CLAIMS, HINTS = GOOD["claims"], GOOD["hints"]


def altered(part, *path_and_value):
    """Return the certificate with another claim or hint."""
    return changed(GOOD, part, *path_and_value)


def bumped(text, mode, by):
    """Return a polynomial with a real part of a coefficient changed."""
    parts = text.split(",")
    re, im = parts[mode].split(" ")
    parts[mode] = f"{int(re) + by} {im}"
    return ",".join(parts)


def test_it_is_verified():
    """All steps, in other units: twice as far, four times as fast, between walls moved by 1."""
    parameters = {"F": "8", "omega": "2", "f": "16/5", "l": "-1", "r": "3"}
    claims = {
        name: [str(Fraction(end) * scale + by) for end in CLAIMS[name]]
        for name, scale, by in (("x", 2, 1), ("v", 4, 0), ("area", 8, 0))
    }
    assert GOOD["parameters"] == {"F": "1", "omega": "1", "f": "2/5", "l": "-1", "r": "1"}
    assert len(verify({**GOOD, "parameters": parameters, "claims": CLAIMS | claims})) == 10
    fits_the_schema(GOOD)


LIES = {
    "a coefficient": (
        "claims",
        "curve",
        "x",
        bumped(CLAIMS["curve"]["x"], 2, UNIT // 10**6),
        "y0|c4|twist",
    ),
    "a coefficient of v": (
        "claims",
        "curve",
        "v",
        bumped(CLAIMS["curve"]["v"], 1, -UNIT // 10**6),
        "y0|c4|twist",
    ),
    "a mean value": (
        "claims",
        "curve",
        "x",
        bumped(CLAIMS["curve"]["x"], 0, UNIT // 10**6),
        "y0|c4|twist",
    ),
    "the error": ("claims", "distance", "0." + 40 * "0" + "1", "farther"),
    "no error": ("claims", "distance", "0", "farther"),
    "rotation": ("claims", "rotation_number", "head", ["3", "2", "18"], "y0|Diophantine"),
    "rotation far away": (
        "claims",
        "rotation_number",
        "head",
        [*GOOD["claims"]["rotation_number"]["head"], *["1"] * 17, "2"],
        "y0|c4",
    ),
    "period": ("claims", "rotation_number", "period", ["2"], "y0"),
    "Diophantine": ("claims", "diophantine", "0.06", "Diophantine"),
    "Diophantine zero": ("claims", "diophantine", "0", "not positive"),
    "Diophantine negative": ("claims", "diophantine", "-1", "not positive"),
    "the other lift": (
        "claims",
        "rotation_number",
        {"head": ["1", "2", *CLAIMS["rotation_number"]["head"][1:]], "period": ["1"]},
        "y0|c4",
    ),
    "winding": ("claims", "winding", "1" if CLAIMS["winding"] == "-1" else "-1", "other way"),
    "sigma": ("claims", "map", "sigma", "hit for each|leave|inside"),
    "a frame": ("hints", "frame", "x", bumped(HINTS["frame"]["x"], 1, 10**21), "1/2|y0|twist"),
    "a time": (
        "hints",
        "hits",
        0,
        "time",
        bumped(HINTS["hits"][0]["time"], 0, UNIT // 100),
        "contraction|farther|y0|twist",
    ),
    "an inverse": ("hints", "hits", 1, "inverse", "0 0", "contraction"),
    "reach": ("hints", "reach", "1/3", "leave U"),
    "no reach": ("hints", "reach", "0", "reach"),
    "a small reach": ("hints", "reach", "1/" + 45 * "9", "y0|R.*r/4|contains zero"),
    "half": ("hints", "half", "0.001", "leave U"),
    "half negative": ("hints", "half", "-1", "parallelogram"),
    "axes": ("hints", "axes", [["1", "2"], ["2", "4"]], "parallelogram"),
    "U too large": ("hints", "half", "0.2", "hit|vanish|outside"),
    "middle": ("hints", "middle", 0, "0.2", "lie inside|vanish|wall|elsewhere"),
    "radius": ("hints", "radius", "0", "radius"),
    "preconditioner": ("hints", "preconditioner", [["0", "0"], ["0", "0"]], "lie inside"),
    "rho": ("hints", "rho", "0", "rho"),
    "rho too large": ("hints", "rho", "1", "may|large"),
    "one hit": ("hints", "hits", HINTS["hits"][:1], "one hit"),
    "degree": ("hints", "degree", "8", "too many"),
    "work": ("hints", "places", "200000", "between"),
    "coarser than a frame": ("hints", "places", "19", "between"),
}


@pytest.mark.parametrize("name", LIES)
def test_lies(name):
    """Each is rejected, by what it contradicts."""
    *path, value, why = LIES[name]
    rejected(altered(*path, value), why)


def test_enclosures_are_moved():
    """P* and the area."""
    for name in ("x", "v", "area"):
        low, high = map(Fraction, CLAIMS[name])
        width = high - low
        for ends in ((low - width, low), (high, high + width), (high, low)):
            rejected(altered("claims", name, [str(end) for end in ends]), "contain|lower > upper")
    rejected(altered("claims", "area", ["-1", CLAIMS["area"][1]]), "positive")
    rejected(altered("claims", "x", ["-1", "1"]), "wider")


@pytest.mark.parametrize("parameter", ["F", "omega", "f", "l", "r"])
def test_other_parameters(parameter):
    """The curve is one at these parameters only: another by 1e-20 has none so near."""
    value = str(Fraction(GOOD["parameters"][parameter]) + Fraction(1, 10**12))
    with pytest.raises(Rejected):
        verify(changed(GOOD, "parameters", parameter, value))


@pytest.mark.parametrize("loss", [{"e": "1"}, {"mu": "0"}, *SMALL_LOSSES])
def test_losses_are_no_parameters(loss):
    """The theorem has none: what contracts area has no such curve, and no inequality sees it."""
    rejected({**GOOD, "parameters": GOOD["parameters"] | loss}, "unknown fields")


def test_no_friction():
    """Refused: flights would need another lemma."""
    rejected(changed(GOOD, "parameters", "f", "0"), "0 < f")


def test_a_claim_of_less():
    """One disk, a larger distance, a smaller constant: true, too."""
    less = altered("claims", "disks", "1")
    assert len(verify(less)) == 9
    assert len(verify(altered("claims", "distance", "0.0001"))) == 10


def test_what_is_malformed():
    """Fields missing, added, of another type; what has the form of numbers is tested above."""
    survived = [where for where, bad in malformed(GOOD) if not refused(bad)]
    fewer = [("hints", "hits", n) for n in (0, 1)]
    form = [w for w in survived if w[-1] == ["2", "1"] or w[1] == _QUOTIENTS or w in fewer]
    assert survived == form


def refused(certificate):
    """Return whether a certificate is refused when it is read, or its polynomials are."""
    try:
        given = read(encode(certificate))
        Island(given, lambda _: None).polynomials()
    except Rejected:
        return True
    return False


@pytest.mark.parametrize(
    "text",
    ["", "1", "1 2,", "1 0,2", "1 1", "1 0, 2 3", "1e3 0", "1.5 0", "١ 0", "-- 0", "1 0,2 3 4"],
)
def test_what_is_no_polynomial(text):
    """Integers in pairs, the first one real."""
    with pytest.raises(Rejected):
        coefficients(text)


def test_coefficients_are_bounded():
    """Before anything is computed with them."""
    circle = Circle(8, Fraction(1, 10), 30)
    assert function(circle, f"{10**36} 0", 1).mean == 10**36
    for words_of, unit in ((f"{10**36 + 1} 0", 1), (f"1 0,0 {-(10**36)}", 2)):
        with pytest.raises(Rejected, match="larger than"):
            function(circle, words_of, unit)


ORBITS = {"centre": ["0.28695976", "0.28695977"]}
WITH_ORBITS = {
    **GOOD,
    "claims": CLAIMS | {"orbits": ORBITS},
    "hints": HINTS | {"ray": {"place": "0", "pieces": "16"}},
    "cites": list(Island.CITES),
}


def test_periodic_orbits():
    """They may be claimed, or not; then Franks is cited, or not."""
    assert len(verify(WITH_ORBITS)) == 11
    fits_the_schema(WITH_ORBITS)
    said = words(read(encode(WITH_ORBITS)))
    assert "lies in [0.28695976, 0.28695977]" in said
    alpha = float(rotation.value([3, 2, 17], [1], 96).lower)
    least = next(q for q in range(1, 999) if int(q * 0.28695976) > int(q * alpha))
    assert f"(as {int(least * 0.28695976)}/{least})" in said
    assert "two periodic orbits of Phi" in said
    assert "periodic orbit" not in words(read(encode(GOOD)))
    rejected(WITH_ORBITS | {"cites": GOOD["cites"]}, "own list")
    rejected(GOOD | {"cites": WITH_ORBITS["cites"]}, "own list")
    rejected(WITH_ORBITS | {"claims": CLAIMS, "cites": GOOD["cites"]}, "orbits without a ray")
    rejected(WITH_ORBITS | {"hints": HINTS}, "orbits without a ray")


@pytest.mark.parametrize(
    ("ends", "why"),
    [
        (["0.28695975", "0.28695976"], "contain"),
        (["0.28695977", "0.28695978"], "contain"),
        (["0.71304023", "0.71304024"], "contain"),
        (["0.28", "0.29"], "may be equal"),
    ],
)
def test_lies_about_the_centre(ends, why):
    """The rotation number is another, or not another than that of the curve."""
    rejected(changed(WITH_ORBITS, "claims", "orbits", "centre", ends), why)


def test_a_segment_that_is_turned_both_ways():
    """By a shear, which turns no direction by 0; by one that turns some by π: nothing is shown."""
    one, zero = (Interval.enclosing(n, n, 96) for n in (1, 0))

    class Shear:
        def __init__(self, slope):
            self.slope = slope

        def after(self, z):
            (a, b), (c, d) = z.B
            k = self.slope(z.x)
            return z._replace(B=((a, b), (c + k * a, d + k * b)))

    ends = (zero, zero), (one, zero)
    assert between.sense(Shear(lambda _: one), 1, ends, 4) == 1
    assert between.sense(Shear(lambda _: -one), 2, ends, 4) == -1
    half = one / 2
    with pytest.raises(Rejected, match="by 0 or pi"):
        between.sense(Shear(lambda x: x - half), 1, ends, 3)
    with pytest.raises(Rejected, match="both ways"):
        between.sense(Shear(lambda x: x - half), 1, ends, 4)


def test_all_of_a_segment_is_looked_at():
    """Its pieces follow each other from one end to the other, in x and in v."""
    exact = lambda q: Interval.enclosing(Fraction(q), Fraction(q), 96)  # noqa: E731
    seen = []

    class Shear:
        def after(self, z):
            seen.append(z)
            (a, b), (c, d) = z.B
            return z._replace(B=((a, b), (c + a, d + b)))

    between.sense(Shear(), 1, ((exact(1), exact(-1)), (exact(5), exact(7))), 4)
    for n, z in enumerate(seen):
        for at, half, begin, step in ((z.x, z.B[0][0], 1, 1), (z.v, z.B[1][0], -1, 2)):
            assert (at - half).lower <= begin + n * step <= (at - half).upper
            assert (at + half).lower <= begin + (n + 1) * step <= (at + half).upper
    assert len(seen) == 4


@pytest.mark.parametrize("rows", [((2, 1), (-1, 3)), ((1, -4), (2, 1)), ((-3, 1), (5, 2))])
def test_the_norm_of_the_inverse_of_the_axes(rows):
    """The larger sum of a row, in absolute values: of vectors with entries 1 and -1."""
    island = Island(read(encode(GOOD)), lambda _: None)
    island.hints["axes"] = [list(map(Fraction, row)) for row in rows]
    ends = [np.linalg.solve(rows, corner) for corner in ((1, 1), (1, -1))]
    assert float(island.stretch()) == pytest.approx(np.abs(ends).max())


def test_what_is_between_the_rotation_numbers():
    """That of P* on either side of that of the curve, or about it."""
    value = rotation.value([2], [1], 96)
    a, b = value.lower, value.upper
    for low, high, expected in (
        ("1/10", "1/5", (Fraction(1, 5), a)),
        ("1/2", "3/5", (b, Fraction(1, 2))),
        ("1/5", "1/2", None),
    ):
        claims = {
            "rotation_number": {"head": [2], "period": [1]},
            "orbits": {"centre": SimpleNamespace(lower=Fraction(low), upper=Fraction(high))},
        }
        assert told.gap(claims) == expected
    assert told.gap({}) is None


def test_rotation_numbers_at_the_centre():
    """In the sense of the curve; where the lifts may not match, nothing is shown."""
    exact = lambda q: Interval.enclosing(Fraction(q), Fraction(q), 96)  # noqa: E731
    trace, small, large = exact(1), exact("3/10"), exact("7/10")  # a = 1/6
    near_sixth = between.at_centre(trace, True, small)
    assert abs(near_sixth.lower - Fraction(1, 6)) < Fraction(1, 10**20)
    assert abs(between.at_centre(trace, False, large).lower - Fraction(5, 6)) < Fraction(1, 10**20)
    for same, alpha in ((True, large), (False, small)):
        with pytest.raises(Rejected, match="other way"):
            between.at_centre(trace, same, alpha)
    with pytest.raises(Rejected, match="arccosine"):
        between.at_centre(exact(2), True, small)


def test_values_on_the_curve():
    """At sixteen places, they are those of the series."""
    island = Island(read(encode(GOOD)), lambda _: None)
    (x, _), _, _ = island.polynomials()
    modes = [complex(a / UNIT, b / UNIT) for a, b in x.coefficients]
    for place in range(16):
        turn = np.exp(2j * np.pi * place / 16)
        there = modes[0].real + 2 * sum((c * turn**k).real for k, c in enumerate(modes) if k)
        found = between.value(x, place, 0, 96)
        assert abs(float(found.lower) - there) < 1e-12
        assert found.upper - found.lower < Fraction(1, 10**20)
        wider = between.value(x, place, UNIT // 1000, 96)
        assert wider.lower <= found.lower - Fraction(1, 1001)
        assert wider.upper >= found.upper + Fraction(1, 1001)


def test_the_simplest_fraction():
    """No smaller denominator is between."""
    for n in range(1, 60):
        low, high = Fraction(n, 61), Fraction(n, 61) + Fraction(1, 3 + n * n)
        found = between.simplest(low, high)
        assert low <= found <= high
        for q in range(1, found.denominator):
            assert not any(low <= Fraction(p, q) <= high for p in range(2 * q))


def test_each_inequality():
    """Each of the theorem, broken once."""
    exact = lambda q: Interval.enclosing(Fraction(q), Fraction(q), 400)  # noqa: E731
    good = Sizes(*map(exact, ("1e-40", 1, 100, "1/100", 100, 50, 1, "1/100", "1/10", 1)))
    assert 0 < near(good).distance < Fraction(1, 10**20)
    for change, why in {
        ("d0", "6/10"): "d <= 1/2",
        ("tm", "1/10000000000000000000000000000000"): "dT|y0",
        ("tm", 0): "dT",
        ("tm", -1): "dT",
        ("eps", "1e-3"): "c4",
        ("eps", "1e-6"): "y0",
        ("M", "1e60"): "y0|dT",
        ("rho", "1/1000000000000"): "y0",
        ("small", "1e40"): "y0",
    }.items():
        with pytest.raises(Rejected, match=why):
            near(good._replace(**{change[0]: exact(change[1])}))


@pytest.mark.parametrize(
    ("passes", "why"),
    [
        ([(1, 1), (1, 1), (3, 1)], r"RK <= R\* may fail"),
        ([(1, 1), (1, 1), (1, 3)], r"s <= s\* may fail"),
        ([(1, 1), (13, 1), (1, 1)], r"R\* <= r/4 may fail"),
    ],
)
def test_what_is_assumed_is_shown(monkeypatch, passes, why):
    """R* and s*, twice what the formulas gave before, are bounds of what they give then."""
    exact = lambda q: Interval.enclosing(Fraction(q), Fraction(q), 400)  # noqa: E731
    sizes = Sizes(*map(exact, ("1e-40", 1, 100, "1/100", 100, 50, 1, 100, "1/10", 1)))
    given = iter([tuple(map(exact, each)) for each in passes])
    monkeypatch.setattr(invariant_curve, "bounds", lambda *_: next(given))
    with pytest.raises(Rejected, match=why):
        near(sizes)


@pytest.mark.parametrize("tm", [0, -1])
def test_a_twist_that_may_vanish(monkeypatch, tm):
    """Its mean value must not be 0."""
    monkeypatch.setattr(invariant_curve, "twist", lambda *_: (UNIT, tm))
    rejected(GOOD, "the mean twist may vanish")


def test_rotation_numbers():
    """γ is a lower bound, and not a small one."""
    for head, period in (([3], [1]), ([1, 2], [3, 1]), ([4, 1, 7], [2])):
        alpha, gamma = rotation.value(head, period, 80), rotation.constant(head, period)
        worst = min(
            k * min(x % 1, 1 - x % 1)
            for k in range(1, 3000)
            for x in (alpha.lower * k, alpha.upper * k)
        )
        assert gamma * Fraction(999, 1000) < worst < 3 * gamma
        assert gamma < worst + Fraction(1, 10**15)


@pytest.mark.parametrize(
    ("t", "v", "why"),
    [
        (-0.1, 3.0, r"not be in \(0, pi\)"),
        (3.2, 3.0, r"not be in \(0, pi\)"),
        (2.9, 0.5, "speed at a hit may not be positive"),
    ],
)
def test_what_is_no_hit_of_functions(t, v, why):
    """Roots before the start, or after the end, or where the mass comes back."""
    motion, circle = Motion(Fraction(2, 5), Fraction(1), 160), Circle(8, Fraction(1, 10), 40)

    def constant(value):
        return circle.constant(Interval.enclosing(Fraction(value), Fraction(value), 160))

    x = 1 - (v * t + 1 - np.cos(t) - t * t / 5)
    hit = Hit.of(constant(t), constant(1 / (v + np.sin(t) - 2 * t / 5)))
    with pytest.raises(Rejected, match=why):
        motion.passage(hit, constant(float(x)), constant(v))


@pytest.mark.parametrize(("t", "hits"), [(0.05, False), (3.1, False), (0.2, True)])
def test_hits_that_are_not_all_in_time(t, hits):
    """t + cos(theta)/10 is in (0, pi) for all theta, or leaves it for some."""
    motion, circle = Motion(Fraction(2, 5), Fraction(1), 160), Circle(24, Fraction(1, 10), 40)

    def constant(value):
        return circle.constant(Interval.enclosing(Fraction(value), Fraction(value), 160))

    time = constant(t) + Function(circle, [(0, 0), (circle.unit // 20, 0)], 0)
    v = constant(3)
    hit = Hit.of(time, constant(1 / (3 + np.sin(t) - 2 * t / 5)))
    x = v * -1 * time + hit.cos + (time * time).divided(5)
    if hits:
        motion.passage(hit, x, v)
    else:
        with pytest.raises(Rejected, match=r"not be in \(0, pi\)"):
            motion.passage(hit, x, v)


def test_states_stop_or_not():
    """Boxes in which motions stop, hit twice, or are beyond a wall are refused."""
    motion = Motion(Fraction(2, 5), Fraction(1), 96)

    def after(x, v, size):
        (cell,) = cells(
            (Fraction(x), Fraction(v)),
            [[Fraction(1), Fraction(0)], [Fraction(0), Fraction(1)]],
            Fraction(size),
            1,
            96,
        )
        return motion.after(cell)

    assert isinstance(after("0.1", "0.54", "0.001"), States)
    for state, why in (
        (("0.6", "0.3", "0.001"), "velocity may vanish"),
        (("-0.9", "1", "0.001"), "hit the left wall"),
        (("0.1", "0.1", "0.001"), "elsewhere"),
        (("1.5", "0.5", "0.001"), "state may be outside"),
        (("0.1", "-0.5", "0.001"), "state may be outside"),
        (("0.1", "0.05", "0.2"), "state may be outside"),
        (("0.1", "0.3", "0.01"), r"not be in \(0, pi\)"),
        (("-0.5", "0.01", "0.001"), "no hit is found"),
        (("0.6", "0.2", "0.1"), "speed at a hit"),
    ):
        with pytest.raises(Rejected, match=why):
            after(*state)
    for state in (("0.1", "0.54", "0.4"), ("0.1", "3", "0.001"), ("-0.9", "0.3", "0.01")):
        with pytest.raises(Rejected):
            after(*state)


@pytest.mark.parametrize("t", [float("nan"), float("inf")])
def test_guesses_are_numbers(t):
    """Doubles that are none are refused."""
    with pytest.raises(Rejected, match="no hit is found"):
        Motion(Fraction(2, 5), Fraction(1), 96).number(t)


def test_a_guess_of_the_hit_is_not_trusted(monkeypatch):
    """Where the wall is not reached between the ends of the guess, the states are refused."""
    motion = Motion(Fraction(2, 5), Fraction(1), 96)
    square = [[Fraction(1), Fraction(0)], [Fraction(0), Fraction(1)]]
    (cell,) = cells((Fraction(1, 10), Fraction(27, 50)), square, Fraction(1, 1000), 1, 96)
    t, width = motion.guess(cell)
    for other in ((t + 3 * width, width), (t - 3 * width, width), (t, width / 100)):
        monkeypatch.setattr(Motion, "guess", lambda *_, other=other: other)
        with pytest.raises(Rejected, match="elsewhere"):
            motion.after(cell)


def test_a_curve_that_does_not_wind_around_the_point():
    """P* is taken elsewhere, or the curve known too roughly; disks may meet."""
    island = Island(read(encode(GOOD)), lambda _: None)
    island.half_periods = 2
    K = island.polynomials()[0]
    place = [island.number_at(Fraction(q)) for q in HINTS["middle"]]
    island.around(K, Near(Fraction(0), Fraction(0)), (place[0], place[1]))
    far = place[0] + island.number_at(Fraction(1, 20))
    for close, centre in ((Fraction(0), (far, place[1])), (Fraction(1, 50), (place[0], place[1]))):
        with pytest.raises(Rejected, match="wind around"):
            island.around(K, Near(close, Fraction(0)), centre)
    low, high = (Interval.enclosing(q, q + 2, 96) for q in (0, 1))
    with pytest.raises(Rejected, match="may meet"):
        island.disks(low, high)
    above = Interval.enclosing(Fraction(3), Fraction(4), 96)
    island.disks(low, above)
    island.disks(above, low)
    island.half_periods = 1
    with pytest.raises(Rejected, match="own image by sigma"):
        island.disks(low, high)


def test_a_curve_that_may_not_be_embedded(monkeypatch):
    """Its first harmonic must be larger than the distance, whatever is known of its winding."""
    island = Island(read(encode(GOOD)), lambda _: None)
    K = island.polynomials()[0]
    place = [island.number_at(Fraction(q)) for q in HINTS["middle"]]
    monkeypatch.setattr(island, "stretch", lambda: Fraction(0))
    island.around(K, Near(Fraction(1, 1000), Fraction(0)), (place[0], place[1]))
    with pytest.raises(Rejected, match="embedded"):
        island.around(K, Near(Fraction(1), Fraction(0)), (place[0], place[1]))


def test_work_is_bounded():
    """Degree times places."""
    large = altered("hints", "degree", "4096")
    rejected(changed(large, "hints", "places", "101"), "degree times places")


def test_the_sentence():
    """It says what is claimed."""
    said = words(read(encode(GOOD)))
    for part in (
        "[0;3,2,17,(1)]",
        CLAIMS["area"][0],
        "never vanishes",
        "disjoint",
        "start at t = 0 in another",
    ):
        assert part in said
