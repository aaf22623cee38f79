"""The theorems that start from formulas, in words."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from cap.checker.kernel.certificate import Certificate
from cap.checker.terms import ONE_ONE
from cap.checker.theorems import attractor, segment


def words(c: Certificate) -> str:
    """Return the theorem in one line."""
    sentences = {
        "symmetric": symmetric,
        "pitchfork": pitchfork,
        "branch": branch,
        "segment": segment.words,
        "attractor": attractor.words,
    }
    numbers = c.parameters._asdict() | c.claims
    return "".join(sentences[c.theorem](c.claims)).format_map(numbers)


_SYSTEM = (
    "x'' = F cos(omega t) - f sgn x' with F = {F}, omega = {omega}, FRICTION and elastic walls at "
    "{l} and {r}, T = 2 pi/omega; a (1,1) orbit is " + ONE_ONE + ": "
)
_SYSTEM_AT_F = _SYSTEM.replace("FRICTION", "f = {f}")
_SYSTEM_FOR_ALL_F = _SYSTEM.replace("FRICTION", "0 < f < F")


def symmetric(claims: dict[str, Any]) -> Iterable[str]:
    """Yield the sentences about symmetric orbits."""
    orbits = claims["branches"]
    genuine = [name for name, orbit in orbits.items() if orbit and orbit["genuine"] == "yes"]
    count = ("zero (1,1) orbits have", "one (1,1) orbit has", "two (1,1) orbits have")[len(genuine)]
    yield _SYSTEM_AT_F
    yield f"exactly {count} x(t + T/2) = l + r - x(t) for all t"
    for name in genuine:
        yield _SYMMETRIC.format_map(orbits[name] | {"name": name})
    for name, orbit in orbits.items():
        if orbit and orbit["genuine"] == "no":
            yield _NOT_GENUINE.format_map(orbit | {"name": name})
    yield _VALUES
    for trace, name in (("2", "pitchfork"), ("-2", "minus_identity")):
        f = claims[name]
        where = f"at f in {f} only" if f else "nowhere"
        yield f"; for 0 < f < 2F/pi the trace of the formula for 'plus' is {trace} {where}"
    yield _PAPER if claims["paper_roots"] else _NO_ROOTS
    for root in claims["paper_roots"]:
        yield "; theta in {theta}, v in {velocity}".format_map(root)


_SYMMETRIC = (
    "; '{name}' has x in {x}, v in {v} at t = 0, hits r and then l at times in {hit_times[0]} and "
    "{hit_times[1]} with a speed in {hit_speed}, has a least speed in {least_speed}, and the "
    "time-T map Phi has at it a trace in {trace}: {type}"
)
_NOT_GENUINE = (
    "; the formula for '{name}', with a speed in {hit_speed} at the hits, has a least speed in "
    "{least_speed}, so it is no (1,1) orbit"
)
_VALUES = (
    "; as f varies, the formulas are defined for f up to 2F/pi in {saddle_center}, where they "
    "meet, and are orbits where their least speed is positive"
)
_PAPER = (
    "; the paper's equation of theta for orbits with one turn between hits has in (0, pi) exactly "
    "the two roots below, where its formula has the velocity v before the hit of l at T/2, against "
    "its premise v > 0: so neither is an orbit"
)
_NO_ROOTS = (
    "; the paper's equation of theta for orbits with one turn between hits has no root in (0, pi)"
)


def pitchfork(claims: dict[str, Any]) -> Iterable[str]:
    """Yield the sentences about the pitchfork."""
    kind = "elliptic" if claims["trace_curvature"].upper < 0 else "saddles"
    side = "f < f_0" if claims["curvature"].upper < 0 else "f > f_0"
    yield _SYSTEM_FOR_ALL_F
    yield _PITCHFORK
    yield (
        f"; so for {side} near f_0 both are {kind} near the symmetric orbit, and none is there "
        "on the other side of f_0"
    )


_PITCHFORK = (
    "at one f_0 in {f}, two (1,1) orbits, mirror images of each other under (x, v, t) -> (l + r - "
    "x, -v, t + T/2), branch off from the symmetric (1,1) orbit with x in {x}, v in {v} at t = 0, "
    "which there has the speed at its hits in {hit_speed} and a least speed in {least_speed}; its "
    "map over half a period with the reflection has the trace -2 there, with the derivative in f "
    "in {half_trace_slope}; the two, with (pi + 2 delta)/omega and (pi - 2 delta)/omega from the "
    "hit of r to that of l, belong to f = f_0 + p delta^2 + O(delta^4) with p in {curvature}, and "
    "have the trace 2 + q delta^2 + O(delta^4) with q in {trace_curvature}"
)


def branch(claims: dict[str, Any]) -> Iterable[str]:
    """Yield the sentences about the branch."""
    yield _SYSTEM_FOR_ALL_F
    yield _BRANCH
    if claims["f_end"] is not None:
        yield _END
    if claims["resonances"]:
        met = ", ".join(f"{q['ratio']} at f in {q['f']}" for q in claims["resonances"])
        yield f"; {_MET} {met}; {_COMPLETE}"
    if any(q["ratio"] == "1/2" for q in claims["resonances"]):
        yield "; for f in the range below that of 1/2 both are saddles, with trace < -2"
    for zero in claims["twist_zeros"]:
        yield f"; the first twist coefficient vanishes at an f in {zero}"
    exceptions = ", ".join(map(str, claims["exceptions"]))
    outside = f", but perhaps those in {exceptions}" if exceptions else ""
    yield (
        f"; for all f in the range with trace > -2{outside}, both orbits are elliptic, without "
        "resonance of order at most four, with a twist that is not zero: hence (Moser) they are "
        "stable, and every neighbourhood of them contains invariant closed curves around them"
    )


_BRANCH = (
    "for every f in {f_range} there are exactly two (1,1) orbits that are not symmetric, mirror "
    "images of each other under (x, v, t) -> (l + r - x, -v, t + T/2); with them the trace and "
    "the least speed decrease as f decreases; they are born at f in {f_start}, with trace 2"
)
_MET = (
    "as f decreases the trace passes 2 cos(2 pi p/q), where an elliptic orbit has the rotation "
    "number p/q, for p/q ="
)
_COMPLETE = (
    "for no other p/q with 0 < p/q <= 1/2 and q <= 8 is it 2 cos(2 pi p/q) at an f in the range"
)
_END = "; the least speed vanishes at f in {f_end}, with trace in {trace_end}"
