"""A certificate in words, for people.  Every number printed is one that the certificate claims."""

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from cap.certificate import NONE

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
        "rotation_angle": "Theta",
        "rotation_number": "rotation number",
        "resonance_distances": "distance to",
    },
    "capture": {
        "forcing": "force towards the wall",
        "accumulation_time": "hits accumulate at",
        "release_time": "released at",
    },
    "twist": {
        "twist": "tau_1 per |z|^2",
        "twist_action": "tau_1 per action I",
        "higher_twists": "tau",
    },
}

_CONCLUSIONS = {
    "elliptic": (
        "P* is elliptic, without resonance of order <= 4, and its twist does not vanish.  Hence "
        "(Moser) every\nneighbourhood of P* contains invariant closed curves around it, on which "
        "the map is conjugate to a rotation;\nthey have density one at P*, and P* is stable."
    ),
    "saddle": (
        "P* is hyperbolic.  Hence (Hadamard-Perron) it has analytic stable and unstable curves, "
        "and it is unstable."
    ),
}


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
    box = " x ".join(f"[{lower}, {upper}]" for lower, upper in claims["box"].values())
    of_orbits = {"periodic": _periodic, "persistence": _persistent, "capture": _captured}
    return of_orbits.get(kind, _non_sticking)(kind, claims, box)


def _non_sticking(kind: str, claims: dict[str, Any], box: str) -> Iterator[str]:
    yield f"The stroboscopic map has exactly one fixed point P* = (x, v) in {box}."
    yield (
        "Every orbit from this box is non-sticking on [0, T]; it hits the walls "
        f"{_walls(claims)}, transversely."
    )
    yield from _numbers(claims)
    yield f"\n{_forcing(claims)}"
    yield _CONCLUSIONS[kind]


def _periodic(_kind: str, claims: dict[str, Any], box: str) -> Iterator[str]:
    n = claims["period"]
    power = "" if n == "1" else f"^{n}"
    yield f"The stroboscopic map Phi{power} has exactly one fixed point P* = (x, v) in {box}."
    yield f"Every orbit from this box has on [0, {'' if n == '1' else n}T] these events:"
    yield f"  {', '.join(claims['itinerary']) or 'none'}"
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
    *before, _, release = claims["itinerary"]
    yield f"Every orbit that starts at t = 0 in the interior of {box}"
    if before:
        yield f"has these events: {', '.join(before)};"
    side = "right" if claims["wall"] == "r" else "left"
    yield (
        f"{'then it' if before else 'it'} makes infinitely many hits of the {side} wall, which "
        f"accumulate (each speed is at most {claims['ratio']} times the one before);"
    )
    yield f"from then on the mass rests at this wall until its {release}."
    yield from _numbers(claims)


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
    yield "Orbits that never stop, hit each wall once per period, and are their own mirror image"
    yield "x(t + T/2) = l + r - x(t):"
    for name, orbit in claims["branches"].items():
        if orbit == NONE:
            yield f"\n{name}: there is none."
            continue
        exists = orbit["genuine"] == "yes"
        kind = orbit["type"] if exists else "it would stop, so there is none"
        yield f"\n{name}: {kind}"
        yield from _aligned(_rows(_ORBIT, orbit))
    yield "\nThe formulas, which are orbits where their least speed is positive, change at these f:"
    names = {
        "saddle_center": "plus and minus meet",
        "pitchfork": "asymmetric pair is born",
        "minus_identity": "Phi' = -1",
    }
    yield from _aligned(_rows(names, claims))
    for root in claims["paper_roots"]:
        yield f"\nThe paper's equation has the root theta in [{', '.join(root['theta'])}],"
        yield f"where x' would arrive at the left wall with [{', '.join(root['velocity'])}] < 0,"
        yield "while its ansatz has x' > 0 there: that is no orbit."


def _pitchfork(claims: dict[str, Any]) -> Iterator[str]:
    yield "At this f the half-period map has the multiplier -1 twice at the symmetric orbit, which"
    yield "is elliptic for f a little above and a saddle a little below; there a pair of asymmetric"
    yield "orbits is born for f below, elliptic at birth:"
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
    yield from _aligned(_rows(names, claims))


