"""The theorems at the paper's parameters: every claim against an oracle of sixty digits."""

from copy import deepcopy
from fractions import Fraction
from functools import cache

import mpmath
import pytest
import reference
from checker.forge import forge
from conftest import ORBITS, STARTS
from mpmath import mp, mpf
from oracle import compared, exact_decimal, oracle
from support import certified, number, rational, rounds, seeded

from cap.certificate.writer import dumps
from cap.errors import NotProved
from cap.maps.fixed_point import Start
from cap.parameters import PAPER, Parameters, exact
from cap.proofs import elliptic, saddle
from cap.proofs.fixed_point import Setting

THEOREMS = {
    "elliptic": elliptic,
    "mirror": elliptic,
    "saddle": saddle,
    "second saddle": saddle,
}
NAMES = pytest.mark.parametrize("name", THEOREMS)
DIGITS = pytest.mark.parametrize("digits", [6, 30, 100])
THIRD = {"order": 3}
PRECISION = {"second saddle": 20}  # digits of the oracle's derivatives; 35 for the others


def proved(name, digits, part=Fraction(9, 10)):
    """Return the certificate of one of the paper's orbits."""
    return deepcopy(proved_once(name, digits, part))


@cache
def proved_once(name, digits, part):
    """Prove a theorem about one of the paper's orbits."""
    return certified(THEOREMS[name], Setting(PAPER, STARTS[name], digits, options=THIRD), part)


@NAMES
@DIGITS
def test_claims_contain_the_truth(name, digits):
    """Every number claimed, at 6, 30 and 100 digits, as far as the oracle goes."""
    claims = proved(name, digits)["claims"]
    with mpmath.workdps(reference.DIGITS):
        values = oracle(name)
        for key, value in values.items():
            derived = key not in ("x", "v", "hit_times", "hit_speeds", "hit_forcing", "least_speed")
            places = PRECISION.get(name, 35) if derived else 50
            error = Fraction(1, 10 ** (14 if key == "taylor" else places))
            assert compared(claims[key], value, error, key)
    left = {
        "box",
        *({"twist", "twist_action", "higher_twists", "remainder"} if "twist" in claims else ()),
    }
    assert set(claims) == set(values) | left


@NAMES
@DIGITS
def test_widths_obey_the_rule_of_digits(name, digits):
    """At most 10^-digits max(|lower|, |upper|, unit), with unit one: here all units are <= 2."""
    claims = proved(name, digits)["claims"]
    narrowest = []

    def check(claim):
        if isinstance(claim, dict):
            for part in claim.values():
                check(part)
        elif isinstance(claim, list) and claim and isinstance(claim[0], str):
            lower, upper = map(exact_decimal, claim)
            assert lower <= upper
            size = max(abs(lower), abs(upper), 2)
            assert upper - lower <= size / 10**digits
            narrowest.append((upper - lower) / size)
        elif isinstance(claim, list):
            for part in claim:
                check(part)

    check({k: c for k, c in claims.items() if k not in ("box", "remainder")})
    assert len(narrowest) >= 16
    assert max(narrowest) > Fraction(1, 10 ** (digits + 4))


@NAMES
def test_more_digits_say_the_same(name):
    """The enclosures at 100 digits lie in those at 6; the box is the same but for rounding."""

    def nested(fine, coarse):
        if isinstance(fine, dict):
            assert list(fine) == list(coarse)
            fine, coarse = list(fine.values()), list(coarse.values())
        if fine and isinstance(fine[0], str):
            (a, b), (c, d) = (map(Fraction, pair) for pair in (fine, coarse))
            assert c <= a <= b <= d
        else:
            for f, c in zip(fine, coarse, strict=True):
                nested(f, c)

    fine, coarse = (proved(name, digits)["claims"] for digits in (100, 6))
    for claims in (fine, coarse):
        for key in ("box", "remainder"):
            claims.pop(key, None)
    nested(fine, coarse)


