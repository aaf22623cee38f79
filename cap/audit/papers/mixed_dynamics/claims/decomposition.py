"""Section 7: the decomposition of the state space, contraction, and what is forward invariant."""

from fractions import Fraction

from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.means import block
from cap.audit.papers.mixed_dynamics.means.orbits import States
from cap.audit.steps import Words
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval

HEIGHT = Fraction(8, 10**9)  # of the block around the saddle, half
ARC = Fraction("-0.39"), Fraction("1.437170054123255357625761233795"), Fraction(2, 10**17)
RETURNS = States("-0.73", "2.08", "0.001")  # turns in the first period, and not in the second


def not_forward_invariant() -> Words:
    x, v, reach = ARC
    with interval.workprec(block.BITS):
        around = block.around_the_saddle(HEIGHT, 2 * HEIGHT)
        around.covers_itself()
        arc = after_periods(PAPER, interval.ball(x), interval.around(v, reach), 4)
        ends = [
            after_periods(PAPER, interval.ball(x), interval.ball(v + s * reach), 4) for s in (-1, 1)
        ]
        h, k = interval.ball(HEIGHT), interval.ball(2 * HEIGHT)
        need(abs(around.coordinates(arc.state)[1]) < k, "the arc is not within the block's height")
        left, right = (around.coordinates(end.state)[0] for end in ends)
        need(left > h and right < -h, "the arc does not cross the block", ends=(left, right))
    words = [event.word for event in arc.events]
    times = [event.time for event in arc.events]
    first = [w for w, t in zip(words, times, strict=True) if t < 2 * interval.pi()]
    need(first[2:] == ["turn left", "turn right"], "the first period is another", words=words)
    need(all(word.startswith("hit") for word in words[4:]), "a later period has a stop")
    return {"v": v}


def example_of_non_invariance() -> Words:
    first, both = RETURNS.follow(1), RETURNS.follow(2)
    later = both.words[len(first.words) :]
    need(first.has("turn"), "they do not turn in the first period")
    need(all(word.startswith("hit") for word in later), "they stop in the second", words=later)
    long = States("-0.73", "2.08").follow(4)
    need(long.has("turn") and long.has("stick"), "it does not stop later", words=long.words)
    return {"returns": RETURNS, "words": ", ".join(long.words)}
