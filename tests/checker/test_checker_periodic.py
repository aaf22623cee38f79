"""The theorem ``periodic``: true certificates are verified, and each number in them counts."""

from __future__ import annotations

import copy
from fractions import Fraction

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import Enclosure
from cap.checker.theorems.periodic import Periodic, norm, real
from checker.altered import changed, decimal, encode, leaves, rejected, verify
from checker.forge_hybrid import PERIODIC, valid

pytestmark = pytest.mark.usefixtures("orbits_computed_once")

TYPES = {
    "focus": "sink focus",
    "saddle": "saddle",
    "stick": "superstable",
    "viscous": "sink focus",
    "elliptic": "elliptic",
    "damped": "sink focus",
    "double": "sink focus",
    "captured": "superstable",
}


@pytest.fixture(scope="module")
def forged():
    """Return a valid certificate of each orbit."""
    return {name: valid(name) for name in PERIODIC}


@pytest.mark.parametrize("name", PERIODIC)
def test_accepts(forged, name):
    """Orbits with hits, turns, sticks and captures, damped or not, of one and of two periods."""
    certificate = forged[name]
    assert certificate["claims"]["type"] == TYPES[name]
    assert len(verify(certificate)) == 7 + ("basin" in certificate["claims"])


def test_the_numbers_of_the_paper(forged):
    """The stable focus at F = 3: trace and determinant, two hits of each wall, two turns."""
    claims = forged["focus"]["claims"]
    assert abs(Fraction(claims["trace"][0]) + Fraction("0.968")) < Fraction(1, 1000)
    assert abs(Fraction(claims["determinant"][0]) - Fraction("0.578")) < Fraction(1, 1000)
    assert sorted(w.split()[0] for w in claims["itinerary"]) == ["hit"] * 4 + ["turn"] * 2
    assert abs(Fraction(forged["saddle"]["claims"]["trace"][0]) - Fraction("11.76")) < 1


# each claim


def compared(certificate):
    """Return the proof, its fixed point and its orbit, before the comparisons."""
    proof = Periodic(read(encode(certificate)), lambda _: None)
    fixed_point = proof.localisation()
    return proof, fixed_point, proof.near(fixed_point, fixed_point, 2)


def replaced(claims, path, value):
    """Return the claims with another enclosure at a path."""
    result = copy.deepcopy(claims)
    part = result
    for key in path[:-1]:
        part = part[key]
    lower, upper = value
    part[path[-1]] = part[path[-1]]._replace(lower=lower, upper=upper)
    return result


@pytest.mark.parametrize("name", PERIODIC)
def test_every_claim_is_compared_at_both_ends_and_for_its_width(forged, name):
    """Either end moved past the truth, and both moved apart, are noticed everywhere."""
    certificate = forged[name]
    proof, fixed_point, orbit = compared(certificate)
    claims, count = proof.claims, 0
    proof.orbit(fixed_point, orbit)
    for path, (lower, upper) in leaves(claims_without_sets(certificate)):
        a, b = Fraction(lower), Fraction(upper)
        width, middle = b - a, abs(a + b) / 2
        wrong = [(b - width / 8, b), (b, b + max(width, Fraction(1, 1000))), (a - 1, a)]
        kind = certificate["claims"]["itinerary"][path[1]] if path[0] == "event_times" else ""
        if not kind.startswith("capture"):  # no width rule
            wrong.append((a - 20 * width * max(1, middle), b + 20 * width * max(1, middle)))
        if width == 0:
            wrong = [(a, a + 1), (a - 1, a), (a + 1, a + 1)]
        for ends in wrong[kind.startswith("capture") :]:
            proof.claims = replaced(claims, path, ends)
            with pytest.raises(Rejected, match=r"contain|wider|exactly"):
                proof.orbit(fixed_point, orbit)
            count += 1
    assert count > 40


def claims_without_sets(certificate):
    """Return the claims that are enclosures of numbers."""
    unequal = ("box", "basin", "itinerary", "type", "period")
    return {k: v for k, v in certificate["claims"].items() if k not in unequal}


@pytest.mark.parametrize(
    "path", [("x",), ("event_times", 1), ("hit_speeds", 0), ("jacobian", 1, 0)]
)
def test_a_wrong_claim_rejects_the_certificate(forged, path):
    """The comparisons are made for a whole certificate, too."""
    rejected(changed(forged["elliptic"], "claims", *path, ["5", "5.0000001"]), "contain")


