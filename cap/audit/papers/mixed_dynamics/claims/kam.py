"""Section 5.2: the twist theorem, its measure estimate, and the islands."""

from fractions import Fraction

from cap.audit.means.balls import inner, pair
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.orbits import States
from cap.audit.steps import Words
from cap.parameters import PAPER
from cap.proofs.census import census


def islands_along_the_branch() -> Words:
    claims = stored("branch.json").claims
    need(len(claims["exceptions"]) <= 4, "there are more exceptions")
    found = {"f_range": inner(claims["f_range"]), "exceptions": len(claims["exceptions"])}
    islands = stored("islands.json")
    same = all(
        islands.parameters[name] == getattr(PAPER, name) for name in ("F", "omega", "l", "r")
    )
    need(same, "the islands are between other walls")
    each = islands.claims["islands"]
    here = next(one for one in each if one["f"] == PAPER.f)
    need(here["area"].lower > 0, "the disk may have no area")
    ends = {"first": each[0]["f"], "last": each[-1]["f"]}
    return found | ends | {"count": len(each), "at_the_paper": pair(here["area"], 8)}


def existence_of_the_gallery_orbit() -> None:
    found = [m for m in census(Fraction(2, 5), Fraction(2)) if m.kind == "elliptic"]
    need([m.name for m in found] == ["pair"], "the elliptic orbits are others")


def pattern_of_the_gallery() -> None:
    starts = (("0.10028", "0.54194"), ("0.10328", "0.54194"), ("0.11228", "0.54194"))
    for x, v in starts:
        orbits = States(x, v).follow(4)
        need(orbits.words == ("hit r", "hit l") * 4, f"({x}, {v}) does something else")
    row_d = States("0.1502798898441954", "0.5919433067664584").follow(8)
    need(row_d.words == ("hit r", "hit l") * 8, "row (d) does something else", w=row_d.words)
