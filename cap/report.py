"""A certificate in words, for people.  Every number printed is one that the certificate claims."""

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

_SECTIONS = {
    "fixed point": {"x": "x", "v": "v"},
    "orbit": {
        "hit_times": "hit time",
        "hit_speeds": "hit speed",
        "hit_forcing": "|F cos wt| - f at hit",
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
    claims = certificate["claims"]
    parameters = ", ".join(f"{k} = {v}" for k, v in certificate["parameters"].items())
    box = " x ".join(f"[{lower}, {upper}]" for lower, upper in claims["box"].values())
    lines = [
        f"Theorem ({certificate['theorem']}).  {parameters}.",
        "",
        f"The stroboscopic map has exactly one fixed point P* = (x, v) in {box}.",
        f"Every orbit from this box is non-sticking on [0, T]; it hits the walls {_walls(claims)}, "
        "transversely.",
        *_numbers(claims),
        "",
        _forcing(claims),
        _CONCLUSIONS[certificate["theorem"]],
        "",
        *_citations(certificate),
    ]
    return "\n".join(lines)


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
        for label, pair in _flatten(name, claims.get(key, []))
    ]
    whole, part = (max(len(side) for *_, pair in rows for side in _sides(pair, n)) for n in (0, 1))
    width = max(len(label) for _, label, _ in rows)
    before = ""
    for section, label, pair in rows:
        if section != before:
            yield f"\n{section}"
            before = section
        lower, upper = (
            f"{a:>{whole}}{b:<{part}}"
            for a, b in zip(*(_sides(pair, n) for n in (0, 1)), strict=True)
        )
        yield f"  {label:<{width}}  [{lower}, {upper}]"
    if "remainder" in claims:
        r = claims["remainder"]
        yield (
            f"\nOn the disk of radius {r['radius']} around P* the map differs from its Taylor "
            f"polynomial of degree {r['degree']}\nby at most {r['x']} in x and {r['v']} in v."
        )


def _sides(pair: list[str], side: int) -> list[str]:
    """Return what stands before (0) the decimal points of both ends, or from them on (1)."""
    split = [(whole, point + part) for whole, point, part in (end.partition(".") for end in pair)]
    return [halves[side] for halves in split]


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