def test_the_determinant_is_exact(forged):
    """Without losses it is 1, after a stick 0: an enclosure, however narrow, is refused."""
    for name, exact in (("elliptic", 1), ("stick", 0)):
        near = [str(exact), decimal(exact + Fraction(1, 10**50))]
        rejected(changed(forged[name], "claims", "determinant", near), "exactly")


@pytest.mark.parametrize("name", ["focus", "saddle", "stick", "elliptic"])
def test_another_type_is_refused(forged, name):
    """Each of the other types, with or without a basin as its form demands."""
    basin = forged["focus"]["claims"]["basin"]
    for kind in {*TYPES.values(), "sink node", "flip saddle"} - {TYPES[name]}:
        certificate = changed(forged[name], "claims", "type", kind)
        certificate["claims"].pop("basin", None)
        if kind.startswith("s") and kind != "saddle":
            certificate["claims"]["basin"] = basin
        rejected(certificate, "type")


def pair(lower, upper):
    """Return an enclosure with these ends."""
    return Enclosure(Fraction(lower), Fraction(upper), (lower, upper))


@pytest.mark.parametrize(
    ("trace", "det", "kind"),
    [
        (("-2", "1"), ("1", "1"), "elliptic"),
        (("-1", "1"), ("0.99", "1"), "elliptic"),
        (("-1", "0.5"), ("0", "0"), "superstable"),
        (("0", "0.5"), ("0", "1/10"), "superstable"),
        (("0.5", "1"), ("1/4", "1/3"), "sink focus"),
        (("0.5", "0.6"), ("1/2", "1"), "sink focus"),
        (("0.5", "0.6"), ("0", "1/2"), "sink focus"),
        (("1", "1.1"), ("1/5", "1/4"), "sink node"),
        (("-1.2", "-1.1"), ("1/5", "1/4"), "sink node"),
        (("-1", "1.1"), ("1/100", "1/100"), "sink node"),
        (("1.5", "2"), ("1/2", "1/2"), "saddle"),
        (("-2", "-1.5"), ("1/2", "1/2"), "flip saddle"),
    ],
    ids=str,
)
def test_the_borders_of_the_types(forged, trace, det, kind):
    """Trace and determinant on the border of a type are not enough."""
    proof = Periodic(read(encode(forged["focus"])), lambda _: None)
    proof.claims |= {"trace": pair(*trace), "determinant": pair(*det), "type": kind}
    with pytest.raises(Rejected, match="type"):
        proof.kind()


# the box and the basin


def test_the_contraction(forged):
    """A contraction of 1, one below the multipliers, and a matrix that is no norm, or too small."""
    certificate = forged["focus"]
    rejected(changed(certificate, "claims", "basin", "contraction", "1"), "not below 1")
    rejected(changed(certificate, "claims", "basin", "contraction", "0.76"), "contracted")
    verify(changed(certificate, "claims", "basin", "contraction", "0.97"))
    matrix = certificate["claims"]["basin"]["matrix"]
    for size in (1, 2, 20):
        scaled = [[decimal(Fraction(q) / size) for q in row] for row in matrix]
        altered = changed(certificate, "claims", "basin", "matrix", scaled)
        if size < 20:
            verify(altered)
        else:
            rejected(altered, "lie in the box")
    rejected(
        changed(certificate, "claims", "basin", "matrix", [["1", "2"], ["2", "4"]]), "singular"
    )


@pytest.mark.parametrize("side", [-1, 1])
@pytest.mark.parametrize("axis", [0, 1])
def test_an_ellipse_that_touches_the_box(forged, axis, side):
    """The box may end where the ellipse does, but not a unit 2^-bits before."""
    certificate = forged["focus"]
    proof, fixed_point, _ = compared(certificate)
    (a, b), (c, d) = proof.claims["basin"]["matrix"]
    row = [(d, -b), (-c, a)][axis]  # of the inverse, times the determinant
    square = sum(q**2 for q in row) / (a * d - b * c) ** 2
    reach = Interval.enclosing(square, square, proof.hints["bits"]).sqrt().upper
    z, unit = fixed_point[axis], Fraction(1, 1 << proof.hints["bits"])
    end = z.upper + reach if side > 0 else z.lower - reach
    path = "claims", "box", "xv"[axis], (side + 1) // 2
    verify(changed(certificate, *path, str(end)))
    rejected(changed(certificate, *path, str(end - side * unit)), "basin does not certainly lie")


