"""Certificates: exact strings from enclosures, and files written whole or not at all.

The format is specified in ``certificates/FORMAT.md``.
"""

import json
import platform
from collections.abc import Mapping
from dataclasses import dataclass
from errno import ENOTDIR
from fractions import Fraction
from hashlib import sha256
from importlib.metadata import version
from itertools import count
from pathlib import Path
from typing import Any

from cap import __version__, interval
from cap.checker.certificate import MAX_BYTES, Certificate, read
from cap.checker.rejection import Rejected
from cap.errors import TooFewDigits
from cap.files import replacing
from cap.interval import Ball
from cap.matrix import Matrix
from cap.parameters import PAPER, Parameters

FORMAT = "cap-certificate/1"
NONE = "none"  # for what does not exist

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
        size = max(*map(abs, interval.ends(x)), unit)
        lower, upper = interval.outward(x, self.digits + 2 - interval.decade(size))
        a, b = Fraction(lower), Fraction(upper)
        if b - a > max(abs(a), abs(b), unit) / 10**self.digits:
            sets = {"enclosure": f"[{lower}, {upper}]"}
            raise TooFewDigits("rounding", f"fewer than {self.digits} digits are certain", sets)
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
    width = max(upper - lower, Fraction(1, 10**400))
    return list(interval.outward(x, 3 - interval.decade(width)))


def bound(x: Ball) -> str:
    """Return a decimal not below ``x``, of about three digits; x >= 0."""
    _, upper = interval.ends(x)
    size = max(upper, Fraction(1, 10**400))
    return interval.outward(x, 2 - interval.decade(size))[1]


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


def place(certificate: Mapping[str, Any], directory: Path) -> Path:
    """Return a path in ``directory`` for a certificate: free, or held by one on the same orbit.

    That is THEOREM.json, THEOREM-2.json, ...; or, where one for other parameters is in the way,
    THEOREM-SPECIAL.json, ..., where SPECIAL tells the parameters.  So nothing else is overwritten.
    """
    theorem, new = certificate["theorem"], read(dumps(certificate).encode())
    for number in count(1):
        path = directory / f"{theorem}{_suffix(number)}.json"
        if _is_open_to(path, new):
            return path
        old = _stored(path)
        if not (old and old.parameters == new.parameters):
            break
    special = _special(certificate["parameters"])
    paths = (directory / f"{theorem}-{special}{_suffix(number)}.json" for number in count(1))
    return next(path for path in paths if _is_open_to(path, new))


def _special(parameters: Mapping[str, str]) -> str:
    """Return what tells the parameters from the paper's."""
    paper = PAPER.strings()
    changed = [f"{k}={v}" for k, v in parameters.items() if v != paper[k]]
    name = "-".join(changed).replace("/", "_") or "paper"
    return name if len(name) <= 80 else sha256(name.encode()).hexdigest()[:12]


def _suffix(number: int) -> str:
    return "" if number == 1 else f"-{number}"


def _is_open_to(path: Path, new: Certificate) -> bool:
    """Return whether ``path`` is free, or held by a certificate on the same orbit."""
    old = _stored(path)
    return not path.exists() or (old is not None and _same_orbit(old, new))


def _same_orbit(old: Certificate, new: Certificate) -> bool:
    """Return whether two certificates are of one theorem, with parameters and orbit the same.

    Captures are the same if their boxes meet.
    """
    if (old.theorem, old.parameters) != (new.theorem, new.parameters):
        return False
    where = [c.claims if "x" in c.claims else c.claims["box"] for c in (old, new)]
    pairs = [(where[0][key], where[1][key]) for key in ("x", "v")]
    return all(a.lower <= b.upper and b.lower <= a.upper for a, b in pairs)


def _stored(path: Path) -> Certificate | None:
    """Return the certificate at ``path``, or None if there is none of this format."""
    if not path.is_file() or path.stat().st_size > MAX_BYTES:
        return None
    try:
        return read(path.read_bytes())
    except Rejected:
        return None


def write(certificate: Mapping[str, Any], path: Path) -> str:
    """Write a certificate to ``path``: after any failure the old file, or none, is there.

    A file that differs in its provenance only is left alone.  Returns what happened, in a word.
    Raises `OSError` if the file cannot be written.
    """
    old = _stored(path)
    same = {"provenance": certificate["provenance"]}
    if old and {**json.loads(path.read_bytes()), **same} == certificate:
        return "unchanged"
    if path.parent.exists() and not path.parent.is_dir():
        raise NotADirectoryError(ENOTDIR, "not a directory")
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as file:
        file.write(dumps(certificate).encode())
    return "replaced" if old else "written"
