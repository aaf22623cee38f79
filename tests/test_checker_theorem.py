"""The checker accepts true certificates and rejects those of which one hypothesis is broken."""

from __future__ import annotations

import copy
import json
import time
from fractions import Fraction

import pytest
from checker.forge import ORBITS, PARAMETERS, forge

from cap.checker.certificate import Enclosure, read
from cap.checker.interval import Interval
from cap.checker.mechanics import Mechanics, Parameters
from cap.checker.rejection import Rejected
from cap.checker.theorem import Elliptic, Saddle, check

SCALED = {
    "F": "3",
    "omega": "2",
    "f": "6/5",
    "l": "1/4",
    "r": "7/4",
}  # the orbit of ORBITS, times 3/4
SLOW_SADDLE = ("-0.791447819623894", "0.497920043724544")
SLOW = {"F": "1", "omega": "1", "f": "0.39", "l": "-1", "r": "1"}


@pytest.fixture(scope="module")
def good():
    return forge()


@pytest.fixture(scope="module")
def saddle():
    return forge("saddle")


def verify(certificate):
    steps = []
    check(json.dumps(certificate).encode(), steps.append)
    return steps


def rejected(certificate, why):
    with pytest.raises(Rejected, match=why):
        verify(certificate)


def changed(certificate, *path_and_value):
    *path, last, value = path_and_value
    result = copy.deepcopy(certificate)
    part = result
    for key in path:
        part = part[key]
    part[last] = value
    return result


# what is true is accepted


@pytest.mark.parametrize(
    "options",
    [
        {"digits": 6},
        {"digits": 30, "order": 5},
        {"digits": 60, "order": 7, "box_radius": "0.001"},
        {"digits": 12, "orbit": ORBITS["mirror"]},
        {"digits": 12, "box_radius": "0.01"},
        {"digits": 12, "theorem": "saddle", "box_radius": "0.004"},
        {"digits": 12, "parameters": SLOW, "orbit": ("0.0793", "0.5264")},
        {"digits": 12, "parameters": SCALED, "orbit": ("1.0752099", "0.812915")},
        {
            "digits": 12,
            "parameters": SCALED,
            "orbit": ("1.2576445", "1.162979"),
            "theorem": "saddle",
        },
        {"digits": 300, "theorem": "saddle"},
    ],
    ids=str,
)
def test_accepts(options):
    assert len(verify(forge(**options))) >= 6


def test_an_elliptic_certificate_takes_less_than_a_second(good):
    start = time.perf_counter()
    verify(good)
    assert time.perf_counter() - start < 1


def test_the_saddle_that_hits_slowly():
    verify(forge("saddle", orbit=SLOW_SADDLE, box_radius="0.0000002", digits=10))


# the claims


def leaves(value, path=()):
    if isinstance(value, dict):
        for key, part in value.items():
            yield from leaves(part, (*path, key))
    elif isinstance(value, list) and not (len(value) == 2 and isinstance(value[0], str)):
        for n, part in enumerate(value):
            yield from leaves(part, (*path, n))
    elif isinstance(value, list):
        yield path, value


def decimal(q, places=60):
    n = round(q * 10**places)
    return ("-" if n < 0 else "") + f"{abs(n) // 10**places}.{abs(n) % 10**places:0{places}d}"


def enclosures(certificate):
    return [(p, v) for p, v in leaves(certificate["claims"]) if p[0] != "box"]


@pytest.mark.parametrize("theorem", ["elliptic", "saddle"])
def test_every_claim_is_compared_at_both_ends_and_for_its_width(theorem, good, saddle):
    certificate = good if theorem == "elliptic" else saddle
    for path, (lower, upper) in enclosures(certificate):
        a, b = Fraction(lower), Fraction(upper)
        middle, width = (a + b) / 2, b - a
        for low, high, why in (
            (a, a + width / 8, "contain"),
            (b - width / 8, b, "contain"),
            (a - width, a, "contain"),
            (b, b + width, "contain"),
            (a - 20 * width * max(1, abs(middle)), b + 20 * width * max(1, abs(middle)), "wider"),
        ):
            rejected(changed(certificate, "claims", *path, [decimal(low), decimal(high)]), why)


