"""Each lemma refuses what its hypothesis excludes, on maps and boxes made for that."""

from dataclasses import replace
from fractions import Fraction

import pytest
from conftest import STARTS
from support import between, decimal_fraction, holds, rounds, seeded

from cap.errors import NotProved
from cap.flow.strobe import oscillator
from cap.maps.fixed_point import Neighbourhood
from cap.parameters import PAPER
from cap.proofs import elliptic, fixed_point, saddle
from cap.proofs.fixed_point import Around, Located, Setting
from cap.proofs.orbit import of_hits
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet

SETTING = Setting(PAPER, STARTS["elliptic"], 10)


def rotation(turns, twist=None, wobble=None):
    """Return the jets of z -> z e^{2πi turns} (1 + i twist |z|²), to order 3, over balls."""
    sin, cos = (2 * interval.pi() * turns.numerator / turns.denominator).sin_cos()
    if wobble is not None:
        cos = cos + interval.around(Fraction(0), wobble)
    x, v = Jet.variables((Ball(0), Ball(0)), 3)
    square = (x * x + v * v) * (Ball(0) if twist is None else twist)
    x, v = x - v * square, v + x * square
    return x * cos - v * sin, x * sin + v * cos


@pytest.mark.parametrize("turns", ["1/4", "-1/4", "1/3", "-1/3"])
@pytest.mark.parametrize("wobble", [None, Fraction(1, 10**15)])
def test_lemma_3_excludes_resonances(turns, wobble):
    """A rotation number that is, or may be, 1/4 or 1/3; it names which."""
    with interval.workprec(100), pytest.raises(NotProved) as caught:
        elliptic.lemma_3_ellipticity(SETTING, rotation(Fraction(turns), Ball(1), wobble))
    assert caught.value.step == "Lemma 3"
    assert caught.value.reason.endswith(turns.lstrip("-"))


@pytest.mark.parametrize("turns", ["1/5", "2/5", "-3/8", "1/1000", "499/1000", "13/40"])
def test_lemma_3_allows_the_rest(turns):
    """The rotation angle has its sign, the number has not; the distances are right."""
    q = Fraction(turns)
    with interval.workprec(100):
        claims = elliptic.lemma_3_ellipticity(SETTING, rotation(q, Ball(1)))
    low, high = map(Fraction, claims["rotation_number"])
    assert low <= abs(q) <= high
    assert (Fraction(claims["rotation_angle"][0]) > 0) == (q > 0)
    for name, pair in claims["resonance_distances"].items():
        low, high = map(Fraction, pair)
        assert 0 < low <= abs(abs(q) - Fraction(name)) <= high


def test_lemma_4_excludes_a_vanishing_twist():
    """A twist that is zero, or may be; the least that is certain is allowed, with its sign."""
    turns = Fraction(13, 40)
    with interval.workprec(100):
        for twist in (Ball(0), Ball(0, 1e-6), Ball(1e-6, 1e-6)):
            with pytest.raises(NotProved) as caught:
                elliptic.lemma_4_twist(SETTING, rotation(turns, twist))
            assert caught.value.step == "Lemma 4"
        for twist in (Fraction(1, 1000), Fraction(-7, 3)):
            claims = elliptic.lemma_4_twist(SETTING, rotation(turns, interval.ball(twist)))
            low, high = map(Fraction, claims["twist"])
            assert low <= twist <= high
            low, high = map(Fraction, claims["twist_action"])
            assert low <= 2 * twist <= high


def test_lemma_3_of_saddles():
    """Trace 2 and -2, exactly or perhaps, and less; beyond, the multipliers are right."""
    with interval.workprec(100):
        point = proved_point()[1]
        for trace in (Ball(2), Ball(-2), Ball(2, 1e-9), Ball(-2, 1e-9), Ball(0), Ball("nan")):
            with pytest.raises(NotProved) as caught:
                saddle.lemma_3_hyperbolicity(SETTING, with_trace(point, trace))
            assert caught.value.step == "Lemma 3"
        for trace, outer in ((Fraction(5, 2), Fraction(2)), (Fraction(-10, 3), Fraction(-3))):
            claims = saddle.lemma_3_hyperbolicity(SETTING, with_trace(point, interval.ball(trace)))
            for pair, value in zip(claims, (outer, 1 / outer), strict=True):
                low, high = map(Fraction, pair)
                assert low <= value <= high


