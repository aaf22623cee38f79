"""A certificate in words, for people.  Every number printed is one that the certificate claims."""

import textwrap
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from cap.certificate.table import aligned, labelled, rows
from cap.certificate.writer import NONE
from cap.checker import terms

_SECTIONS = {
    "fixed point": {"x": "x", "v": "v"},
    "orbit": {
        "hit_times": "hit time",
        "event_times": "event time",
        "hit_speeds": "hit speed",
        "hit_forcing": "|F cos wt| - f at hit",
        "turning_factors": "factor of turn",
        "least_speed": "least speed",
    },
    "linear part": {
        "jacobian": "Jacobian",
        "trace": "trace",
        "determinant": "determinant",
        "multipliers": "multiplier",
        "rotation_angle": "Theta, from x to v",
        "rotation_number": "rotation number |Theta|/2pi",
        "resonance_distances": "distance to",
    },
    "capture": {
        "forcing": "|F cos wt| in the last capture",
        "accumulation_time": "hits of the last capture accumulate at",
        "release_time": "last release at",
    },
    "twist": {
        "twist": "tau_1 per |z|^2",
        "twist_action": "tau_1 per action I",
        "higher_twists": "tau",
    },
}

_CONCLUSIONS = {
    "elliptic": (
        f"P* is elliptic, without resonance of order <= 4: {terms.NORMAL_FORM}, with Theta and "
        "tau_1 as above.  tau_1 is not zero.  Hence (Moser) every neighbourhood of P* contains "
        "invariant closed curves around it, on which the map is conjugate to a rotation; they have "
        "density one at P*, and P* is stable."
    ),
    "saddle": (
        "P* is hyperbolic.  Hence (Hadamard-Perron) it has analytic stable and unstable curves, "
        "and it is unstable."
    ),
}
_WIDTH = 110  # of a line of prose


def theorem(certificate: dict[str, Any]) -> str:
    """Return the theorem that a certificate of this package states, with its numbers."""
    claims, kind = certificate["claims"], certificate["theorem"]
    parameters = ", ".join(f"{k} = {v}" for k, v in certificate["parameters"].items())
    lines = [
        f"Theorem ({kind}).  {parameters}.",
        "",
        *_statement(kind, claims),
        "",
        *_citations(certificate),
    ]
    return "\n".join(lines).rstrip()


def _statement(kind: str, claims: dict[str, Any]) -> Iterator[str]:
    """Give the lines that state a theorem."""
    closed_form = {"symmetric": _symmetric, "pitchfork": _pitchfork, "branch": _branch}
    if kind in closed_form:
        return closed_form[kind](claims)
    if kind == "impulse":
        return _impulse(claims)
    box = " x ".join(f"[{lower}, {upper}]" for lower, upper in claims["box"].values())
    of_orbits = {"periodic": _periodic, "persistence": _persistent, "capture": _captured}
    return of_orbits.get(kind, _non_sticking)(kind, claims, box)


def _non_sticking(kind: str, claims: dict[str, Any], box: str) -> Iterator[str]:
    yield f"The stroboscopic map Phi has exactly one fixed point P* = (x, v) in {box}."
    yield (
        "Every orbit from this box is non-sticking on [0, T]; it hits the walls "
        f"{_walls(claims)}, transversely."
    )
    yield from _numbers(claims)
    yield f"\n{_forcing(claims)}"
    yield textwrap.fill(_CONCLUSIONS[kind], _WIDTH)
    if claims.get("higher_twists"):
        yield "The other tau_k are those of |z|^2k, for a z that preserves area up to that order."


def _periodic(_kind: str, claims: dict[str, Any], box: str) -> Iterator[str]:
    n = claims["period"]
    power = "" if n == "1" else f"^{n}"
    yield f"The stroboscopic map Phi{power} has exactly one fixed point P* = (x, v) in {box}."
    yield f"Every orbit from this box has on [0, {'' if n == '1' else n}T] exactly these events:"
    yield f"  {', '.join(claims['itinerary']) or 'none'}"
    yield from _captures(claims)
    yield from _numbers(claims)
    yield f"\nP* is of the type: {claims['type']}."
    if "basin" in claims:
        (a, b), (c, d) = claims["basin"]["matrix"]
        yield (
            f"The ellipse ({a} X + {b} V)^2 + ({c} X + {d} V)^2 <= 1, (X, V) = (x, v) - P*, "
            f"is mapped into itself by Phi{power},\nshrunk by {claims['basin']['contraction']} or "
            "less: it lies in the basin of attraction."
        )


