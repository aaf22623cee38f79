"""Nothing false is certified of orbits that turn, stick and are captured: each kind of mistake."""

from dataclasses import replace
from fractions import Fraction

import pytest
from flows import BITS, MIXED, exactly, moment, point_orbit, starting

from cap.errors import NotProved
from cap.flow.event import BALLS, Expected
from cap.flow.model import Constants
from cap.flow.strobe import follow, of_constants
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

NAMES = pytest.mark.parametrize("name", MIXED)
WORDS = (
    *("hit r", "hit l", "turn right", "turn left", "stick"),
    *("capture r", "capture l", "release right", "release left"),
)


@NAMES
def test_every_wrong_word_is_refused(name):
    """In each place each other word; a word left out, or twice; two neighbours exchanged."""
    p, state, start, end, events = point_orbit(name)
    wrong = []
    for k, event in enumerate(events):
        before, after = events[:k], events[k + 1 :]
        others = (Expected(word, event.window) for word in WORDS if word != event.word)
        wrong += [(*before, other, *after) for other in others]
        wrong += [(*before, *after), (*before, event, event, *after)]
        wrong += [(*before, after[0], event, *after[1:])] if after else []
        wrong += [(*before, Expected(word, event.window), event, *after) for word in WORDS]
    wrong += [(*events, Expected(word, interval.ball(end))) for word in WORDS]
    exactly(p, state, start, end, events)
    for attempt in wrong:
        with pytest.raises(NotProved):
            exactly(p, state, start, end, attempt)


@NAMES
def test_windows_elsewhere_are_refused(name):
    """Of hits, turns and sticks: early, late, a period off; releases need no window."""
    p, state, start, end, events = point_orbit(name)
    period = Fraction("6.2831853") / p.omega
    for k, event in enumerate(events):
        if event.word.split()[0] in ("release", "capture"):
            continue
        for shift in (Fraction(1, 1000), Fraction(-1, 1000), period, -period):
            moved = event._replace(window=event.window + interval.ball(shift))
            with pytest.raises(NotProved):
                exactly(p, state, start, end, (*events[:k], moved, *events[k + 1 :]))


@NAMES
def test_an_end_too_early_or_in_doubt(name):
    """Before the last events are over, or at an event: no orbit has these events until then."""
    p, state, start, _, events = point_orbit(name)
    for k, event in enumerate(events):
        time = interval.midpoint(event.window)
        early = time - Fraction(1, 10**6)
        resting = event.word.split()[0] in ("stick", "capture")
        if not resting:  # see the next test
            with pytest.raises(NotProved):
                exactly(p, state, start, early, events[: k + 1])
        if not event.word.startswith(("release", "capture")):
            near = interval.around(time, Fraction(1, 10**6))
            with pytest.raises(NotProved):
                exactly(p, state, start, near, events[:k])


@pytest.mark.parametrize("name", [n for n in MIXED if "stick" in n or "capture" in n])
def test_a_rest_that_begins_after_the_end(name):
    """The mass still moves at the end, or may: it is not said to rest."""
    p, state, start, _, events = point_orbit(name)
    for k, event in enumerate(events):
        if event.word.split()[0] in ("stick", "capture"):
            for early in (Fraction(1, 10**6), Fraction(1, 10**12)):
                first = events[k - 1 if event.word.startswith("capture") else k].window
                with pytest.raises(NotProved):
                    exactly(p, state, start, interval.midpoint(first) - early, events[: k + 1])


def test_an_end_before_the_start():
    """Of a mass at rest too."""
    with pytest.raises(NotProved):
        exactly(PAPER, (0, 0), Fraction(3, 2), Fraction(1), ())


@pytest.mark.parametrize("word", ["turn r", "stick right", "turn up", "fly right", "hit right"])
def test_words_that_do_not_exist(word):
    """No event is recorded under a name that nobody knows."""
    p, state, start, _, events = point_orbit("stick")
    for k in (0, 1):
        wrong = (*events[:k], Expected(word, events[k].window))
        end = interval.midpoint(events[k].window) + Fraction(1, 1000)
        try:
            found = exactly(p, state, start, end, wrong)
        except NotProved:
            continue
        assert {event.word for event in found.events} <= set(WORDS)
    q, state, start, _, events = point_orbit("soft")
    with pytest.raises(NotProved):
        exactly(q, state, start, Fraction(1), (Expected("hit right", events[0].window),))


def test_a_viscosity_that_is_not_declared():
    """Constants with μ, said not to be viscous, give no orbit without μ."""
    constants = Constants.of(PAPER, interval.ball)._replace(mu=Ball(1))
    state, end = (Fraction(0), Fraction(2)), Fraction(1, 10)
    exact = exactly(replace(PAPER, mu=Fraction(1)), state, 0, end, ())
    with interval.workprec(BITS):
        try:
            osc = of_constants(constants)
        except (NotProved, ValueError):
            return
        orbit = follow(osc, starting(osc, state), (), moment(osc, end), BALLS)
        assert orbit.end[1].overlaps(exact.end[1])
