"""Misuse of the algebra is refused: what would silently be wrong raises."""

import pytest
from flows import exactly, point_orbit

from cap.errors import NotProved
from cap.flow.jet_transport import strobe_jet
from cap.flow.strobe import oscillator
from cap.maps.normal_form import twists
from cap.sets.interval import Ball, workprec
from cap.sets.jet import Jet, Space
from cap.sets.taylor_model import Domain


@pytest.mark.parametrize("other", [Space(2, 1), Space(1, 3)])
def test_jets_of_other_spaces(other):
    """Spaces of one size may hold other monomials."""
    jet, alien = Jet.constant(Ball(1), Space(1, 2)), Jet.constant(Ball(1), other)
    for combine in (lambda: jet + alien, lambda: jet * alien, lambda: jet - alien):
        with pytest.raises(ValueError, match="different spaces"):
            combine()


def test_taylor_models_on_other_domains():
    """A remainder holds on one domain only."""
    (small,), (large,) = (Domain((Ball(r),), 2).variables((Ball(0),)) for r in (1, 2))
    for combine in (lambda: small + large, lambda: small * large, lambda: small / (large + 5)):
        with pytest.raises(ValueError, match="different domains"):
            combine()


def test_integers_are_no_scalars_to_divide():
    """1/3 of two Python integers would be a double."""
    jet = Jet.constant(1, Space(2, 2))
    for combine in (lambda: jet / 3, jet.reciprocal, lambda: 1 / jet):
        with pytest.raises(TypeError, match="no exact scalar"):
            combine()
    assert (Jet.constant(Ball(0), Space(2, 2)) / 3).coefficients[1:] == [0] * 5


def test_jets_are_not_transported_through_turnings():
    """An event that is no hit would be taken for one."""
    p, state, start, end, events = point_orbit("turns")
    orbit = exactly(p, state, start, end, events)
    assert orbit.hits != orbit.events
    with pytest.raises(ValueError, match="hits only"):
        strobe_jet(oscillator(p), (Ball(0), Ball(1) / 10), orbit, 2)


def test_contractions_have_no_twist():
    """A determinant that is certainly not one is no area-preserving map."""
    x, v = Jet.variables((Ball(0), Ball(0)), 3)
    for factor in (Ball(99) / 100, Ball(101) / 100):
        with pytest.raises(NotProved, match="determinant"):
            twists(x * factor / 2 - v * factor, x * factor + v * factor / 2)


def test_messages_keep_the_precision_of_their_sets():
    """They are kept as they were computed, not at 53 bits afterwards; ten digits are shown."""
    with workprec(300):
        third = Ball(1) / 3
        failure = NotProved("step", "reason", {"third": third})
    assert failure.sets["third"].rel_accuracy_bits() > 290
    shown = Ball(str(failure).partition(" = ")[2].rstrip("]") + "]")
    assert shown.contains(third)
    assert "0.3333333333 " in str(failure)
