"""The theorem about chaos of the map from contact to contact, of the system that it holds.

The parameters are the system: a state of two variables, modes with linear fields, guards that are
positive in their modes, resets (``given``).  A *contact* is the guard ``guard`` of the mode
``mode`` that comes to zero, L h < 0, after which the system goes on in the same mode.  g maps a
contact to the next one, if until then nothing else happens (``contact_map``).

*Claimed:* what ``entropy`` says of g; and the flow of the motions with contacts in Lambda has the
topological entropy ``per_period``, or more, over one period of the clock (``timed``).
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from cap.checker.coverings.contact_map import ContactMap, Section
from cap.checker.coverings.entropy import (
    CONES,
    COVERINGS,
    ENTROPY,
    GROWTH,
    LEANING,
    MOST_SETS,
    ORBITS,
    SETS,
    TOGETHER,
    VECTOR,
    Coverings,
)
from cap.checker.coverings.timed import confirm_timed
from cap.checker.kernel.arctangent import pi
from cap.checker.kernel.citation import cite
from cap.checker.kernel.decimals import decimal
from cap.checker.kernel.named import name
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many
from cap.checker.system.given import told
from cap.checker.system.model import Model
from cap.checker.system.own import OwnSystem

SHORT = 10**15  # denominators of the times and of what is claimed in time
LONG = 10**6  # times, at most
WORK = 1 << 23  # pieces of flights
BITS = 80

MODE = Field("mode", name, "", "", "the mode in which the motions are")
GUARD = Field("guard", name, "", "", "the guard of the mode that comes to zero at the contacts")
PER_PERIOD = Field(
    "per_period", number, "", "",
    "a lower bound of the entropy of the flow, over a period 2 pi/omega of the clock",
)  # fmt: skip
MIDDLE = Field("middle", number, "", "", "times of contacts are taken within half a period of it")
TIMES = Field(
    "times", Many(number, 1, MOST_SETS), "", "",
    "for each set an upper bound tau of the time from a contact in it to the next",
)  # fmt: skip
TIMED = Field(
    "timed_vector", Many(number, 1, MOST_SETS), "", "",
    "integers v >= 0 with A v >= exp(tau per_period/period) v in each row",
)  # fmt: skip


def per_unit(system: Model) -> Fraction:
    """Return an upper bound of omega/(2 pi)."""
    return system.omega / 2 if system.times_pi else system.omega / (2 * pi(BITS).lower)


class ContactHorseshoe(Coverings, OwnSystem):
    """Entropy of motions with contact after contact."""

    HINTS = (
        SETS._replace(meaning=f"{SETS.meaning}: a time, and the variable that is free at contacts"),
        COVERINGS,
        VECTOR,
        LEANING,
        MIDDLE,
        TIMES,
        TIMED,
    )
    CLAIMS = (MODE, GUARD, GROWTH, ENTROPY, TOGETHER, PER_PERIOD, ORBITS, CONES)
    # fmt: off
    CITES = (
        *Coverings.CITES,
        cite("Ledrappier-Walters",
             "Ledrappier and Walters, A relativised variational principle for continuous "
             "transformations, J. London Math. Soc. 16, 1977",
             ("factor", "a factor map of compact systems: from pairs of an orbit and a path that "
              "it follows to orbits", "growth"),
             ("fibres", "over n steps an orbit follows a bounded number of paths", "together")),
        cite("Abramov",
             "Abramov, On the entropy of a flow, Dokl. Akad. Nauk SSSR 128, 1959",
             ("time", "the time between contacts is continuous, positive and bounded",
              "per_period")),
        cite("variational principle",
             "Walters, An Introduction to Ergodic Theory, 1982, Theorem 8.6",
             ("compact", "a continuous map of a compact metric space", "per_period")),
    )
    # fmt: on
    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound what becomes a double, and the work."""
        super().limit(hints, claims)
        times, rate, middle = hints["times"], claims["per_period"], hints["middle"]
        need(len(times) == len(hints["sets"]), "not one time for each set")
        need(all(0 < tau <= LONG for tau in times), f"a time is not between 0 and {LONG}")
        need(abs(middle) <= LONG, f"the middle is larger than {LONG}")
        need(all(SHORT % q.denominator == 0 for q in (*times, rate, middle)),
             "a time, the middle or the entropy per period has more than 15 places")  # fmt: skip
        need(all(v.denominator == 1 for v in hints["timed_vector"]), "not a vector of integers")

    def map(self) -> ContactMap:
        """Return g."""
        self.section = Section(self.p, self.claims["mode"], self.claims["guard"])
        times = self.hints["times"]
        return ContactMap(self.section, self.hints["middle"], times, WORK // len(times))

    def prove(self) -> None:
        """Prove the theorem."""
        super().prove()
        rate = self.claims["per_period"] * per_unit(self.p)
        need(rate > 0, "the entropy per period is not positive")
        vector = [int(v) for v in self.hints["timed_vector"]]
        confirm_timed(self.hints["coverings"], vector, rate, self.hints["times"])
        self.step("it grows in time as claimed, as no flight from a set is longer than its bound")

    def told(self, sentence: str, **more: object) -> str:
        """Return a sentence with the numbers claimed; the parameters are told as a whole."""
        return sentence.format_map(self.claims | more)

    def words(self) -> str:
        """Return the theorem in one line."""
        section = Section(self.p, self.claims["mode"], self.claims["guard"])
        longest = decimal(max(self.hints["times"]))
        per_period = decimal(self.claims["per_period"])
        return self.bounded(
            _HORSESHOE, _FLOW,
            system=told(self.p), q=section.q, free=section.p, longest=longest, per=per_period,
        )  # fmt: skip


_HORSESHOE = (
    "the system with the {system}; let g map (t, {free}) at a contact, where '{guard}' of '{mode}' "
    "falls through 0, just before it, with {q} given by t, to (t, {free}) at the next contact, if "
    "the system goes on in '{mode}' and until then all its guards are positive; t is taken modulo "
    "2 pi/omega; g has a compact invariant set Lambda, on which its topological entropy is at "
    "least {entropy}: "
)
_FLOW = (
    "; from a contact in Lambda to the next one it takes at most {longest}, and the flow of the "
    "motions, for all times, whose contacts are orbits of g in Lambda has a topological entropy "
    "of at least {per} per period 2 pi/omega"
)

THEOREM = ContactHorseshoe
