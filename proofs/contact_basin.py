"""Theorem (contact_basin).  Let a system be given as data (`cap.system.model`), with a guard h of a
mode D whose events, the hits, make h' to -e h', 0 < e <= 1, and which names a mode of rest; D has
no other guard, h depends on one variable of the state, h' on the other, and -h'' = m + c cos wt + d
sin wt.  If the lemmas succeed, then of the states of an explicit rectangle at a time t_0, by area,

 (i)  at least an explicit part comes to rest before T: infinitely many hits accumulate before;
 (ii) at least an explicit part does not: it is in D with h > 0 at T, after finitely many hits.

Proof.  The rectangle is cut in cells, halves of halves (`cap.areas.resting`).  In outward-rounded
doubles all motions of a cell are followed from hit to hit: their states are in the image of its
middle and a product of derivatives, mean values; each hit has a window of times in which h' < 0.
(i): near the wall the lemma of `cap.orbits.capture` applies.  (ii): h > 0 until T.
"""

from fractions import Fraction
from typing import Any

from cap.areas.resting.asked import Rectangle, driven, numbers
from cap.areas.resting.fates import Sides
from cap.areas.resting.pull import Pull
from cap.areas.resting.sweep import DEEPEST, Swept, sweep
from cap.certificate import writer
from cap.errors import NotProved
from cap.orbits.wall import Wall
from cap.proofs.certified import certified
from cap.proofs.contacts import as_parameters
from cap.runner import Runner, Tell
from cap.sets import interval

BITS, CHECKED = 128, 128
PLACES = 6  # decimals of the shares that are claimed
CELLS = 10_000  # about so many, if nothing is said


def prove(
    place: Wall, asked: Rectangle, cells: int = CELLS, runner: Runner | None = None
) -> dict[str, Any]:
    """Return a certificate, which the independent checker accepts.

    Its cells are followed by the processes of ``runner``, after a sweep in this one.

    Raises `BadInput` if the system is not of this kind, `NotProved` if no cell has a fate.
    """
    runner = runner or Runner()
    with interval.workprec(BITS):
        pull = driven(place)
        swept = lemma_1_fates(*numbers(place, pull, asked), cells, runner.tell)
    if not (swept.rests or swept.flies):
        raise NotProved("cells", "of no cell it is certain that it rests, or that it does not")
    return _checked(place, asked, swept, runner)


def lemma_1_fates(p: Pull, sides: Sides, cells: int, tell: Tell) -> Swept:
    """*Statement.* (i), (ii).

    *Computed.* Cells in compiled doubles, halved where no fate is certain.
    """
    return sweep(p, sides, cells, tell)


def _checked(place: Wall, asked: Rectangle, swept: Swept, runner: Runner) -> dict[str, Any]:
    """Return the certificate, if the checker accepts it."""
    claims = {
        "start": writer.exact(asked.start),
        "until": writer.exact(asked.until),
        "mode": place.falling,
        "guard": place.guard,
        "restitution": writer.exact(place.e),
        "box": {z: [*map(writer.exact, ends)] for z, ends in asked.box.items()},
        "resting": _share(swept.rests),
        "flying": _share(swept.flies),
    }
    parameters = as_parameters(place.system, rests=True)
    content = claims, {"bits": str(CHECKED), "tree": swept.tree}
    return certified("contact_basin", parameters, content, runner, digits=PLACES, bits=BITS)


def _share(units: int) -> str:
    """Return a share, rounded down."""
    return writer.exact(Fraction(units * 10**PLACES >> DEEPEST, 10**PLACES))
