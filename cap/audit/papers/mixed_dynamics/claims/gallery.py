"""Appendix, A.2 and A.3: the certified orbits of the gallery, and how counts grow with F."""

from collections.abc import Iterable
from fractions import Fraction

from cap.audit import labels
from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import formula, symbols
from cap.audit.means.balls import pair
from cap.audit.means.bouncing import FORCINGS, STARTS, growth, near_the_walls
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.printed import stated
from cap.audit.means.stored import Stored, stored
from cap.audit.papers.mixed_dynamics.claims.linearization import below_the_bound
from cap.audit.verdict import (
    Outcome,
    Strength,
    Verdict,
    confirmed,
    corrected,
    imprecise,
    refuted,
)

CERTIFIED = {"1.5": 4, "3": 1, "4.5": 5, "6": 6}  # F: number of the certificate


def _orbit(F: str) -> Stored:
    found = stored(f"periodic-{CERTIFIED[F]}.json")
    need(found.parameters["F"] == Fraction(F), f"it is not about F = {F}")
    return found


def _agrees(F: str) -> Verdict:
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


@claim("eq:hist-orbits-FPs", Kind.NUMBER, stated="F = 1.5: (+0.6276, -0.1184), -1.324, +0.578")
def orbit_at_three_halves() -> Verdict:
    """At F = 1.5 there is a T-periodic orbit with these x*, v*, trace and determinant."""
    return _agrees("1.5")


@claim("eq:hist-orbits-FPs", Kind.NUMBER, stated="F = 3: (+0.4064, -0.6708), -0.968, +0.578")
def orbit_at_three() -> Verdict:
    """At F = 3 there is a T-periodic orbit with these x*, v*, trace and determinant."""
    return _agrees("3")


@claim("eq:hist-orbits-FPs", Kind.NUMBER, stated="F = 4.5: (+0.2156, -0.8293), -0.520, +0.559")
def orbit_at_nine_halves() -> Verdict:
    """At F = 4.5 there is a T-periodic orbit with these x*, v*, trace and determinant."""
    return _agrees("4.5")


@claim("fig:hist-gallery-high", Kind.NUMBER, stated="F = 6: (+0.0267, -0.4816), -0.665, +0.538")
def orbit_at_six() -> Verdict:
    """At F = 6 there is a T-periodic orbit with these x*, v*, trace and determinant."""
    return _agrees("6")


@claim("ssec:hist-orbits", Kind.WORDS, stated="none of the periodic orbits lies in Ω_NS")
def gallery_is_dissipative() -> Verdict:
    """The periodic orbits at F = 1.5, 3, 4.5 and 6 turn, have det Φ' < 1, and attract."""
    for F in CERTIFIED:
        claims = _orbit(F).claims
        need(any(word.startswith("turn") for word in claims["itinerary"]), f"F = {F}: no turn")
        need(claims["determinant"].upper < 1 and claims["type"] == "sink focus", f"F = {F}")
    return confirmed(
        "all four are sinks with turns; the words 'elliptic orbit' for them, here and in the "
        "captions, mean |tr Φ'| < 2 only",
        "Stored certificates periodic-1, -4, -5 and -6.",
        certificate="periodic-6.json",
    )


@claim("ssec:hist-orbits", Kind.FORMULA, stated="hits grow in proportion to F")
def growth_of_the_hits() -> Verdict:
    """The number of hits grows from 12 to 20 in four periods, proportional to F."""
    hits = {F: Fraction(stated(f"wall hits in 4 T at F = {F}", "fig:hist-gallery-low"))
            for F in ("1.5", "3", "4.5")}  # fmt: skip
    ratios = [count / Fraction(F) for F, count in hits.items()]
    need(ratios[0] > ratios[1] > ratios[2], "the ratio does not fall", ratios=ratios)
    slope = (hits["4.5"] - hits["1.5"]) / 3
    constant = hits["3"] - 3 * slope
    need(constant != 0, "the line goes through 0")
    need(all(constant + slope * Fraction(F) == n for F, n in hits.items()), "it is no line")
    return corrected(
        f"the three counts are {constant} + ({slope}) F, not proportional to F: their quotients by "
        f"F are {', '.join(f'{float(each):.3g}' for each in ratios)}",
        "Arithmetic with the printed counts.",
    )


