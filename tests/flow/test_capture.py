"""The lemma of capture: each inequality of its proof, against bounces worked out one by one."""

from dataclasses import replace
from fractions import Fraction

import pytest
from flows import BITS, certified, exactly, moment, starting
from mpmath import mp, mpf, workdps
from support import holds, number, rational, rounds, seeded

from cap.errors import NotProved
from cap.flow.capture import Entry, accumulation
from cap.flow.event import BALLS, Expected
from cap.flow.strobe import follow, oscillator
from cap.parameters import PAPER, Parameters
from cap.sets import interval
from cap.sets.interval import Ball


class Bounces:
    """A mass above a wall in mpmath, y the height, w = y', by bisection; b the force to it."""

    def __init__(self, p, side):
        self.F, self.w, self.f, self.e, self.mu = (
            number(q) for q in (p.F, p.omega, p.f, p.e, p.mu)
        )
        self.side = side

    def force(self, t):
        """Return b(t)."""
        return self.side * self.F * mp.cos(self.w * t)

    def state(self, start, d, sign):
        """Return (y, w) after the time d from (t, y, w); w' = -b - sign f - μ w."""
        t, y, w = start
        F, o, mu, f = -self.side * self.F, self.w, self.mu, self.f
        P = F / (o * o + mu * mu)

        def forced(s):
            sin, cos = mp.sin(o * s), mp.cos(o * s)
            return P * (mu / o * sin - cos), P * (o * sin + mu * cos)

        (a, b), (A, B) = forced(t + d), forced(t)
        decay = mp.exp(-mu * d)
        h = (1 - decay) / mu if mu else d
        k = (d - h) / mu if mu else d * d / 2
        return y - A + a + (w - B) * h - sign * f * k, b + (w - B) * decay - sign * f * h

    def zero(self, g, scale):
        """Return the first zero of g > 0 near 0 that becomes negative, steps a part of scale."""
        a, b = mpf(0), scale
        while g(b) > 0:
            a, b = b, 2 * b
        for _ in range(100):
            m = (a + b) / 2
            a, b = (m, b) if g(m) > 0 else (a, m)
        return (a + b) / 2

    def bounce(self, t, y, w):
        """Return (time of the next hit, speed there, greatest height)."""
        if w > 0:
            g = self.force(t) + self.f
            up = self.zero(lambda d: self.state((t, y, w), d, 1)[1], w / g / 4)
            y, t = self.state((t, y, w), up, 1)[0], t + up
            w = mpf(0)
        pull = self.force(t) - self.f
        down = self.zero(
            lambda d: self.state((t, y, w), d, -1)[0], mp.sqrt(2 * (y + w * w / pull) / pull) / 16
        )
        return t + down, -self.state((t, y, w), down, -1)[1], y


def systems():
    """Give random oscillators, walls, entries and ends of windows."""
    random = seeded(11)
    while True:
        F, w = Fraction(random.randint(5, 30), 10), Fraction(random.randint(5, 30), 10)
        f = F * Fraction(random.choice([1, 20, 40, 60, 80]), 100)
        e = Fraction(random.choice(["1", "1", "9/10", "1/2", "1/10"]))
        mu = Fraction(random.choice(["0", "0", "1/10", "3"]))
        p = Parameters(F, w, f, Fraction(-1), Fraction(-1) + F / w**2 * random.randint(1, 4), e, mu)
        side = random.choice([1, -1])
        phase = Fraction(random.randint(-15, 15), 10) + (0 if side > 0 else Fraction(355, 113))
        speed = F / w * Fraction(random.randint(1, 100), random.choice([200, 2000, 20000]))
        far = random.choice([0, speed / w, speed**2 / F])
        yield p, side, phase / w, far, speed, Fraction(random.randint(1, 40), 40) / w, random


