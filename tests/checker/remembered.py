"""What certificates that differ in their claims have in common, computed once: to test faster.

Every step of the checker stays as it is.
"""

import json
from collections.abc import Mapping
from contextlib import contextmanager
from functools import singledispatch
from types import FunctionType

from cap.checker.kernel import certificate
from cap.checker.one_one import falling, pairs
from cap.checker.particles import periodic_orbit
from cap.checker.particles.mechanics import Mechanics
from cap.checker.particles.neighbours import Neighbours
from cap.checker.system.model import Model
from cap.checker.system.polynomial import Polynomial
from checker.parts import Function, Interval, Jet, LossyMap, Pairs, PeriodMap, TaylorModel, home


@contextmanager
def orbits_computed_once():
    """Compute the orbits from a box once for equal maps, boxes and orders."""
    known, before = {}, {kind: kind.over for kind in (PeriodMap, LossyMap)}

    def remembered(computed):
        def over(phi, box, m, order):
            key = type(phi).__name__, *vars(phi).values(), box, m, order
            return _known(known, key, lambda: computed(phi, box, m, order))

        return over

    for kind, computed in before.items():
        kind.over = remembered(computed)
    yield
    for kind, computed in before.items():
        kind.over = computed


@contextmanager
def releases_computed_once():
    """Compute the release map over an interval once for equal systems, places and windows."""
    release_map, sheared, known = home("Attractor").Attractor, home("Sheared").Sheared, {}
    image, over, near = release_map.image, sheared.over, sheared.near

    def at(proof, *arguments):
        words, halves = proof.claims["itinerary"], proof.claims["half_periods"]
        return _known(known, (proof.p, words, halves, *arguments), lambda: image(proof, *arguments))

    def once(method):
        def computed(H, *arguments):
            key = (method.__name__, H, *arguments)
            return _known(known, key, lambda: method(H, *arguments))

        return computed

    release_map.image, sheared.over, sheared.near = at, once(over), once(near)
    yield
    release_map.image, sheared.over, sheared.near = image, over, near


def _known(known, key, compute):
    """Return what is known by the content of a key, or is computed now."""
    text = content(key)
    if text not in known:
        known[text] = compute()
    return known[text]


@contextmanager
def pairs_computed_once():
    """Compute pairs of (1,1) orbits, and their twists, once for equal jets of delta; and angles."""
    known, along = {}, Pairs.along
    branch = home("Branch")
    twist = branch.regularised_twist
    arccos = pairs.arccos

    def remembered_arccos(y):
        return _known(known, ("arccos", y), lambda: arccos(y))

    def remembered_along(at, delta):
        return _known(known, (at.rho, at.pi, delta), lambda: along(at, delta))

    def remembered_twist(at, pair):
        if id(pair) not in known:
            known[id(pair)] = twist(at, pair)
        return known[id(pair)]

    Pairs.along, branch.regularised_twist = remembered_along, remembered_twist
    pairs.arccos = falling.arccos = remembered_arccos
    yield
    Pairs.along, branch.regularised_twist = along, twist
    pairs.arccos = falling.arccos = arccos


@contextmanager
def impacts_computed_once():
    """Compute a bouncing ball's map once for equal functions, a passage once for equal starts."""
    theorem, passage, known = home("BallCurve"), home("Impact"), {}
    over, after = theorem.over, passage.after

    def image(a, flight, *K):
        return _known(known, (a, flight, *K), lambda: over(a, flight, *K))

    def end(a, start, unit):
        key = a, sorted(start.items()), unit
        return _known(known, key, lambda: after(a, start, unit))

    theorem.over, passage.after = image, end
    yield
    theorem.over, passage.after = over, after


@contextmanager
def legs_followed_once():
    """Follow the legs of a cell of orbits by contacts once for equal systems, cells and cuts."""
    theorem, known = home("ContactsBranch").ContactsBranch, {}
    quiet = theorem.quiet

    def once(proof, k, cell):
        given = proof.certificate.parameters, proof.claims["contacts"], proof.claims["periods"]
        hints = proof.hints["cuts"][k], proof.hints["bits"], proof.claims.get("symmetry")
        key = given, hints, *cell.line, cell.error
        return _known(known, key, lambda: quiet(proof, k, cell))

    theorem.quiet = once
    yield
    theorem.quiet = quiet


