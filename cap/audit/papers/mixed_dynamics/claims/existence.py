"""Section 10.5: the fixed point of Theorem 10.1, Krawczyk's operator, and what follows."""

from fractions import Fraction

from cap.audit.filled import pair
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval, matrix

BITS = 120
CENTRE = Fraction("0.1002798898"), Fraction("0.5419433068")
RADIUS = Fraction(1, 10**9)


def newton_from_any_point() -> Words:
    # G(z) = z - (9/10) z¹¹/11 on [-1, 1], z̄ = 0, C = 1: G' = 1 - (9/10) z¹⁰ is in [1/10, 1].
    slope = Fraction(1, 10), Fraction(1)
    reach = max(abs(1 - each) for each in slope)
    need(reach < 1, "K([z]) is not in the interior of [z]")
    after = 1 - (1 - Fraction(9, 110)) / slope[0]  # one step from z = 1
    need(after < -8, "the step stays near", after=after)
    for _ in range(60):  # G > 0, and it is convex, below its zero near -1.28: a monotone sequence
        value = after - Fraction(9, 110) * after**11
        need(value > 0 and after < Fraction(-12, 10), "the iterates come back", at=float(after))
        after = Fraction(round((after - value / (1 - Fraction(9, 10) * after**10)) * 2**60), 2**60)
    return {"fraction": Fraction(90, 11), "after": format(float(after), ".3f")}


def number_of_fixed_points() -> Words:
    claims = stored("inventory.json").claims
    points, segment = claims["fixed_points"], stored("segment.json").claims
    need(claims["undecided"]["boxes"] == 0, "the inventory is not complete")
    need(claims["families"] == ["segment"], "no family of orbits that turn is named")
    elliptic = [each for each in points if -2 < each["trace"].lower <= each["trace"].upper < 2]
    places = ", ".join(f"({pair(each['x'], 5)}, {pair(each['v'], 5)})" for each in points)
    return {
        "points": len(points),
        "elliptic": len(elliptic),
        "places": places,
        "v": pair(segment["v"], 5),
        "left": pair(segment["left"], 5),
        "right": pair(segment["right"], 5),
    }


def margin_of_the_inclusion() -> None:
    with interval.workprec(BITS):
        x, v = map(interval.ball, CENTRE)
        image = after_periods(PAPER, x, v, 1)
        defect = image.state[0] - x, image.state[1] - v
        (a, b), (c, d) = image.monodromy
        (p, q), (r, s) = matrix.inverse(((a - 1, b), (c, d - 1)))
        point = interval.point
        C = (point(p), point(q)), (point(r), point(s))
        x, v = (interval.around(q, RADIUS) for q in CENTRE)
        (a, b), (c, d) = after_periods(PAPER, x, v, 1).monodromy
        product = matrix.product(C, ((a - 1, b), (c, d - 1)))
        rest = [[abs((i == j) - product[i][j]) for j in (0, 1)] for i in (0, 1)]
        shift = matrix.apply(C, defect)
        radius = interval.ball(RADIUS)
        reach = [abs(shift[i]) + radius * (rest[i][0] + rest[i][1]) for i in (0, 1)]
        need(all(each < radius for each in reach), "K([z]) may leave [z]")
        margins = [radius - interval.upper(each) for each in reach]
        need(all(each > radius * 9 / 10 for each in margins), "the margin is smaller")
