"""Theorems that are cited, with their hypotheses and the claims that discharge them."""

from typing import Any

MOSER = (
    "Moser twist theorem",
    "Siegel and Moser, Lectures on Celestial Mechanics, 1971, Chapter III; "
    "Theorem kam of the paper",
)


def cited(theorem: str, reference: str, *hypotheses: tuple[str, str, str]) -> dict[str, Any]:
    """Return the citation; a hypothesis has a name, a statement, and claims like "box, range"."""
    return {
        "theorem": theorem,
        "reference": reference,
        "hypotheses": [
            {"name": name, "statement": statement, "by": by.split(", ")}
            for name, statement, by in hypotheses
        ],
    }


def krawczyk(
    smooth: str, inclusion: str = "K(box) lies in the interior of the box", by: str = "box"
) -> dict[str, Any]:
    """Return the citation of Krawczyk's theorem."""
    return cited(
        "Krawczyk",
        "Neumaier, Interval Methods for Systems of Equations, 1990, Section 5.1",
        ("smooth", smooth, by),
        ("inclusion", inclusion, by),
    )
