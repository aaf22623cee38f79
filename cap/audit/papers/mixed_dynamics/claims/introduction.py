"""Claims of the introduction that are not only summaries of what follows."""

import math

from cap.audit import labels
from cap.audit.means.need import need
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.steps import Words
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved


def lift_is_called_a_theorem() -> Words:
    place = labels.stored().place("thm:lift")
    if place.kind == "theorem":
        raise NotProved("audit", "it is a theorem")
    return {"kind": place.kind.capitalize(), "number": place.number}


def coexistence() -> Words:
    island, shares, never = (stored(f"{name}.json") for name in ("island", "mixed", "conservative"))
    need(
        all(at_the_paper(each) for each in (island, shares, never)), "they are at other parameters"
    )
    part, V = shares.claims["shares"], shares.claims["box"]["v"].upper
    need(island.claims["disks"] == 2, "the disk and its image may be one")
    inside = math.floor(2 * island.claims["area"].lower * 10**5) / 10**5
    need(part["attractor"].lower > 0 and part["segment"].lower > 0, "a share may be zero")
    area = math.ceil(never.claims["area"] * 1000) / 1000
    names = "attractor", "segment", "either", "stops"
    attracted, settled, both, stopping = (least(part[name]) for name in names)
    return {
        "v": format(float(V), "g"),
        "attracted": attracted,
        "settled": settled,
        "both": both,
        "stopping": stopping,
        "inside": format(inside, "g"),
        "area": format(area, "g"),
    }


def least(share: Enclosure) -> str:
    """Return a lower bound in per cent, rounded down."""
    return f"{math.floor(share.lower * 1000) / 10:g} %"
