"""Periodic orbits of one's own system: what the checker rejects, each time for its own reason."""

from __future__ import annotations

import math
import time
from fractions import Fraction
from itertools import product
from pathlib import Path

import pytest
from own_systems import certificate, rejected

from cap.certificate.writer import dumps
from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.contacts import Equations, krawczyk, return_map
from cap.checker.theorems.contacts import Contacts
from cap.checker.verdict import check, words

TINY = Fraction(1, 10**9)


def moved(text, by):
    """Return a number, moved."""
    return str(Fraction(text) + by)


def shifted(pair):
    """Return an enclosure, moved by its width."""
    a, b = map(Fraction, pair)
    return [str(b), str(2 * b - a)]


def stop_of(given):
    """Return the guard of the spring."""
    return given["parameters"]["modes"]["fly"]["guards"]["stop"]


def test_of_which_kind_it_is():
    """Of a system with a force in two dimensions the words name the kind."""
    stored = (Path(__file__).parents[2] / "certificates/contacts-1.json").read_bytes()
    assert "none on it (a sink, focus)" in words(read(stored))


# lies about the orbit


@pytest.mark.parametrize("kept", [0, 1, 2])
def test_cuts_dropped(kept):
    """Without most of its cuts a leg is not shown to be quiet."""
    given = certificate("spring")
    del given["hints"]["cuts"][0]["stop"][kept:]
    rejected(given, "a guard|a piece of a flight is too long")


def test_a_cut_moved_behind_the_next():
    """Cuts are in order."""
    given = certificate("spring")
    cuts = given["hints"]["cuts"][0]["stop"]
    cuts[0], cuts[1] = cuts[1], cuts[0]
    rejected(given, "the cuts of a leg are not in order")


def least_x():
    """Return the least x of the spring between two hits, in floats, by Runge and Kutta."""
    t, x, v = map(float, certificate("spring")["hints"]["centre"][0])
    v, least, omega = -0.9 * v, x, 2.7
    steps = 4000
    d = 2 * math.pi / omega / steps

    def rate(t, x, v):
        return v, math.cos(omega * t) - x - v / 10

    for _ in range(steps):
        a = rate(t, x, v)
        b = rate(t + d / 2, x + d / 2 * a[0], v + d / 2 * a[1])
        c = rate(t + d / 2, x + d / 2 * b[0], v + d / 2 * b[1])
        e = rate(t + d, x + d * c[0], v + d * c[1])
        slopes = zip((x, v), a, b, c, e, strict=True)
        x, v = (z + d / 6 * (p + 2 * q + 2 * r + s) for z, p, q, r, s in slopes)
        t, least = t + d, min(least, x)
    return Fraction(least)


@pytest.mark.parametrize(
    ("above", "pieces", "reason"),
    [
        (-Fraction(1, 10**4), 900, ""),
        (Fraction(1, 10**4), 900, "a guard may vanish near"),
        (Fraction(1, 10**4), 16, "a guard may vanish near"),
        (-Fraction(1, 100), 200, ""),
    ],
)
def test_a_dip_is_seen_at_any_cuts(above, pieces, reason):
    """A guard x > c, c close to the least x: pieces that are too wide prove nothing."""
    given = certificate("spring")
    floor = Fraction(round((least_x() + above) * 10**12), 10**12)
    guards = given["parameters"]["modes"]["fly"]["guards"]
    guards["floor"] = {"value": [["1", "x"], [str(-floor)]], "reset": {}, "to": ["fly"]}
    start = Fraction(given["hints"]["centre"][0][0])
    times = [start + Fraction("2.327105669") * k / pieces for k in range(1, pieces)]
    given["hints"]["cuts"][0]["floor"] = [str(t) for t in times]
    if reason:
        rejected(given, reason)
    else:
        check(dumps(given).encode(), lambda _: None)


def test_legs_swapped():
    """The contacts are in the order of the orbit."""
    given = certificate("elliptic")
    given["claims"]["contacts"].reverse()
    given["hints"]["cuts"].reverse()
    rejected(given, "K does not lie in the interior of its box")


@pytest.mark.parametrize("by", [TINY, -TINY])
def test_another_restitution(by):
    """A loss that differs by 1e-9 has another orbit."""
    given = certificate("spring")
    stop_of(given)["reset"]["v"] = [[moved("-9/10", by), "v"]]
    rejected(given, "K does not lie in the interior of its box")


