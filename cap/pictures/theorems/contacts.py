"""A periodic orbit of a system of one's own: its contacts, and its flights between them.

Each contact is proved, and drawn where the certificate has it.  The curves between them are the
flights of the certificate's own system, in floats.
"""

import math
from fractions import Fraction

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cap.checker.kernel.decimals import decimal
from cap.checker.system.model import COS, PI, SIN, Model
from cap.checker.system.polynomial import Polynomial
from cap.checker.theorems.contact_elliptic import ContactElliptic
from cap.checker.theorems.contacts import Contacts
from cap.checker.theorems.contacts_family import ContactsFamily
from cap.floats.findings import Floats
from cap.pictures.style import BLACK, CYCLE, GREY, RED, legend
from cap.pictures.theorems.parts import middle, number
from cap.pictures.times import mark

SHOWN, SAMPLES, FAMILY = 4, 400, 7  # variables, states of a flight, orbits of a family
MARKERS = "ov^sD<>hp"
TERMS, HALVINGS = 20, 10  # of an exponential


def contacts(theorem: Contacts, figure: Figure) -> None:
    """Draw each variable over the time, and the first two in a plane."""
    claims, p = theorem.claims, theorem.p
    states = np.array([[middle(q) for q in state] for state in claims["states"]])
    begin, end = times(theorem)
    axes, shown, other = _panels(p, figure)
    for k, contact in enumerate(claims["contacts"]):
        t = np.linspace(begin[k], end[k], SAMPLES)
        path = flight(p, contact["to"], t, states[(k + 1) % len(states)])
        for i, z in enumerate(shown):
            axes[z].plot(t, path[:, i], color=BLACK, lw=0.9)
        axes["plane"].plot(path[:, 0], path[:, other], color=BLACK, lw=0.8)
        for z, place in _walls(p, contact["to"], t):
            axes[z].plot(t, place, color=GREY, lw=0.8)
    guards = np.array([contact["guard"] for contact in claims["contacts"]])
    for n, word in enumerate(dict.fromkeys(guards.tolist())):
        own = guards == word
        for i, z in enumerate(shown):
            _mark(axes[z], np.roll(end, 1)[own], states[own, i], n, f"{word} (proved)")
        _mark(axes["plane"], states[own, 0], states[own, other], n, "_")
    legend(axes[shown[0]], figure)
    figure.suptitle(_words(theorem), fontsize=10)


def elliptic(theorem: ContactElliptic, figure: Figure) -> None:
    """Draw the same, with the fixed point of the map, where the twist is known."""
    contacts(theorem, figure)
    claims = theorem.claims
    plane = next(axes for axes in figure.axes if axes.get_xlabel() == theorem.p.state[0])
    x, v = (middle(q) for q in claims["point"])
    plane.plot(
        x, v, "*", color=RED, ms=9, ls="none", label=f"at t = {float(claims['phase']):g} (proved)"
    )
    plane.legend(loc="best", fontsize=8)
    figure.suptitle(
        "An elliptic periodic orbit, with invariant curves around it  (the certificate is "
        f"VERIFIED)\nrotation number {number(claims['rotation_number'])}, twist "
        f"{number(claims['twist'])}",
        fontsize=10,
    )


def family(theorem: ContactsFamily, figure: Figure) -> None:
    """Draw some orbits of a family over the time, and in a plane."""
    claims, p = theorem.claims, theorem.p
    quarter = math.pi / (2 * float(p.omega))
    begin = quarter * np.array(claims["quarters"])
    end = np.append(begin[1:], begin[0] + 4 * quarter * claims["periods"])
    axes, shown, other = _panels(p, figure)
    low, high = claims["range"]
    values = np.linspace(float(low), float(high), FAMILY)
    for c, colour in zip(values, CYCLE, strict=False):
        states = np.array([[float(z.a + z.b * Fraction(c)) for z in q] for q in theorem.lines])
        for k, contact in enumerate(claims["contacts"]):
            t = np.linspace(begin[k], end[k], SAMPLES)
            path = flight(p, contact["to"], t, states[(k + 1) % len(states)])
            label = f"c = {c:.6g}" if not k else "_"
            for i, z in enumerate(shown):
                axes[z].plot(t, path[:, i], color=colour, lw=0.9, label=label)
            axes["plane"].plot(path[:, 0], path[:, other], color=colour, lw=0.8)
    legend(axes[shown[0]], figure)
    figure.suptitle(
        "Some orbits (floats) of a family, one for each c "
        f"from {decimal(low)} to {decimal(high)} (proved)\n"
        "(the certificate is VERIFIED)",
        fontsize=10,
    )


