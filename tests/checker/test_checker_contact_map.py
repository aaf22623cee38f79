"""The map from contact to contact: enclosures against another integration, and what is no map."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import chain, pairwise
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cap.checker.coverings import contact_map
from cap.checker.coverings.contact_map import ContactMap, Section, double, interval
from cap.checker.kernel.doubles import Double, between
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from checker.altered import changed
from checker.contacts_of_a_ball import ball, read, system

LONG = [Fraction(30)]


def mapped(model, middle=0, times=LONG, budget=10**6):
    """Return the map of the contacts of the ball with the table."""
    return ContactMap(Section(model, "fly", "table"), Fraction(middle), times, budget)


class Table(NamedTuple):
    """Its height A sin(w t) + B cos(w t)."""

    A: float
    B: float = 0.0
    w: float = 1.0

    def height(self, t):
        """Return the height."""
        return self.A * math.sin(self.w * t) + self.B * math.cos(self.w * t)

    def speed(self, t):
        """Return its derivative."""
        return self.w * (self.A * math.cos(self.w * t) - self.B * math.sin(self.w * t))


def next_contact(table, e, t, v, force=(0.0, 0.0), g=1.0):
    """Return time and velocity at the next contact, from an integration in small steps."""
    C, S = force
    up = (1 + e) * table.speed(t) - e * v

    def field(s, z):
        return [z[1], -g + C * math.cos(table.w * s) + S * math.sin(table.w * s)]

    def gap(s, z):
        return z[0] - table.height(s)

    gap.terminal, gap.direction = True, -1
    start, span = [table.height(t), up], (t, t + 30)
    flown = solve_ivp(field, span, start, events=gap, rtol=1e-12, atol=1e-12, max_step=0.05)
    return flown.t_events[0][0], flown.y_events[0][0][1]


def forced(A, e, C, S):
    """Return the system of the ball with a force of the clock."""
    given = system(A, e)
    given["modes"]["fly"]["field"]["v"] += [[C, "cos"], [S, "sin"]]
    return given


def shifted():
    """Return a ball on a table whose height has a sine and a cosine, of the frequency 3/2."""
    given = forced("1/2", "4/5", "1/4", "-1/8")
    table = given["modes"]["fly"]["guards"]["table"]
    table["value"].append(["-1/3", "cos"])
    table["reset"] = {"v": [["27/20", "cos"], ["-9/10", "sin"], ["-4/5", "v"]]}
    return read(given | {"omega": "3/2"})


CASES = {
    "low table": (ball("1/2"), Table(0.5), 1.0, (0.0, 0.0)),
    "high table": (ball("3/2", "9/10"), Table(1.5), 0.9, (0.0, 0.0)),
    "forced": (read(forced("1/2", "4/5", "1/4", "-1/8")), Table(0.5), 0.8, (0.25, -0.125)),
    "shifted": (shifted(), Table(0.5, 1 / 3, 1.5), 0.8, (0.25, -0.125)),
}


@pytest.mark.parametrize("name", CASES)
def test_enclosures_contain_the_next_contact(name):
    """At random places, in points and in boxes; derivatives against differences."""
    model, table, e, force = CASES[name]
    g, source, tried = mapped(model), np.random.default_rng(5), 0
    while tried < 12:
        t, v = float(source.uniform(-3, 3)), float(source.uniform(-6, -1))
        if e * (table.speed(t) - v) < 0.3:
            continue
        try:
            point = g.image(Double(t), Double(v))
        except Rejected as reason:
            assert "cut" in str(reason) or "soon" in str(reason)  # noqa: PT017
            continue
        tried += 1
        here = next_contact(table, e, t, v, force)
        turns = (here[0] - point.x.mid) * table.w / (2 * math.pi)
        assert abs(turns - round(turns)) < 1e-8
        assert abs(here[1] - point.y.mid) < 1e-7
        assert max(point.x.rad, point.y.rad) < 1e-11
        far = 1e-4
        box = g.image(between(t - far, t + far), between(v - far, v + far))
        for dt, dv in ((-far, far), (far, far), (far / 3, -far)):
            other = g.image(Double(t + dt), Double(v + dv))
            for old, new, whole, row in zip(
                point[:2], other[:2], box[:2], box.derivative, strict=True
            ):
                assert whole.lower <= new.mid <= whole.upper
                moved = row[0] * dt + row[1] * dv
                assert moved.lower - 1e-11 <= new.mid - old.mid <= moved.upper + 1e-11


@pytest.mark.parametrize(("low", "high"), [("-1/3", "2/7"), ("1/3", "1/3"), ("10", "11")])
def test_doubles_contain_an_interval(low, high):
    """Both of its ends, and not much more."""
    x = Interval.enclosing(Fraction(low), Fraction(high), contact_map.BITS)
    found = double(x)
    assert found.lower <= x.lower <= x.upper <= found.upper
    assert found.upper - found.lower <= float(x.upper - x.lower) + 1e-12


def test_a_divisor():
    """The speed after a contact times D, over D, which depends on time and speed: the same map."""
    given = system("1/2", "4/5")
    reset = given["modes"]["fly"]["guards"]["table"]["reset"]["v"]
    times = [["5"], ["1", "sin"], ["1/4", "v"]]
    product = [[str(Fraction(a) * Fraction(b)), *m, *n] for a, *m in reset for b, *n in times]
    table = given["modes"]["fly"]["guards"]["table"] | {"reset": {"v": product}, "divisor": times}
    path = ("modes", "fly", "guards", "table")
    g, same = mapped(ball("1/2", "4/5")), mapped(read(changed(given, *path, table)))
    for t, v in ((0.3, -2.0), (-1.2, -4.0), (2.0, -3.0)):
        one, other = (each.image(Double(t), Double(v)) for each in (g, same))
        pairs = zip(one[:2], other[:2], strict=True), *map(zip, one.derivative, other.derivative)
        for p, q in chain(*pairs):
            assert abs(p.mid - q.mid) + q.rad < 1e-10


def heights(A, t, v, d):
    """Return how high the ball would be above the table, if it went on after contacts."""
    s = t + d
    up = 2 * A * np.cos(t) - v
    return A * np.sin(t) + up * d - d**2 / 2 - A * np.sin(s)


def dips(A, t, v):
    """Return after what times the guard would fall through 0, if motions went on after contacts."""
    d = np.linspace(0, 40, 20001)[1:]
    positive = heights(A, t, v, d) > 0
    return d[1:][positive[:-1] & ~positive[1:]]


def test_the_first_contact_is_met():
    """Where the table comes up again, the contact is that with its top, not a later one."""
    g, several = mapped(ball("4"), times=[Fraction(60)]), 0
    for t in np.linspace(-3, 3, 50).tolist():
        for v in np.linspace(-9, 0, 12).tolist():
            try:
                end = g.flown(Double(t), Double(v)).duration.mid
            except Rejected:
                continue
            all_ = dips(4.0, t, v)
            assert abs(end - all_[0]) < 3e-3
            several += len(all_) > 1
    assert several > 10


def test_a_contact_that_may_be_missed_is_rejected():
    """A box with motions that hit the top of the table, and others that pass it."""
    g, passed = mapped(ball("2"), times=[Fraction(60)]), 0
    for t in (-1.9, -1.7, -1.5, -1.3, -1.1):
        low, high = -4.4, -0.8  # a fast one passes
        jump = lambda a, b, t=t: abs(dips(2.0, t, a)[0] - dips(2.0, t, b)[0])  # noqa: E731
        grid = np.linspace(low, high, 60).tolist()
        a, b = max(pairwise(grid), key=lambda pair: jump(*pair))
        for _ in range(30):
            m = (a + b) / 2
            a, b = (a, m) if jump(a, m) > jump(m, b) else (m, b)
        assert jump(a, b) > 0.5
        passed += 1
        for size in (1e-3, 1e-5, 1e-7):
            with pytest.raises(Rejected, match=r"pieces|crossed|certain|division"):
                g.image(Double(t), between(a - size, b + size))
    assert passed == 5


WHY = {
    "at the cut": (3.1416, -2.0, "a phase that may be at the cut"),
    "soon": (0.0, 0.75, "too soon"),
    "far": (0.0, -300.0, "no contact is seen"),
    "wide": (Double(0.0, 1.0), Double(-3.0, 3.0), "may not be crossed|no length|division"),
    "longer": (0.0, -8.5, "longer than claimed"),
}


@pytest.mark.parametrize("name", WHY)
def test_what_is_rejected(name):
    """Each for its own reason."""
    t, v, why = WHY[name]
    g = mapped(ball(), times=[Fraction(10), Fraction(20)]).on(0)
    t, v = (x if isinstance(x, Double) else Double(x) for x in (t, v))
    with pytest.raises(Rejected, match=why):
        g.image(t, v)


@pytest.mark.parametrize(
    ("part", "why"),
    [
        (0.3, "a guard may not be crossed"),
        (0.6, "a flight that may have no length"),
        (0.9, "no certain contact"),
    ],
)
def test_a_guess_that_is_wrong(part, why, monkeypatch):
    """While the ball rises, when it has just turned, and too early."""
    g = mapped(ball())
    flight = g.flown(Double(0.3), Double(-2.0)).duration.mid
    monkeypatch.setattr(ContactMap, "_guess", lambda *_: part * flight)
    with pytest.raises(Rejected) as refused:
        g.flown(Double(0.3), Double(-2.0))
    assert str(refused.value) == why


def test_other_bounds_of_other_sets():
    """What is too long on one set is not on another one."""
    g = mapped(ball(), times=[Fraction(10), Fraction(20)])
    g.on(1).image(Double(0.0), Double(-6.0))
    with pytest.raises(Rejected, match="longer"):
        g.on(0).image(Double(0.0), Double(-6.0))


def test_an_image_at_the_cut():
    """The next contact may not be half a period from the middle."""
    end = mapped(ball()).flown(Double(0.0), Double(-2.0)).time.mid
    g = mapped(ball(), middle=Fraction(math.remainder(end - math.pi, 2 * math.pi)))
    with pytest.raises(Rejected, match="at the cut"):
        g.image(Double(0.0), Double(-2.0))


def ceiling(height):
    """Return the ball below a ceiling, with the name of the other guard."""
    given = system()
    top = {"value": [[height], ["-1", "y"]], "reset": {"v": [["-1", "v"]]}, "to": ["fly"]}
    given["modes"]["fly"]["guards"]["top"] = top
    return read(given)


def test_other_guards_are_watched():
    """A ceiling that is higher than the ball flies changes nothing; a lower one is met before."""
    t, v = Double(0.0, 1e-6), Double(-3.0, 1e-6)
    free, high = (mapped(model).image(t, v) for model in (ball(), ceiling("40")))
    assert (free.x.mid, free.y.mid) == (high.x.mid, high.y.mid)
    with pytest.raises(Rejected, match=r"pieces|may vanish"):
        mapped(ceiling("2")).image(t, v)


def test_a_row_of_several_entries():
    """All products are added, those with 1 exactly."""
    row = [(0, Double(2.0)), (2, Double(1.0)), (1, Double(3.0, 0.5))]
    found = contact_map._dot(row, [Double(5.0), Double(7.0), Double(11.0)])
    assert found.lower == pytest.approx(38.5)
    assert found.upper == pytest.approx(45.5)


def test_pieces_are_counted():
    """No more of them than there are for a set."""
    t, v = Double(0.0, 1e-6), Double(-3.0, 1e-6)
    high = ball("3/2")
    mapped(high).image(t, v)
    with pytest.raises(Rejected, match="too many pieces"):
        mapped(high, budget=1).image(t, v)


# sections


def spring(given):
    """The ball hangs on a spring."""
    given["modes"]["fly"]["field"]["v"] = [["-1", "y"], ["1", "cos"]]


def resting(given):
    """It goes on in another mode."""
    given["modes"]["fly"]["guards"]["table"]["to"] = ["rest"]
    given["modes"]["rest"] = {"field": {"y": [], "v": []}, "guards": {}}


def squared(given):
    """The square of the height."""
    given["modes"]["fly"]["guards"]["table"]["value"][0] = ["1", "y", "y"]


def mixed(given):
    """The velocity, too."""
    given["modes"]["fly"]["guards"]["table"]["value"].append(["1/2", "v"])


def moving(given):
    """The height jumps."""
    given["modes"]["fly"]["guards"]["table"]["reset"]["y"] = [["1", "y"], ["1/10", "cos"]]


def inelastic(given):
    """It sticks to the table."""
    given["modes"]["fly"]["guards"]["table"]["reset"]["v"] = [["3/4", "cos"]]


def still(given):
    """The table does not move."""
    table = given["modes"]["fly"]["guards"]["table"]
    table["value"], table["reset"] = [["1", "y"]], {"v": [["-1", "v"]]}


def of_three(given):
    """There is another variable."""
    given["state"].append("w")
    given["modes"]["fly"]["field"]["w"] = []


NONE = {
    spring: "not polynomial in time",
    resting: "does not lead to the mode fly",
    squared: "not of degree 1 in y",
    mixed: "not of one variable",
    moving: "does not come to zero alone",
    inelastic: "does not come to zero alone",
    still: "the clock occurs nowhere",
    of_three: "not two variables",
}


@pytest.mark.parametrize("alter", NONE)
def test_what_is_no_map(alter):
    """Each system, changed in one place."""
    given = changed(system(), "omega", "1")
    alter(given)
    with pytest.raises(Rejected, match=NONE[alter]):
        mapped(read(given))


@pytest.mark.parametrize(("mode", "guard"), [("rest", "table"), ("fly", "wall")])
def test_no_such_guard(mode, guard):
    """It is said."""
    with pytest.raises(Rejected, match="there is no guard"):
        Section(ball(), mode, guard)


def test_a_constant_that_divides():
    """The guard -2 y + 3/2 sin, negative above the table, is that of a ball below it."""
    given = system()
    table = given["modes"]["fly"]["guards"]["table"]
    table["value"] = [["-2", "y"], ["3/2", "sin"]]
    given["modes"]["fly"]["field"]["v"] = [["1"]]
    below = mapped(read(given)).image(Double(0.5), Double(3.0))
    above = mapped(ball()).image(Double(0.5 - math.pi), Double(-3.0))
    assert abs(below.y.mid + above.y.mid) < 1e-13
    assert abs(math.remainder(below.x.mid - above.x.mid - math.pi, 2 * math.pi)) < 1e-13


# between intervals


def test_conversions_contain():
    """Both ways; what is too large is refused."""
    x = Double(1 / 3, 1e-20)
    back = double(interval(x))
    assert back.lower <= x.lower
    assert back.upper >= x.upper
    bits = contact_map.BITS
    with pytest.raises(Rejected, match="too large"):
        double(Interval(0, 1 << 2 * bits, bits))
    with pytest.raises(Rejected, match="too far away"):
        interval(Double(1e12))