def test_the_width_rule_is_sharp(good):
    """The unit of x is R = 2, so the width may be 2e-30 at 30 digits."""
    lower = Fraction(good["claims"]["x"][0])
    for excess, fine in ((0, True), (Fraction(1, 10**40), False)):
        claim = [decimal(lower), decimal(lower + Fraction(2, 10**30) + excess)]
        certificate = changed(good, "claims", "x", claim)
        if fine:
            verify(certificate)
        else:
            rejected(certificate, "wider")


def test_each_comparison_uses_its_unit():
    """In a system with R = 200, omega = 1/10, widths that the unit allows exactly are accepted."""
    parameters = {"F": "1", "omega": "1/10", "f": "2/5", "l": "-100", "r": "100"}
    R, w = Fraction(200), Fraction(1, 10)
    certificate = forge(
        parameters=parameters, orbit=("10.027988984", "5.41943306"), box_radius="0.02", digits=9
    )
    units = {
        "x": R,
        "v": R * w,
        "hit_times": 1 / w,
        "hit_speeds": R * w,
        "least_speed": R * w,
        "hit_forcing": 1,
    }
    units |= {"twist": 1 / (R**2 * w), "twist_action": 1 / (R**2 * w)}
    for path, (lower, upper) in enclosures(certificate):
        unit = units.get(path[0], 1)
        if path[0] == "jacobian":
            unit = {(0, 1): 1 / w, (1, 0): w}.get(path[1:], 1)
        if path[0] == "taylor":
            i, j = (int(n) for n in path[2].split(","))
            unit = (R if path[1] == "x" else R * w) / R**i / (R * w) ** j
        a, b = Fraction(lower), Fraction(upper)
        allowed = max(abs(a), abs(b), unit) / 10**9
        middle = (a + b) / 2
        fine = [decimal(middle + side * allowed * Fraction(49, 100)) for side in (-1, 1)]
        wide = [decimal(middle + side * allowed * Fraction(51, 100)) for side in (-1, 1)]
        verify(changed(certificate, "claims", *path, fine))
        rejected(changed(certificate, "claims", *path, wide), "wider")


# the conclusions, for numbers that cannot be reached with true enclosures


def proof(certificate, **claims):
    theorem = {"elliptic": Elliptic, "saddle": Saddle}[certificate["theorem"]]
    result = theorem(read(json.dumps(certificate).encode()), lambda _: None)
    for name, value in claims.items():
        result.claims[name] = value
    return result


def pair(lower, upper):
    return Enclosure(Fraction(lower), Fraction(upper), (str(lower), str(upper)))


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"hit_times": [pair(0, 1), pair(2, 3)]}, "not positive"),
        ({"hit_times": [pair(1, 2), pair(2, 3)]}, "increasing"),
        ({"hit_times": [pair(1, 2), pair("5/2", "6.29")]}, "before T"),
        ({"hit_speeds": [pair(1, 2), pair(0, 1)]}, "hit speed"),
        ({"least_speed": pair(0, 1)}, "least speed"),
        ({"determinant": pair("1.001", "1.002")}, "determinant"),
        ({"determinant": pair("0.998", "0.999")}, "determinant"),
    ],
    ids=str,
)
def test_conclusions_of_both(good, claims, why):
    proof(good).conclusion_of_both()
    with pytest.raises(Rejected, match=why):
        proof(good, **claims).conclusion_of_both()


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"trace": pair(2, 3)}, "trace"),
        ({"trace": pair(-3, -2)}, "trace"),
        ({"multipliers": [pair(1, 2), pair("1/3", "1/2")]}, "outer"),
        ({"multipliers": [pair(-2, -1), pair("1/3", "1/2")]}, "outer"),
        ({"multipliers": [pair(2, 3), pair("1/3", 1)]}, "inner"),
        ({"multipliers": [pair(2, 3), pair(-1, "1/2")]}, "inner"),
    ],
    ids=str,
)
def test_conclusions_of_hyperbolicity(saddle, claims, why):
    proof(saddle).hyperbolicity()
    with pytest.raises(Rejected, match=why):
        proof(saddle, **claims).hyperbolicity()


