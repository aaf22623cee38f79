"""Numbers, roots, integrals, orbits, certificates: each means against what is known otherwise."""

from fractions import Fraction

import pytest
from support import holds

from cap.audit.comparison import rounded
from cap.audit.filled import above, below, inner, pair
from cap.audit.means import stored
from cap.audit.means.need import noted
from cap.audit.papers.mixed_dynamics.means import equation
from cap.audit.papers.mixed_dynamics.means.melnikov import over_the_line
from cap.audit.papers.mixed_dynamics.means.orbits import (
    before_a_hit,
    before_a_stop,
    follow,
    overlap,
    until,
)
from cap.audit.papers.mixed_dynamics.means.roots import roots
from cap.audit.verdict import Outcome
from cap.checker.kernel.shapes import Enclosure
from cap.errors import NotProved
from cap.floats.engine import swarm
from cap.parameters import PAPER, at
from cap.sets import interval
from cap.sets.interval import Ball

THIRDS = Enclosure(Fraction(1, 3), Fraction(2, 3), ("1/3", "2/3"))


def test_numbers_of_the_paper():
    """Rounded, less than a unit of the last digit away, or not; a wide ball decides nothing."""
    with interval.workprec(60):
        ends = interval.ends(interval.pi())
    assert rounded("3.14", *ends) is Outcome.CONFIRMED
    assert rounded("3.15", *ends) is Outcome.IMPRECISE
    assert rounded("3.16", *ends) is Outcome.CORRECTED
    with pytest.raises(NotProved, match="undecided"):
        rounded("3.16", Fraction(305, 100), Fraction(325, 100))


def test_roundings():
    """Enclosures outwards, bounds to their side, ranges inwards."""
    assert pair(THIRDS, 2) == "[0.33, 0.67]"
    assert inner(THIRDS, 2) == "[0.34, 0.66]"
    assert (below(THIRDS.lower, 1), above(THIRDS.upper, 1)) == ("0.3", "0.7")
    with interval.workprec(60):
        assert pair(interval.ball(Fraction(1, 4)), 2) == "0.25"


def test_all_roots_are_found():
    """Of sin on [1/2, 20]: six, in their order."""
    with interval.workprec(80):
        found = roots(Ball.sin, Ball.cos, interval.ball(Fraction(1, 2)), Ball(20))
        assert len(found) == 6
        for k, root in enumerate(found, 1):
            assert root.contains(k * interval.pi())


def test_a_double_root_is_refused():
    """(x - 1/3)² has a root without a change of sign."""
    third = Fraction(1, 3)
    with interval.workprec(60), pytest.raises(NotProved, match="undecided"):
        roots(
            lambda x: (x - interval.ball(third)) ** 2,
            lambda x: 2 * (x - interval.ball(third)),
            Ball(0),
            Ball(1),
        )


@pytest.mark.parametrize("alpha", ["3/10", "2/5", "1/2", "13/20"])
def test_roots_of_the_equation(alpha):
    """They are narrow, symmetric about π/2, and none for small friction."""
    with interval.workprec(120):
        found = equation.roots(Fraction(alpha), Fraction(2))
        assert len(found) == (0 if alpha == "3/10" else 2)
        assert all(float(root.rad()) < 1e-20 for root in found)
        if found:
            assert (found[0] + found[1] - interval.pi()).contains(0)


def test_an_integral():
    """Of sech² over the line: 2."""
    with interval.workprec(80):
        value = over_the_line(lambda u: 1 / (u.cosh() * u.cosh()), 4)
        assert holds(value, 2)
        assert float(value.rad()) < 1e-20


def test_a_pole_on_the_line_is_refused():
    """The enclosure is not finite there."""
    with interval.workprec(60), pytest.raises(NotProved, match="quadrature failed"):
        over_the_line(lambda u: 1 / u, 1)


def test_orbits_agree_with_floats():
    """The image of a box contains that of its centre."""
    with interval.workprec(100):
        first = follow("-0.39", "0.53", "0.001")
        centre = follow("-0.39", "0.53")
    seen = swarm.follow(PAPER, [[-0.39, 0.53]], 1).states[0]
    assert [abs(float(b.mid()) - q) < 0.02 for b, q in zip(first.state, seen, strict=True)]
    assert all(b.contains(q) for b, q in zip(first.state, seen, strict=True))
    assert (first.words, first.stops, first.turning) == (("hit r", "hit l"), (), 1)
    assert first.determinant.contains(1)
    assert first.trace.contains(centre.trace)
    assert "hit r at [" in first.events
    assert first.box == "|x - (-0.39)| <= 0.001, |v - (0.53)| <= 0.001"
    assert centre.box == "(x, v) = (-0.39, 0.53)"


def test_orbits_that_stop():
    """Their events are more than hits, and areas shrink by the factors of the turns."""
    with interval.workprec(100):
        found = follow("0.4064", "-0.6708", F="3")
    assert found.stops == ("turn right", "turn left")
    assert overlap(found.determinant, found.turning)
    assert not overlap(found.determinant, Fraction(1))


def test_orbits_made_to_hit():
    """At 11/10 they hit r with the speed 1; a little to the left they come later."""
    with interval.workprec(100):
        early = until(before_a_hit(Fraction(1, 100)), Fraction(12, 10))
        assert early.words == ("hit r",)
        assert early.times[0] < Fraction(11, 10).numerator / Ball(10)
        late = until(before_a_hit(Fraction(-1, 100)), Fraction(11, 10))
        assert late.words == ()


@pytest.mark.parametrize(("cosine", "verb"), [("-3/10", "stick"), ("-1/2", "turn left")])
def test_orbits_made_to_stop(cosine, verb):
    """They hit l at 3/2, and stop at the time that was asked for."""
    with interval.workprec(100):
        orbit = until(before_a_stop(Fraction(cosine)), Fraction(5, 2))
        assert orbit.words[:2] == ("hit l", verb)
        assert orbit.times[0].contains(Fraction(3, 2).numerator / Ball(2))
        assert (orbit.times[1].cos() - interval.ball(Fraction(cosine))).contains(0)


def test_parameters():
    """The paper's but for those given, exactly."""
    assert at(F="3", e="0.9").e == Fraction(9, 10)
    assert at(F="3").f == PAPER.f


def test_certificates_are_checked():
    """A stored one is accepted; what was asked for is remembered once."""
    noted()
    assert stored.stored("capture.json").parameters["f"] == Fraction(2, 5)
    assert set(noted()) - {""} == {"capture.json"}
    assert noted() == []
    with pytest.raises(NotProved, match=r"no certificate none\.json"):
        stored.stored("none.json")


def test_certificates_are_not_believed(tmp_path, monkeypatch):
    """The checker rejects one that was changed."""
    text = (stored.FOLDER / "capture.json").read_text("utf-8")
    (tmp_path / "false.json").write_text(text.replace('"capture r"', '"capture l"'))
    monkeypatch.setattr(stored, "FOLDER", tmp_path)
    with pytest.raises(NotProved, match=r"the checker rejects false\.json"):
        stored.stored("false.json")
