"""Proofs from closed forms, each done once, and all that a branch claims, evaluated anew."""

from fractions import Fraction
from functools import cache
from itertools import pairwise

from support import among, over, seeded

from cap.maps.fixed_point import Start
from cap.one_one.closed_form import asymmetric
from cap.parameters import Parameters
from cap.proofs.fixed_point import Setting
from cap.sets import interval


def setting(rho=2, digits=12, f="1/2", **others):
    """Return a setting with F = ω = 1, l = 0 and R = ρ."""
    p = Parameters(Fraction(1), Fraction(1), Fraction(f), Fraction(0), Fraction(rho))
    return Setting(p, Start(0.0, 0.0, ()), digits, **others)


def plain(value):
    """Return claims with None for what does not exist."""
    if isinstance(value, dict):
        return {key: plain(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [plain(inner) for inner in value]
    return None if value == "none" else value


@cache
def proved(theorem, rho=2, digits=12, f="1/2", low=None, high=None):
    """Return the certificate of one of the theorems."""
    f_range = tuple(end and Fraction(end) for end in (low, high))
    return plain(theorem.prove(setting(rho, digits, f, options=over(*f_range)))(Fraction(1)))


def claims_of(theorem, *words, **others):
    """Return the claims."""
    return proved(theorem, *words, **others)["claims"]


def near_paper(pair, value, error=Fraction(1, 10**12)):
    """Return whether an enclosure contains a number known up to an error, and is as sharp."""
    low, high = map(Fraction, pair)
    return among(pair, Fraction(value), error) and high - low <= error


def within(pair, value, error=0):
    """Return whether a rational lies in the pair."""
    low, high = map(Fraction, pair)
    return low - error <= value <= high + error


def check_cells(certificate):
    """Check all of what a certificate of `branch` says of its cells, evaluated anew at points."""
    certificate = plain(certificate)
    claims, hints = certificate["claims"], certificate["hints"]
    p = certificate["parameters"]
    F, omega = Fraction(p["F"]), Fraction(p["omega"])
    rho = (Fraction(p["r"]) - Fraction(p["l"])) * omega**2 / F
    cells = claims["cells"]
    ends = [tuple(map(Fraction, cell["delta"])) for cell in cells]
    assert ends[0][0] == 0
    assert all(a < b for a, b in ends)
    assert all(one[1] == other[0] for one, other in pairwise(ends))
    if hints["end"]:
        assert ends[-1][1] == Fraction(hints["end"][1])
    else:
        assert claims["f_end"] is claims["trace_end"] is None
    random, low, high = seeded(str(rho)), *map(Fraction, claims["f_range"])
    with interval.workprec(200):
        for (a, b), cell in zip(ends, cells, strict=True):
            for delta in (a, b, a + (b - a) * Fraction(random.randint(1, 99), 100)):
                orbit = asymmetric(interval.ball(delta), interval.ball(rho))
                values = {
                    "f": orbit.alpha * interval.ball(F),
                    "trace": orbit.trace(),
                    "least_speed": orbit.slowest()[0] * interval.ball(F / omega),
                }
                for name, value in values.items():
                    assert within(cell[name], interval.midpoint(value))
        first, *_, last = cells
        assert high < Fraction(claims["f_start"][0])
        assert high <= Fraction(first["f"][1])
        assert low >= Fraction(last["f"][0])
        assert low < high
    check_exceptions(claims, (low, high))


def check_exceptions(claims, f_range):
    """Check that the exceptions and the cells with a sign cover f, as long as the trace is > -2."""
    pairs = [tuple(map(Fraction, pair)) for pair in claims["exceptions"]]
    assert all(a <= b for a, b in pairs)
    assert all(one[1] < other[0] for one, other in pairwise(pairs))
    parabolic = [r for r in claims["resonances"] if r["ratio"] == "1/2"]
    lowest = Fraction(parabolic[0]["f"][1]) if parabolic else f_range[0]
    signed = [tuple(map(Fraction, cell["f"])) for cell in claims["cells"] if cell["twist"]]
    reached = lowest
    for low, high in sorted(pairs + signed):
        if low <= reached:
            reached = max(reached, high)
    assert reached >= f_range[1]
    low_order = [r for r in claims["resonances"] if int(r["ratio"].split("/")[1]) <= 4]
    for pair in [*(each["f"] for each in low_order), *claims["twist_zeros"]]:
        a, b = max(Fraction(pair[0]), f_range[0]), min(Fraction(pair[1]), f_range[1])
        assert a > b or any(low <= a and b <= high for low, high in pairs)
