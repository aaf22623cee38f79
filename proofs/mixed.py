"""Theorem (mixed).  Let f > 0, e = 1, μ = 0.  Consider the states of

    x'' = F cos ωt - f sgn x',   l < x < r,   v -> -v at the walls,   T = 2π/ω,

with l < x < r, |v| < V at t = 0.  There are explicit numbers such that of the area of this box

 (i)   at least `shares.attractor` tends to the orbits released in A (theorem `attractor`),
 (ii)  at least `shares.segment` converges to T-periodic orbits that touch no wall (`segment`),
 (iii) at least `shares.stops` stops at least once, the first two included,
 (iv)  at most `never_stopping_area` never stops.

Proof.  After a stick the state is one number, the place of the release, and a table of places,
made in rounds, gives their fates.  The box is divided into leaves; each is followed, in quadratic
models, until its orbits are released, and cut where this fails; the parts of a leaf are counted
whose releases all lie in an interval of one fate.

The theorems `attractor` and `segment` are proved here in balls.  The leaves are followed by the
arithmetic of the checker (`cap.checker.folded`), which is asked for what it can count: there is no
second one.  The tests compare its fates with orbits in floats, and with `cap.cells`.
"""

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

from cap.certificate.writer import dumps
from cap.checker.kernel.certificate import read
from cap.checker.kernel.theorem import WITHOUT_LOSSES
from cap.checker.theorems.mixed import Mixed
from cap.errors import BadInput
from cap.floats import candidates
from cap.proofs import attractor, segment
from cap.proofs.fixed_point import Proof, Setting, assembled
from cap.sets import interval

SUMMARY = "shares of the states: attracted, to the segment, stopping, undecided"
SEARCH = candidates.releasing
SPEED = Fraction(3)
SLACK = Fraction(1, 10**5)  # of a share: libraries may steer otherwise by rounding
PLACES = {"parts": "512", "cuts": "6", "depth": "9"}
COLUMNS, ROWS, CUTS, DEPTH = 16, 48, 7, 9


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    if setting.parameters.e != 1 or setting.parameters.mu:
        raise BadInput("the theorem mixed is about e = 1, mu = 0")
    claims, hints = attractor.Proved(setting).certified()
    nested = {"attractor": claims, "segment": segment.prove(setting)(Fraction(1))["claims"]}
    hints = {"bits": str(setting.checker_bits), "attractor": hints, **efforts(setting)}
    claims = claims_of(setting, (0, 0, 0)) | nested
    draft = certificate_of(setting, claims, hints)
    counts = lemma_counts(setting, Mixed(read(dumps({**draft, "provenance": {}}).encode()), silent))
    proved = certificate_of(setting, claims_of(setting, counts) | nested, hints)
    return lambda _part: proved


def silent(_step: str) -> None:
    """Hear nothing."""


def efforts(setting: Setting) -> dict[str, Any]:
    """Return the hints on how places and leaves are cut."""
    cuts = CUTS if setting.cuts is None else setting.cuts
    return {
        "places": PLACES,
        "columns": str(COLUMNS),
        "rows": str(ROWS),
        "depth": str(cuts + DEPTH - CUTS),
        "leaves": str(cuts) * (COLUMNS * ROWS),
    }


def lemma_counts(setting: Setting, theorem: Mixed) -> tuple[Fraction, ...]:
    """*Statement.* So much of the box is attracted, goes to the segment, and otherwise stops.

    *Computed.* All leaves are followed, as by the checker.
    """
    runner = replace(setting.runner, journal=None)

    def work(function: Callable[[Any], Any], tasks: Any) -> list[Any]:
        return runner.map(function, list(tasks), "leaves", processes=True)

    counted = theorem.counted(work)
    return theorem.parts(counted)


def claims_of(setting: Setting, found: tuple[Fraction | int, ...]) -> dict[str, Any]:
    """Return the claims about the shares found, with some slack."""
    p, V = setting.parameters, setting.speed or SPEED
    a, s, stops = (max(Fraction(0), share - SLACK) for share in found)
    known = a + s + stops
    area = 2 * p.R * V
    shares = {
        "attractor": (a, 1 - s),
        "segment": (s, 1 - a),
        "stops": (known, Fraction(1)),
        "undecided": (Fraction(0), 1 - known),
    }
    return {
        "box": {"x": [str(p.l), str(p.r)], "v": [str(-V), str(V)]},
        "shares": {name: outward(*ends, 6) for name, ends in shares.items()},
        "never_stopping_area": outward(Fraction(0), (1 - known) * area, 6),
    }


def outward(lower: Fraction, upper: Fraction, places: int) -> list[str]:
    """Return decimals with so many places around an interval."""
    scale = 10**places
    ends = Fraction(lower * scale // 1, scale), Fraction(-(-upper * scale // 1), scale)
    return [interval.decimal(end, places) for end in ends]


def certificate_of(
    setting: Setting, claims: dict[str, Any], hints: dict[str, Any]
) -> dict[str, Any]:
    """Return a certificate with these claims and hints."""
    strings = setting.parameters.strings()
    kept = {name: strings[name] for name in WITHOUT_LOSSES}
    return assembled("mixed", setting, kept, (claims, hints))
