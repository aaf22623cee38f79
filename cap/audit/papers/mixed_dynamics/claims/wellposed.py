"""Section 2.3: the proof of Theorem 2.5, step by step.

What it misses is that a wall can hold the mass: bounces accumulate (`cap.flow.capture`).
"""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, identity, same, symbols
from cap.audit.means.balls import above, between
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.orbits import before_a_stop, until
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball

CAPTURE = "capture.json"
SMALL = Fraction(1, 100), Fraction(1, 10**4), Fraction(1, 10**6)


def accumulation() -> str:
    """Return the capture at the paper's parameters in words, certified."""
    claims = stored(CAPTURE).claims
    need(claims["itinerary"][0] == "capture r", "the capture is not the first event")
    need(claims["ratio"] < 1, "the ratio of successive speeds may be 1")
    box = claims["box"]
    return (
        f"every orbit from the interior of {box['x']} × {box['v']} at t = 0 hits the right wall "
        f"infinitely often before t = {above(claims['accumulation_time'])}"
    )


@claim("thm:wellposed", Kind.THEOREM, stated="no finite-time accumulation of switching events")
def no_accumulation() -> Verdict:
    """No finite-time accumulation of switching events can occur."""
    return refuted(
        f"{accumulation()}, turning once between any two hits; then it rests there until a fixed "
        "time. With each capture counted as one event the events do not accumulate",
        "Certified capture: speeds of successive hits fall at least geometrically.",
        certificate=CAPTURE,
    )


@claim("thm:wellposed", Kind.STEP, stated="Step 1: unique C² solution until the first event")
def first_piece() -> Verdict:
    """Until the first event the equation is x'' = F cos ωt - f sgn v₀ and has a unique solution."""
    t, x, v, F, f, w = sp.symbols("t x v F f omega", real=True)
    right = F * sp.cos(w * t) - f
    need(not right.free_symbols & {x, v}, "it depends on the state")
    return confirmed(
        "the right-hand side is a continuous function of t alone: integrate twice",
        "It contains neither x nor v.",
    )


@claim("thm:wellposed", Kind.STEP, stated="Step 2: |x'(t*+) - 0| = |F cos ωt*| - f > 0")
def velocity_after_a_turn() -> Verdict:
    """After a transverse turning point |x'(t*+) - 0| = |F cos ωt*| - f > 0."""
    t, a = symbols("t a")
    v = sp.limit(a * t, t, 0)  # the velocity at t* + t is (F cos ωt* - f) t + o(t)
    need(same(v, sp.Integer(0)), "the velocity jumps at a turn")
    need(differs(v, a), "the acceleration may vanish")
    return corrected(
        "x'(t*+) = 0, and |x''(t*+)| = |F cos ωt*| - f: the acceleration is meant",
        "The velocity is continuous at a turning point.",
    )


@claim("thm:wellposed", Kind.FORMULA, stated="E' = x' F cos ωt - f |x'|")
def rate_of_energy() -> Verdict:
    """Step 3: E = x'²/2 has E' = x' F cos ωt - f |x'| on a flight, and |E'| <= (F + f) sqrt(2E)."""
    v, c, F, f = sp.symbols("v c F f", real=True)
    for sign in (1, -1):
        speed = sp.Symbol("u", positive=True)
        derivative = (v * (F * c - f * sign)).subs(v, sign * speed)
        identity("E'", derivative, sign * speed * F * c - f * speed)
    u = sp.Symbol("u", positive=True)
    identity("sqrt(2E) = |x'|", sp.sqrt(2 * u**2 / 2), u)
    return confirmed(
        "E' = x' F cos ωt - f |x'|, at most (F + f) |x'| in size", "Both signs, symbolically."
    )


@claim("eq:wp-energy", Kind.INEQUALITY, stated="sqrt E <= sqrt E(0) + (F + f) t/sqrt 2")
def energy_bound() -> Verdict:
    """sqrt E(t) <= sqrt E(0) + (F + f) t/sqrt 2, so |x'| <= |v₀| + (F + f) T₀ on [0, T₀]."""
    E, F, f = symbols("E F f")
    rate = (F + f) * sp.sqrt(2 * E) / (2 * sp.sqrt(E))
    identity("(sqrt E)' <= (F + f)/sqrt 2", rate, (F + f) / sp.sqrt(2))
    return confirmed(
        "both bounds; a sharper one is |x'(t)| <= |v₀| + (F - f) t, as friction only brakes",
        "(sqrt E)' = E'/(2 sqrt E), with the bound of E', by sympy. Step 3 of the proof.",
    )


@claim("thm:wellposed", Kind.STEP, stated="Step 4: consecutive hits are a distance R apart")
def hits_are_a_gap_apart() -> Verdict:
    """Step 4: between two consecutive wall hits the trajectory traverses at least R, so hits do not
    accumulate.
    """
    return refuted(
        f"two hits of the same wall are not: {accumulation()}",
        "Certified capture. The step is right for orbits whose velocity does not vanish.",
        certificate=CAPTURE,
    )