def _panels(p: Model, figure: Figure) -> tuple[dict[str, Axes], tuple[str, ...], int]:
    """Return axes for some variables over the time, these, and which is shown with the first."""
    shown, other = p.state[:SHOWN], min(1, len(p.state) - 1)
    axes = figure.subplot_mosaic([[z, "plane"] for z in shown], width_ratios=[1.4, 1])
    for z in shown:
        axes[z].set_ylabel(z)
    axes[shown[-1]].set_xlabel("time $t$")
    axes["plane"].set(xlabel=shown[0], ylabel=shown[other])
    return axes, shown, other


def times(theorem: Contacts) -> tuple[Floats, Floats]:
    """Return the times of all contacts, and those of the contacts after them.

    Without a clock the first contact is at 0, and what is claimed of it is the period.
    """
    claimed = np.array([middle(q) for q in theorem.claims["times"]])
    if theorem.p.autonomous:
        return np.append(0.0, claimed[1:]), np.roll(claimed, -1)
    period = 2 * math.pi * theorem.claims["periods"] / float(value(theorem.p.frequency, {}))
    return claimed, np.append(claimed[1:], claimed[0] + period)


def _mark(axes: Axes, x: Floats, y: Floats, n: int, words: str) -> None:
    mark(axes, (x, y), (MARKERS[n % len(MARKERS)], CYCLE[n % len(CYCLE)]), words)


def _words(theorem: Contacts) -> str:
    """Return what is proved, in two lines."""
    claims = theorem.claims
    count, periods = len(claims["contacts"]), claims["periods"]
    told = [f"{count} contact{'s' * (count > 1)}"]
    told += [] if theorem.p.autonomous else [f"{periods} period{'s' * (periods > 1)} of the clock"]
    told += [claims["kind"]] if "kind" in claims else []
    if "unstable" in claims:
        circle = "" if "radius" not in claims else f" of radius {float(claims['radius']):g}"
        told += [f"{claims['unstable']} multipliers outside the unit circle"]
        told[-1] = told[-1].replace(" unit circle", f" circle{circle}") if circle else told[-1]
    product = number(claims["symmetric"][-1])
    return (
        f"A periodic orbit: {', '.join(told)}  (the certificate is VERIFIED)\n"
        f"product of the multipliers {product}"
    )


def flight(p: Model, mode: str, t: Floats, end: Floats) -> Floats:
    """Return the states (K, n) at times of the flight in a mode that is at ``end`` at the last."""
    names = [*p.state, COS, SIN, ""]
    w = value(p.frequency, {})
    n = len(p.state)
    A = np.zeros((n + 3, n + 3))
    A[n, n + 1], A[n + 1, n] = -w, w
    for i, z in enumerate(p.state):
        for monomial, c in p.modes[mode].field[z].terms.items():
            variables = [name for name in monomial if name != PI]
            factor = float(c) * math.pi ** (len(monomial) - len(variables))
            A[i, names.index(variables[0] if variables else "")] += factor
    last = np.array([*end, math.cos(w * t[-1]), math.sin(w * t[-1]), 1.0])
    back = exponential(A * (t[0] - t[-1]) / (len(t) - 1))
    path = [last]
    for _ in t[1:]:
        path.append(back @ path[-1])
    return np.array(path[::-1])[:, : len(p.state)]


def exponential(M: Floats) -> Floats:
    """Return exp(M), by its series and squaring."""
    small, total, term = M / 2**HALVINGS, np.eye(len(M)), np.eye(len(M))
    for n in range(1, TERMS + 1):
        term = term @ small / n
        total = total + term
    return np.asarray(np.linalg.matrix_power(total, 2**HALVINGS))


def _walls(p: Model, mode: str, t: Floats) -> list[tuple[str, Floats]]:
    """Return where guards of a mode vanish that are about one variable of the state and the clock:
    its name and its place over the time."""
    w, found = value(p.frequency, {}), []
    clock = {COS: np.cos(w * t), SIN: np.sin(w * t)}
    for guard in p.modes[mode].guards.values():
        h = guard.value
        own = [z for z in p.state[:SHOWN] if z in h.variables]
        if len(own) == 1 and not h.derivative(own[0]).variables.difference((PI,)):
            z = own[0]
            rest = value(h - _times(h.derivative(z), z), clock)
            found.append((z, np.broadcast_to(-rest / value(h.derivative(z), {}), t.shape)))
    return found


def _times(q: Polynomial, z: str) -> Polynomial:
    return Polynomial({tuple(sorted((*monomial, z))): c for monomial, c in q.terms.items()})


def value(q: Polynomial, values: dict[str, Floats]) -> Floats:
    """Return the value of a polynomial."""
    known, total = {PI: np.array(math.pi), **values}, np.array(0.0)
    for monomial, c in q.terms.items():
        term = np.array(float(c))
        for name in monomial:
            term = term * known[name]
        total = total + term
    return total
