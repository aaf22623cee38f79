"""The theorem that was proved, in the checker's words, with the numbers claimed; and these numbers
in LaTeX."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from math import ceil, floor
from typing import Any

from cap.checker import forms, sentences, terms
from cap.checker.kernel.certificate import WITHOUT_LOSSES, Certificate
from cap.checker.kernel.reading import Enclosure
from cap.checker.kernel.rejection import need

_AS_THEY_ARE = (
    *("Box", "RemainderRadius", "RemainderDegree", "Basin", "Range"),
    *("FRange", "Exceptions", "Cells"),
)
_DIGITS = ("Zero", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")


def words(c: Certificate) -> str:
    """Return the theorem in one line."""
    if c.theorem in forms.THEOREMS:
        return sentences.words(c)
    numbers = _Pairs(c.claims | c.parameters._asdict())
    if c.theorem == "impulse":
        return f"{_WITH_LOSSES}{_IMPULSE}".format_map(numbers)
    numbers["box"] = " x ".join(_pair(c.claims["box"][z]) for z in ("x", "v"))
    if c.theorem in WITHOUT_LOSSES:
        numbers["hits"] = len(c.claims["hit_times"])
        return f"{_BOTH}; {_CONCLUSIONS[c.theorem]}".format_map(numbers)
    captures = terms.captures(c.claims["itinerary"])
    numbers["captures"] = f"; {captures}" if captures else ""
    parts = [_WITH_LOSSES, _CAPTURE if c.theorem == "capture" else _PERIODIC]
    if c.theorem != "capture":
        multipliers = [_complex(m) for m in c.claims["multipliers"]]
        numbers["multipliers"] = " and ".join(multipliers)
        det = c.claims["determinant"]
        numbers["determinant"] = det.lower if det.lower == det.upper else f"in {_pair(det)}"
    if "basin" in c.claims:
        parts.append(_BASIN)
        rows = [f"({p}, {q})" for p, q in c.claims["basin"]["matrix"]]
        numbers |= {"matrix": f"({', '.join(rows)})", "kappa": c.claims["basin"]["contraction"]}
    if "range" in c.claims:
        parts.append(_PERSISTENCE)
        numbers |= {
            "epsilon": c.claims["range"]["epsilon"][-1],
            "most": c.claims["range"]["mu"][-1],
        }
        numbers["degree"] = 2 * len(c.claims["itinerary"])
    return "".join(parts).format_map(numbers)


_BOTH = (
    "x'' = F cos(omega t) - f sgn x' with F = {F}, omega = {omega}, f = {f} and elastic walls at "
    "{l} and {r}: the time-T map Phi of (x, v), T = 2 pi/omega, has one and only one fixed point "
    "in {box}, with x in {x}, v in {v}; its orbit hits the walls {hits} times per period, "
    "transversely, and never turns or sticks, with a least speed in {least_speed}"
)
_CONCLUSIONS = {
    "elliptic": "the fixed point is elliptic with trace in {trace}, and has no resonance of order "
    f"at most four: {terms.NORMAL_FORM}, with Theta in {{rotation_angle}}, the rotation number "
    "|Theta|/(2 pi) in {rotation_number}, and tau_1 in {twist}, that is, in {twist_action} per "
    "action |z|^2/2; so tau_1 is not zero: hence (Moser) the fixed point is stable, and every "
    "neighbourhood of it contains invariant closed curves around it",
    "saddle": "the fixed point is a hyperbolic saddle with trace in {trace} and multipliers in "
    "{multipliers}: hence (Hadamard-Perron) it has stable and unstable curves, and is unstable",
}
_WITH_LOSSES = (
    "x'' = F cos(omega t) - f sgn x' - mu x' with F = {F}, omega = {omega}, f = {f}, mu = {mu} and "
    "walls at l = {l} and r = {r}, where v becomes -e v with e = {e}: "
)
_PERIODIC = (
    "with Phi the time-T map of (x, v) from t = 0, T = 2 pi/omega, and n = {period}, Phi^n has one "
    "and only one fixed point P* in {box}, with x in {x}, v in {v}; all orbits from this box have "
    "in (0, nT) exactly these events, in this order: {itinerary}{captures}; the Jacobian of Phi^n "
    "at P* has its trace in {trace}, the determinant {determinant} and the multipliers "
    "{multipliers}: {type}"
)
_BASIN = (
    "; the ellipse |W (z - P*)| <= 1 with the matrix W = {matrix} lies in the box, and |W "
    "(Phi^n(z) - P*)| <= {kappa} |W (z - P*)| for all z in it: its orbits converge to that of P*"
)
_PERSISTENCE = (
    "; moreover, for all 0 <= epsilon <= {epsilon} and 0 <= mu <= {most} in the place of 1 - e and "
    "mu, Phi has one and only one fixed point P(epsilon, mu) in the box that the certificate gives "
    "for (epsilon, mu), with the same itinerary; P is one real analytic function of (epsilon, mu), "
    "with the value P* at the parameters above; its determinant is exp(-mu T) (1 - "
    "epsilon)^{degree}, and |trace| < 1 + determinant: so P(epsilon, mu) is asymptotically stable "
    "for all (epsilon, mu) but (0, 0), and elliptic there"
)
_CAPTURE = (
    "every orbit that starts at t = 0 in the interior of {box} has at first exactly these events, "
    "in this order: {itinerary}{captures}; the hits of the last capture accumulate at a time in "
    "{accumulation_time}, while |F cos(omega t)|, the force towards the wall {wall}, is in "
    "{forcing}, above f; the speed after each of them is at most {ratio} times that after the one "
    "before; the last release is at a time in {release_time}"
)

_IMPULSE = (
    "f - 2F/pi is in {margin}, so from every state (x, v), at every time, the mass comes to rest "
    "within any time longer than D + B |v|, D in {delay}, B in {delay_per_speed}: its velocity is "
    "zero on an interval of time; hence there is no motion whose velocity never vanishes; with "
    "f = 2F/pi, e = 1 and mu = 0, and walls farther apart than G in {gap}, there is one, of "
    "period 2 pi/omega: the bound 2F/pi is sharp"
)


class _Pairs(dict[str, Any]):
    """The claims, written as [lower, upper]."""

    def __getitem__(self, name: str) -> str:
        claim = super().__getitem__(name)
        if isinstance(claim, list) and isinstance(claim[0], str):
            return ", ".join(claim)
        if isinstance(claim, list):
            return " and ".join(_pair(c) for c in claim)
        return _pair(claim) if isinstance(claim, Enclosure) else str(claim)


def _complex(claim: Enclosure | dict[str, Enclosure]) -> str:
    """Return where a multiplier lies."""
    if isinstance(claim, Enclosure):
        return f"in {_pair(claim)}"
    return f"in {_pair(claim['re'])} + i {_pair(claim['im'])}"


def _pair(claim: Enclosure) -> str:
    """Return an enclosure exactly as it is claimed."""
    return str(claim)


def macros(c: Certificate, prefix: str, digits: int) -> Iterator[str]:
    r"""Yield a LaTeX ``\newcommand`` for each number claimed, rounded outwards to the digits.

    The box, the disk of the remainder, the basin, ranges, exceptions and cells are printed as they
    are: what is claimed of all their points need not hold of larger ones.
    """
    stem = "cap" + _name(prefix)
    for path, claim in _leaves(c.claims, ""):
        if path.startswith(_AS_THEY_ARE) or isinstance(claim, str | int):
            shown = _pair(claim) if isinstance(claim, Enclosure) else str(claim)
        else:
            shown = latex(claim, digits)
        yield f"\\newcommand{{\\{stem}{path}}}{{{shown}}}"


def _leaves(value: Any, path: str) -> Iterator[tuple[str, Any]]:
    """Yield the numbers in the claims with their names."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield from _leaves(part, path + _name(key))
    elif isinstance(value, list):
        for n, part in enumerate(value, start=1):
            yield from _leaves(part, path + _name(str(n)))
    elif value is not None:
        yield path, value


