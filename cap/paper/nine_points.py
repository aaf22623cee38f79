"""Of fig:continuation: the (1,1) orbits at its nine points, all of them, and three other orbits.

A (1,1) orbit is T-periodic, its velocity never vanishes, it hits each wall once per period.  The
others hit each wall once, too, but turn or stick.  Everything here is proved.
"""

from fractions import Fraction
from functools import cache

from cap.audit import tables
from cap.paper.certified import theorem
from cap.paper.figure import Found, Run
from cap.parameters import PAPER
from cap.proofs.census import Member, census

FORCES, GAPS = ("0.15", "0.35", "0.55"), ("1", "2", "3")
OTHERS = {  # (f, R): a state near which Newton's method finds it
    ("0.35", "1"): (0.107172, 0.512121),
    ("0.15", "1"): (0.339661, 0.775652),
    ("0.15", "2"): (0.0548195, 0.726421),
}
POINTS = tuple((f, R) for f in FORCES for R in GAPS)


@cache
def members(f: str, R: str) -> dict[str, str]:
    """Return the kinds of the (1,1) orbits at a point, by their names."""
    return {each.name: each.kind for each in census(Fraction(f), Fraction(R))}


def papers_kind(f: str, R: str) -> str:
    """Return what the paper's Newton search found at a point."""
    stated = tables.stated(f"(1,1) orbits at f = {f}, R = {R}", "fig:continuation")
    return stated.removesuffix(" only")


def point(_run: Run, f: str, R: str) -> Found:
    """Find all (1,1) orbits at a point, and which of them the paper missed."""
    own, found = members(f, R), papers_kind(f, R)
    kinds = set(own.values())
    has = next((kind for kind in ("elliptic", "saddle") if kind in kinds), "none")
    missed = sorted(kinds - {found})
    why = f"missed by the four seeds: {', '.join(missed)}" if missed else ""
    return {"orbits": _words(own), "has": has, "all": has == found and not missed, "missed": why}


def _words(own: dict[str, str]) -> str:
    """Return the orbits of a point in words."""
    kinds = [f"{kind} pair" if name == "pair" else kind for name, kind in own.items()]
    return ", ".join(kinds) or "none"


def counts(_run: Run) -> Found:
    """Count the points with orbits of these kinds."""
    kinds = [set(members(*key).values()) for key in POINTS]
    elliptic = sum("elliptic" in each for each in kinds)
    both = kinds.count({"elliptic", "saddle"})
    return {
        "elliptic": elliptic,
        "both": both,
        "without_saddle": elliptic - both,
        "saddle": kinds.count({"saddle"}),
        "none": kinds.count(set()),
    }


def other(_run: Run, f: str, R: str) -> Found:
    """Prove that there is another orbit at a point."""
    own = theorem("periodic", OTHERS[f, R], f=f, R=R)
    return {"type": own["type"], "events": ", ".join(own["itinerary"])}


def at_the_paper() -> list[tuple[Member, int]]:
    """Return all (1,1) orbits at the paper's parameters, with their number: a pair is two."""
    found = census(PAPER.f / PAPER.F, PAPER.R * PAPER.omega**2 / PAPER.F)
    return [(member, 2 if member.name == "pair" else 1) for member in found]


def number_of_orbits() -> int:
    """Return how many (1,1) orbits there are at the paper's parameters."""
    return sum(number for _, number in at_the_paper())
