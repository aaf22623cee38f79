"""The derivative and the jet of order 3 of the period map of N masses, at t = 0.

Order of the coordinates: (x_1, .., x_N, v_1, .., v_N).  The force does not depend on the state, so
a flight of duration d is affine: x_i -> x_i + d v_i for deviations.  All that is not linear is in
the events, each taken at its nominal time t.  A deviation (ξ, η) of the state just before it has
its event at t + σ, where

    n · (ξ + (v + η)σ + a⁻ σ²/2 + a' σ³/6) = 0,

v the nominal velocities before, n the normal of the contact, a⁻ the accelerations before, a⁺ those
after.  The contact changes the velocities by C, and the flights with a⁺ back to the time t give

    η⁺ = C (η + a⁻σ + a'σ²/2 + a''σ³/6) - (a⁺σ + a'σ²/2 + a''σ³/6),
    ξ⁺ = ξ + (v + η - C v - η⁺) σ + (a⁻ - a⁺) σ²/2.

Here (v - C v) σ = p (n · v) σ if C = 1 - p nᵀ, and (n · v) σ begins with -n · ξ exactly.  Friction
is constant on flights, so a' and a'' are those of the forcing.  To first order this is the
saltation matrix ((C, 0), (K, C)), K = (a⁺ - C a⁻) nᵀ/(n · v).
"""

from collections.abc import Sequence

from cap.particles.model import Event, Leg, Model, legs_of
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet

ORDER = 3
Rows = list[list[Ball]]


def state(model: Model, events: Sequence[Event]) -> tuple[list[Ball], list[Ball]]:
    """Return the positions and velocities at t = 0, of the flights that end in the first event."""
    o, end = model.first, events[0]
    last = legs_of(model, events)[-1]
    begin = o.moment(interval.ZERO)
    launched = [
        each.launch(s, end.at, x, v)
        for each, s, x, v in zip(model.oscillators, last.signs, end.x, end.before, strict=True)
    ]
    pairs = list(zip(model.oscillators, launched, strict=True))
    return [o.position(g, begin) for o, g in pairs], [o.velocity(g, begin) for o, g in pairs]


def monodromy(model: Model, events: Sequence[Event]) -> Rows:
    """Return the derivative of the period map at t = 0."""
    jets = jet(model, events, 1)
    size = 2 * model.n
    return [[each.coefficients[1 + j] for j in range(size)] for each in jets]


def jet(model: Model, events: Sequence[Event], order: int = ORDER) -> list[Jet]:
    """Return jets, in the deviation at t = 0, of the deviation a period later.

    ``events`` enclose the orbit, which is verified; order 1 to 3.
    """
    n, legs = model.n, legs_of(model, events)
    deviation = list(Jet.variables([interval.ZERO] * (2 * n), order))
    deviation = _drift(deviation, events[0].at.t)
    for before, leg in zip([legs[-1], *legs[:-1]], legs, strict=True):
        deviation = _event(before, leg, deviation)
        rest = leg.duration if leg is not legs[-1] else model.first.T - leg.start.at.t
        deviation = _drift(deviation, rest)
    return deviation


def _drift(deviation: list[Jet], duration: Ball) -> list[Jet]:
    n = len(deviation) // 2
    x, v = deviation[:n], deviation[n:]
    return [a + b * duration for a, b in zip(x, v, strict=True)] + v


def _event(before: Leg, leg: Leg, deviation: list[Jet]) -> list[Jet]:
    """Return the deviation just after an event, between two legs, from that just before it."""
    model, event, n = leg.model, leg.start, leg.model.n
    a = before.accelerations(event.at)
    b = leg.accelerations(event.at)
    xi, eta = deviation[:n], deviation[n:]
    rate, way = _way(model, event, a, xi, eta)
    sigma = way / rate
    forced = _forced(model, event, sigma)
    changed = [e + s * sigma + w for e, s, w in zip(eta, a, forced, strict=True)]
    eta_after = [
        _combination(row, changed) - (b[i] * sigma + forced[i])
        for i, row in enumerate(model.rules[event.contact])
    ]
    square, push = sigma * sigma, model.pushes[event.contact]
    xi_after = [
        xi[i]
        + way * push[i]
        + (eta[i] - eta_after[i]).above(0) * sigma
        + square * ((a[i] - b[i]) / 2)
        for i in range(n)
    ]
    return [q.above(0) for q in (*xi_after, *eta_after)]


def _way(
    model: Model, event: Event, a: list[Ball], xi: list[Jet], eta: list[Jet]
) -> tuple[Ball, Jet]:
    """Return n · v and (n · v) σ: each round of the iteration is right to one more order."""
    used = [(i, k) for i, k in enumerate(model.normal(event.contact)) if k]
    rate = _along(used, event.before)
    pull = _along(used, a)
    bend = _along(used, [_jerk(model, i, event) for i in range(model.n)])
    normal = [k for _, k in used]
    gap, closing = (_combination(normal, [q[i] for i, _ in used]) for q in (xi, eta))
    way = -gap
    for _ in range(way.space.order - 1):
        sigma = way / rate
        square = sigma * sigma
        way = -(gap + closing * sigma + square * (pull / 2) + square * sigma * (bend / 6))
    return rate, way


def _along(used: Sequence[tuple[int, int]], vector: Sequence[Ball]) -> Ball:
    return interval.total(k * vector[i] for i, k in used)


def _jerk(model: Model, i: int, event: Event) -> Ball:
    """Return the derivative of the acceleration, -Fω sin ωt/m."""
    o = model.oscillators[i]
    return Ball(-o.F * o.omega * event.at.sin)


def _forced(model: Model, event: Event, sigma: Jet) -> list[Jet]:
    """Return a'σ²/2 + a''σ³/6 of all masses."""
    square = sigma * sigma
    cube = square * sigma
    result = []
    for i, o in enumerate(model.oscillators):
        second = -o.omega * o.omega * o.forcing(event.at)
        result.append(square * (_jerk(model, i, event) / 2) + cube * (second / 6))
    return result


def _combination(row: Sequence[Ball | int], jets: Sequence[Jet]) -> Jet:
    total = jets[0] * row[0]
    for c, q in zip(row[1:], jets[1:], strict=True):
        total = total + q * c
    return total


def symplectic_defect(model: Model, D: Rows) -> list[Ball]:
    """Return the entries of Dᵀ J D - J above the diagonal, J the form Σ m_i dv_i ∧ dx_i."""
    n, m = model.n, [interval.ball(q) for q in model.masses]
    size = 2 * n
    return [
        interval.total(m[k] * (D[n + k][i] * D[k][j] - D[k][i] * D[n + k][j]) for k in range(n))
        - (-m[i] if j == n + i else 0)
        for i in range(size)
        for j in range(i + 1, size)
    ]
