"""The map from contact to contact in floats, against the enclosures of the checker."""

from fractions import Fraction

import models
import numpy as np
import pytest
from models import cos, pi, sin, v, y

from cap.checker.coverings.contact_map import ContactMap
from cap.checker.coverings.contact_map import Section as Checked
from cap.checker.kernel.doubles import Double
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.checker.system.given import SYSTEM, model
from cap.errors import BadInput
from cap.floats.coverings.planar import contacts, images
from cap.floats.coverings.saddles import saddles
from cap.maps.graphs import in_time
from cap.proofs.contacts import as_parameters
from cap.system.model import Bounce, Guard, Mode, System
from cap.system.polynomial import ONE
from cap.system.section import sections


def forced():
    """Return a ball with a force, with the other variable first, and pi in the frequency."""
    table = Guard(2 * y - sin + Fraction(1, 3) * cos, ("fly",), Bounce(ONE * Fraction(4, 5)))
    force = Fraction(1, 5) * cos - Fraction(1, 9) * sin - 2
    fly = Mode({"v": force, "y": v}, {"table": table})
    return System(("v", "y"), pi * Fraction(1, 2), {"fly": fly})


CASES = {"ball": models.ball(Fraction(1, 2), Fraction(1)), "forced": forced()}


@pytest.mark.parametrize("name", CASES)
def test_values_lie_in_enclosures(name):
    """At random places: times, the other variable, all four derivatives."""
    system, source = CASES[name], np.random.default_rng(2)
    (section,) = sections(system)
    middle = Fraction(1, 4)
    g = contacts(section, float(middle))
    held = model(matched(as_parameters(system), SYSTEM, "the system"))
    known = ContactMap(Checked(held, "fly", "table"), middle, [Fraction(20)])
    points = source.uniform([-1.7, -6], [2.1, -0.5], (60, 2))
    tried = 0
    for (t, p), found in zip(points.tolist(), images(g, points), strict=True):
        try:
            image = known.image(Double(t), Double(p))
        except Rejected:
            continue
        tried += 1
        (a, b), (c, d) = image.derivative
        for enclosure, value in zip((image.x, image.y, a, b, c, d), found.tolist(), strict=True):
            assert abs(enclosure.mid - value) < 1e-9 * (1 + abs(value))
    assert tried > 20


def test_saddles():
    """Those of the elastic ball: cos t = 0 and v = -k pi, of the multiplier 2 + sqrt 3."""
    (section,) = sections(CASES["ball"])
    found = saddles(contacts(section, 0.0))
    assert len(found) > 2
    for saddle in found:
        t, p = saddle.point
        assert abs(abs(t) - np.pi / 2) < 1e-9
        assert abs(p / np.pi - round(p / np.pi)) < 1e-9
        assert abs(abs(saddle.large) - 2 - 3**0.5) < 1e-6


def test_a_guard_that_is_not_linear_in_the_clock():
    """It is refused."""
    table = Guard(y - sin * cos, ("fly",), Bounce(ONE))
    system = System(("y", "v"), ONE, {"fly": Mode({"y": v, "v": -ONE}, {"table": table})})
    (section,) = sections(system)
    with pytest.raises(BadInput, match="not linear in cos and sin"):
        contacts(section, 0.0)


def test_growth_in_time():
    """Of a full shift of the times 1 and 2: the vector is (1, 1/golden ratio), up to a factor."""
    source, target = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1])
    vector = in_time(source, target, np.array([1.0, 2.0]))
    assert abs(vector[1] / vector[0] - (5**0.5 - 1) / 2) < 1e-9