def _persistent(kind: str, claims: dict[str, Any], box: str) -> Iterator[str]:
    yield from _periodic(kind, claims, box)
    ends = claims["range"]["epsilon"][-1], claims["range"]["mu"][-1]
    yield (
        f"\nFor all 1 - e in [0, {ends[0]}] and mu in [0, {ends[1]}] "
        f"({len(claims['range']['boxes'])} cells) there is such a fixed point, with the same hits,"
        "\nit is one analytic function of e and mu, elliptic at e = 1, mu = 0, and asymptotically "
        "stable everywhere else."
    )


def _captured(_kind: str, claims: dict[str, Any], box: str) -> Iterator[str]:
    yield f"Every orbit that starts at t = 0 in the interior of {box}"
    yield "has at first exactly these events:"
    yield f"  {', '.join(claims['itinerary'])}"
    yield from _captures(claims)
    yield f"Of the last capture the speed after each hit is at most {claims['ratio']} times that"
    yield "after the one before."
    yield from _numbers(claims)


def _captures(claims: dict[str, Any]) -> Iterator[str]:
    """Give the lines that say what the captures among the events stand for."""
    if meaning := terms.captures(claims["itinerary"]):
        yield textwrap.fill(f"({meaning})", _WIDTH)


_ORBIT = {
    "x": "x at t = 0",
    "v": "v at t = 0",
    "hit_times": "hit time",
    "hit_speed": "hit speed",
    "least_speed": "least speed",
    "half_trace": "trace of half map",
    "trace": "trace",
}


def _symmetric(claims: dict[str, Any]) -> Iterator[str]:
    yield f"(1,1) orbits ({terms.ONE_ONE})"
    yield "that are their own mirror image, x(t + T/2) = l + r - x(t):"
    for name, orbit in claims["branches"].items():
        if orbit == NONE:
            yield f"\n{name}: there is none."
            continue
        exists = orbit["genuine"] == "yes"
        kind = orbit["type"] if exists else "its velocity would vanish, so there is none"
        yield f"\n{name}: {kind}"
        yield from aligned(rows(_ORBIT, orbit))
    yield "\nThe formulas, which are orbits where their least speed is positive, change at these f:"
    names = {
        "saddle_center": "plus and minus meet",
        "pitchfork": "asymmetric pair is born",
        "minus_identity": "Phi' = -1",
    }
    yield from aligned(rows(names, claims))
    if not claims["paper_roots"]:
        yield "\nThe paper's equation of theta has no root in (0, pi)."
    for root in claims["paper_roots"]:
        yield f"\nThe paper's equation has the root theta in [{', '.join(root['theta'])}],"
        yield f"where x' would arrive at the left wall with [{', '.join(root['velocity'])}] < 0,"
        yield "while its ansatz has x' > 0 there: that is no orbit."


def _pitchfork(claims: dict[str, Any]) -> Iterator[str]:
    yield "At this f the half-period map has the multiplier -1 twice at the symmetric orbit, which"
    yield "is elliptic for f a little above and a saddle a little below; there a pair of asymmetric"
    yield f"(1,1) orbits ({terms.ONE_ONE})"
    yield "is born for f below, elliptic at birth:"
    yield "  f = f0 + c delta^2 + ..., trace = 2 + d delta^2 + ..., with\n"
    names = {
        "f": "f0",
        **_ORBIT,
        "half_trace_slope": "slope of the half map's trace in f",
        "cubic": "cubic coefficient",
        "linear_slope": "slope of the linear coefficient in f/F",
        "curvature": "c",
        "trace_curvature": "d",
    }
    yield from aligned(rows(names, claims))


