"""Section 10.5: the interval proof as the paper describes it, and what its printed numbers say.

The printed intervals are taken from the rows of `cap.paper.orbit`, as `printed` returns them.
"""

from fractions import Fraction

from cap.audit.means.balls import between
from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.claims.existence import BITS, CENTRE, RADIUS, orbits
from cap.audit.papers.mixed_dynamics.means.printed import printed
from cap.audit.steps import Words
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball


def width_of_event_times() -> Words:
    with interval.workprec(BITS):
        times = []
        for sign in (-1, 1):
            x, v = (interval.ball(c + sign * RADIUS) for c in CENTRE)
            times.append(after_periods(PAPER, x, v, 1).events[0].time)
        spread = abs(times[1] - times[0])
        need(spread > interval.ball(Fraction(1, 10**10)), "the times are the same", spread=spread)
    return {"words": spread}


def enclosure_over_the_box() -> Words:
    low, high = printed("enclosure of the trace")
    with interval.workprec(BITS):
        traces = []
        for sign in (-1, 1):
            (a, _), (_, d) = orbits((CENTRE[0] + sign * RADIUS, CENTRE[1]), Fraction(0))[1]
            traces.append(a + d)
        spread = abs(traces[1] - traces[0])
        need(spread > 10 * interval.ball(high - low), "the trace hardly varies", spread=spread)
    return {"words": spread, "value": format(float(high - low), ".3g")}


def entries_and_trace() -> Words:
    first, last, trace = (
        printed(f"enclosure of {name}") for name in ("entry 11", "entry 22", "the trace")
    )
    total = first[0] + last[0], first[1] + last[1]
    need(trace[1] - trace[0] > total[1] - total[0], "the trace is narrower")
    need(trace[0] < total[0], "the sum holds the trace's interval")
    return {
        "value": format(float(total[1] - total[0]), ".1e"),
        "value_2": format(float(trace[1] - trace[0]), ".3g"),
    }


def determinant_is_certified() -> Words:
    low, high = printed("enclosure of det Phi'(P_*)")
    need(low < 1 < high, "it does not contain 1")
    return {"value": format(float(max(1 - low, high - 1)), ".2g")}


def angle_from_the_trace() -> Words:
    trace = printed("enclosure of the trace")
    with interval.workprec(BITS):
        angles = [(interval.ball(q) / 2).acos() for q in reversed(trace)]
        turns = [each / (2 * interval.pi()) for each in angles]
        held = [
            _held(angles, printed("enclosure of Theta_*")),
            _held(turns, printed("enclosure of the rotation number")),
        ]
        words = [between(interval.hull(a, b), 15) for a, b in (angles, turns)]
    need(not all(held), "both intervals hold what follows")
    which = " and ".join(n for n, ok in zip(("θ*", "θ*/2π"), held, strict=True) if not ok)
    return {"which": which, "angle": words[0], "turns": words[1]}


def _held(ends: list[Ball], interval_: tuple[Fraction, Fraction]) -> bool:
    """Return whether a printed interval certainly holds [a, b]; raise if that is undecided."""
    low, high = (interval.ball(q) for q in interval_)
    inside, outside = (
        bool(low <= ends[0] and ends[1] <= high),
        bool(low > ends[0] or ends[1] > high),
    )
    need(inside or outside, "whether it holds is undecided")
    return inside


def resonances_up_to_four() -> None:
    stated = {Fraction(n) for n in ("1/4", "1/3", "2/5", "1/2", "3/5", "2/3", "3/4")}
    true = {Fraction(p, q) for q in range(1, 5) for p in range(q)}
    need(true - stated == {Fraction(0)}, "one is missing", missing=true - stated)
    extra = sorted(stated - true)
    need([each.denominator for each in extra] == [5, 5], "the others are of another order")


def tightening_of_the_bounds() -> Words:
    with interval.workprec(BITS):
        changes = []
        for radius in (RADIUS, RADIUS / 2):
            ends = [orbits((CENTRE[0] + s * radius, CENTRE[1]), Fraction(0))[1] for s in (-1, 1)]
            low, high = (a + d for (a, _), (_, d) in ends)
            changes.append(abs(high - low))
        ratio = changes[0] / changes[1]
        need(ratio < 3, "the range of the trace falls faster", ratio=ratio)
    return {"words": ratio}
