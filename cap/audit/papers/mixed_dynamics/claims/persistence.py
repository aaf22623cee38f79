"""Section 8: persistence of never-stopping orbits with inelastic walls and viscosity."""

from fractions import Fraction

from cap.audit.means.balls import between
from cap.audit.means.need import need
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.papers.mixed_dynamics.means.orbits import at
from cap.audit.steps import Words
from cap.flow.propagation import at_time_zero, propagate
from cap.sets import interval
from cap.sets.interval import Ball


def speed_bound() -> Words:
    p = at(e="1/2", mu="1")
    with interval.workprec(100):
        end = interval.ball(Fraction(1, 100))
        x, v = propagate(p, at_time_zero(Ball(0), Ball(100)), end).state
        need(0 < 1 - x < v / 1000, "the wall is not just ahead", x=x)
        at_the_wall = v - 1000 * (1 - x) / v  # it loses at most F + f + 100μ < 1000 per time
        bound = 50 * (-end).exp() + interval.ball(p.F + p.f)  # for all later times
        need(at_the_wall > bound, "the bound holds", v=at_the_wall, bound=bound)
        words = between(v, 2), between(bound, 2)
    return {"words": words[0], "words_2": words[1]}


def persistence_of_the_orbit() -> Words:
    words, boxes = _rectangle()
    orbit = stored("elliptic.json")
    need(at_the_paper(orbit), "P* is at other parameters")
    need(orbit.claims["trace"].upper < 2, "1 may be an eigenvalue at P*")
    need(orbit.claims["least_speed"].lower > 0, "P* may stop")
    for name, (low, high) in boxes[0].items():  # in it is one fixed point at (0, 0)
        at = orbit.claims[name]
        need(low < at.lower and at.upper < high, "P* may be another orbit", at=at)
    return {**words, "boxes": len(boxes)}


def asymptotic_stability() -> Words:
    return _rectangle()[0]


def _rectangle() -> tuple[Words, list[dict[str, tuple[Fraction, Fraction]]]]:
    """Return the last ε and μ of the certificate's grid, which begins at (0, 0), and its boxes."""
    found = stored("persistence.json")
    lossless = found._replace(parameters={**found.parameters, "e": Fraction(1), "mu": Fraction(0)})
    need(at_the_paper(lossless), "but for the losses the parameters are others")
    grid = found.claims["range"]
    for name in ("epsilon", "mu"):
        need(grid[name][0] == 0 < grid[name][-1], f"{name} does not grow from 0")
    boxes = [{z: (box[z].lower, box[z].upper) for z in ("x", "v")} for box in grid["boxes"]]
    return {name: grid[name][-1] for name in ("epsilon", "mu")}, boxes
