"""Appendix, A.2 and A.3: the certified orbits of the gallery, and how counts grow with F."""

from collections.abc import Iterable
from fractions import Fraction

from cap.audit import labels
from cap.audit.means.balls import pair
from cap.audit.means.need import need
from cap.audit.means.stored import Stored, stored
from cap.audit.papers.mixed_dynamics.means.bouncing import FORCINGS, STARTS, growth, near_the_walls
from cap.audit.papers.mixed_dynamics.means.printed import stated
from cap.audit.steps import Words
from cap.audit.verdict import (
    Outcome,
    Strength,
    Verdict,
    confirmed,
)

CERTIFIED = {"1.5": 4, "3": 1, "4.5": 5, "6": 6}  # F: number of the certificate


def _orbit(F: str) -> Stored:
    found = stored(f"periodic-{CERTIFIED[F]}.json")
    need(found.parameters["F"] == Fraction(F), f"it is not about F = {F}")
    return found


def agrees(F: str) -> Verdict:
    """Compare x*, v*, trace and determinant with what is printed, up to one unit of the last."""
    table = "fig:hist-gallery-high" if F == "6" else "fig:hist-gallery-low"
    claims = _orbit(F).claims
    words = []
    for what, name in (("x_*", "x"), ("v_*", "v"), ("trace", "trace"), ("determinant",) * 2):
        text = stated(f"F = {F}: {what}", table)
        unit = Fraction(1, 10 ** len(text.partition(".")[2]))
        ends = claims[name].lower, claims[name].upper
        need(all(abs(each - Fraction(text)) <= unit for each in ends), f"{what} is not {text}")
        words.append(f"{what.strip('_*')} in {pair(claims[name], 7)}")
    return confirmed(
        f"{', '.join(words)}; {claims['type']}, with {_hits(claims)}",
        "The stored certificate; each printed number is at most one unit of its last digit away.",
        certificate=f"periodic-{CERTIFIED[F]}.json",
    )


def _hits(claims: dict[str, list[str]]) -> str:
    words = claims["itinerary"]
    turns = sum(word.startswith("turn") for word in words)
    return f"{words.count('hit r')} right and {words.count('hit l')} left hits, {turns} turns"


def gallery_is_dissipative() -> None:
    for F in CERTIFIED:
        claims = _orbit(F).claims
        need(any(word.startswith("turn") for word in claims["itinerary"]), f"F = {F}: no turn")
        need(claims["determinant"].upper < 1 and claims["type"] == "sink focus", f"F = {F}")


def turns_of_the_gallery() -> Words:
    counts = []
    for F in ("1.5", "3", "4.5"):
        words = _orbit(F).claims["itinerary"]
        after = [*words[1:], words[0]]
        turns = [k for k, word in enumerate(words) if word.startswith("turn")]
        need(all(words[k - 1] == after[k] for k in turns), f"F = {F}: before a turn is another hit")
        need(all(after[k].startswith("hit") for k in turns), f"F = {F}: turns follow each other")
        if F == "1.5":
            need(all(after[k] != "hit l" for k in turns), "at l there is a turn")
        counts.append(len(turns))
    return {"turns": f"{counts[0]}, {counts[1]} and {counts[2]}"}


def growth_of_the_hits() -> Words:
    hits = {F: Fraction(stated(f"wall hits in 4 T at F = {F}", "fig:hist-gallery-low"))
            for F in ("1.5", "3", "4.5")}  # fmt: skip
    ratios = [count / Fraction(F) for F, count in hits.items()]
    need(ratios[0] > ratios[1] > ratios[2], "the ratio does not fall", ratios=ratios)
    slope = (hits["4.5"] - hits["1.5"]) / 3
    constant = hits["3"] - 3 * slope
    need(constant != 0, "the line goes through 0")
    need(all(constant + slope * Fraction(F) == n for F, n in hits.items()), "it is no line")
    return {
        "constant": constant,
        "slope": slope,
        "ratios": ", ".join(f"{float(each):.3g}" for each in ratios),
    }


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(f"{value:.3g}" for value in values)


def scaling_of_the_hits() -> Verdict:
    grown = growth()
    need(grown.exponents[0] < 3 / 4, "the hits may grow in proportion to F", hits=grown.hits)
    return _slower(f"hits per period {_numbers(grown.hits)}", grown.exponents[0])


def scaling_of_the_speed() -> Verdict:
    grown = growth()
    need(grown.exponents[1] < 3 / 4, "speeds may grow in proportion to F", speeds=grown.speeds)
    return _slower(f"largest |v| {_numbers(grown.speeds)}", grown.exponents[1])


def time_near_the_walls() -> Verdict:
    shares = near_the_walls(50)
    need(max(shares) < 1 / 2, "an orbit is near the walls most of the time", shares=shares)
    median = sorted(shares)[len(shares) // 2]
    return Verdict(
        outcome=Outcome.REFUTED,
        found=f"of {len(shares)} orbits the median is within R/10 of a wall during {median:.0%} of "
        f"the time, the largest share is {max(shares):.0%}: a fifth is what chance would give",
        evidence="Random starts, after 20 T, over 4 T, in floats, at ω = 1, R = 2, f = 2/5.",
        strength=Strength.NUMERICAL,
    )


def _slower(numbers: str, exponent: float) -> Verdict:
    return Verdict(
        outcome=Outcome.REFUTED,
        found=f"about like the square root of F: {numbers} at F = {', '.join(map(str, FORCINGS))}, "
        f"an exponent of {exponent:.2f}: a flight is a fraction of T, in which the force adds a "
        "fraction of F/ω to the speed",
        evidence=f"Medians of {STARTS} random starts after 20 T, over 4 T, in floats, at ω = 1, "
        "R = 2, f = 2/5.",
        strength=Strength.NUMERICAL,
    )


def rejected_determinants() -> None:
    claims = stored("periodic-3.json").claims
    need(claims["determinant"].lower == 0 == claims["determinant"].upper, "the determinant")
    need(claims["type"] == "superstable", "the orbit is of another type")


def range_of_the_counts() -> None:
    text = stated("F = 2: elliptic + saddle, grid-Newton", "fig:hist-cont")
    need(text == "0 + 0", "the bar at F = 2 is not empty")


def number_of_subsections() -> Words:
    found = [p for p in labels.stored().places if p.section == "A" and p.kind == "subsection"]
    need(len(found) != 5, "there are five")
    return {"found": len(found)}
