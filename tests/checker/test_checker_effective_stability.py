"""The theorem effective_stability: what is false is rejected, each hypothesis for its reason."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import product

import pytest
from support import rounds, seeded

import cap
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.jet import Centred, Jet
from cap.checker.kernel.rejection import Rejected
from cap.checker.maps import drift
from cap.checker.maps.ellipses import Ellipses
from checker.altered import changed, encode, fits_the_schema, leaves, rejected, verify
from checker.tampered import accepted, malformed, moved

pytestmark = pytest.mark.usefixtures("orbits_computed_once")

BITS = 200


@pytest.fixture(scope="module")
def small():
    """Return a small certificate: few periods, a low degree."""
    proved = cap.prove_theorem("effective_stability", digits=12, degree=6, periods=1000)
    return json.loads(proved.data)


def thin(q):
    """Return the enclosure of a rational."""
    return Interval.enclosing(Fraction(q), Fraction(q), BITS)


def test_it_is_accepted(small):
    """With its steps, and by the schema."""
    steps = verify(small)
    assert any("H does not grow" in step for step in steps)
    fits_the_schema(small)


def test_more_periods_than_proved(small):
    """Some more follow, as the prover leaves room; many do not."""
    verify(changed(small, "claims", "periods", "1001"))
    for more in ("100000000", "1" + "0" * 20, "9" * 60):
        rejected(changed(small, "claims", "periods", more), "leave the ellipse before")
    for wrong in ("0", "-5", "1/2", "1000.5"):
        rejected(changed(small, "claims", "periods", wrong), "not a positive integer")


def test_one_period():
    """It is the least number of periods that may be claimed."""
    claims = {"centre": [Fraction(0)], "axes": [[Fraction(1)]], "part": Fraction(1, 2)}
    for periods in (Fraction(1), Fraction(7)):
        assert Ellipses.of(claims | {"periods": periods}).periods == periods
    for periods in (Fraction(0), Fraction(1, 2), Fraction(3, 2)):
        with pytest.raises(Rejected, match="not a positive integer"):
            Ellipses.of(claims | {"periods": periods})


def test_the_box_of_an_ellipse():
    """It reaches from the centre, either way, as far as rows of A are long."""
    rows = [[Fraction(3), Fraction(4)], [Fraction(0), Fraction(1, 2)]]
    x, y = Ellipses((Fraction(1), Fraction(2)), rows, Fraction(1, 2), Fraction(1)).box(64)
    for side, low, high in ((x, -4, 6), (y, Fraction(3, 2), Fraction(5, 2))):
        assert low - Fraction(1, 10**9) < side.lower <= low
        assert high <= side.upper < high + Fraction(1, 10**9)


def test_a_larger_inner_ellipse(small):
    """One nearly as large as the outer one, as large, larger, or none."""
    rejected(changed(small, "claims", "part", "0.99"), "leave the ellipse before")
    for wrong in ("1", "3/2", "0", "-1/2"):
        rejected(changed(small, "claims", "part", wrong), "not the smaller one")
    rejected(changed(small, "claims", "part", "0.00000000000000000001"), "certainly in the inner")


def test_other_axes(small):
    """Larger ones, others that leave the box, and parallel ones."""
    axes = [[Fraction(q) for q in row] for row in small["claims"]["axes"]]

    def scaled(factor):
        return changed(small, "claims", "axes", [[str(q * factor) for q in row] for row in axes])

    rejected(scaled(Fraction(3, 2)), "leave the ellipse before|not in the box")
    rejected(scaled(40), "outer ellipse is not in the box")
    rejected(changed(small, "claims", "axes", [["0.001", "0.002"]] * 2), "do not span the space")
    turned = [[str(b), str(a)] for a, b in axes]
    rejected(changed(small, "claims", "axes", turned), "leave the ellipse before")


def test_another_centre(small):
    """Beside the fixed point, or out of the box."""
    x, v = map(Fraction, small["claims"]["centre"])
    near = changed(small, "claims", "centre", [str(x + Fraction(1, 100)), str(v)])
    rejected(near, "outer ellipse is not in the box|certainly in the inner")
    far = changed(small, "claims", "centre", [str(x + 1), str(v)])
    rejected(far, "certainly in the inner")


@pytest.mark.slow
def test_another_integral(small):
    """|u|² alone, one coefficient changed, and a polynomial that is no integral but constant."""
    rows = small["hints"]["integral"]
    rejected(changed(small, "hints", "integral", rows[:2]), "leave the ellipse before")
    for n, row in enumerate(rows):
        for j, c in enumerate(row):
            other = changed(small, "hints", "integral", n, j, str(Fraction(c) + Fraction(1, 100)))
            rejected(other, "leave the ellipse before")
    flat = [["0"] * len(row) for row in rows]
    rejected(changed(small, "hints", "integral", flat), "leave the ellipse before")
    long = [*rows[:-1], [*rows[-1], "0"]]
    rejected(changed(small, "hints", "integral", long), "coefficients than|as many coefficients")


def test_an_order_that_is_too_low(small):
    """The remainder over the box is then not small."""
    rejected(changed(small, "hints", "order", "5"), "leave the ellipse before")
    for wrong in ("3", "25"):
        rejected(changed(small, "hints", "order", wrong), "not between")


def test_walls_with_losses(small):
    """The theorem is about elastic walls without viscosity: no certificate says anything else."""
    for name, value in (("e", "9/10"), ("mu", "1/100")):
        parameters = small["parameters"] | {name: value}
        rejected(changed(small, "parameters", parameters), "missing or unknown")


def test_every_claim_is_compared(small):
    """Each enclosure moved out of its place is noticed."""
    for path, pair in leaves(small["claims"]):
        if path[0] in ("box", "centre", "axes"):
            continue
        for ends in moved(pair):
            other = changed(small, "claims", *path, [str(end) for end in ends])
            assert not accepted(other), path


@pytest.mark.slow
def test_malformed(small):
    """A field or an item more, less, or of another type; but a shorter integral is one, too."""
    last = "hints", "integral", len(small["hints"]["integral"]) - 1
    for path, bad in malformed(small):
        if path[-1:] != ("provenance",) and path != last:
            assert not accepted(bad), path


def test_sizes_bound_polynomials_on_the_ellipse():
    """Of dz at dz = A u, |u| <= 1, from above, and not by far."""
    random = seeded(3)
    for _ in range(rounds(20)):
        n = random.randint(1, 7)
        axes = [[Fraction(random.randint(-9, 9), 3) for _ in range(2)] for _ in range(2)]
        jet = {(n - j, j): thin(Fraction(random.randint(-99, 99), 7)) for j in range(n + 1)}
        bound = float(drift.size(Jet(n, jet), axes, thin(0)).upper)
        most = 0.0
        for k in range(200):
            u = math.cos(k / 32), math.sin(k / 32)
            x, v = (float(a) * u[0] + float(b) * u[1] for a, b in axes)
            terms = (float(c.lower) * x**i * v**j for (i, j), c in jet.items())
            most = max(most, abs(math.fsum(terms)))
        assert most <= bound * (1 + 1e-12)
        assert bound <= 6 * most + 1e-9


def test_values_of_polynomials():
    """H(u) by Horner's rule is the sum of its terms."""
    random = seeded(4)
    powers = [p for p in product(range(4), repeat=3) if 0 < sum(p) < 6]
    H = {p: Fraction(random.randint(-9, 9)) for p in powers if random.random() < 0.7}
    at = Fraction(3, 4), Fraction(-5, 4), Fraction(1, 2)
    u = [Jet(0, {(0, 0, 0): thin(q)}) for q in at]
    expected = sum(c * math.prod(q**k for q, k in zip(at, p, strict=True)) for p, c in H.items())
    value = drift.value(H, u).constant
    assert value.lower <= expected <= value.upper
    assert value.upper - value.lower < Fraction(1, 10**40)


def test_jets_that_are_too_short():
    """The terms between the jets at the centre and those over the box would be missing."""
    jet = Jet(3, {(0, 0): thin(1)})
    short = Centred(Jet(1, {(0, 0): thin(1)}), jet, [thin(0)] * 2)
    with pytest.raises(Rejected, match="too short"):
        drift.drift(short, [[Fraction(1), Fraction(0)], [Fraction(0), Fraction(1)]])


def test_encoded(small):
    """The certificate is small enough to be read by people."""
    assert len(encode(small)) < 10_000
