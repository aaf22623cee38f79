"""Section 11: what the conclusion says beyond the sections that it sums up."""

from cap.audit.means.balls import below
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.parameters import PAPER


def smooth_lift() -> Words:
    margins = stored("elliptic.json").claims["hit_forcing"]  # |F cos ωt*| - f
    need(all(each.lower > 0 for each in margins), "the forcing may vanish")
    jumps = " and ".join(f"f + {below(each)}" for each in margins)
    return {"jumps": jumps}


def energy_in_the_islands() -> Words:
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    hits = len(claims["hit_times"])
    work = PAPER.f * PAPER.R * hits
    need(work > 0, "friction does no work")
    return {"hits": hits, "work": work}
