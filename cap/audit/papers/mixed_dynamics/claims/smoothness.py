"""Section 5.1: smoothness of Φ near never-stopping orbits."""

from fractions import Fraction

from cap.audit.means.balls import pair, precisely
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means import block
from cap.audit.steps import Words
from cap.one_one.closed_form import symmetric
from cap.proofs.census import census
from cap.sets import interval
from cap.sets.interval import Ball

SMALL_BLOCK = Fraction(8, 10**9)


def forcing_at_hits() -> Words:
    plus = next(m for m in census(Fraction(3, 5), Fraction(2)) if m.name == "plus")
    need(plus.kind == "elliptic" and plus.least_speed > 0, "no elliptic never-stopping orbit")
    with precisely():
        alpha = interval.ball(Fraction(3, 5))
        orbit = symmetric(alpha, Ball(2), 1)
        force = [abs(cos) for _, cos in orbit.phases]
        need(all(each < alpha for each in force), "the forcing at a hit exceeds f")
    return {"words": force[0]}


def interior_of_the_set() -> Words:
    with interval.workprec(block.BITS):
        around = block.around_the_saddle(SMALL_BLOCK, 2 * SMALL_BLOCK)
        around.covers_itself()
        words = [event.word for event in block.followed(around.edge(-1), 3).events]
    need(any(word.startswith("turn") for word in words), "not all stop", events=words)
    return {"words": ", ".join(words)}


def no_resonance() -> Words:
    claims = stored("elliptic.json").claims
    distances = claims["resonance_distances"]
    need(all(each.lower > 0 for each in distances.values()), "a resonance is possible")
    need(set(distances) == {"0", "1/4", "1/3", "1/2"}, "a resonance is not considered")
    shown = ", ".join(f"{pair(each, 4)} from {name}" for name, each in distances.items())
    return {"shown": shown}