def test_an_ellipse_in_the_box_that_is_not_contracted(forged):
    """A round ellipse is not contracted by a focus that shears, nor is a large one by a node."""
    round_one = [["10000", "0"], ["0", "10000"]]
    rejected(changed(forged["focus"], "claims", "basin", "matrix", round_one), "contracted")
    small = changed(forged["captured"], "claims", "basin", "matrix", round_one)
    verify(changed(small, "claims", "basin", "contraction", "0.000001"))


def test_the_norm_of_a_matrix():
    """The norm of (3, 0; 4, 5) is 3 sqrt 5; a radius adds at most its root of sum of squares."""
    exact = [[Interval(q << 64, q << 64, 64) for q in row] for row in ((3, 0), (4, 5))]
    assert 0 <= norm(exact).upper ** 2 - 45 < Fraction(1, 10**15)
    wide = [[q + Interval(-1 << 60, 1 << 60, 64) for q in row] for row in exact]
    assert abs(norm(wide).upper - norm(exact).upper - Fraction(1, 8)) < Fraction(1, 10**15)


@pytest.mark.parametrize("entry", [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_the_radius_of_each_entry_counts(entry):
    """The norm of a matrix with one entry in [-1, 1] and zeros is at most 1, and may be 1."""
    N = [
        [Interval((n, m) == entry and -1 << 64, (n, m) == entry and 1 << 64, 64) for m in (0, 1)]
        for n in (0, 1)
    ]
    assert 1 <= norm(N).upper < 1 + Fraction(1, 10**15)


@pytest.mark.parametrize(
    ("trace", "det", "zeros"),
    [(3, 2, (2, 1)), (-3, 2, (-2, -1)), (5, 4, (4, 1)), (-5, 4, (-4, -1))],
)
def test_real_multipliers(trace, det, zeros):
    """The zeros of z^2 - 3 z + 2 and others, of either sign, the larger one first."""
    found = real(*(Interval(q << 64, q << 64, 64) for q in (trace, det)))
    for value, zero in zip(found, zeros, strict=True):
        assert value.lower <= zero <= value.upper
        assert value.width < 10


@pytest.mark.parametrize("name", ["focus", "stick", "captured"])
def test_a_larger_box(forged, name):
    """A box that is much too large, or that touches v = 0 or a wall, is refused."""
    certificate = forged[name]
    for ends in (["-0.14", "0.14"], ["0", "0.5"], ["-0.9", "1"]):
        for key in ("x", "v"):
            with pytest.raises(Rejected):
                verify(changed(certificate, "claims", "box", key, ends))


# hints and parameters


@pytest.mark.parametrize("name", ["focus", "stick", "captured"])
def test_windows_that_miss_their_events(forged, name):
    """Each window moved by its width to either side is refused."""
    certificate = forged[name]
    for n, (lower, upper) in enumerate(certificate["hints"]["events"]):
        a, b = Fraction(lower), Fraction(upper)
        for step in (b - a, a - b):
            if certificate["claims"]["itinerary"][n].startswith("capture") and step > 0:
                continue  # another valid window is possible; see the next line
            moved = [decimal(a + step), decimal(b + step)]
            with pytest.raises(Rejected):
                verify(changed(certificate, "hints", "events", n, moved))


def test_the_window_of_a_capture(forged):
    """It must not begin after its hit, nor end before the hits have accumulated."""
    certificate = forged["captured"]
    n = certificate["claims"]["itinerary"].index("capture r")
    lower, upper = certificate["hints"]["events"][n]
    hit = certificate["hints"]["events"][n - 1][1]
    rejected(changed(certificate, "hints", "events", n, [hit, upper]), "begins after")
    rejected(changed(certificate, "hints", "events", n, [lower, hit]), "accumulate")
    rejected(changed(certificate, "hints", "events", n, [lower, "1.5"]), "too weak to hold")


@pytest.mark.parametrize("name", ["viscous", "damped", "captured"])
def test_other_parameters(forged, name):
    """Each parameter changed by 1e-9 makes the certificate false; e and mu among them."""
    certificate = forged[name]
    for key, value in certificate["parameters"].items():
        other = Fraction(value) + Fraction(1, 10**9)
        with pytest.raises(Rejected):
            verify(changed(certificate, "parameters", key, decimal(other)))
