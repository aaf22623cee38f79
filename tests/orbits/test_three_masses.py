"""Three masses: a periodic orbit with a proof.

Equal masses exchange their velocities when they meet, so three of them move as three masses alone
would that pass through each other: here the elliptic orbit, its mirror image and the saddle.  Each
row has the mode, the guard, the mode after it; the time, the places and the velocities before it.
"""

from fractions import Fraction

from cap.orbits.itinerary import Contact, Itinerary
from cap.orbits.periodic import prove
from cap.parameters import PAPER
from cap.system.masses import masses

ROWS = """\
+++ | hit r | ++- | 0.374498 0.344495 0.67514 1.0 0.757949 0.991326 1.282976
++- | meet 2 3 | +-+ | 0.521118 0.46112 0.825983 0.825983 0.831346 1.064722 -1.092283
+-+ | hit r | +-- | 0.67939 0.5982 0.668627 1.0 0.898506 -0.898506 1.131882
+-- | meet 1 2 | -+- | 0.718929 0.634015 0.634015 0.956161 0.912951 -0.85243 -1.085806
-+- | meet 2 3 | --+ | 0.885666 0.507372 0.790605 0.790605 -0.669978 0.962013 -0.903354
--+ | hit r | --- | 1.099173 0.386558 0.619964 1.0 -0.468079 -0.701456 0.993106
--- | meet 1 2 | --- | 2.099301 0.1861 0.1861 0.274448 -0.095298 -0.328674 -0.620325
--- | meet 2 3 | --- | 2.267574 0.128649 0.16792 0.16792 -0.358013 -0.124637 -0.649663
--- | meet 1 2 | --- | 2.402224 0.077948 0.077948 0.148643 -0.397245 -0.688896 -0.163869
--- | hit l | +-- | 3.51609 -1.0 -0.67514 -0.344495 -1.282976 -0.991326 -0.757949
+-- | meet 1 2 | -+- | 3.662711 -0.825983 -0.825983 -0.46112 1.092283 -1.064722 -0.831346
-+- | hit l | ++- | 3.820983 -1.0 -0.668627 -0.5982 -1.131882 0.898506 -0.898506
++- | meet 2 3 | +-+ | 3.860521 -0.956161 -0.634015 -0.634015 1.085806 0.85243 -0.912951
+-+ | meet 1 2 | -++ | 4.027258 -0.790605 -0.790605 -0.507372 0.903354 -0.962013 0.669978
-++ | hit l | +++ | 4.240766 -1.0 -0.619964 -0.386558 -0.993106 0.701456 0.468079
+++ | meet 2 3 | +++ | 5.240893 -0.274448 -0.1861 -0.1861 0.620325 0.328674 0.095298
+++ | meet 1 2 | +++ | 5.409166 -0.16792 -0.16792 -0.128649 0.649663 0.124637 0.358013
+++ | meet 2 3 | +++ | 5.543817 -0.148643 -0.077948 -0.077948 0.163869 0.688896 0.397245
"""
ELLIPTIC, SADDLE = -0.460286834573929, 3.37548396820815  # the traces of one mass alone


def test_three_masses():
    """18 contacts; the multipliers are those of the three orbits of one mass, all isolated."""
    cells = [row.split(" | ") for row in ROWS.splitlines()]
    contacts = [Contact(mode, guard, to) for mode, guard, to, _ in cells]
    guess = [float(q) for *_, numbers in cells for q in numbers.split()]
    system = masses(PAPER, [Fraction(1)] * 3)
    orbit = prove(Itinerary(system, contacts), guess, 12)
    total = [1.0]
    for trace in (ELLIPTIC, ELLIPTIC, SADDLE):  # the product of 1 - trace z + z²
        padded = [0.0, 0.0, *total, 0.0, 0.0]
        total = [c - trace * b + a for a, b, c in zip(padded, padded[1:], padded[2:], strict=False)]
    for k, found in enumerate(orbit.symmetric, start=1):
        assert abs(float(found) - (-1) ** k * total[k]) < 1e-7
    assert len(orbit.contacts) == 18
    assert {reason.lemma for reason in orbit.reasons} == {"M", "C", "B"}
