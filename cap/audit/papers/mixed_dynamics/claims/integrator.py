"""Sections 10.1 and A.1: the closed form of a flight, events, and what a scan may miss."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity, symbols
from cap.audit.means.balls import above, below
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise
from cap.parameters import PAPER
from cap.sets import interval

CELLS = 256  # of the time from the start of a flight to the next minimum of sin ωt
DOUBLE = Fraction(1, 2**53)  # the relative error of one operation on doubles


@claim("eq:flight-closed", Kind.FORMULA, stated="x = -(F/ω²) cos ωt - fst²/2 + A₀t + B₀")
def closed_form_of_a_flight() -> Verdict:
    """On a flight of sign s, x' = (F/ω) sin ωt - fst + A₀ and x = -(F/ω²) cos ωt - fst²/2 + A₀t +
    B₀.
    """
    F, f, w = symbols("F f omega")
    t, s, A, B = sp.symbols("t s A_0 B_0", real=True)
    x = -F / w**2 * sp.cos(w * t) - f * s * t**2 / 2 + A * t + B
    v = F / w * sp.sin(w * t) - f * s * t + A
    identity("x' is the velocity", sp.diff(x, t), v)
    identity("x'' is the force", sp.diff(v, t), F * sp.cos(w * t) - s * f)
    return confirmed("as stated", "Differentiated by sympy.")


@claim("eq:hist-vel", Kind.FORMULA, stated="x' = v₀ + (F/ω)(sin ωt - sin ωt₀) - sf(t - t₀)")
def velocity_of_a_flight() -> Verdict:
    """The velocity on a flight from (t₀; x₀, v₀)."""
    F, f, w = symbols("F f omega")
    t, start, s, v = sp.symbols("t t_0 s v_0", real=True)
    velocity = v + F / w * (sp.sin(w * t) - sp.sin(w * start)) - s * f * (t - start)
    identity("its derivative", sp.diff(velocity, t), F * sp.cos(w * t) - s * f)
    identity("its value at the start", velocity.subs(t, start), v)
    return confirmed("as stated", "Derivative and initial value by sympy.")


@claim("eq:hist-pos", Kind.FORMULA, stated="x = x₀ + v₀(t - t₀) - (F/ω²)(cos ωt - cos ωt₀) - ..")
def position_on_a_flight() -> Verdict:
    """The position on a flight from (t₀; x₀, v₀), with the terms -(F/ω) sin(ωt₀)(t - t₀) and
    -sf(t - t₀)²/2.
    """
    F, f, w = symbols("F f omega")
    t, start, s, x, v = sp.symbols("t t_0 s x_0 v_0", real=True)
    after = t - start
    place = x + v * after - F / w**2 * (sp.cos(w * t) - sp.cos(w * start))
    place += -F / w * sp.sin(w * start) * after - s * f * after**2 / 2
    velocity = v + F / w * (sp.sin(w * t) - sp.sin(w * start)) - s * f * after
    identity("its derivative", sp.diff(place, t), velocity)
    identity("its value at the start", place.subs(t, start), x)
    return confirmed("as stated", "Derivative and initial value by sympy.")


@claim("ssec:num-event", Kind.STEP, stated="candidates are bracketed by a coarse scan")
def events_by_a_scan() -> Verdict:
    """The next event is found by a coarse scan of the flight and bisection."""
    u, a, f, t = symbols("u a f t")
    # From the right wall at the speed u, under a force a > f towards it: turn, and hit again.
    back = sp.solve(-u + (a + f) * t, t)[0]
    identity("the time until it turns", back, u / (a + f))
    far = u * back - (a + f) * back**2 / 2
    again = sp.sqrt(2 * far / (a - f))
    need(sp.limit(back + again, u, 0) == 0, "the hits stay apart")
    claims = stored("capture.json").claims
    need("capture r" in claims["itinerary"], "nothing is captured")
    end = claims["accumulation_time"]
    return imprecise(
        "a scan with any step may miss events: a mass that leaves a wall at the speed u, pushed "
        "back with the force a > f, turns and hits again after a time of order u, and such hits "
        "accumulate from an open set of states (before t = "
        f"{above(end)} from the certified box). No scan is needed: on a flight the velocity is "
        "monotone between the known times at which F cos ωt = ±f, so its zeros are bracketed, and "
        "between these x is monotone",
        "Times of the turn and of the next hit for a constant force, by sympy; the stored "
        "certificate of a capture.",
        certificate="capture.json",
    )


@claim("ssec:num-event", Kind.STEP, stated="rules a, b, c for hits, turns and sticking")
def rules_at_events() -> Verdict:
    """Reflection at a wall; a turn with the sign of F cos ωt if |F cos ωt| > f; sticking until |F
    cos ωt| = f if it is less.
    """
    claims = stored("capture.json").claims
    force = claims["forcing"]
    need(claims["itinerary"] == ["capture r", "release left"], "the events are others")
    need(force.lower > Fraction(2, 5), "the forcing is not above f", force=force)
    return corrected(
        "true in the open segment; a rule for rest at a wall is missing: after a capture the mass "
        "rests at r although |F cos ωt| > f there (F cos ωt >= "
        f"{below(force)} on the box), and leaves when F cos ωt < -f, not when |F cos ωt| = f. Nor "
        "does the loop reach t∞ after infinitely many hits",
        "Zeros of the velocity: stops.speed-after-a-turn, stops.sticking-begins. At the wall: the "
        "stored certificate of a capture.",
        certificate="capture.json",
    )


@claim("ssec:num-event", Kind.WORDS, stated="the error is governed solely by the bisection")
def error_of_the_integrator() -> Verdict:
    """The numerical error on a flight is governed solely by the bisection tolerance."""
    outer = max(stored("saddle.json").claims["multipliers"], key=lambda each: abs(each.upper))
    growth = abs(outer.lower)
    need(growth > 2, "errors do not grow much at the saddle", growth=float(growth))
    error, periods = DOUBLE, 0
    while error < Fraction(1, 10):
        error, periods = error * growth, periods + 1
    return imprecise(
        "it is free of a truncation error, which is the point made; but the closed form is "
        "rounded, and errors grow along an orbit like Φ': at the saddle that is certified beside "
        f"the island by {below(outer, 3)} in a period, from 2⁻⁵³ to 1/10 in {periods} periods",
        "The outer multiplier of the stored certificate of the saddle, exactly.",
        certificate="saddle.json",
    )


@claim("ssec:hist-closed-form", Kind.STEP, stated="the next event comes within [t₀, t₀ + T]")
def an_event_within_a_period() -> Verdict:
    """On every flight the next event comes within a period."""
    with interval.workprec(80):
        pi, f, R = interval.pi(), interval.ball(PAPER.f), interval.ball(PAPER.R)
        step = 2 * pi / CELLS
        for k in range(CELLS):
            delta = interval.hull(k * step, (k + 1) * step)
            most = interval.lower(1 + f * delta), interval.lower(2 * pi * f + delta.cos())
            way = [2 * pi * (each - pi * f) for each in most]  # m > each of the two
            need(any(each > R for each in way), "a flight may last a period", at=float(delta.mid()))
        need(2 * pi * (10 - 1 - pi * f) > 48, "the way is shorter")  # m >= 10 - 1, v > 0
    return imprecise(
        "true for the paper's parameters F = ω = 1, R = 2, f = 0.4; not in general: with v₀ = 10 a "
        "mass covers more than 48 in a period without an event, if the gap is that long",
        "If v > 0 for a period after t₀, then v = m - f (t - t₀) + sin t with m > 1 + f δ, δ the "
        "time to the next minimum of sin, and m > 2πf + cos δ; so the mass covers 2π (m - πf), "
        "which is more than R for every δ in [0, 2π]: in balls. The other direction is the mirror "
        "image.",
    )