@pytest.mark.parametrize(
    ("claims", "why"),
    [
        ({"trace": pair(-1, 2)}, "trace"),
        ({"trace": pair(-2, 1)}, "trace"),
        ({"rotation_angle": pair(-1, 0)}, "exclude 0"),
        ({"rotation_angle": pair(0, 1)}, "exclude 0"),
        ({"rotation_angle": pair(1, "3.1416")}, "rotation angle"),
        ({"rotation_angle": pair("-3.1416", -1)}, "rotation angle"),
        ({"rotation_number": pair(0, "1/3")}, "rotation number"),
        ({"rotation_number": pair("1/3", "1/2")}, "rotation number"),
        ({"resonance_distances": {"0": pair(1, 1), "1/4": pair(0, 1)}}, "resonance"),
        ({"twist": pair(0, 1)}, "twist does"),
        ({"twist": pair(-1, 0)}, "twist does"),
        ({"twist_action": pair(-1, 1)}, "twist_action does"),
    ],
    ids=str,
)
def test_conclusions_of_ellipticity(good, claims, why):
    proof(good).ellipticity()
    with pytest.raises(Rejected, match=why):
        proof(good, **claims).ellipticity()


# existence


def test_the_box_must_be_between_the_walls(good):
    rejected(changed(good, "claims", "box", "x", ["0.09", "1"]), "between the walls")
    rejected(changed(good, "claims", "box", "x", ["-1", "0.11"]), "between the walls")


