"""Section 10.5: the interval proof as the paper describes it, and what its printed numbers say.

The printed intervals are taken from the rows of `cap.paper.orbit`, as `printed` returns them.
"""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.balls import below, between
from cap.audit.means.need import need
from cap.audit.means.printed import printed
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.claims.existence import BITS, CENTRE, RADIUS, orbits
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball


@claim("ssec:num-cap", Kind.STEP, stated="event times are bracketed near the float estimates")
def events_that_are_certified() -> Verdict:
    """Step 2: the hits are bracketed by bisection on a tight interval around the estimate."""
    claims = stored("elliptic.json").claims
    need(len(claims["hit_times"]) == 2 and claims["least_speed"].lower > 0, "other events")
    return imprecise(
        "this shows that x(t) = r has a root there, not that it is the next event: that no hit, "
        "turn or rest comes before has to be shown on the whole flight, else the product of "
        "matrices is not Φ'. It is true here: the speed is at least "
        f"{below(claims['least_speed'], 4)} throughout, so x is monotone on flights",
        "The stored certificate, whose proof excludes other events on whole flights.",
        certificate="elliptic.json",
    )


@claim("ssec:num-cap", Kind.NUMBER, stated="event times to below 10⁻¹², for the box of radius 10⁻⁹")
def width_of_event_times() -> Verdict:
    """Step 2: the interval widths of the event times are halved to below 10⁻¹²."""
    with interval.workprec(BITS):
        times = []
        for sign in (-1, 1):
            x, v = (interval.ball(c + sign * RADIUS) for c in CENTRE)
            times.append(after_periods(PAPER, x, v, 1).events[0].time)
        spread = abs(times[1] - times[0])
        need(spread > interval.ball(Fraction(1, 10**10)), "the times are the same", spread=spread)
        words = between(spread, 12)
    return corrected(
        "true of one orbit; over [z], where P* is only known to lie, the time of the first hit "
        f"varies by {words} between two corners, so no enclosure over [z] is that narrow",
        "Two orbits of the box, in balls.",
    )


@claim("ssec:num-cap", Kind.STEP, stated="the enclosure follows from the bracket 2·10⁻⁹")
def enclosure_over_the_box() -> Verdict:
    """Steps 1 to 3 enclose Φ'(P*) in eq:DPhi-iv, P* being known to lie in [z]."""
    low, high = printed("enclosure of the trace")
    with interval.workprec(BITS):
        traces = []
        for sign in (-1, 1):
            (a, _), (_, d) = orbits((CENTRE[0] + sign * RADIUS, CENTRE[1]), Fraction(0))[1]
            traces.append(a + d)
        spread = abs(traces[1] - traces[0])
        need(spread > 10 * interval.ball(high - low), "the trace hardly varies", spread=spread)
        words = between(spread, 12)
    return refuted(
        f"on [z] the trace varies by at least {words}, more than ten times the printed width "
        f"{float(high - low):.3g}: the printed enclosures cannot come from the box of Step 1. They "
        "follow from a smaller box, which is not given; the true values do lie in those for the "
        "trace, θ* and the rotation number",
        "The trace of Φ' at two points of [z], in balls; the rows of the table of fig:orbit.",
    )


@claim("eq:DPhi-iv", Kind.CONSISTENCY, stated="entries and trace, both enclosed")
def entries_and_trace() -> Verdict:
    """The intervals of the diagonal entries and that of the trace belong together."""
    first, last, trace = (
        printed(f"enclosure of {name}") for name in ("entry 11", "entry 22", "the trace")
    )
    total = first[0] + last[0], first[1] + last[1]
    need(trace[1] - trace[0] > total[1] - total[0], "the trace is narrower")
    need(trace[0] < total[0], "the sum holds the trace's interval")
    return refuted(
        f"the sum of the printed diagonal entries has the width {float(total[1] - total[0]):.1e}, "
        f"the printed trace {float(trace[1] - trace[0]):.3g}: the entries were rounded to nearest "
        "when printed, so the intervals are no enclosures; two of them are single numbers, and do "
        "not hold the true entries",
        "Arithmetic with the printed numbers; see the rows on the entries 21 and 22.",
    )