@pytest.mark.slow
@pytest.mark.parametrize(
    "leaving",
    [
        pytest.param(True, id="from the wall", marks=pytest.mark.slow),
        pytest.param(False, id="near the wall"),
    ],
)
def test_against_bounces(leaving):
    """Where the lemma applies: no bounce too high, too fast, too late; the speeds fall as told."""
    found = 0
    for p, side, t, far, speed, stretch, random in systems():
        with workdps(40), interval.workprec(100):
            osc, end = oscillator(p), t + stretch
            height = 0 if leaving else far
            entry = Entry(*map(interval.ball, (t, height, speed)), leaving=leaving)
            try:
                told = accumulation(osc, side, entry, interval.ball(end))
            except NotProved:
                continue
            found += 1
            exact, ratio = Bounces(p, side), number(interval.midpoint(told.ratio))
            y = number(Fraction(height)) * random.randint(0, 4) / 4
            w = number(speed) * (1 if leaving else mpf(random.randint(-4, 4)) / 4)
            w = abs(w) or number(speed) if y == 0 else w
            now, last = number(t), w if leaving else None
            for _ in range(rounds(15)):
                now, arrived, top = exact.bounce(now, y, w)
                assert top < number(p.R)
                assert holds(told.forcing, exact.force(now))
                y, w = mpf(0), exact.e * arrived
                if last is not None:
                    assert w <= last * ratio * (1 + mpf(10) ** -25)
                last = w
                lower, upper = (number(q) for q in interval.ends(told.time))
                assert lower <= now < upper
                if w < mpf(10) ** -12:
                    break
        if found == rounds(20):
            return


def lemma(p=PAPER, *, side=1, t="0", far="0", speed="1/100", end="3/10", leaving=True):  # noqa: PLR0913
    """Apply the lemma."""
    with interval.workprec(BITS):
        numbers = (interval.ball(Fraction(q)) for q in (t, far, speed))
        return accumulation(
            oscillator(p), side, Entry(*numbers, leaving=leaving), interval.ball(Fraction(end))
        )


STEEP = {  # a fall with b near F gives more speed than a rise with b near 0.17 takes
    "p": replace(PAPER, f=Fraction(1, 100), e=Fraction(3, 10)),
    "t": "-7/5",
    "end": "1",
    "speed": "3/5",
}


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"t": "1", "end": "5/4", "speed": "1/1000"}, "may not press"),
        ({"t": "3", "end": "31/10"}, "may not press"),
        ({"side": -1}, "may not press"),
        ({"p": replace(PAPER, f=Fraction(999, 1000))}, "may not press"),
        ({"end": "1/100"}, "may not accumulate"),
        ({"end": "1/10000"}, "may not accumulate"),
        ({"speed": "1/5", "end": "2/5"}, "may not accumulate"),
        ({"end": "0"}, "window is over"),
        ({"end": "-1"}, "window is over"),
        ({"end": "7"}, "too long"),
        ({"speed": "3"}, "may reach the other wall"),
        ({"speed": "3", "p": replace(PAPER, e=Fraction(1, 100))}, "may reach the other wall"),
        ({"far": "2", "leaving": False}, "may reach the other wall"),
        ({"far": "19/10", "speed": "1", "leaving": False}, "may reach the other wall"),
        ({**STEEP, "leaving": True}, "may reach the other wall"),
        ({**STEEP, "leaving": False}, "may reach the other wall"),
        ({"p": replace(PAPER, mu=Fraction(10**4))}, "may not decrease"),
        ({"p": replace(PAPER, f=Fraction(0))}, "may not decrease"),
    ],
    ids=str,
)
def test_refusals(changes, reason):
    """Each condition of the lemma, just broken."""
    assert float(lemma().ratio) < 0.7
    with pytest.raises(NotProved) as caught:
        lemma(**changes)
    assert caught.value.step == "capture"
    assert reason in caught.value.reason


