"""The form of a certificate: exactly the fields of its theorem's tables."""

from __future__ import annotations

from fractions import Fraction

from cap.checker.kernel.reading import MAX_BYTES, MAX_SIZE, parsed, text
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Whole, matched, tabled
from cap.checker.kernel.theorem import Certificate, Parameters, Theorem, parameter_shapes
from cap.checker.theorems import NAMES, load

__all__ = ["MAX_BYTES", "Certificate", "read"]

DIGITS = Whole(6, 1000)


def read(data: bytes) -> Certificate:
    """Return the certificate in these bytes; anything that is not exactly of its form rejects."""
    fields = matched(parsed(data), _FIELDS, "certificate")
    need(fields["format"] == "cap-certificate/1", "the format is not cap-certificate/1")
    name = fields["theorem"]
    need(name in NAMES, f"the theorem is none of: {', '.join(NAMES)}")
    theorem = load(name)
    need(fields["cites"] == list(theorem.CITES), "cites is not the checker's own list")
    need(isinstance(fields["provenance"], dict), "provenance is not an object")
    p = read_parameters(theorem, fields["parameters"])
    hints = tabled(fields["hints"], theorem.HINTS, "hints")
    claims = tabled(fields["claims"], theorem.CLAIMS, "claims")
    theorem.limit(hints, claims)
    return Certificate(name, p, fields["digits"], claims, hints)


def read_parameters(theorem: type[Theorem], value: object) -> Parameters:
    """Return the parameters; where a theorem is about all f, f is set to 0, and is not used."""
    read = matched(value, parameter_shapes(theorem.PARAMETERS), "parameters")
    p = Parameters(**{"f": Fraction(0)} | read)
    p = p._replace(masses=tuple(p.masses))
    need(p.omega > 0, "omega is not positive")
    need(0 <= p.f < p.F, "0 <= f < F does not hold")
    need(p.l < p.r, "l < r does not hold")
    need(0 < p.e <= 1, "0 < e <= 1 does not hold")
    need(p.mu >= 0, "mu >= 0 does not hold")
    need(all(m > 0 for m in p.masses), "a mass is not positive")
    large = max(p.F, p.omega, abs(p.l), abs(p.r), p.mu, *p.masses) > MAX_SIZE
    small = min(p.F, p.omega, p.r - p.l, *p.masses) * MAX_SIZE < 1
    need(not (large or small), "the parameters are not between 10^-30 and 10^30 in size")
    return p


def _anything(value: object, _: str) -> object:
    """Return the value as it is."""
    return value


_FIELDS = {"format": text, "theorem": text, "digits": DIGITS} | dict.fromkeys(
    ("parameters", "claims", "hints", "cites", "provenance"), _anything
)
