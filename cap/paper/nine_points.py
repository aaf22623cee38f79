"""Of fig:continuation: the (1,1) orbits at its nine points, all of them, and three other orbits.

A (1,1) orbit is T-periodic, its velocity never vanishes, it hits each wall once per period.  The
others hit each wall once, too, but turn or stick.  Everything here is proved.
"""

from cap.audit.comparison import Comparison, claim, count, roughly
from cap.paper.certified import theorem

FORCES, GAPS = ("0.15", "0.35", "0.55"), ("1", "2", "3")
PAPER_KINDS = {  # (f, R): what the paper's Newton search found
    ("0.15", "1"): "none", ("0.35", "1"): "none", ("0.55", "1"): "saddle",
    ("0.15", "2"): "none", ("0.35", "2"): "elliptic", ("0.55", "2"): "elliptic",
    ("0.15", "3"): "elliptic", ("0.35", "3"): "elliptic", ("0.55", "3"): "elliptic",
}  # fmt: skip
OTHERS = {  # (f, R): a state near which Newton's method finds it
    ("0.35", "1"): (0.107172, 0.512121),
    ("0.15", "1"): (0.339661, 0.775652),
    ("0.15", "2"): (0.0548195, 0.726421),
}
WHY = "its velocity vanishes: it is no (1,1) orbit, and the map does not show it"


def _words(members: dict[str, str]) -> str:
    """Return the orbits of a point in words."""
    kinds = [f"{kind} pair" if name == "pair" else kind for name, kind in members.items()]
    return ", ".join(kinds) or "none"


def nine(points: dict[tuple[str, str], dict[str, str]]) -> list[Comparison]:
    """Compare the nine points."""
    rows = []
    for (f, R), found in PAPER_KINDS.items():
        members = points[f, R]
        kinds = set(members.values())
        has = "elliptic" if "elliptic" in kinds else "saddle" if "saddle" in kinds else "none"
        missed = sorted(kinds - {found})
        said = {"none": "none", "elliptic": "elliptic only", "saddle": "saddle only"}[found]
        reason = f"missed by the four seeds: {', '.join(missed)}" if missed else ""
        rows.append(
            roughly(claim(f"(1,1) orbits at f = {f}, R = {R}", said,
                          f"{_words(members)} (proved)", has == found and not missed, reason))
        )  # fmt: skip
    elliptic = sum("elliptic" in each.values() for each in points.values())
    only = sum(set(each.values()) == {"saddle"} for each in points.values())
    none = sum(not each for each in points.values())
    both = sum(set(each.values()) == {"saddle", "elliptic"} for each in points.values())
    why = "saddles were missed at {} points"
    return [
        *rows,
        count("points with an elliptic (1,1) orbit", 5, elliptic),
        count("of these, points without a saddle", 5, elliptic - both, why.format(both)),
        count("points where all (1,1) orbits are saddles", 1, only,
              "at f = 0.15, R = 2 two saddles were missed"),
        count("points without (1,1) orbits", 3, none, "at f = 0.15, R = 2 two are saddles"),
        claim("elliptic (1,1) orbit at (0.55, 1)", "exists, missed by the seeds: a false negative",
              f"none (proved): {_words(points['0.55', '1'])}",
              "elliptic" in points["0.55", "1"].values(), "nothing was missed there"),
    ]  # fmt: skip


def others() -> list[Comparison]:
    """Prove that they exist, and compare."""
    rows = []
    for (f, R), state in OTHERS.items():
        own = theorem("periodic", state, f=f, R=R)
        events = ", ".join(own["itinerary"])
        rows.append(
            roughly(claim(f"another T-periodic orbit at f = {f}, R = {R}", "none",
                          f"{own['type']} (proved): {events}", False, WHY))
        )  # fmt: skip
    return rows