def test_another_frequency_and_field():
    """And so has another frequency, or a force that differs by 1e-9."""
    given = certificate("spring")
    given["parameters"]["omega"] = moved("27/10", TINY)
    rejected(given, "K does not lie in the interior of its box")
    given = certificate("spring")
    given["parameters"]["modes"]["fly"]["field"]["v"].append([str(TINY)])
    rejected(given, "K does not lie in the interior of its box")


def test_a_guard_left_out():
    """Of a contact, or of the cuts."""
    given = certificate("elliptic")
    del given["parameters"]["modes"]["right"]["guards"]["wall"]
    rejected(given, "contact 1: there is no guard wall of a mode right")
    given = certificate("elliptic")
    del given["parameters"]["modes"]["right"]["guards"]["stop"]
    rejected(given, "leg 2: cuts of a guard that its mode has not")
    given = certificate("elliptic")
    del given["hints"]["cuts"][0]["stop"]
    rejected(given, "leg 1: no cuts, and no Lemma M, for wall")


def test_a_guard_added():
    """What the orbit meets on its way is seen: a second stop, before the first."""
    given = certificate("spring")
    guards = given["parameters"]["modes"]["fly"]["guards"]
    guards["near"] = {**guards["stop"], "value": [["1/20"], ["-1", "x"]]}
    given["hints"]["cuts"][0]["near"] = given["hints"]["cuts"][0]["stop"]
    rejected(given, "a guard may vanish near")


@pytest.mark.parametrize("value", [[["1/10"], ["-1", "x"]], [["1", "v"]], [["-1", "x"], ["1/10"]]])
def test_guards_that_vanish_at_the_end_or_are_negative_at_the_start(value):
    """Two at once at a contact; and a mode after it in which the system cannot be."""
    given = certificate("spring")
    guards = given["parameters"]["modes"]["fly"]["guards"]
    guards["other"] = {**guards["stop"], "value": value}
    given["hints"]["cuts"][0]["other"] = given["hints"]["cuts"][0]["stop"]
    rejected(given, "a guard may vanish")


def test_the_other_sign_of_a_guard():
    """The equations are the same, but the orbit is where the guard is negative."""
    given = certificate("spring")
    stop_of(given)["value"] = [["-1/10"], ["1", "x"]]
    for row in given["hints"]["preconditioner"]:
        row[0] = str(-int(row[0]))
    rejected(given, "a guard may vanish")


def test_another_itinerary():
    """The contacts are those of the system, and each begins in the mode that the last one left."""
    given = certificate("elliptic")
    given["claims"]["contacts"][0]["to"] = "right"
    rejected(given, "contact 1: wall does not lead to the mode right")
    given = certificate("elliptic")
    given["claims"]["contacts"][1] = dict(given["claims"]["contacts"][0])
    rejected(given, "contact 1: the next contact is in another mode than left")
    given = certificate("elliptic")
    given["parameters"]["modes"]["right"]["guards"]["wall"]["to"] = ["right"]
    given["claims"]["contacts"][0]["to"] = "right"
    rejected(given, "contact 1: the next contact|contact 2: the next contact")
    given = certificate("spring")
    given["claims"]["periods"] = "2"
    rejected(given, "K does not lie in the interior of its box")


def test_the_centre_moved():
    """A point that is not in the box; and a box that is elsewhere."""
    given = certificate("spring")
    given["hints"]["centre"][0][2] = moved(given["hints"]["centre"][0][2], TINY)
    rejected(given, "the centre is not in the box")
    given["claims"]["box"][0][2] = [moved(q, 2 * TINY) for q in given["claims"]["box"][0][2]]
    rejected(given, "the centre is not in the box")


@pytest.mark.parametrize("side", [1, -1])
def test_the_zero_is_kept(side):
    """From a centre that is wrong by 1e-4, in a box that reaches but to one side of it."""
    theorem = proved("spring")
    truth = [c for place in theorem.hints["centre"] for c in place]
    off, far, near = Fraction(1, 10**4), Fraction(2, 10**4), Fraction(1, 10**7)
    centre = [c + side * off for c in truth]
    sides = [(c - far, c + near) if side > 0 else (c - near, c + far) for c in centre]
    K = krawczyk(theorem.equations, sides, centre, theorem.hints["preconditioner"])
    for z, c in zip(K, truth, strict=True):
        assert z.lower <= c <= z.upper
        assert z.upper - z.lower < Fraction(1, 10**6)