def _branch(claims: dict[str, Any]) -> Iterator[str]:
    low, high = claims["f_range"]
    yield f"For every f in [{low}, {high}] there is exactly one pair of asymmetric"
    yield f"(1,1) orbits ({terms.ONE_ONE});"
    yield f"trace and least speed grow with f ({len(claims['cells'])} cells):\n"
    found = [("born at", claims["f_start"])]
    if claims["f_end"] != NONE:
        found.append(("least speed vanishes at", claims["f_end"]))
        found.append(("  with trace", claims["trace_end"]))
    found += [
        (f"trace = 2 cos(2 pi {each['ratio']}) at", each["f"]) for each in claims["resonances"]
    ]
    yield from aligned(found)
    yield "An elliptic orbit then has the rotation number p/q.  At no other f in the range is the"
    yield "trace 2 cos(2 pi p/q) with q <= 8."
    for zero in claims["twist_zeros"]:
        yield f"The twist vanishes at an f in [{', '.join(zero)}]."
    yield "\nFor every f of the range with trace > -2, but for those in"
    yield "  " + (", ".join(f"[{a}, {b}]" for a, b in claims["exceptions"]) or "no interval")
    yield "both orbits are elliptic, without resonance of order <= 4, and their twist does not"
    yield "vanish: hence (Moser) each is stable and surrounded by invariant curves."


def _impulse(claims: dict[str, Any]) -> Iterator[str]:
    yield textwrap.fill(
        "From every state (x, v), at every time, the mass comes to rest within any time longer "
        "than D + B |v|: its velocity is zero on an interval of time.  So there is no motion whose "
        "velocity never vanishes: Omega_NS is empty.  The bound 2F/pi is sharp: with f = 2F/pi, e "
        "= 1 and mu = 0, and walls farther apart than G, there is a motion of period T whose "
        "velocity never vanishes.\n",
        _WIDTH,
    )
    yield ""
    names = {"margin": "f - 2F/pi", "delay": "D", "delay_per_speed": "B", "gap": "G"}
    yield from aligned(rows(names, claims))


def _walls(claims: dict[str, Any]) -> str:
    """Return the itinerary: the walls alternate, the first is r if the mass starts to the right."""
    rightwards = not claims["v"][0].startswith("-")
    walls = ("r", "l") if rightwards else ("l", "r")
    return ", ".join(walls[k % 2] for k in range(len(claims["hit_times"])))


def _forcing(claims: dict[str, Any]) -> str:
    """Say whether the last clause of the paper's (H1), which nothing here needs, holds."""
    pairs = claims["hit_forcing"]
    below = [str(k) for k, (_, upper) in enumerate(pairs, 1) if Fraction(upper) < 0]
    if below:
        holds = f"fails at hit {', '.join(below)}; nothing here needs it"
    elif any(Fraction(lower) <= 0 for lower, _ in pairs):
        holds = "is undecided; nothing here needs it"
    else:
        holds = "holds at every hit"
    return f"The clause |F cos wt| > f at hits, of (H1) in the paper, {holds}."


def _numbers(claims: dict[str, Any]) -> Iterator[str]:
    """Give the lines of all sections, enclosures aligned at their decimal points."""
    found = [
        (section, label, pair)
        for section, labels in _SECTIONS.items()
        for key, name in labels.items()
        for label, pair in labelled(key, name, claims)
    ]
    lines = aligned([(label, pair) for _, label, pair in found])
    before = ""
    for (section, _, _), line in zip(found, lines, strict=True):
        if section != before:
            yield f"\n{section}"
            before = section
        yield line
    if "remainder" in claims:
        r = claims["remainder"]
        yield (
            f"\nOn the disk of radius {r['radius']} around P* the map differs from its Taylor "
            f"polynomial of degree {r['degree']}\nby at most {r['x']} in x and {r['v']} in v."
        )


def _citations(certificate: dict[str, Any]) -> Iterator[str]:
    """Give the lines that name what is cited, hypothesis by hypothesis."""
    for cited in certificate["cites"]:
        yield f"Cited: {cited['theorem']} ({cited['reference']})."
        for hypothesis in cited["hypotheses"]:
            by = ", ".join(hypothesis["by"])
            yield f"  {hypothesis['name']:<10} {hypothesis['statement']}  <- {by}"
