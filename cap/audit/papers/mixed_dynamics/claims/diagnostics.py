"""Sections 10.2 to 10.4: the alignment index, the basin entropy, and the map over (f, R)."""

from fractions import Fraction

from cap.audit.means.balls import between
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.equation import Equation
from cap.audit.papers.mixed_dynamics.means.orbits import States
from cap.audit.steps import Words
from cap.audit.tables import stated
from cap.sets import interval

LEAVES = States("0.0653", "0.5069")  # a state in the box of the map of fig:sali
EARLY, LATE = 15, 30  # periods


def classes_of_the_map() -> Words:
    early, late = LEAVES.follow(EARLY), LEAVES.follow(LATE)
    need(early.only_hits(), f"it stops within {EARLY} periods")
    need(late.has("turn") or late.has("stick"), f"it does not stop within {LATE} periods")
    word = next(word for word in late.words if not word.startswith("hit"))
    return {"leaves": LEAVES, "word": word, "early": EARLY, "late": LATE}


def elliptic_only_region() -> Words:
    with interval.workprec(100):
        pi = interval.pi()
        critical = 4 * (2 + 1 - pi) / (pi * pi)  # at R = 1
        need(critical < 0, "f_sc is not negative there")
        found = Equation(Fraction(11, 20), Fraction(1)).both()
        words = " and ".join(between(each, 5) for each in found)
    return {"words": words}


def orbit_count() -> Words:
    table = "fig:hist-cont"
    counts = {}
    for F in ("1.5", "2", "3.5"):
        words = stated(f"F = {F}: elliptic + saddle, grid-Newton", table)
        counts[F] = sum(int(each) for each in words.split("+"))
    need(counts["2"] < counts["1.5"], "the counts of the appendix grow", counts=counts)
    segment = stored("segment.json")
    left, right = segment.claims["left"], segment.claims["right"]
    need(segment.parameters["F"] == 1 and left.upper < right.lower, "there is no segment at F = 1")
    return {"counts": ", ".join(f"{n} at F = {F}" for F, n in counts.items())}