def test_a_centre_outside_of_its_region():
    """The operator itself refuses it, for S has its centre inside."""
    theorem = proved("spring")
    sides = [(Fraction(0), Fraction(1, 100))] * 3
    with pytest.raises(Rejected, match="the centre is not in the box"):
        krawczyk(theorem.equations, sides, [Fraction(1)] * 3, [[0] * 3] * 3)


def test_a_box_that_is_too_large():
    """Uniqueness is claimed for the box, and so is proved for all of it."""
    given = certificate("spring")
    centre, wide = given["hints"]["centre"][0], Fraction(1, 8)
    given["claims"]["box"] = [[[moved(c, -wide), moved(c, wide)] for c in centre]]
    rejected(given, "K does not lie in the interior of its box")


@pytest.mark.parametrize("name", ["times", "states", "symmetric"])
def test_claims_shifted(name):
    """Each claim, moved by its width, does not contain what is computed; or is too wide."""
    given = certificate("spring")
    count = len(given["claims"][name]) if name != "states" else 2
    for k in range(count):
        given = certificate("spring")
        claims = given["claims"][name] if name != "states" else given["claims"][name][0]
        claims[k] = shifted(claims[k])
        rejected(given, "does not contain the enclosure computed")
        claims[k] = ["-10", "10"]
        rejected(given, "is wider than its digits allow")


def test_another_preconditioner():
    """C need not be trusted: none, or another one, proves nothing."""
    given = certificate("spring")
    given["hints"]["preconditioner"] = [["0"] * 3] * 3
    rejected(given, "K does not lie in the interior of its box")
    given["hints"]["preconditioner"][0][0] = "1/2"
    rejected(given, "is not an integer of at most 40 digits")
    given["hints"]["preconditioner"] = [["1" + "0" * 39] * 3] * 3
    rejected(given, "K does not lie in the interior of its box")


# steps that no certificate reaches alone


def proved(name):
    """Return a theorem after its proof."""
    theorem = Contacts(read(dumps(certificate(name)).encode()), lambda _: None)
    theorem.prove()
    return theorem


def test_contacts_out_of_order():
    """A leg that ends before it begins is none."""
    theorem = proved("elliptic")
    zero = theorem.zero()
    zero[0], zero[3] = zero[3], zero[0]
    with pytest.raises(Rejected, match="leg 1: the contacts are not in order"):
        theorem.nothing_else(zero, theorem.equations.steps(zero), theorem.hints["cuts"])


def test_a_graze():
    """Where it is not certain that a guard falls, there is no return map."""
    theorem = proved("spring")
    equations: Equations = theorem.equations
    t, x, _ = theorem.zero()
    slow = Interval.enclosing(-10, 10, equations.bits)
    with pytest.raises(Rejected, match="a guard may not be crossed: a graze"):
        return_map(equations.steps([t, x, slow]), equations.n)


# sizes


def test_sizes():
    """As many of everything as there are contacts and unknowns; and not too many."""
    for kind, name in (
        ("hints", "centre"),
        ("hints", "cuts"),
        ("claims", "box"),
        ("claims", "times"),
        ("claims", "states"),
    ):
        given = certificate("elliptic")
        given[kind][name].pop()
        rejected(given, f"{kind}.{name} is not a list of 2")
    given = certificate("elliptic")
    given["hints"]["centre"][0].pop()
    rejected(given, "the unknowns are not as many everywhere")
    given = certificate("elliptic")
    given["hints"]["preconditioner"][0].pop()
    rejected(given, "the unknowns are not as many everywhere")
    given = certificate("elliptic")
    given["hints"]["preconditioner"] = [["1"] * 4] * 4
    rejected(given, "hints.preconditioner has not 6 rows")
    given = certificate("elliptic")
    for table in (given["hints"]["centre"], given["claims"]["box"]):
        for row in table:
            row.append(row[-1])
    given["hints"]["preconditioner"] = [["1"] * 8] * 8
    rejected(given, "there are not 6 unknowns")
    given = certificate("elliptic")
    given["claims"]["symmetric"].pop()
    rejected(given, "symmetric is not a list of 2")


def test_limits():
    """Bits and cuts are bounded, and flights not too long for their exponential."""
    given = certificate("spring")
    given["hints"]["bits"] = "1025"
    rejected(given, "more than 1024 bits")
    given = certificate("elliptic")
    given["hints"]["bits"] = "1000"
    given["hints"]["cuts"] = [{f"g{k}": [str(k)] * 999 for k in range(2)}] * 2
    rejected(given, "bits x variables x pieces of legs are more than 2")
    given = certificate("spring")
    given["parameters"]["modes"]["fly"]["field"]["v"] = [["-1000", "x"]]
    rejected(given, "a flight is too long for an exponential")


