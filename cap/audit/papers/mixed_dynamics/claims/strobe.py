"""Section 2.4: the stroboscopic map and the never-stopping set."""

from cap.audit.means.balls import pair
from cap.audit.means.need import need
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.steps import Words


def never_stopping_orbits_exist() -> Words:
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    distances = claims["resonance_distances"].values()
    need(all(each.lower > 0 for each in distances), "a resonance is possible")
    twist = claims["twist"]
    need(twist.lower > 0 or twist.upper < 0, "the twist may vanish")
    disk = stored("island.json")
    need(at_the_paper(disk), "the invariant disk is at other parameters")
    area = disk.claims["area"]
    need(area.lower > 0, "the disk may have no area")
    return {"area": pair(area, 8)}
