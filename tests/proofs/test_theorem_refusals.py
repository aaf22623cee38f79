"""The theorems refuse what is false, and what is not known to the digits that are asked for."""

from dataclasses import replace
from fractions import Fraction

import mpmath
import pytest
import reference
from conftest import ORBITS, STARTS
from oracle import compared, oracle
from support import certified

from cap.errors import BadInput, NotProved, TooFewDigits
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import elliptic, saddle
from cap.proofs.fixed_point import Setting


@pytest.mark.parametrize("digits", [6, 40])
def test_false_statements_are_refused(digits):
    """Each theorem of the other kind of orbit, of no orbit, of other hits, of other friction."""

    def refused(theorem, start, step, reason, parameters=PAPER):
        with pytest.raises(NotProved) as caught:
            certified(theorem, Setting(parameters, start, digits))
        assert (caught.value.step, caught.value.reason) == (step, reason)

    kam, unstable = elliptic, saddle
    for name in ("elliptic", "mirror"):
        refused(unstable, STARTS[name], "Lemma 3", "the trace may lie in [-2, 2]")
    for name in ("saddle", "second saddle"):
        refused(kam, STARTS[name], "Lemma 3", "the trace may leave (-2, 2)")
    star, (x, v, times) = STARTS["elliptic"], ORBITS["elliptic"]
    grazes = "the hit {} may not be transverse in its time window"
    for theorem in (kam, unstable):
        refused(theorem, replace(star, x=0.8, v=0.1), "event 1", grazes.format("r"))
        other = Start.non_sticking(x, v, (2.0, 3.0))
        refused(theorem, other, "event 1", grazes.format("r"))
        one = Start.non_sticking(x, v, times[:1])
        refused(theorem, one, "end", "the velocity may vanish before the end")
        more = Start.non_sticking(x, v, (*times, 6.0))
        refused(theorem, more, "event 3", grazes.format("r"))
        refused(theorem, star, "event 2", grazes.format("l"), replace(PAPER, f=Fraction(7, 10)))


@pytest.mark.parametrize("theorem", [elliptic, saddle])
def test_they_are_about_hits(theorem):
    """A guess with a turning, of two periods, or without events: one line, before any proof."""
    star = STARTS["elliptic"]
    turning = replace(star, events=(*star.events, ("turn left", 5.0)))
    for start in (turning, replace(star, periods=2), replace(star, events=())):
        with pytest.raises(BadInput, match="hits only"):
            theorem.prove(Setting(PAPER, start, 10))


@pytest.mark.parametrize(("name", "places"), [("second saddle", 20), ("saddle", 35)])
def test_ask_for_digits_that_are_not_there(name, places):
    """P* to ever more digits: first not proved, then too wide for the claims, then claimed truly.

    Twenty digits are claimed from 4 to 20 of P*; they are never claimed too narrow.
    """
    outcomes = []
    with mpmath.workdps(reference.DIGITS):
        trace = oracle(name)["trace"]
        for guard in range(-16, 1):
            try:
                claims = certified(saddle, Setting(PAPER, STARTS[name], 20, guard=guard))["claims"]
            except TooFewDigits:
                outcomes.append("too few")
            except NotProved:
                outcomes.append("no proof")
            else:
                assert compared(claims["trace"], trace, Fraction(1, 10**places), "")
                outcomes.append("claimed")
    counts = [outcomes.count(outcome) for outcome in ("no proof", "too few", "claimed")]
    assert outcomes == ["no proof"] * counts[0] + ["too few"] * counts[1] + ["claimed"] * counts[2]
    assert counts[0] >= 2
    assert counts[1] >= 5
    assert counts[2] >= 2
