"""Ellipsoids that orbits attract, and orbits of which it is not shown that they attract."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import models
import pytest
from orbits.test_periodic import TABLE

from cap.errors import NotProved
from cap.orbits.ellipsoid import attracted
from cap.orbits.equations import Equations
from cap.orbits.itinerary import Itinerary
from cap.orbits.periodic import Prover
from cap.proofs.contacts import prove
from cap.sets import interval


def test_each_is_half_as_large_as_the_one_before():
    """The factor comes down to that of the derivative; nothing is found around a saddle."""
    with interval.workprec(120):
        prover = Prover(Equations(Itinerary(models.ball(), TABLE)))
        orbit = prover.prove([0.51, 0.58, -3.14], 20)
        found = [ellipsoid for ellipsoid, _ in attracted(prover, orbit, prover.reasons)]
        assert len(found) > 8
        for one, two in pairwise(found):
            assert two.matrix[0][0] / one.matrix[0][0] == pytest.approx(2, rel=1e-3)
            assert two.contraction <= one.contraction < 1
        saddle = prover.prove([5.77, -0.58, -3.14], 20)
        with pytest.raises(NotProved, match="attracts too slowly"):
            next(attracted(prover, saddle, prover.reasons))


def test_a_mode_that_may_be_open_is_told_before_the_checker():
    """After a contact two modes are open: whether the orbit attracts is not decided."""
    system = models.ball()
    fly, rest = system.modes["fly"], system.modes["rest"]
    both = replace(fly.guards["table"], to=("fly", "rest"))
    modes = {"fly": replace(fly, guards={"table": both}), "rest": rest}
    orbit = Itinerary(replace(system, modes=modes), TABLE)
    with pytest.raises(NotProved, match=r"after contact 1 \('table'\) the mode 'rest' may be open"):
        prove(orbit, [0.51, 0.58, -3.14])
    closed = replace(rest.guards["leave"], value=-rest.guards["leave"].value)
    modes["rest"] = replace(rest, guards={"leave": closed})
    orbit = Itinerary(replace(system, modes=modes), TABLE)
    assert prove(orbit, [0.51, 0.58, -3.14])["claims"]["unstable"] == "0"
    assert Fraction(prove(orbit, [0.51, 0.58, -3.14])["claims"]["basin"]["contraction"]) < 1