def test_the_box_must_not_contain_rest(good):
    rejected(changed(good, "claims", "box", "v", ["0", "0.55"]), "velocity vanishes in the box")
    rejected(changed(good, "claims", "box", "v", ["-0.1", "0.55"]), "velocity vanishes in the box")


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("side", [-1, 1])
def test_the_centre_must_lie_in_the_box(good, axis, side):
    name = "xv"[axis]
    centre = Fraction(good["hints"]["centre"][axis])
    ends = sorted((centre + side * Fraction(1, 10**6), centre + side * Fraction(1, 500)))
    rejected(changed(good, "claims", "box", name, [decimal(q) for q in ends]), "centre")


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("side", [-1, 1])
def test_the_square_must_lie_in_the_box(good, axis, side):
    """The centre is in the box and K(box) is inside, but S reaches over one side."""
    certificate, reach = changed(good, "hints", "radius", "0.0001"), Fraction(11, 100000)
    for n, name in enumerate("xv"):
        centre = Fraction(good["hints"]["centre"][n])
        ends = [centre - reach, centre + reach]
        if n == axis:
            ends[(side + 1) // 2] = centre + side * Fraction(1, 20000)
        certificate["claims"]["box"][name] = [decimal(q) for q in ends]
    rejected(certificate, "S is not in the box")


def test_a_box_that_is_too_large(good):
    """Moderately: K is not inside; then the windows do not hold all hits."""
    box = {"x": ["0.08", "0.12"], "v": ["0.52", "0.56"]}
    windows = [["1.03", "1.17"], ["3.3", "3.7"]]
    rejected(
        changed(changed(good, "claims", "box", box), "hints", "hit_times", windows), "interior"
    )
    rejected(changed(good, "claims", "box", box), "wall may")


def test_a_box_without_a_fixed_point(good):
    shift = Fraction(1, 100)
    certificate = copy.deepcopy(good)
    for n, name in enumerate("xv"):
        ends = [Fraction(q) + shift for q in good["claims"]["box"][name]]
        certificate["claims"]["box"][name] = [decimal(q) for q in ends]
        certificate["hints"]["centre"][n] = decimal(sum(ends) / 2)
    certificate["hints"]["hit_times"] = [["1.04", "1.12"], ["3.45", "3.65"]]
    rejected(certificate, "interior")


@pytest.mark.parametrize("n", [0, 1])
@pytest.mark.parametrize("m", [0, 1])
def test_a_bad_preconditioner(good, n, m):
    rejected(changed(good, "hints", "preconditioner", n, m, "5"), "interior")


def test_a_square_that_does_not_hold_the_fixed_point(good):
    centre = decimal(Fraction(good["hints"]["centre"][0]) + Fraction(1, 10**20))
    rejected(changed(good, "hints", "centre", 0, centre), "interior")


@pytest.mark.parametrize("side", [0, 1])
@pytest.mark.parametrize("name", ["x", "v"])
def test_the_interior_at_each_side(good, name, side):
    """A box around S that ends just beyond the fixed point on one side: K(box) reaches over it."""
    certificate = copy.deepcopy(good)
    n = "xv".index(name)
    value = Fraction(good["claims"][name][0])
    ends = [value - Fraction(1, 1000), value + Fraction(1, 1000)]
    ends[side] = value + Fraction(side * 2 - 1, 10**9)
    certificate["claims"]["box"][name] = [decimal(q) for q in ends]
    rejected(certificate, "interior")
    certificate["hints"]["centre"][n] = decimal(sum(ends) / 2)
    rejected(certificate, "interior")


# the itinerary


@pytest.mark.parametrize(
    ("windows", "why"),
    [
        ([["0", "1.2"], ["3.4", "3.6"]], "begins before"),
        ([["1.0", "1.2"], ["1.1", "3.6"]], "begins before"),
        ([["1.0", "1.2"], ["3.4", "6.3"]], "after T"),
        ([["1.11", "1.2"], ["3.4", "3.6"]], "reached before"),
        ([["1.0", "1.05"], ["3.4", "3.6"]], "not be reached"),
        ([["1.05", "1.15"], ["3.6", "3.7"]], "reached before"),
        ([["1.05", "1.15"], ["3.3", "3.4"]], "not be reached"),
        ([["1.05", "1.15"], ["3.4", "3.6"], ["5.9", "6.1"]], "not be reached"),
        ([["1.05", "1.15"]], "vanish between the last"),
        ([["1.05", "1.15"], ["3.4", "3.6"], ["6.1", "6.2"], ["6.25", "6.26"]], "not be reached"),
    ],
)
def test_windows(good, windows, why):
    certificate = changed(good, "hints", "hit_times", windows)
    for name in ("hit_times", "hit_speeds", "hit_forcing"):
        certificate["claims"][name] = (good["claims"][name] * 2)[: len(windows)]
    rejected(certificate, why)


def passage(x, v, windows, parameters=PARAMETERS, radius="0", order=2):
    p = Parameters(**{k: Fraction(q) for k, q in parameters.items()})
    rho, m = Fraction(radius), (Fraction(x), Fraction(v))
    box = [Interval.enclosing(q - rho, q + rho, 128) for q in m]
    centre = [Interval.enclosing(q, q, 128) for q in m]
    return Mechanics(p, box, centre, order).passage(
        [(Fraction(a), Fraction(b)) for a, b in windows]
    )


@pytest.mark.parametrize("x", ["1", "-1", "1.5", "-2"])
def test_a_start_at_or_beyond_a_wall(x):
    with pytest.raises(Rejected, match="box is not certainly between"):
        passage(x, "0.5", [("1", "2")])


def test_a_start_at_rest():
    with pytest.raises(Rejected, match="velocity vanishes"):
        passage("0", "0.001", [("1", "2")], radius="0.001")


def test_a_turn_before_the_hit():
    """From (0, 0.1) at 0 the mass goes right and turns before it returns to the right wall."""
    with pytest.raises(Rejected, match="vanish before a hit"):
        passage("0", "0.1", [("3", "6")])


def test_a_turn_inside_the_flight_only():
    """s v is positive at both ends of the flight, and negative at its minimum between them."""
    parameters = {"F": "1", "omega": "1", "f": "0", "l": "-10", "r": "10"}
    with pytest.raises(Rejected, match="vanish between the last hit"):
        passage("0", "0.5", [], parameters)  # v = 1/2 + sin t
    passage("0", "1.1", [], parameters)
    with pytest.raises(Rejected, match="vanish between the last hit"):
        passage("0", "1", [], parameters)  # v = 1 + sin t touches zero
    passage("0", "-1.1", [], parameters)
    with pytest.raises(Rejected, match="vanish between the last hit"):
        passage("0", "-0.9", [], parameters)


@pytest.mark.parametrize("x", ["2", "5", "-2"])
def test_the_end_must_lie_between_the_walls(x):
    """x(T) = x + 2 pi v, and no hit is named."""
    parameters = {"F": "1", "omega": "1", "f": "0", "l": "-10", "r": "10"}
    with pytest.raises(Rejected, match="x\\(T\\)"):
        passage(x, "1.5" if Fraction(x) > 0 else "-1.5", [], parameters)


@pytest.mark.parametrize(("v", "least"), [("1.5", "0.5"), ("-1.5", "0.5")])
def test_the_least_speed_of_a_flight(v, least):
    parameters = {"F": "1", "omega": "1", "f": "0", "l": "-20", "r": "20"}
    result = passage("0", v, [], parameters).least_speed
    assert result.lower <= Fraction(least) <= result.upper
    assert result.width < 100


def test_the_passage_of_the_free_mass():
    """With a weak force the hits are at 3/4, 7/4, ... of a flight of length 2 with speed 2."""
    parameters = {"F": "1/1000000", "omega": "1", "f": "0", "l": "-1", "r": "1"}
    windows = [
        (Fraction(1, 2) + k - Fraction(1, 9), Fraction(1, 2) + k + Fraction(1, 9)) for k in range(6)
    ]
    result = passage("0", "2", windows, parameters)
    for k, hit in enumerate(result.hits):
        assert abs(float(hit.moment.t[0, 0].lower) - 0.5 - k) < 1e-4
    assert abs(float(result.v[0, 0].lower) - 2) < 1e-4


# the remainder


@pytest.mark.parametrize("component", ["x", "v"])
def test_the_remainder_must_be_large_enough(good, component):
    bound = Fraction(good["claims"]["remainder"][component])
    rejected(
        changed(good, "claims", "remainder", component, decimal(bound / 4, 80)),
        f"remainder of {component}",
    )


def test_the_remainder_disk(good):
    rejected(changed(good, "claims", "remainder", "radius", "0"), "radius")
    rejected(changed(good, "claims", "remainder", "radius", "-0.0001"), "radius")
    rejected(changed(good, "claims", "remainder", "degree", "5"), "degree")
    rejected(changed(good, "claims", "remainder", "radius", "0.0021"), "in the box")


@pytest.mark.parametrize("name", ["x", "v"])
def test_the_remainder_disk_lies_in_the_box_on_all_sides(good, name):
    value = Fraction(good["claims"][name][0])
    for ends in ((Fraction(1, 20000), Fraction(1, 500)), (Fraction(1, 500), Fraction(1, 20000))):
        certificate = copy.deepcopy(good)
        certificate["claims"]["box"][name] = [decimal(value - ends[0]), decimal(value + ends[1])]
        other = "xv"[name == "x"]
        middle = Fraction(good["claims"][other][0])
        reach = Fraction(11, 100000)
        certificate["claims"]["box"][other] = [decimal(middle - reach), decimal(middle + reach)]
        with pytest.raises(Rejected, match=r"in the box|interior"):
            verify(certificate)


# other theorems


@pytest.mark.parametrize("name", ["F", "omega", "f", "l", "r"])
def test_other_parameters(good, name):
    value = Fraction(PARAMETERS[name]) + Fraction(1, 10**12)
    with pytest.raises(Rejected):
        verify(changed(good, "parameters", name, decimal(value)))


def test_a_saddle_is_not_elliptic(good, saddle):
    certificate = copy.deepcopy(good)
    for name in saddle["claims"].keys() & good["claims"].keys():
        certificate["claims"][name] = saddle["claims"][name]
    certificate["hints"] = saddle["hints"] | {"order": "3"}
    rejected(certificate, "square root")


def test_an_elliptic_point_is_no_saddle(good, saddle):
    certificate = copy.deepcopy(saddle)
    for name in saddle["claims"].keys() & good["claims"].keys():
        certificate["claims"][name] = good["claims"][name]
    certificate["hints"] = {k: v for k, v in good["hints"].items() if k != "order"}
    rejected(certificate, "square root")


def test_too_few_bits(good):
    rejected(changed(good, "hints", "bits", "64"), "interior")
