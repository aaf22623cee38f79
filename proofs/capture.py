"""Theorem (capture).  Let x'' = F cos ωt - f sgn x' - μ x', l < x < r, v -> -e v at the walls, be
given at rational parameters.  If the lemmas below succeed, then every orbit that starts at t = 0 in
the interior of an explicit box makes infinitely many impacts with one wall, which accumulate at a
time in an explicit interval; then the mass rests at the wall until an explicit release time.

Lemma 1 follows all orbits from the box to a hit, with which the infinitely many begin; if the box
lies at the wall, there is nothing to follow.  Lemma 2 is the lemma of `cap.flow.capture` (ratio and
duration of the bounces over a window of time, geometric sum), applied to the whole box.

*Against Theorem wellposed of the paper.*  Step 4 of its proof excludes that hits accumulate, since
two consecutive hits are a distance R apart.  Hits of the same wall are not: between them the mass
turns.  Steps 6 and (5b) fail with it: there is no positive time between events.  Capture happens on
an open set of initial states.  What remains true: from every state one forward solution exists and
is unique for as long as v is not 0 at a time with |F cos ωt| = f, where the contact law at the wall
is part of the definition, which (F1) to (F3) do not spell out: a mass at rest at the right wall
stays at rest while F cos ωt >= -f, the wall or friction holding it, and leaves when F cos ωt < -f;
mirrored at the left wall.  Bounded time intervals contain finitely many events, a capture with all
its hits counted as one.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

from cap.certificate import writer as certificate
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.flow.capture import Accumulation, Entry, accumulation
from cap.flow.event import TAYLOR_MODELS, Expected, next_slow
from cap.flow.model import Moment, Oscillator
from cap.flow.strobe import Orbit, State, follow, oscillator
from cap.flow.windows import Itinerary, windows_for
from cap.proofs.fixed_point import Proof, Setting, assembled
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.sets.taylor_model import Domain, TaylorModel

SUMMARY = "infinitely many hits of a wall in finite time, then rest, from a box of states"
GROUP = "orbit"
SEARCH = candidates.capturing

BITS = 128  # the box is of no extreme size
SIDES = {"r": 1, "l": -1}
Range = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Captured:
    """All orbits from the interior of the box are captured after these ``events``.

    They happen in their windows; the last of them is the capture, ``window`` is that of the lemma,
    ``found`` what it says.
    """

    x: Range
    v: Range
    events: Itinerary
    window: Range
    found: Accumulation


Box = Callable[[Fraction], Captured]


def prove(setting: Setting) -> Proof:
    """Find the largest box; return the proof for parts of it.

    ``setting.start`` is a state in the middle of the box with its events up to the capture; if that
    is the only one, a box at the wall is looked for.  Raises `NotProved` with the step that failed.
    """
    words = [word for word, _ in setting.start.events]
    if not (words and words[-1].startswith("capture")):
        raise BadInput("a capture is proved from a state whose events end with a capture")
    side = SIDES[words[-1].split()[1]]
    with interval.workprec(BITS):
        osc = oscillator(setting.parameters)
        box = (lemma_1_box if words[1:] else box_at_the_wall)(osc, setting, side)

    def certified(part: Fraction) -> dict[str, Any]:
        with interval.workprec(BITS):
            captured = box(part)
            first, last = (interval.ball(t) for t in captured.window)
            number = next_slow(osc, -side, interval.hull(first, last))
        with interval.workprec(setting.bits):
            release = oscillator(setting.parameters).slow(-side, number).t
            return _certificate(setting, side, captured, release)

    return certified


def lemma_1_box(osc: Oscillator[Any], setting: Setting, side: int) -> Box:
    """*Statement.* All orbits from an explicit box have the same events, up to a hit, with which
    the lemma of capture applies to all of them.

    *Computed.* The certified flow over Taylor models of order two, for the largest box found with
    sides in the ratio of the natural units; a part of it is claimed.
    """
    size = bisection.largest(lambda size: _followed(osc, setting, side, size), Fraction(1, 8), 4)
    if size is None:
        raise NotProved("Lemma 1", "no box around the state is captured as a whole")
    largest = size
    return lambda part: _followed(osc, setting, side, largest * part)


def _followed(osc: Oscillator[Any], setting: Setting, side: int, size: Fraction) -> Captured:
    """Follow the box of half-widths ``size`` times the natural units to the end of the window."""
    start, centre = setting.start, (Fraction(setting.start.x), Fraction(setting.start.v))
    x, v = (_inside(m, size * unit) for m, unit in zip(centre, _scale(setting), strict=True))
    middle = [interval.ball((a + b) / 2) for a, b in (x, v)]
    domain = Domain([interval.ball((b - a) / 2) for a, b in (x, v)], 2)
    begin = Moment(Ball(0), Ball(0), Ball(1))
    x_model, v_model = domain.variables(middle)
    state = State(begin, x_model, v_model)
    until = _rounded(Fraction(start.events[-1][1]), setting)
    number = next_slow(osc, -side, interval.ball(until))
    end = osc.moment(interval.point((osc.slow(-side, number).t + interval.ball(until)) / 2))

    def attempt(events: Itinerary) -> Orbit[TaylorModel]:
        return follow(osc, state, events, end, TAYLOR_MODELS)

    expected = start.expected()
    events, orbit = windows_for(attempt, expected, TAYLOR_MODELS.bound)
    hit = orbit.events[-2]
    speed = osc.e * abs(TAYLOR_MODELS.bound(hit.velocity))
    since = Fraction(certificate.window(events[-2].window)[0])
    time = interval.hull(interval.ball(since), TAYLOR_MODELS.bound(hit.time))
    found = accumulation(osc, side, Entry(time, Ball(0), speed, leaving=True), interval.ball(until))
    return Captured(x, v, events, (since, until), found)


def box_at_the_wall(osc: Oscillator[Any], setting: Setting, side: int) -> Box:
    """*Statement.* The lemma applies at t = 0 to all states with x in [r - δ, r], |v| <= u (at the
    right wall), but to rest at the wall.

    *Computed.* The largest product δ u found among ends of the window and ratios δ F/u².
    """
    leaving = interval.midpoint(osc.slow(-side, 0).t)
    pressed = interval.midpoint((osc.f / osc.F).acos() / osc.omega)
    for latest in (leaving, pressed):  # with f near F the wall is pressed for a short time only
        speed, choice = _best(osc, setting, side, latest)
        if speed:
            break
    else:
        raise NotProved("Lemma 2", "no box at the wall is captured from t = 0 on")
    return lambda part: _at_the_wall(osc, setting, side, choice, interval.short(speed * part))


def _best(
    osc: Oscillator[Any], setting: Setting, side: int, latest: Fraction
) -> tuple[Fraction, tuple[Fraction, Fraction]]:
    """Return the speed, the end of the window and the ratio of the largest box; speed 0 if none."""
    best, speed, choice = Fraction(0), Fraction(0), (Fraction(0), Fraction(0))
    for part, ratio in product(range(3, 20), (1, 2, 4, 8)):
        tried = _rounded(latest * part / 20, setting), Fraction(ratio, 4)
        u = _fastest(osc, setting, side, tried)
        if tried[1] * u**3 > best:
            best, choice, speed = tried[1] * u**3, tried, u
    return speed, choice


def _scale(setting: Setting) -> tuple[Fraction, Fraction]:
    """Return R and Rω, halved until the forcing moves the mass as far and as fast in 1/ω."""
    p, (length, speed) = setting.parameters, setting.scale
    while length > 2 * p.F / p.omega**2:
        length /= 2
    while speed > 2 * p.F / p.omega:
        speed /= 2
    return length, speed


def _finest(time: Fraction, setting: Setting) -> Fraction:
    """Return the unit of time, a shorter one if ``time`` is short."""
    return min(setting.units.time, 100 * time)


def _rounded(time: Fraction, setting: Setting) -> Fraction:
    grid = 10 ** max(0, 6 - interval.decade(_finest(time, setting)))
    return Fraction(round(time * grid) + 1, grid)


def _far(setting: Setting, ratio: Fraction, u: Fraction) -> Fraction:
    """Return the distance δ from the wall that goes with the speed u."""
    return interval.short(ratio * u * u / setting.parameters.F)


def _fastest(
    osc: Oscillator[Any], setting: Setting, side: int, choice: tuple[Fraction, Fraction]
) -> Fraction:
    """Return the largest speed found for an end of the window and a ratio, 0 if there is none."""
    speed = bisection.largest(
        lambda u: _lemma(osc, setting, side, choice, u), _scale(setting)[1], 8
    )
    return speed or Fraction(0)


def _lemma(
    osc: Oscillator[Any],
    setting: Setting,
    side: int,
    choice: tuple[Fraction, Fraction],
    u: Fraction,
) -> Accumulation:
    """Apply the lemma of `cap.flow.capture` at t = 0."""
    until, ratio = choice
    entry = Entry(Ball(0), interval.ball(_far(setting, ratio, u)), interval.ball(u), leaving=False)
    return accumulation(osc, side, entry, interval.ball(until))


def _at_the_wall(
    osc: Oscillator[Any],
    setting: Setting,
    side: int,
    choice: tuple[Fraction, Fraction],
    u: Fraction,
) -> Captured:
    """Return the box at the wall for a speed."""
    until, ratio = choice
    found, p, far = (
        _lemma(osc, setting, side, choice, u),
        setting.parameters,
        _far(setting, ratio, u),
    )
    x = (p.r - far, p.r) if side > 0 else (p.l, p.l + far)
    event = Expected("capture r" if side > 0 else "capture l", interval.ball(until))
    return Captured(x, (-u, u), (event,), (Fraction(0), until), found)


def _inside(centre: Fraction, half: Fraction) -> Range:
    """Return decimals [lower, upper] inside [centre - half, centre + half]."""
    scale = 10 ** max(0, 3 - interval.decade(half))
    return Fraction(-(-(centre - half) * scale // 1), scale), Fraction(
        (centre + half) * scale // 1, scale
    )


def _certificate(setting: Setting, side: int, captured: Captured, release: Ball) -> dict[str, Any]:
    """Return the certificate."""
    wall, leave = ("r", "release left") if side > 0 else ("l", "release right")
    window = certificate.window
    released = setting.rounding.pair(release, setting.units.time)
    before = [window(event.window) for event in captured.events[:-1]]
    since, until = captured.window
    latest = (interval.ends(captured.found.time)[1] + until) / 2  # for the checker, looser
    places = 4 - interval.decade(_finest(until, setting))
    accumulated = [certificate.exact(since), interval.outward(interval.ball(latest), places)[1]]
    hints = [*before, [certificate.exact(end) for end in captured.window], window(release)]
    claims = {
        "box": {
            name: [certificate.exact(end) for end in sides]
            for name, sides in zip("xv", (captured.x, captured.v), strict=True)
        },
        "wall": wall,
        "itinerary": [*(event.word for event in captured.events), leave],
        "event_times": [*before, accumulated, released],
        "forcing": window(captured.found.forcing),
        "ratio": certificate.bound(captured.found.ratio),
        "accumulation_time": accumulated,
        "release_time": released,
    }
    found = claims, {"bits": str(setting.checker_bits), "events": hints}
    return assembled("capture", setting, setting.parameters.strings(), found)
