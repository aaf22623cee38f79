"""Certificates: exact strings from enclosures, and files written whole or not at all.

The format is specified in ``certificates/FORMAT.md``.
"""

import json
import os
import platform
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from importlib.metadata import version
from math import floor, log10
from pathlib import Path
from typing import Any

from cap import __version__, interval
from cap.errors import BadInput, NotProved
from cap.interval import Ball
from cap.matrix import Matrix
from cap.parameters import Parameters

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


def decade(value: Fraction) -> int:
    """Return the largest integer d with 10^d <= value, give or take one; value > 0."""
    return floor(log10(value.numerator) - log10(value.denominator))


@dataclass(frozen=True)
class Rounding:
    """Outward rounding to ``digits`` digits, relative to a quantity or its unit, the larger."""

    digits: int

    def pair(self, x: Ball, unit: Fraction = Fraction(1)) -> Pair:
        """Return decimals [lower, upper] that enclose ``x``.

        They are at most 10^-digits max(|lower|, |upper|, unit) apart, or `NotProved` is raised.
        """
        size = max(*map(abs, interval.ends(x)), unit)
        lower, upper = interval.outward(x, max(0, self.digits + 2 - decade(size)))
        a, b = Fraction(lower), Fraction(upper)
        if b - a > max(abs(a), abs(b), unit) / 10**self.digits:
            sets = {"enclosure": f"[{lower}, {upper}]"}
            raise NotProved("rounding", f"fewer than {self.digits} digits are certain", sets)
        return [lower, upper]

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
    width = max(upper - lower, Fraction(1, 10**60))
    return list(interval.outward(x, max(0, 3 - decade(width))))


def bound(x: Ball) -> str:
    """Return a decimal not below ``x``, of about three digits; x >= 0."""
    _, upper = interval.ends(x)
    size = max(upper, Fraction(1, 10**60))
    return interval.outward(x, max(0, 2 - decade(size)))[1]


def provenance(bits: int, seconds: float) -> dict[str, str]:
    """Return what produced a certificate; the checker ignores it."""
    return {
        "cap": __version__,
        "python-flint": version("python-flint"),
        "python": platform.python_version(),
        "bits": str(bits),
        "seconds": f"{seconds:.3f}",
    }


def dumps(certificate: Mapping[str, Any]) -> str:
    """Return the text of a certificate, the same for equal certificates."""
    return json.dumps(certificate, indent=1) + "\n"


def write(certificate: Mapping[str, Any], path: Path) -> str:
    """Write a certificate to ``path``: after any failure the old file, or none, is there.

    A file that differs in its provenance only is left alone.  Returns what happened, in a word.
    """
    try:
        if _same(certificate, path):
            return "unchanged"
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=".certificate-")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(dumps(certificate))
            Path(name).chmod(0o644)
            Path(name).replace(path)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise BadInput(f"cannot write {path}: {error.strerror}") from None
    return "written"


def _same(certificate: Mapping[str, Any], path: Path) -> bool:
    """Return whether ``path`` holds the same certificate, provenance apart."""
    if not path.is_file():
        return False
    try:
        old = json.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        return False
    return isinstance(old, dict) and {**old, "provenance": certificate["provenance"]} == certificate