# hostile systems

HOSTILE = {
    "a frequency of 0": (lambda p: p.update(omega="0"), "omega is not between"),
    "a huge frequency": (lambda p: p.update(omega="1" + "0" * 31), "omega is not between"),
    "an exponent": (lambda p: p.update(omega="1e9"), "omega is not a number of the format"),
    "a power": (lambda p: p.update(omega="9**9**9"), "omega is not a number of the format"),
    "an unknown field": (lambda p: p.update(code="1"), "parameters has missing or unknown fields"),
    "one name twice": (lambda p: p.update(state=["x", "x"]), "two variables of the state have one"),
    "nine variables": (
        lambda p: p.update(state=list("abcdefghi")),
        "state is not a list of 1 to 8",
    ),
    "the name of code": (lambda p: p.update(state=["__import__"]), "has a name that is none"),
    "no variable": (lambda p: p.update(state=["x", "1"]), "1 is not a name of a variable"),
    "a sentence": (lambda p: p.update(state=["x", "x y"]), "x y is not a name of a variable"),
    "the name of the clock": (lambda p: p.update(state=["x", "cos"]), "cos is not a free name"),
    "no modes": (lambda p: p.update(modes=[]), "modes is not an object with at most 64 names"),
    "a quoted mode": (lambda p: p["modes"].update({"a'b": {}}), "has a name that is none"),
    "a long name": (lambda p: p["modes"].update({"a" * 41: {}}), "has a name that is none"),
    "65 modes": (
        lambda p: p["modes"].update({str(k): {} for k in range(65)}),
        "modes is not an object with at most 64 names",
    ),
    "no rate": (lambda p: p["modes"]["fly"]["field"].pop("v"), "does not give the rate of each"),
}


def rate(terms):
    """Return what gives the velocity another rate."""
    return lambda p: p["modes"]["fly"]["field"].update(v=terms)


def stop(**parts):
    """Return what changes the guard."""
    return lambda p: p["modes"]["fly"]["guards"]["stop"].update(parts)


HOSTILE |= {
    "a field that is not linear": (rate([["1", "x", "v"]]), "v' in the mode fly is not linear"),
    "a product with the clock": (rate([["1", "x", "cos"]]), "v' in the mode fly is not linear"),
    "a guard of a high degree": (
        stop(value=[["1"], ["1", *"xxvv"]]),
        "the guard stop of the mode fly has a degree above 3",
    ),
    "a high power": (rate([["1", *"xxxxxxx"]]), "is not a list of 1 to 7"),
    "many terms": (rate([["1", "x"]] * 41), "is not a list of 0 to 40"),
    "a monomial twice": (rate([["1", "x"], ["1", "x"]]), "has a monomial twice"),
    "an unknown variable": (rate([["1", "os.system"]]), "has an unknown variable"),
    "the number pi in a constant force": (rate([["1", "pi"]]), "has pi where its flights need"),
    "pi in a spring": (rate([["-1", "pi", "x"]]), "has pi where its flights need"),
    "pi as a variable": (lambda p: p.update(state=["x", "pi"]), "pi is not a free name"),
    "half of pi": (lambda p: p.update(times_pi="1/2"), "times_pi is none of: 1"),
    "no number": (rate([["x"]]), "is not a number of the format"),
    "an empty term": (rate([[]]), "is not a list of 1 to 7"),
    "a huge number": (rate([["1" + "0" * 31]]), "a number that is not between"),
    "a tiny number": (rate([["1/1" + "0" * 31]]), "a number that is not between"),
    "a long denominator": (rate([["1" + "0" * 30 + "/1" + "0" * 29 + "17"]]), "not between"),
    "denominators without a common one": (
        rate([[f"1/{10**30 - 1}"], [f"1/{10**30 - 3}", "x"], [f"1/{10**30 - 7}", "v"]]),
        "the mode fly has a common denominator above 10",
    ),
    "a constant guard": (stop(value=[["1"]]), "the guard stop of the mode fly is constant"),
    "an unknown reset": (stop(reset={"y": []}), "resets what is no variable of the state"),
    "a divisor 0": (stop(divisor=[]), "the divisor of the guard stop of the mode fly is 0"),
    "a divisor that vanishes": (
        stop(divisor=[["1"], ["-10", "x"]], reset={"v": [["1", "v"]]}),
        "division by an interval that contains zero|does not lie in the interior",
    ),
    "an unknown mode": (stop(to=["fly", "roof"]), "leads to an unknown mode"),
    "a mode twice": (stop(to=["fly", "fly"]), "leads to a mode twice"),
    "nowhere to go": (stop(to=[]), "to is not a list of 1 to 64"),
    "an unknown mode of rest": (stop(rest="roof"), "rests in an unknown mode"),
    "a field that a guard has not": (stop(then="fly"), "has missing or unknown fields"),
    "nested": (stop(value=[[[["1"]]]]), "is not a string"),
}


