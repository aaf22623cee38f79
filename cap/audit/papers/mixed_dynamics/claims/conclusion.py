"""Section 11: what the conclusion says beyond the sections that it sums up."""

from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.parameters import PAPER


def energy_in_the_islands() -> Words:
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    hits = len(claims["hit_times"])
    work = PAPER.f * PAPER.R * hits
    need(work > 0, "friction does no work")
    return {"hits": hits, "work": work}