@claim("ssec:hist-orbits", Kind.FORMULA, stated="hits per period scale like F/(Rω)")
def unit_of_the_hits() -> Verdict:
    """F/(Rω) is a number of hits per period, up to a factor."""
    F, R, w, c = symbols("F R omega c")
    faster = {F: F * c**2, w: w * c}  # another unit of time
    stated_, true = F / (R * w), F / (R * w**2)
    need((sp.simplify(stated_.subs(faster, simultaneous=True) / stated_) - c) == 0, "no unit")
    return formula(
        true,
        stated_,
        "A number of hits does not depend on the unit of time, F/(Rω) does; what these three give "
        "without a unit is a function of F/(Rω²). (F Δt/ω² is no length either.) Which function "
        "is seen, tells gallery.scaling-of-the-hits.",
        "a function of F/(Rω²)",
    )


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(f"{value:.3g}" for value in values)


@claim("ssec:hist-orbits", Kind.WORDS, stated="hits per period scale like F/(Rω)")
def scaling_of_the_hits() -> Verdict:
    """At fixed f the hits per period grow in proportion to F."""
    grown = growth()
    need(grown.exponents[0] < 3 / 4, "the hits may grow in proportion to F", hits=grown.hits)
    return _slower(f"hits per period {_numbers(grown.hits)}", grown.exponents[0])


@claim("fig:hist-gallery-high", Kind.WORDS, stated="the maximum velocity scales like F/ω")
def scaling_of_the_speed() -> Verdict:
    """As F grows, the largest velocity of an orbit grows in proportion to F."""
    grown = growth()
    need(grown.exponents[1] < 3 / 4, "speeds may grow in proportion to F", speeds=grown.speeds)
    return _slower(f"largest |v| {_numbers(grown.speeds)}", grown.exponents[1])


@claim("fig:hist-gallery-high", Kind.WORDS, stated="most of the time near the walls")
def time_near_the_walls() -> Verdict:
    """At F = 50 the orbit spends most of its time near the walls."""
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


@claim("ssec:hist-bif", Kind.WORDS, stated="a determinant outside [0.1, 5] is an artifact")
def rejected_determinants() -> Verdict:
    """A fixed point whose determinant is outside [0.1, 5] is a numerical artifact."""
    claims = stored("periodic-3.json").claims
    need(claims["determinant"].lower == 0 == claims["determinant"].upper, "the determinant")
    need(claims["type"] == "superstable", "the orbit is of another type")
    return refuted(
        "orbits that stick have the determinant 0, and are the strongest attractors: one at F = 3 "
        "is certified. The filter removes them",
        "The stored certificate.",
        certificate="periodic-3.json",
    )


@claim("fig:hist-cont", Kind.STEP, stated="Theorem 2.5 forces all orbits into Ω_dissip")
def below_the_bound_by_theorem() -> Verdict:
    """Below the impulse bound Theorem 2.5 forces all orbits into Ω_dissip."""
    need(below_the_bound().outcome is Outcome.CONFIRMED, "it is not so")
    return imprecise(
        "it is so, by the impulse bound; Theorem 2.5 is on well-posedness, and says nothing of it",
        "See linearization.below-the-bound.",
        proof="periodic.md#the-impulse-bound",
    )


@claim("fig:hist-cont", Kind.CONSISTENCY, stated="between 1 and 3 orbits above F_imp")
def range_of_the_counts() -> Verdict:
    """Above F_imp the orbit count is between 1 and 3 on the sampled values."""
    text = stated("F = 2: elliptic + saddle, grid-Newton", "fig:hist-cont")
    need(text == "0 + 0", "the bar at F = 2 is not empty")
    return corrected(
        "between 0 and 3 orbits were found: none at F = 2, as the same caption says",
        "The printed counts.",
    )


@claim("eq:hist-Fsc-cross", Kind.FORMULA, stated="F_sc = (fπ² - 4Rω²)/(4(2 - π))")
def critical_forcing() -> Verdict:
    """f = f_sc solved for F gives F_sc = (fπ² - 4Rω²)/(4(2 - π))."""
    F, f, R, w = symbols("F f R omega")
    solved = sp.solve(4 * (2 * F + R * w**2 - F * sp.pi) / sp.pi**2 - f, F)[0]
    return formula(
        solved,
        (f * sp.pi**2 - 4 * R * w**2) / (4 * (2 - sp.pi)),
        "eq:fsc-formula solved by sympy. It is where an equation has a double root, no orbit: see "
        "fold.colliding-orbits.",
        "as stated",
    )


@claim("app:historical", Kind.CONSISTENCY, stated="five subsections")
def number_of_subsections() -> Verdict:
    """The appendix has five subsections."""
    found = [p for p in labels.stored().places if p.section == "A" and p.kind == "subsection"]
    need(len(found) != 5, "there are five")
    return corrected(f"{len(found)}, as many as the sentence lists", "The labels of the TeX file.")