@contextmanager
def release_cells_proved_once():
    """Prove a cell of times of releases once for equal systems, cells, windows and limits."""
    theorem, known = home("ContactAttractor"), {}
    proved = theorem.cell

    def once(F, periods, ends, windows):
        system = F.model, F.contacts, F.bits, theorem.WORK
        return _known(
            known, (system, periods, ends, windows), lambda: proved(F, periods, ends, windows)
        )

    theorem.cell = once
    yield
    theorem.cell = proved


@contextmanager
def neighbours_followed_once():
    """Follow the orbits of two masses from a box once for equal masses, boxes and windows."""
    over, known = Neighbours.over, {}

    def once(near, itinerary, windows):
        states = [(q.centre, q.box, q.offsets) for q in near.states]
        key = near.M, near.order, states, itinerary, windows
        return _known(known, key, lambda: over(near, itinerary, windows))

    Neighbours.over = once
    yield
    Neighbours.over = over


@contextmanager
def hints_read_once():
    """Read equal hints once; they are the same object then."""
    known, matched = {}, certificate.matched

    def once(value, shape, where):
        if where != "hints":
            return matched(value, shape, where)
        key = json.dumps(value), *map(id, shape.values())
        if key not in known:
            known[key] = matched(value, shape, where)
        return known[key]

    certificate.matched = once
    yield
    certificate.matched = matched


@singledispatch
def content(value):
    """Return a text that tells values apart by what they contain."""
    text = repr(value)
    assert " at 0x" not in text, f"{text} is told apart by its address"
    return text


@content.register(tuple)
@content.register(list)
def _(several):
    return f"({', '.join(map(content, several))})"


@content.register
def _(pairs: Mapping):
    return f"{{{content(list(pairs.items()))}}}"


@content.register
def _(x: Interval):
    return f"{x.lo} {x.hi} {x.bits}"


@content.register
def _(jet: Jet):
    return f"jet {jet.order} {content(sorted(jet.coefficients.items()))}"


@content.register
def _(model: TaylorModel):
    return f"model {model.coefficients} {model.error} {model.bits}"


@content.register
def _(function: Function):
    circle = function.circle
    return f"function {function.coefficients} {function.error} {circle.rho} {circle.unit}"


@content.register
def _(q: Polynomial):
    return f"polynomial {sorted(q.terms.items())}"


@content.register
def _(system: Model):
    return content((system.state, system.omega, system.times_pi, system.modes))


@content.register
def _(masses: Mechanics):
    if type(masses) is Mechanics:  # all else is computed from these
        return content(("Mechanics", masses.p, masses.bits))
    return content((type(masses).__qualname__, vars(masses)))


@content.register
def _(function: FunctionType):
    cells = function.__closure__ or ()
    return content((function.__module__, function.__qualname__, [c.cell_contents for c in cells]))


@contextmanager
def contacts_computed_once():
    """Compute what is known of two masses' contacts once for equal arguments: Krawczyk's operator,
    least speeds, the monodromy, the map to third order."""
    zero, theorem = home("ZeroOfEvents"), home("Particles")
    known = {}
    places = [(zero, "krawczyk"), (periodic_orbit, "least_speeds"), (periodic_orbit, "monodromy")]
    places += [(theorem, name) for name in ("third_order", "in_complex_coordinates")]

    def remembered(function):
        def once(M, *arguments):
            key = (function.__name__, M.p, M.bits, content(arguments))
            if key not in known:
                known[key] = function(M, *arguments)
            return known[key]

        return once

    before = [getattr(*place) for place in places]
    for place, function in zip(places, before, strict=True):
        setattr(*place, remembered(function))
    yield
    for place, function in zip(places, before, strict=True):
        setattr(*place, function)