@claim("eq:det-iv", Kind.WORDS, stated="certifying det Φ'(P*) = 1")
def determinant_is_certified() -> Verdict:
    """The interval for det Φ' contains 1, which certifies det Φ'(P*) = 1."""
    low, high = printed("enclosure of det Phi'(P_*)")
    need(low < 1 < high, "it does not contain 1")
    return imprecise(
        f"it certifies |det Φ' - 1| <= {float(max(1 - low, high - 1)):.2g}: no interval of "
        "positive width certifies an equality. det Φ' = 1 exactly, because Φ' is a product of "
        "matrices of determinant 1; the interval is a check of the computation",
        "See saltation.wall-determinant, saltation.free-flight.",
    )


@claim("eq:theta-iv", Kind.CONSISTENCY, stated="θ* from the trace by |arccos'| <= 1/sqrt(1 - y²)")
def angle_from_the_trace() -> Verdict:
    """Step 4: the interval of θ* follows from that of the trace, and that of θ*/2π from it."""
    trace = printed("enclosure of the trace")
    with interval.workprec(BITS):
        angles = [(interval.ball(q) / 2).acos() for q in reversed(trace)]
        turns = [each / (2 * interval.pi()) for each in angles]
        held = [
            _held(angles, printed("enclosure of Theta_*")),
            _held(turns, printed("enclosure of the rotation number")),
        ]
        words = [between(interval.hull(a, b), 15) for a, b in (angles, turns)]
    if all(held):
        return confirmed("both follow from the printed trace", "arccos in balls.")
    which = " and ".join(n for n, ok in zip(("θ*", "θ*/2π"), held, strict=True) if not ok)
    return imprecise(
        f"the printed interval of {which} does not hold what follows from the printed trace: θ* in "
        f"{words[0]}, θ*/2π in {words[1]}; it was rounded to nearest. The true value is in it",
        "arccos in balls, at the ends of the printed trace.",
    )


def _held(ends: list[Ball], interval_: tuple[Fraction, Fraction]) -> bool:
    """Return whether a printed interval certainly holds [a, b]; raise if that is undecided."""
    low, high = (interval.ball(q) for q in interval_)
    inside, outside = (
        bool(low <= ends[0] and ends[1] <= high),
        bool(low > ends[0] or ends[1] > high),
    )
    need(inside or outside, "whether it holds is undecided")
    return inside


@claim("ssec:num-cap", Kind.NUMBER, stated="seven: 1/4, 1/3, 2/5, 1/2, 3/5, 2/3, 3/4")
def resonances_up_to_four() -> Verdict:
    """Step 5: the candidate resonances of order at most four are these seven."""
    stated = {Fraction(n) for n in ("1/4", "1/3", "2/5", "1/2", "3/5", "2/3", "3/4")}
    true = {Fraction(p, q) for q in range(1, 5) for p in range(q)}
    need(true - stated == {Fraction(0)}, "one is missing", missing=true - stated)
    extra = sorted(stated - true)
    need([each.denominator for each in extra] == [5, 5], "the others are of another order")
    return corrected(
        "five in (0, 1): 1/4, 1/3, 1/2, 2/3, 3/4 (and 0); 2/5 and 3/5 are of order five. The "
        "smallest distance is that from 1/4, so nothing else changes",
        "All p/q with q <= 4.",
    )


@claim("ssec:num-cap", Kind.WORDS, stated="bounds tighten quadratically with the bracket")
def tightening_of_the_bounds() -> Verdict:
    """The rigorous bounds tighten quadratically as the initial bracket is reduced."""
    with interval.workprec(BITS):
        changes = []
        for radius in (RADIUS, RADIUS / 2):
            ends = [orbits((CENTRE[0] + s * radius, CENTRE[1]), Fraction(0))[1] for s in (-1, 1)]
            low, high = (a + d for (a, _), (_, d) in ends)
            changes.append(abs(high - low))
        ratio = changes[0] / changes[1]
        need(ratio < 3, "the range of the trace falls faster", ratio=ratio)
        words = between(ratio, 6)
    return corrected(
        "linearly: the trace of Φ' varies over [z] in proportion to its width (by a factor of "
        f"{words} for half the width), and no bound can be narrower than that. What is quadratic "
        "is the step from [z] to K([z])",
        "The trace at opposite ends of [z] for two radii, in balls.",
    )
