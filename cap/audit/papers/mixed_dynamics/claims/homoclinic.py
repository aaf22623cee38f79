"""Section 6: what is concluded from the Melnikov function."""

from cap.audit.means.balls import pair
from cap.audit.means.need import need
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.steps import Words


def horseshoe() -> Words:
    found = stored("homoclinic.json")
    need(at_the_paper(found), "it is at other parameters")
    need(found.claims["trace"].lower > 2, "it is no saddle")
    points = found.claims["points"]
    need(len(points) > 0, "there is no homoclinic point")
    x, v = found.claims["x"], found.claims["v"]
    angles = " and ".join(pair(each["angle"], 2) for each in points)
    return {"x": pair(x, 4), "v": pair(v, 4), "angles": angles}