@NAMES
def test_the_same_request_gives_the_same_certificate(name):
    """Whatever ran before, also a failed proof at another precision."""
    first = proved(name, 12)
    proved_once.cache_clear()
    proved("saddle", 40)
    with pytest.raises(NotProved):
        certified(saddle, Setting(PAPER, STARTS["elliptic"], 33))
    second = proved(name, 12)
    assert first == second
    assert dumps(first) == dumps(second)


@NAMES
def test_the_shape_of_a_certificate(name):
    """The fields of the format; strings everywhere; parameters exact."""
    result = proved(name, 10)
    assert list(result) == ["format", "theorem", "parameters", "digits", "claims", "hints", "cites"]
    assert result["format"] == "cap-certificate/1"
    assert result["theorem"] in name or name == "mirror"
    assert Parameters(*map(exact, result["parameters"].values())) == PAPER
    assert result["digits"] == "10"
    hints = ["bits", "centre", "radius", "preconditioner", "hit_times"]
    kind = [] if "saddle" in name else ["order"]
    assert list(result["hints"]) == hints + kind

    def strings(value):
        if isinstance(value, dict):
            return all(isinstance(k, str) and strings(v) for k, v in value.items())
        return isinstance(value, str) or (isinstance(value, list) and all(map(strings, value)))

    assert strings(result)
    keys = set(result["claims"])
    for cite in result["cites"]:
        assert all(set(h["by"]) <= keys for h in cite["hypotheses"])


@NAMES
def test_the_box_holds_only_orbits_of_the_same_kind(name):
    """Random orbits from the claimed box, and its corners: hits in the windows, no fixed point."""
    result, random = proved(name, 20), seeded(name)
    sides = [[Fraction(end) for end in side] for side in result["claims"]["box"].values()]
    windows = [[Fraction(end) for end in pair] for pair in result["hints"]["hit_times"]]
    corners = [(x, v) for x in sides[0] for v in sides[1]]
    others = [
        [a + (b - a) * Fraction(random.randint(0, 100), 100) for a, b in sides]
        for _ in range(rounds(4))
    ]
    with mpmath.workdps(reference.DIGITS):
        system = reference.System.of(PAPER)
        for state in [*corners, *others]:
            orbit = reference.flow(system, *map(number, state))
            for (lower, upper), time in zip(windows, orbit.hits, strict=True):
                assert lower < rational(time) < upper
            assert any(abs(number(a) - b) > 1e-12 for a, b in zip(state, orbit.end, strict=True))
        x, v, _ = reference.periodic_orbit(system, ORBITS[name][2])
        for (lower, upper), value in zip(sides, (x, v), strict=True):
            assert lower < rational(value) < upper


def middle(pair):
    """Return the middle of a claimed pair."""
    return sum(number(Fraction(end)) for end in pair) / 2


@pytest.mark.parametrize("name", ["elliptic", "mirror"])
@pytest.mark.parametrize("order", [3, 5])
def test_the_remainder(name, order):
    """On the disk Φ is as close to its Taylor polynomial as claimed; the disk is in the box."""
    claims = certified(elliptic, Setting(PAPER, STARTS[name], 20, options={"order": order}))[
        "claims"
    ]
    remainder, worst = claims["remainder"], {"x": mpf(0), "v": mpf(0)}
    assert remainder["degree"] == str(order)
    with mpmath.workdps(reference.DIGITS):
        system = reference.System.of(PAPER)
        fixed = reference.periodic_orbit(system, ORBITS[name][2])[:2]
        matrix = reference.jacobian(system, *fixed)
        radius = number(Fraction(remainder["radius"]))
        for k in range(rounds(16)):
            d = [radius * f(2 * mp.pi * k / rounds(16)) for f in (mp.cos, mp.sin)]
            image = reference.strobe(system, fixed[0] + d[0], fixed[1] + d[1])
            for n, key in enumerate("xv"):
                taylor = fixed[n] + matrix[n][0] * d[0] + matrix[n][1] * d[1]
                for exponent, pair in claims["taylor"][key].items():
                    i, j = map(int, exponent.split(","))
                    taylor += middle(pair) * d[0] ** i * d[1] ** j
                worst[key] = max(worst[key], abs(image[n] - taylor))
        for n, key in enumerate("xv"):
            assert worst[key] <= number(Fraction(remainder[key])) < 5000 * worst[key]
            lower, upper = (number(Fraction(end)) for end in claims["box"][key])
            assert lower < fixed[n] - radius < fixed[n] + radius < upper


