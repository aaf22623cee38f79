"""Section 2.2: what happens where the velocity vanishes (Lemma 2.3), and at a wall (Lemma 2.4)."""

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import differs, enclosure, identity, same, symbols
from cap.audit.means.balls import between
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.orbits import States
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted
from cap.sets import interval


@claim("vzero-a", Kind.THEOREM, stated="x' is differentiable at t*")
def differentiable_at_a_turn() -> Verdict:
    """At a transverse turning point x' is differentiable, with v' = F cos ωt* - f sgn v'."""
    a, f = symbols("a f")  # a = F cos ωt* > f; v < 0 before, v > 0 after
    left, right = a + f, a - f
    need(same(left - right, 2 * f), "the one-sided derivatives do not differ by 2f")
    return corrected(
        "x' has the left derivative F cos ωt* + f sgn(F cos ωt*) and the right derivative "
        "F cos ωt* - f sgn(F cos ωt*): a corner, as the proof itself says; the formula is that of "
        "the right derivative",
        "One-sided limits of F cos ωt - f sgn v; they differ by 2f.",
    )


@claim("vzero-a", Kind.FORMULA, stated="|v'(t*)| = |F cos ωt*| - f > 0")
def speed_after_a_turn() -> Verdict:
    """After a transverse turning point |v'| is |F cos ωt*| - f."""
    a, f = symbols("a f")
    for force, sign in ((f + a, 1), (-f - a, -1)):  # |force| > f, and the sign of v after it
        identity("|v'| = |F cos| - f", sign * (force - f * sign), sp.Abs(force) - f)
    return confirmed("|F cos ωt*| - f, from the right", "Both signs, symbolically.")


@claim("vzero-a", Kind.STEP, stated="leaving with x' < 0, and resting, are impossible")
def only_one_way_to_leave() -> Verdict:
    """Where F cos ωt* > f the solution leaves v = 0 with v > 0, and in no other way."""
    a, f, share = symbols("a f share")
    need((a + f).is_positive is True, "below v = 0 the velocity may fall")
    stay = sp.solve(a - f + 2 * f * share, share)[0]
    identity("rest needs the share (f - a)/2f", stay, (f - a) / (2 * f))
    return confirmed(
        "v < 0 would have v' = F cos ωt + f > 0; rest would need 0 in [F cos ωt - f, F cos ωt + f]",
        "Signs, symbolically: the share (f - a)/2f is negative for a > f.",
    )


@claim("vzero-a", Kind.STEP, stated="x' had the sign -1 before (the case +1 is symmetric)")
def velocity_before_a_turn() -> Verdict:
    """Before a turning point with F cos ωt* > f the velocity may have had either sign."""
    a, f = symbols("a f")
    need(same((f + a) - f, a), "a velocity v > 0 does not grow where F cos ωt = f + a")
    need(a.is_positive is True, "a is not positive")
    return imprecise(
        "only the sign -1: where F cos ωt > f a positive velocity grows, and does not vanish",
        "v > 0 has v' = F cos ωt - f > 0 near t*.",
    )


@claim("vzero-b", Kind.THEOREM, stated="|F cos ωt*| < f implies x' ≡ 0 on [t*, t* + δ]")
def sticking_begins() -> Verdict:
    """If |F cos ωt*| < f the body rests for some time, and this is the only continuation."""
    f = symbols("f")
    for faster, slower in ((1, -1), (1, 0), (0, -1)):  # signs of v > w that are not the same
        need((f * (faster - slower)).is_positive is True, "two solutions may separate")
    return confirmed(
        "rest is a solution, and forward solutions are unique: the difference of two velocities "
        "that move in the interior never grows in size",
        "d|v - w|/dt = -f (sgn v - sgn w) <= 0 for v > w: a one-sided Lipschitz condition. The "
        "paper cites Filippov's theorem for the same.",
    )


@claim("vzero-b", Kind.THEOREM, stated="it leaves when |F cos ωt♯| = f first, with sgn F cos ωt♯")
def sticking_ends() -> Verdict:
    """The body rests until |F cos ωt| = f for the first time, within T, and leaves with that
    sign.
    """
    F, a, w = symbols("F a omega")  # f = F cos a, 0 < a < π/2
    t = sp.Symbol("t", real=True)
    force = F * sp.cos(w * t)
    for phase, sign in ((2 * sp.pi - a, 1), (sp.pi - a, -1)):
        rate = sp.diff(force, t).subs(t, phase / w)
        identity("|F cos ωt| grows through f", sp.expand_trig(sign * rate), F * w * sp.sin(a))
        identity(
            "F cos ωt = ±f there", sp.expand_trig(force.subs(t, phase / w)), sign * F * sp.cos(a)
        )
    return confirmed(
        "|F cos ωt| grows through f at the rate ω sqrt(F² - f²), so what leaves, leaves at once; "
        "the rest lasts at most (2/ω) arcsin(f/F) < T/2",
        "The derivative of F cos ωt at the release phases 2π - arccos(f/F) and π - arccos(f/F).",
    )


