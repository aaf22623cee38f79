"""Appendix, A.2 and A.3: the certified orbits of the gallery, and how counts grow with F."""

from collections.abc import Iterable
from fractions import Fraction

from cap.audit import labels
from cap.audit.means.balls import pair
from cap.audit.means.need import need
from cap.audit.means.stored import Stored, stored
from cap.audit.papers.mixed_dynamics.means.bouncing import FORCINGS, STARTS, growth, near_the_walls
from cap.audit.steps import Words
from cap.audit.tables import stated

CERTIFIED = {"1.5": 4, "3": 1, "4.5": 5, "6": 6}  # F: number of the certificate


def _orbit(F: str) -> Stored:
    found = stored(f"periodic-{CERTIFIED[F]}.json")
    need(found.parameters["F"] == Fraction(F), f"it is not about F = {F}")
    return found


def agrees(F: str) -> Words:
    """Compare x*, v*, trace and determinant with what is printed, up to one unit of the last."""
    table = "fig:hist-gallery-high" if F == "6" else "fig:hist-gallery-low"
    claims = _orbit(F).claims
    words = {"type": claims["type"], "hits": _hits(claims)}
    for what, name in (("x_*", "x"), ("v_*", "v"), ("trace", "trace"), ("determinant",) * 2):
        text = stated(f"F = {F}: {what}", table)
        unit = Fraction(1, 10 ** len(text.partition(".")[2]))
        ends = claims[name].lower, claims[name].upper
        need(all(abs(each - Fraction(text)) <= unit for each in ends), f"{what} is not {text}")
        words[name] = pair(claims[name], 7)
    return words


def _hits(claims: dict[str, list[str]]) -> str:
    words = claims["itinerary"]
    turns = sum(word.startswith("turn") for word in words)
    return f"{words.count('hit r')} right and {words.count('hit l')} left hits, {turns} turns"


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


def scaling_of_the_hits() -> Words:
    grown = growth()
    return _slower(grown.hits, grown.exponents[0])


def scaling_of_the_speed() -> Words:
    grown = growth()
    return _slower(grown.speeds, grown.exponents[1])


def _slower(medians: Iterable[float], exponent: float) -> Words:
    numbers = ", ".join(f"{value:.3g}" for value in medians)
    need(exponent < 3 / 4, "they may grow in proportion to F", medians=numbers)
    forcings = ", ".join(map(str, FORCINGS))
    shown = f"{exponent:.2f}"
    return {"numbers": numbers, "forcings": forcings, "exponent": shown, "starts": STARTS}


def time_near_the_walls() -> Words:
    shares = near_the_walls(50)
    largest, median = max(shares), sorted(shares)[len(shares) // 2]
    need(largest < 1 / 2, "an orbit is near the walls most of the time", shares=shares)
    return {"orbits": len(shares), "median": f"{median:.0%}", "largest": f"{largest:.0%}"}


def number_of_subsections() -> Words:
    found = [p for p in labels.stored().places if p.section == "A" and p.kind == "subsection"]
    need(len(found) != 5, "there are five")
    return {"found": len(found)}