def test_higher_orders_agree():
    """Order 5 claims the same numbers as order 3, and τ_2 besides, which forge computes too."""
    third, fifth = (
        certified(elliptic, Setting(PAPER, STARTS["elliptic"], 20, options={"order": order}))[
            "claims"
        ]
        for order in (3, 5)
    )
    (second,) = fifth["higher_twists"]
    assert third["higher_twists"] == []
    (other,) = forge(digits=30, order=5)["claims"]["higher_twists"]
    lower, low, high, upper = map(Fraction, (second[0], *other, second[1]))
    assert lower <= low <= high <= upper
    assert upper - lower <= -lower / 10**20
    for key in ("x", "trace", "rotation_angle", "twist", "twist_action"):
        assert third[key] == fifth[key]
    assert [Fraction(end) for end in third["twist"]] == pytest.approx([0.11347797703] * 2)
    for end, double in zip(third["twist"], third["twist_action"], strict=True):
        assert abs(2 * Fraction(end) - Fraction(double)) < Fraction(1, 10**18)


def test_a_smaller_margin_gives_a_smaller_box():
    """The part of the neighbourhood that is claimed; the rest of the claims stay."""
    whole, part = (deepcopy(proved("saddle", 10, Fraction(n, 10))["claims"]) for n in (9, 3))
    for key in "xv":
        (a, b), (c, d) = (map(Fraction, claims["box"].pop(key)) for claims in (whole, part))
        assert a < c < d < b
        assert (d - c) / (b - a) == pytest.approx(Fraction(1, 3), rel=0.01)
    assert whole == part


@pytest.mark.parametrize(
    ("length", "omega", "shift"),
    [("3/2", "2", "1"), ("1000000", "1/10", "-7/3"), ("1/1000000", "1000", "0")],
)
@pytest.mark.parametrize("name", ["elliptic", "saddle"])
def test_theorems_scale(name, length, omega, shift):
    """In other units of length and time, and elsewhere, the same theorem with scaled numbers."""
    size, w, shift = Fraction(length), Fraction(omega), Fraction(shift)
    force = size * w**2
    p = Parameters(force, w, PAPER.f * force, shift - size, shift + size)
    x, v, times = ORBITS[name]
    x, v, times = float(size) * x + float(shift), float(size * w) * v, [t / float(w) for t in times]
    start = Start.non_sticking(x, v, times)
    scaled = certified(THEOREMS[name], Setting(p, start, 12, options=THIRD))["claims"]
    claims = proved(name, 12)["claims"]

    def same(key, unit, offset=Fraction(0)):
        small, large = claims[key], scaled[key]
        for a, b in zip(
            *(c if isinstance(c[0], list) else [c] for c in (small, large)), strict=True
        ):
            (lower, upper), (low, high) = (sorted(map(Fraction, pair)) for pair in (a, b))
            assert lower * unit + offset <= high
            assert low <= upper * unit + offset

    same("x", size, shift)
    same("v", size * w)
    same("hit_times", 1 / w)
    same("hit_speeds", size * w)
    same("hit_forcing", force)
    same("least_speed", size * w)
    same("trace", Fraction(1))
    if name == "elliptic":
        same("rotation_angle", Fraction(1))
        same("twist", 1 / (size**2 * w))