@claim("vzero-c", Kind.FORMULA, stated="ωt* in {±arccos(f/F) + 2πZ}")
def tangency_times() -> Verdict:
    """|F cos ωt| = f only for ωt in {±arccos(f/F) + 2πZ}."""
    a = sp.Symbol("a", real=True)
    identity("cos(π ± a) = -cos a", sp.cos(sp.pi - a) + sp.cos(a))
    need(differs(sp.cos(sp.pi - sp.pi / 5), sp.cos(sp.pi / 5)), "π - a is among the times named")
    return corrected(
        "ωt in {±arccos(f/F), π ± arccos(f/F)} + 2πZ: those with F cos ωt = -f are missing",
        "cos(π - a) = -cos a. They are the times at which a rest ends to the left.",
    )


@claim("vzero-c", Kind.NUMBER, stated="±a/ω and (2π ± a)/ω: four points in one period")
def four_tangency_times() -> Verdict:
    """The times ±a/ω, (2π ± a)/ω, a = arccos(f/F), are four points in one period."""
    a = sp.Symbol("a", positive=True)
    named = [a, -a, 2 * sp.pi + a, 2 * sp.pi - a]
    classes = {
        sp.simplify(phase - 2 * sp.pi * shift)
        for phase, shift in zip(named, (0, 0, 1, 1), strict=True)
    }
    need(classes == {a, -a}, "the phases named are not two modulo 2π")
    return corrected(
        "modulo a period they are two, ±a/ω; the four are ±a/ω and (π ± a)/ω",
        "2π ± a and ±a are the same phases.",
    )


@claim("vzero-c", Kind.THEOREM, stated="for almost every datum, no zero-velocity event then")
def no_stop_at_a_tangency() -> Verdict:
    """For almost every initial datum the velocity does not vanish at a time with |F cos ωt| = f."""
    box = States("0.53", "-1.47", "0.01")
    orbits = box.follow(1)
    need(orbits.has("stick") and orbits.has("release"), "not all orbits stick", w=orbits.words)
    return refuted(
        "every rest in the interior ends at such a time, with v = 0; and the data that lead to a "
        f"rest are open: all from {box} do: {orbits.shown()}",
        "A box of states followed in balls. What is meant, that no velocity becomes zero then, is "
        "stops.tangential-touch-on-an-open-set.",
    )


@claim("rem:Lebtyp", Kind.THEOREM, stated="codimension-one submanifolds, hence a null set")
def tangential_touch_on_an_open_set() -> Verdict:
    """The data that lead to a tangential touch, v reaching 0 at a time with |F cos ωt| = f, form
    a countable union of codimension-one analytic submanifolds.
    """
    t = sp.Symbol("t", real=True)
    a = sp.atan(sp.pi / 2)
    ratio = 2 / sp.sqrt(4 + sp.pi**2)
    identity("cos a = 2/sqrt(4 + π²)", sp.cos(a), ratio)
    v = sp.sin(t) + sp.sin(a) - ratio * (t + a)  # released to the right at t = -a, F = ω = 1
    identity("v vanishes at π - a", v.subs(t, sp.pi - a))
    identity("where cos t = -f/F", sp.cos(sp.pi - a), -ratio)
    stroke = sp.integrate(v, (t, -a, sp.pi - a))
    identity("the stroke is 2f/ω²", stroke, 2 * ratio)
    with interval.workprec(80):
        value = enclosure(ratio)
    return refuted(
        f"not for f/F = 2/sqrt(4 + π²), in {between(value, 8)}: there every rest that ends to the "
        "right with room for a stroke of 2f/ω² is followed by v = 0 exactly when F cos ωt = -f, "
        "and the data that lead to such a rest are open",
        "v = sin t + sin a - (f/F)(t + a) vanishes at t = π - a if and only if tan a = π/2; "
        "symbolic identities; v increases until a and decreases from there, so it is positive "
        "before.",
        proof="setup.md#a-tangential-touch-for-an-open-set-of-data",
    )


@claim("lem:wall", Kind.THEOREM, stated="x < r just after a hit with x'(t*-) > 0")
def wall_reflection() -> Verdict:
    """After a hit with x'(t*-) > 0 the velocity is -x'(t*-), and x < r for a while."""
    u, b, t = symbols("u b t")
    away = u * t - b * t**2 / 2  # r - x is at least this, |x''| <= b
    identity("it is positive until 2u/b", sp.factor(away), t * (2 * u - b * t) / 2)
    return confirmed(
        "r - x >= u t - (F + f) t²/2 > 0 for 0 < t < 2u/(F + f), u the speed of the hit",
        "Taylor's formula with |x''| <= F + f.",
    )