@claim("thm:wellposed", Kind.NUMBER, stated="τ_wait = (2/ω)(π - 2 arccos(f/F))")
def length_of_a_sticking_phase() -> Verdict:
    """(5a) A phase {|F cos ωt| < f} has the length τ_wait = (2/ω)(π - 2 arccos(f/F))."""
    ratio, w = symbols("rho omega")
    a = sp.acos(ratio)
    phase = ((sp.pi - a) - a) / w  # from F cos ωt = f to F cos ωt = -f
    stated = 2 / w * (sp.pi - 2 * a)
    evidence = (
        "From the phase arccos(f/F) to π - arccos(f/F). Two such phases make a period's τ_wait."
    )
    need(same(2 * phase, stated), "twice the length is not what is stated")
    if same(phase, stated):
        return confirmed("τ_wait", evidence)
    return corrected("half of it, (1/ω)(π - 2 arccos(f/F)) = (2/ω) arcsin(f/F)", evidence)


@claim("thm:wellposed", Kind.STEP, stated="(5a) a rest lasts longer than a positive constant")
def rests_last() -> Verdict:
    """(5a) A rest has a duration bounded below by a positive constant depending on F, f, ω only."""
    lengths = []
    with interval.workprec(100):
        for excess in SMALL:
            orbit = until(before_a_stop(excess - PAPER.f), interval.ball(Fraction(5, 2)))
            need(orbit.words == ("hit l", "stick", "release left"), "no rest", w=orbit.words)
            lengths.append(orbit.times[2] - orbit.times[1])
        bounds = [2 * interval.ball(q) for q in SMALL]
        need(all(0 < a < b for a, b in zip(lengths, bounds, strict=True)), "longer rests")
    return refuted(
        "rests of every positive duration occur: let v > 0 vanish the time η before F cos ωt falls "
        "to -f",
        "Orbits at the paper's parameters, followed in balls, hit l at t = 3/2, and rest for "
        f"{', '.join(between(each, 10) for each in lengths)}.",
    )


@claim("thm:wellposed", Kind.FORMULA, stated="x' = s (F cos ωτ - f)(t - τ) + r")
def velocity_after_turning() -> Verdict:
    """(5b) After a turn at τ the velocity is s (F cos ωτ - f)(t - τ) up to second order."""
    c, f, s = sp.symbols("c f s", real=True)
    derived, stated = c - s * f, s * (c - f)
    need(same(derived.subs(s, 1), stated.subs(s, 1)), "they differ for s = 1")
    need(differs(derived.subs(s, -1), stated.subs(s, -1)), "they agree for s = -1")
    identity("its size", (-1) * derived.subs({s: -1, c: -sp.Abs(c)}), sp.Abs(c) - f)
    return corrected(
        "(F cos ωτ - s f)(t - τ), which is s (|F cos ωτ| - f)(t - τ); the two agree for s = 1 only",
        "The derivative of the velocity at τ+, for both signs.",
    )


@claim("thm:wellposed", Kind.INEQUALITY, stated="|r(t)| <= (Fω + f)(t - τ)²/2")
def remainder_after_turning() -> Verdict:
    """(5b) The remainder is at most (Fω + f)(t - τ)²/2."""
    F, f, w, d = symbols("F f omega d")
    true, stated = F * w * d**2 / 2, (F * w + f) * d**2 / 2
    need(sp.simplify(stated - true).is_positive is True, "the stated bound may be too small")
    unit = symbols("k")  # with time in units 1/k as long, ω becomes ω/k, forces become F/k²
    degrees = {
        sp.degree(sp.expand(term * unit**3), unit) for term in (F * w / unit**3, f / unit**2)
    }
    need(len(degrees) == 2, "both terms scale alike")
    return imprecise(
        "Fω(t - τ)²/2 bounds it, so the stated bound is true in numbers; but Fω + f adds a force "
        "to a force per time, and changes with the unit of time",
        "|(F cos ωt)'| <= Fω; the two terms scale with different powers of the unit of time.",
    )


@claim("thm:wellposed", Kind.STEP, stated="a* > 0 depending only on F, f, ω, T₀")
def turns_are_robust() -> Verdict:
    """(5b) There is a* > 0, depending only on F, f, ω, T₀, with |F cos ωτ| - f >= a* at every
    turn.
    """
    with interval.workprec(100):
        for excess in SMALL:
            orbit = until(before_a_stop(-PAPER.f - excess), interval.ball(Fraction(5, 2)))
            need(orbit.words == ("hit l", "turn left"), "no turn", w=orbit.words)
            over = -orbit.times[1].cos() - interval.ball(PAPER.f)
            need(0 < over < 2 * interval.ball(excess), "the excess is larger", over=over)
    return refuted(
        "turns with every small excess η = |F cos ωτ| - f > 0 occur: let v > 0 vanish just after "
        "F cos ωt has fallen to -f",
        "Orbits at the paper's parameters, followed in balls, hit l at t = 3/2, and turn with an "
        f"excess below {', '.join(str(2 * float(q)) for q in SMALL)}.",
    )


