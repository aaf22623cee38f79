"""Corollary 3.4: the factors of Φ', its determinant, and where |det Φ'| < 1."""

from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.means.orbits import Followed, States, hits_only
from cap.audit.steps import Words
from cap.parameters import at
from cap.sets import interval
from cap.sets.interval import Ball

LATER = States("-0.39", "0.53", "0.001")  # hits only in the first period, a stop in the second


def determinant_of_a_period() -> Words:
    p = at(F="3")
    orbits = States("0.4064", "-0.6708", "1e-12").follow(1, p)
    with interval.workprec(100):
        (a, b), (c, d) = orbits.monodromy
        product = _turning_product(orbits, 3)
        need((a * d - b * c - product).contains(0), "the product differs")
        need(abs(product) < 1, "the product is not below 1")
    captured = stored("capture.json").claims["itinerary"]
    need("capture r" in captured, "there is no capture")
    return {"words": product}


def _turning_product(orbits: Followed, F: int) -> Ball:
    """Return the product over the turns, for ω = 1 and f = 2/5."""
    f, product = interval.ball(at().f), Ball(1)
    for word, time in zip(orbits.words, orbits.times, strict=True):
        if word.startswith("turn"):
            force = abs(F * time.cos())
            product = product * (force - f) / (force + f)
    return product


def contraction_almost_everywhere() -> Words:
    first, second = hits_only(LATER, 1), LATER.follow(2)
    need(second.has("turn") or second.has("stick"), "it does not stop in the second period either")
    with interval.workprec(100):
        (a, b), (c, d) = first.monodromy
        need((a * d - b * c).contains(1), "the determinant is not 1")
    stop = next(word for word in second.words if not word.startswith("hit"))
    shown, longer = first.shown(), second.shown()
    return {"later": LATER, "shown": shown, "stop": stop, "longer": longer}


def unit_determinants() -> Words:
    orbits = hits_only(States("0.1003", "0.5419", "1e-6"))
    with interval.workprec(100):
        (a, b), (c, d) = orbits.monodromy
        det = a * d - b * c
        need(det.contains(1), "the determinant is not 1")
    return {"words": det}