def proved_point():
    """Return the oscillator and its proved fixed point."""
    osc = oscillator(PAPER)
    return osc, fixed_point.lemma_1_fixed_point(osc, SETTING)


def with_trace(point, trace):
    """Return the point as if its Jacobian had this trace."""
    orbit = point.orbit._replace(monodromy=((trace, Ball(-1)), (Ball(1), Ball(0))))
    return replace(point, orbit=orbit)


def test_lemma_2_needs_the_fixed_point_in_the_box():
    """An enclosure of P* that reaches over an edge of the rectangle: no claim."""
    with interval.workprec(SETTING.bits):
        osc, point = proved_point()
        reach = Fraction(1, 1000), Fraction(1, 1000)
        fixed_point.lemma_2_uniqueness(osc, point, reach)
        x, v = point.box
        for box in ((x + 1, v), (x, v - 1), (interval.around(Fraction(1, 10), Fraction(1)), v)):
            with pytest.raises(NotProved) as caught:
                fixed_point.lemma_2_uniqueness(osc, replace(point, box=box), reach)
            assert caught.value.step == "Lemma 2"


def test_the_claimed_box_is_inside():
    """Its decimals are rounded inwards, by little."""
    random = seeded(1)
    for _ in range(rounds(200)):
        centre = decimal_fraction(random) * Fraction(10) ** random.randint(-9, 9)
        half = (1 + abs(decimal_fraction(random))) * Fraction(10) ** random.randint(-40, 3)
        lower, upper = map(Fraction, fixed_point.inside(centre, half))
        assert centre - half <= lower < upper <= centre + half
        assert upper - lower > Fraction(97, 100) * 2 * half
        assert holds(between(lower, upper), centre)


def test_the_claims_on_an_orbit_contain_both_ends_of_wide_enclosures():
    """An orbit known to seven digits, its numbers claimed to six: no end of any is lost."""
    with interval.workprec(SETTING.bits):
        osc, point = proved_point()
        wide = interval.around(Fraction(0), Fraction(1, 2 * 10**7))
        orbit = point.orbit._replace(
            events=tuple(
                h._replace(time=h.time + wide, velocity=h.velocity + wide, cos=h.cos + wide)
                for h in point.orbit.hits
            ),
            monodromy=tuple(tuple(e + wide for e in row) for row in point.orbit.monodromy),
            least_speed=point.orbit.least_speed + wide,
        )
        box = tuple(side + wide for side in point.box)
        setting = replace(SETTING, digits=6)
        located = Located(setting, osc, replace(point, box=box, orbit=orbit))
        claims = of_hits(located, Around(Fraction(1), Neighbourhood(point.reach, ()), {}))
        assert claims.pop("box") == {}
    hits, entries = orbit.hits, [list(map(interval.ends, row)) for row in orbit.monodromy]
    (a, b), (c, d) = entries
    forcing = [sorted(abs(end) - PAPER.f for end in interval.ends(h.cos)) for h in hits]
    expected = {
        "x": interval.ends(box[0]),
        "v": interval.ends(box[1]),
        "hit_times": [interval.ends(h.time) for h in hits],
        "hit_speeds": [sorted(map(abs, interval.ends(h.velocity))) for h in hits],
        "hit_forcing": forcing,  # F = 1, and cos does not vanish at a hit
        "least_speed": interval.ends(orbit.least_speed),
        "jacobian": entries,
        "trace": [a[0] + d[0], a[1] + d[1]],
        "determinant": extremes(p * s - q * r for p in a for q in b for r in c for s in d),
    }
    assert claims.keys() == expected.keys()
    for key, ends in expected.items():
        contain(claims[key], ends)


def extremes(values):
    """Return the least and the greatest of the values."""
    ordered = sorted(values)
    return ordered[0], ordered[-1]


def contain(claim, ends):
    """Check that a claim, of any nesting, contains [lower, upper], and is not much wider."""
    if isinstance(claim[0], str):
        (low, high), (lower, upper) = map(Fraction, claim), ends
        assert low <= lower < upper <= high
        assert high - low <= 2 * (upper - lower)
    else:
        for part, inner in zip(claim, ends, strict=True):
            contain(part, inner)
