"""Where orbits of two masses become critical: one family contains all masses that are claimed."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from pathlib import Path

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.particles.family import with_second
from cap.checker.theorems import particles_limits
from cap.checker.theorems.particles_limits import Crossing, ParticlesLimits

STORED = Path(__file__).parents[2] / "certificates/particles_limits.json"


@pytest.mark.parametrize("name", ["flip", "stop"])
def test_zeros_for_all_masses_of_an_interval(monkeypatch, name):
    """Krawczyk's operator is of all of them, then of each end."""
    theorem = ParticlesLimits(read(STORED.read_bytes()), lambda _step: None)
    claim, seen = theorem.claims[name], []

    def seeing(M, *_):
        seen.append((M.m[1].lower, M.m[1].upper))
        raise Rejected("seen")

    monkeypatch.setattr(particles_limits, "krawczyk", seeing)
    with pytest.raises(Rejected, match="seen"):
        theorem.crossing(name)
    bits = theorem.hints["bits"]
    whole = Interval.enclosing(claim.lower, claim.upper, bits)
    assert seen == [(whole.lower, whole.upper)]
    assert whole.lower <= claim.lower < claim.upper <= whole.upper
    monkeypatch.setattr(particles_limits, "krawczyk", lambda *_: None)
    monkeypatch.setattr(particles_limits, "contacts", lambda *_: None)
    zeros = []
    monkeypatch.setattr(theorem, "zero", lambda mass, centre, *_: zeros.append((mass, centre)))
    theorem.crossing(name)
    assert [mass for mass, _ in zeros] == [claim.lower, claim.upper]
    ends = [theorem.hints[name][end] for end in ("lower", "upper")]
    given = [[Fraction(q) for contact in end for q in contact] for end in ends]
    assert [list(centre) for _, centre in zeros] == given


def test_another_second_mass():
    """The first one stays."""
    p = read(STORED.read_bytes()).parameters._replace(masses=(Fraction(2), Fraction(3)))
    assert with_second(p, Fraction(1)).masses == (2, 1)


@pytest.mark.parametrize(
    ("name", "looked_at"),
    [
        ("flip", [("least_speeds", "family", "orbit")]),
        ("stop", [("no_other_contacts", "family", "orbit"), ("least_speeds", "above", "later")]),
    ],
)
def test_orbits_on_which_a_mass_may_stop(monkeypatch, name, looked_at):
    """At flip no mass stops; at stop there are no other contacts, and none stops at its upper end.

    What is refused there is refused in all.
    """
    theorem = ParticlesLimits(read(STORED.read_bytes()), lambda _step: None)
    found = Crossing("family", "orbit", [("below", "sooner"), ("above", "later")])
    for last in range(len(looked_at)):
        seen = []

        def looking(which, *given, seen=seen, last=last):
            seen.append((which, *given))
            if len(seen) > last:
                raise Rejected("refused here")

        for which in ("least_speeds", "no_other_contacts"):
            monkeypatch.setattr(particles_limits, which, partial(looking, which))
        with pytest.raises(Rejected, match="refused here"):
            getattr(theorem, name)(found)
        assert seen == looked_at[: last + 1]