@pytest.mark.parametrize("what", HOSTILE)
def test_hostile_systems(what):
    """Each is rejected for its own reason, and nothing in it is run."""
    change, reason = HOSTILE[what]
    given = certificate("spring")
    change(given["parameters"])
    rejected(given, reason)


def test_work_is_bounded():
    """Resets and a divisor with as many terms as there may be: rejected at once."""
    given = certificate("spring")
    factors = (
        [*a, *b] for a in product("xv", repeat=3) for b in product(("cos", "sin", "pi"), repeat=3)
    )
    monomials = sorted({tuple(sorted(f)) for f in factors})[:40]
    terms = [[f"1/{10**6 + k}", *m] for k, m in enumerate(monomials)]
    assert len(terms) == 40
    stop(value=[["1/10", "x", "x", "x"], ["-1", "x", "v", "v"]])(given["parameters"])
    stop(reset={"v": terms, "x": terms}, divisor=[["1"], *terms[1:]])(given["parameters"])
    began = time.process_time()
    rejected(given, "the interior of its box|contains zero|may vanish|is not in")
    assert time.process_time() - began < 2


def test_deep_nesting():
    """A system of a thousand lists in each other is none."""
    given = certificate("spring")
    text = dumps(given).replace('"27/10"', "[" * 1000 + "]" * 1000)
    with pytest.raises(Rejected, match="recursion"):
        check(text.encode(), lambda _: None)


def test_a_choice_of_modes():
    """A ball that may also rest at a contact need not stay near the orbit; else it attracts."""
    given = certificate("ball")
    del given["claims"]["basin"], given["hints"]["reach"]
    assert words(check(dumps(given).encode(), lambda _: None)).endswith("; it attracts")
    modes = given["parameters"]["modes"]
    modes["fly"]["guards"]["table"]["to"].append("rest")
    rejected(given, "another mode may be open")
    leave = modes["rest"]["guards"]["leave"]
    leave["value"] = [["1", "sin"], ["-1"]]
    check(dumps(given).encode(), lambda _: None)
    leave["value"] = [["1", "y"], ["-6/5", "sin"], ["0.000000000000000001", "cos"]]
    rejected(given, "another mode may be open")
    leave["value"] = modes["fly"]["guards"]["table"]["value"]
    rejected(given, "another mode may be open")
    given["claims"].pop("unstable")
    check(dumps(given).encode(), lambda _: None)


@pytest.mark.parametrize("count", ["0", "2"])
def test_another_stability(count):
    """The orbit of the spring is a saddle."""
    given = certificate("spring")
    assert given["claims"]["unstable"] == "1"
    given["claims"]["unstable"] = count
    rejected(given, "claims.unstable is not certain")
    given["claims"]["radius"] = "1.5"
    rejected(given, "claims.unstable is not certain")


def circled():
    """Return the certificate of `elliptic` with its multipliers counted outside a circle."""
    given = certificate("elliptic")
    assert given["claims"].pop("kind") == "elliptic"
    given["claims"] |= {"unstable": "0", "radius": "1.000001"}
    return given


@pytest.mark.parametrize("radius", ["", "1.000000000001", "0.9", "2.1", "3"])
def test_multipliers_on_the_circle(radius):
    """Those of an area-preserving orbit lie on the unit circle: another circle is needed."""
    given = circled()
    check(dumps(given).encode(), lambda _: None)
    del given["claims"]["radius"]
    if radius:
        given["claims"]["radius"] = radius
    if radius != "1.000000000001":
        rejected(given, "claims.unstable is not certain|claims.radius is not between 1 and 2")
    given["claims"].pop("unstable")
    given["claims"]["radius"] = "1.1"
    rejected(given, "claims.radius is one of nothing")