def _name(key: str) -> str:
    """Return a name of letters: words capitalised, digits spelled."""
    parts = re.findall("[A-Za-z]+|[0-9]", key)
    return "".join(_DIGITS[int(p)] if p in "0123456789" else p[0].upper() + p[1:] for p in parts)


def latex(claim: Enclosure | Fraction, digits: int) -> str:
    """Return an enclosure, or an upper bound, with so many significant digits, rounded outwards."""
    lower, upper = claim[:2] if isinstance(claim, Enclosure) else (claim, claim)
    exponent = _exponent(max(abs(lower), abs(upper)))
    shown = exponent if exponent < -4 or exponent >= digits else 0
    places = digits - 1 - exponent + shown
    ends = [_decimal(lower / Fraction(10) ** shown, places, down=True)]
    ends.append(_decimal(upper / Fraction(10) ** shown, places, down=False))
    low, high = (Fraction(end) * Fraction(10) ** shown for end in ends)
    need(low <= lower and upper <= high, "a printed number does not contain the number claimed")
    body = f"[{ends[0]}, {ends[1]}]" if isinstance(claim, Enclosure) else ends[1]
    return body + (f" \\cdot 10^{{{shown}}}" if shown else "")


def _exponent(q: Fraction) -> int:
    """Return floor(log10 q) or one more for q > 0, 0 for q = 0: it only sets the digits shown."""
    return len(str(q.numerator)) - len(str(q.denominator)) if q else 0


def _decimal(q: Fraction, places: int, *, down: bool) -> str:
    """Return q rounded down or up to so many decimal places."""
    scaled = q * 10**places
    units = floor(scaled) if down else ceil(scaled)
    digits = str(abs(units)).zfill(places + 1)
    point = len(digits) - places
    return ("-" if units < 0 else "") + digits[:point] + ("." + digits[point:] if places else "")
