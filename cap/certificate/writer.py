"""Certificates: exact strings from enclosures, and files written whole or not at all.

The format is specified in ``certificates/FORMAT.md``.
"""

import json
import platform
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from json.encoder import encode_basestring_ascii
from pathlib import Path
from typing import Any

from cap import __version__
from cap.checker.kernel.certificate import MAX_BYTES, Certificate, read
from cap.checker.kernel.rejection import Rejected
from cap.errors import TooFewDigits
from cap.files import replacing
from cap.parameters import Parameters
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.matrix import Matrix

FORMAT = "cap-certificate/1"

Pair = list[str]


@dataclass(frozen=True)
class Units:
    """The natural units of the oscillator: R, Rω, 1/ω, F, and R²ω for |z|²."""

    length: Fraction
    speed: Fraction
    time: Fraction
    force: Fraction
    area: Fraction

    @classmethod
    def of(cls, p: Parameters) -> "Units":
        """Return the units at the parameters ``p``."""
        return cls(p.R, p.R * p.omega, 1 / p.omega, p.F, p.R**2 * p.omega)


@dataclass(frozen=True)
class Rounding:
    """Outward rounding to ``digits`` digits, relative to a quantity or its unit, the larger."""

    digits: int

    def pair(self, x: Ball, unit: Fraction = Fraction(1)) -> Pair:
        """Return decimals [lower, upper] that enclose ``x``.

        They are at most 10^-digits max(|lower|, |upper|, unit) apart, or `TooFewDigits` is raised.
        """
        lower, upper, bits = ends = interval.binary_ends(x)
        size = Fraction(max(abs(lower), abs(upper)), 1 << bits)
        places = self.digits + 2 - interval.decade(max(size, unit))
        a, b = interval.multiples_of(ends, places)
        pair = [interval.fixed(a, places), interval.fixed(b, places)]
        if (b - a) * 10**self.digits > max(abs(a), abs(b), unit * Fraction(10) ** places):
            sets = {"enclosure": f"[{pair[0]}, {pair[1]}]"}
            raise TooFewDigits("rounding", f"fewer than {self.digits} digits are certain", sets)
        return pair

    def loosely(self, x: Ball, unit: Fraction = Fraction(1)) -> Pair:
        """Return ``pair`` of ``x`` with what rounding may add: a looser arithmetic agrees."""
        return self.pair(x + interval.symmetric(x) * interval.rounding(), unit)

    def matrix(self, m: Matrix[Ball], units: Units) -> list[list[Pair]]:
        """Return the pairs of the entries of a Jacobian, column order (x, v)."""
        (a, b), (c, d) = m
        return [
            [self.pair(a), self.pair(b, units.time)],
            [self.pair(c, 1 / units.time), self.pair(d)],
        ]


def window(x: Ball) -> Pair:
    """Return a short decimal interval that contains ``x`` and is little wider."""
    lower, upper = interval.ends(x)
    width = max(upper - lower, Fraction(1, 10**400))
    return list(interval.outward(x, 3 - interval.decade(width)))


def bound(x: Ball) -> str:
    """Return a decimal not below ``x``, of about three digits; x >= 0."""
    _, upper = interval.ends(x)
    size = max(upper, Fraction(1, 10**400))
    return interval.outward(x, 2 - interval.decade(size))[1]


def exact(q: Fraction) -> str:
    """Return a number, as a decimal if it is one."""
    rest = q.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    return interval.exact_decimal(q) if rest == 1 else str(q)


def provenance(bits: int) -> dict[str, str]:
    """Return what produced a certificate; the checker ignores it.

    It is the same for two runs on a machine: so they give the same bytes.
    """
    return {
        "cap": __version__,
        "python-flint": interval.FLINT,
        "python": platform.python_version(),
        "bits": str(bits),
    }


def dumps(certificate: Mapping[str, Any]) -> str:
    """Return the text of a certificate, the same for equal certificates."""
    return _text(certificate, "\n") + "\n"


def _text(value: object, line: str) -> str:
    """Return what ``json.dumps(value, indent=1)`` returns, sooner."""
    if isinstance(value, str):
        return encode_basestring_ascii(value)
    if not isinstance(value, dict | list | tuple) or not value:
        return json.dumps(value)
    deeper = line + " "
    if isinstance(value, dict):
        parts = [f"{encode_basestring_ascii(k)}: {_text(v, deeper)}" for k, v in value.items()]
        return f"{{{deeper}{f',{deeper}'.join(parts)}{line}}}"
    return f"[{deeper}{f',{deeper}'.join([_text(v, deeper) for v in value])}{line}]"


def stored(path: Path) -> Certificate | None:
    """Return the certificate at ``path``, or None if there is none of this format."""
    try:
        if not path.is_file() or path.stat().st_size > MAX_BYTES:
            return None
        return read(path.read_bytes())
    except (Rejected, OSError):
        return None


def write(certificate: Mapping[str, Any], path: Path) -> str:
    """Write a certificate to ``path``: after any failure the old file, or none, is there.

    A file that differs in its provenance only is left alone.  Returns what happened, in a word.
    Its directory is made if it is missing, but none above that.  Raises `OSError` if the file
    cannot be written.
    """
    old = stored(path)
    same = {"provenance": certificate["provenance"]}
    if old and {**json.loads(path.read_bytes()), **same} == certificate:
        return "unchanged"
    path.parent.mkdir(exist_ok=True)
    with replacing(path) as file:
        file.write(dumps(certificate).encode())
    return "replaced" if old else "written"