def _branch(claims: dict[str, Any]) -> Iterator[str]:
    low, high = claims["f_range"]
    yield f"For every f in [{low}, {high}] there is exactly one pair of"
    yield "asymmetric orbits that never stop and hit each wall once per period; trace and least"
    yield f"speed grow with f ({len(claims['cells'])} cells).  In f:\n"
    rows = [("born at", claims["f_start"])]
    if claims["f_end"] != NONE:
        rows.append(("least speed vanishes at", claims["f_end"]))
        rows.append(("  with trace", claims["trace_end"]))
    rows += [(f"rotation number {each['ratio']}", each["f"]) for each in claims["resonances"]]
    yield from _aligned(rows)
    for zero in claims["twist_zeros"]:
        yield f"The twist vanishes at an f in [{', '.join(zero)}]."
    yield "\nFor every f of the range with trace > -2, but for those in"
    yield "  " + (", ".join(f"[{a}, {b}]" for a, b in claims["exceptions"]) or "no interval")
    yield "both orbits are elliptic, without resonance of order <= 4, and their twist does not"
    yield "vanish: hence (Moser) each is stable and surrounded by invariant curves."


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
    rows = [
        (section, label, pair)
        for section, labels in _SECTIONS.items()
        for key, name in labels.items()
        for label, pair in _labelled(key, name, claims)
    ]
    lines = _aligned([(label, pair) for _, label, pair in rows])
    before = ""
    for (section, _, _), line in zip(rows, lines, strict=True):
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


def _rows(names: dict[str, str], claims: dict[str, Any]) -> list[tuple[str, list[str]]]:
    """Return labels and pairs of those of the claims that there are."""
    present = ((key, name) for key, name in names.items() if claims.get(key, NONE) != NONE)
    return [row for key, name in present for row in _labelled(key, name, claims)]


def _aligned(rows: list[tuple[str, list[str]]]) -> Iterator[str]:
    """Give a line for each label and enclosure, aligned at the decimal points."""
    whole, part = (max(len(side) for _, pair in rows for side in _sides(pair, n)) for n in (0, 1))
    width = max(len(label) for label, _ in rows)
    for label, pair in rows:
        lower, upper = (
            f"{a:>{whole}}{b:<{part}}"
            for a, b in zip(*(_sides(pair, n) for n in (0, 1)), strict=True)
        )
        yield f"  {label:<{width}}  [{lower}, {upper}]"


def _sides(pair: list[str], side: int) -> list[str]:
    """Return what stands before (0) the decimal points of both ends, or from them on (1)."""
    split = [(whole, point + part) for whole, point, part in (end.partition(".") for end in pair)]
    return [halves[side] for halves in split]


def _labelled(key: str, name: str, claims: dict[str, Any]) -> Iterator[tuple[str, list[str]]]:
    """Give (label, pair) for each enclosure in the claim of a name; events by their words."""
    if key == "event_times" and key in claims:
        yield from zip(claims["itinerary"], claims[key], strict=True)
    else:
        yield from _flatten(name, claims.get(key, []))


def _flatten(label: str, value: Any) -> Iterator[tuple[str, list[str]]]:
    """Give (label, pair) for each enclosure in a claim."""
    if isinstance(value, dict):
        for key, pair in value.items():
            yield f"{label} {key}", pair
    elif value and isinstance(value[0], str):
        yield label, value
    else:
        for number, inner in enumerate(value, start=1):
            named = (
                f"tau_{number + 1} per |z|^{2 * number + 2}"
                if label == "tau"
                else f"{label} {number}"
            )
            yield from _flatten(named, inner)


def _citations(certificate: dict[str, Any]) -> Iterator[str]:
    """Give the lines that name what is cited, hypothesis by hypothesis."""
    for cited in certificate["cites"]:
        yield f"Cited: {cited['theorem']} ({cited['reference']})."
        for hypothesis in cited["hypotheses"]:
            by = ", ".join(hypothesis["by"])
            yield f"  {hypothesis['name']:<10} {hypothesis['statement']}  <- {by}"