@claim("eq:wp-tauzero", Kind.INEQUALITY, stated="τ_(n+1) - τ_n >= 2a*/(Fω + f) > 0")
def turns_are_apart() -> Verdict:
    """Consecutive velocity-zero events are at least a time apart that depends on F, f, ω, T₀
    only.
    """
    return refuted(
        f"{accumulation()}, with a turn between any two hits",
        "Certified capture. For consecutive turns without a hit between them the bound 2a/(Fω), a "
        "the excess of the first, is right; but a has no lower bound (wellposed.turns-are-robust).",
        certificate=CAPTURE,
    )


@claim("thm:wellposed", Kind.STEP, stated="at most T₀/min(τ_wait, τ_gap) velocity-zero events")
def number_of_stops() -> Verdict:
    """(5c) There are at most T₀/min(τ_wait, τ_gap) velocity-zero events on [0, T₀]."""
    return refuted(
        f"there may be infinitely many: {accumulation()}, and turns between the hits",
        "Certified capture.",
        certificate=CAPTURE,
    )


@claim("thm:wellposed", Kind.STEP, stated="Step 6: the hybrid bound is no smaller")
def hit_and_turn_are_apart() -> Verdict:
    """Step 6: between a hit and a turn passes at least the smaller of the bounds of steps 4
    and 5.
    """
    u, b, f = symbols("u b f")  # leaves the wall with speed u, pushed back by b > f
    d = sp.solve(u - (b + f) * sp.Symbol("d"), sp.Symbol("d"))[0]
    identity("the time to the turn", d, u / (b + f))
    need(same(sp.limit(d, u, 0), sp.Integer(0)), "the time does not tend to 0")
    return refuted(
        "a mass that leaves the wall with the speed u, pushed back by a force b > f, turns after "
        "about u/(b + f), which is as small as one likes",
        f"The velocity u - (b + f) t vanishes then. And {accumulation()}.",
        certificate=CAPTURE,
    )


@claim("thm:wellposed", Kind.STEP, stated="Step 7: event maps are Lipschitz")
def event_maps() -> Verdict:
    """Step 7: the event maps are Lipschitz in the state at the event."""
    u, F, c = symbols("u F c")
    entry = 2 * F * c / u
    need(sp.limit(entry, u, 0, "+") == sp.oo, "the entry stays bounded")
    return imprecise(
        "locally, where the event is transverse; the saltation matrix of a hit has the entry "
        "2F cos ωt*/v, which has no bound as the speed of the hit tends to 0",
        "Limit by sympy.",
    )


def velocity_jump(distance: Fraction) -> Ball:
    """Return how far apart velocities are at the time 11/10 at which an orbit hits r with speed 1.

    They are those of the orbits that were this distance to its left and right at t = 0.
    """
    f, end = interval.ball(PAPER.f), interval.ball(Fraction(11, 10))
    v = 1 - end.sin() + f * end
    x = interval.ball(PAPER.r) - v * end - (1 - end.cos()) + f * end * end / 2
    early, late = (until((x + s * interval.ball(distance), v), end) for s in (1, -1))
    need((early.words, late.words) == (("hit r",), ()), "the orbits do the same")
    jump: Ball = late.state[1] - early.state[1]
    return jump


@claim("thm:wellposed", Kind.THEOREM, stated="continuous dependence on compact intervals")
def continuous_dependence() -> Verdict:
    """On every compact interval without tangential touch the flow depends continuously on the
    initial datum.
    """
    with interval.workprec(120):
        jumps = [velocity_jump(distance) for distance in SMALL]
        need(all(10 * jump > 19 for jump in jumps), "the velocities are near", j=jumps)
    return corrected(
        "only if (r, v) and (r, -v) are identified, and (l, v) and (l, -v): at the time of a hit "
        "with the speed V two orbits that hit a little earlier and later have velocities near -V "
        "and V. Tangential touches in the interior do no harm",
        f"In balls, with initial data {', '.join(str(2 * float(q)) for q in SMALL)} apart the "
        f"velocities at t = 1.1 are at least 1.9 apart. In the interior |v - w| never grows "
        "(stops.sticking-begins), through tangential touches too.",
    )


@claim("ssec:intro-related", Kind.THEOREM, stated="a uniform lower bound on inter-event times")
def uniform_inter_event_time() -> Verdict:
    """Theorem 2.5 provides a uniform lower bound on inter-event times on bounded velocity
    intervals.
    """
    found = accumulation()
    with interval.workprec(60):
        need(Fraction(stored(CAPTURE).claims["box"]["v"].upper) < 1, "the speeds are large")
    return refuted(
        f"there is none: {found}, with speeds below 1",
        "Certified capture.",
        certificate=CAPTURE,
    )