def test_thick_entries():
    """The time, distance and speed may be sets: the bounds hold for the worst of them."""
    with interval.workprec(BITS):
        osc, end = oscillator(PAPER), Ball(3) / 10
        worst = accumulation(osc, 1, Entry(Ball(0), Ball(0), Ball(1) / 100, leaving=True), end)
        thick = Entry(Ball(0, 1e-6), Ball(0), Ball(1) / 100 + Ball(0, 1e-6), leaving=True)
        wider = accumulation(osc, 1, thick, end)
        assert interval.subset(worst.time, wider.time)
        for entry in (
            Entry(Ball(0, 1), Ball(0), Ball(1) / 100, leaving=True),
            Entry(Ball(0), Ball(0), Ball(0, 1), leaving=True),
            Entry(Ball(0), Ball(0, 3), Ball(1) / 100, leaving=False),
            Entry(Ball(0), Ball(0), Ball("nan"), leaving=True),
            Entry(Ball("nan"), Ball(0), Ball(1) / 100, leaving=True),
            Entry(Ball(0), Ball("nan"), Ball(1) / 100, leaving=False),
        ):
            with pytest.raises(NotProved):
                accumulation(osc, 1, entry, end)
        for bad in (Ball("nan"), Ball(0, "inf")):
            with pytest.raises(NotProved):
                accumulation(osc, 1, Entry(Ball(0), Ball(0), Ball(1) / 100, leaving=True), bad)


@pytest.mark.parametrize("e", ["1", "9/10", "1/3"])
@pytest.mark.parametrize("mu", ["0", "1/2"])
def test_captures_in_the_flow(e, mu):
    """After one hit, or after three: the same rest, the same release; and what is refused."""
    p = replace(PAPER, e=Fraction(e), mu=Fraction(mu))
    state, end = (Fraction(999, 1000), Fraction(1, 100)), Fraction(5, 2)
    with interval.workprec(BITS):
        path, events, orbit = certified(p, state, end)
        assert path.words == ("hit r", "capture r", "release left")
        hit, capture, release = events
        assert orbit.events[0].time < orbit.events[2].time
        assert not orbit.events[1].time < orbit.events[0].time
        osc = oscillator(p)
        begin, stop = starting(osc, state), moment(osc, end)
        bounces, at = [], Bounces(p, 1)
        with workdps(50):
            t, w = (
                number(interval.midpoint(orbit.events[0].time)),
                number(interval.midpoint(osc.e * orbit.events[0].velocity)),
            )
            for _ in range(2):
                rise = at.zero(lambda d, w=w, t=t: at.state((t, 0, w), d, 1)[1], w / 8)
                turn = t + rise
                t, arrived, _ = at.bounce(t, mpf(0), w)
                w = at.e * arrived
                bounces += [("turn right", turn), ("hit r", t)]
            while w > mpf(10) ** -9:
                t, arrived, _ = at.bounce(t, mpf(0), w)
                w = at.e * arrived
            assert holds(orbit.events[1].time, rational(t))
        near = Fraction(1, 10**9)
        more = [Expected(word, interval.around(rational(t), near)) for word, t in bounces]
        later = follow(osc, begin, (hit, *more, capture, release), stop, BALLS)
        for a, b in zip(later.end, orbit.end, strict=True):
            assert (a + Ball(0)).overlaps(b + Ball(0))
        assert later.events[-1].time.overlaps(orbit.events[-1].time)
        early = capture._replace(window=interval.around(interval.midpoint(hit.window), near))
        other = capture._replace(word="capture l")
        for wrong in (
            *((capture, release), (hit, early, release), (hit, other, release), (hit, capture)),
            *((hit, *more[:1], capture, release), (hit, capture, capture, release)),
            *((hit, capture, release._replace(word="release right")), (hit, release)),
            *((hit, capture, *more, release), (hit, capture, release, hit)),
        ):
            with pytest.raises(NotProved):
                follow(osc, begin, wrong, stop, BALLS)
        assert exactly(p, state, 0, 1, (hit, capture)).end[1].is_zero()
