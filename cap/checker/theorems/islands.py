"""The theorem about islands at several values of f: each one is the theorem ``island``.

The claims at each f are those of ``island``, and so are the hints; what is proved is proved there.
Of the values of f that are listed as open nothing is claimed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any

from cap.checker.kernel.citation import Citation
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Many, Word, columns
from cap.checker.kernel.theorem import Certificate
from cap.checker.system.all_f import ForAllF
from cap.checker.theorems.island import MAX_WORK, Island
from cap.checker.tori import told

MOST = 64  # values of f
MAX_ALL = MAX_WORK * 3 // 2  # degrees times places
REASONS = ("no elliptic orbit", "resonance of order 3", "resonance of order 4", "no curve")


class Islands(ForAllF):
    """Invariant curves around elliptic points, at several values of f."""

    # fmt: off
    HINTS = (
        Field("islands", Many(columns(Island.HINTS), 1, MOST), "", "", "those of `island`, for "
              "each value of f"),
        Field("open", Many({"f": number, "reason": Word(REASONS)}, 0, MOST), "", "", "values of f "
              "of which nothing is claimed, and why: as the prover found, in floats"),
    )
    CLAIMS = (
        Field("islands", Many({"f": number} | columns(Island.CLAIMS), 1, MOST), "", "",
              "values of f, in increasing order, with the claims of `island`"),
    )
    CITES = Island.CITES
    # fmt: on

    @classmethod
    def cited(cls, claims: Mapping[str, Any]) -> list[Citation]:
        """Return what is cited; Franks only for periodic orbits."""
        return Island.cited({name for each in claims["islands"] for name in each})

    @classmethod
    def limit(cls, hints: dict[str, Any], claims: dict[str, Any]) -> None:
        """Bound the time."""
        need(len(hints["islands"]) == len(claims["islands"]), "there are not hints for each f")
        for each in zip(hints["islands"], claims["islands"], strict=True):
            Island.limit(*each)
        work = sum(hint["degree"] * hint["places"] for hint in hints["islands"])
        need(work <= MAX_ALL, f"degrees times places are more than {MAX_ALL} in all")

    def seconds(self) -> int:
        """Return about how long a proof takes: besides functions, a part of a second for each f."""
        return sum(each.seconds() for each in self.each()) + len(self.hints["islands"]) // 2

    def each(self) -> Iterator[Island]:
        """Give the theorem at each f."""
        given = {name: getattr(self.p, name) for name in self.PARAMETERS}
        for claims, hints in zip(self.claims["islands"], self.hints["islands"], strict=True):
            p = Island.parameters(given | {"f": claims["f"]})
            at_f = Certificate("island", p, self.certificate.digits, claims, hints)
            yield Island(at_f, lambda _: None)

    def prove(self) -> None:
        """Prove the theorem at each f."""
        values = [each["f"] for each in self.claims["islands"]]
        need(all(f < g for f, g in pairwise(values)), "the values of f do not increase")
        for n, (f, island) in enumerate(zip(values, self.each(), strict=True)):
            self.tell(f"the island at f = {f} is proved", n / len(values))
            island.prove()
            self.step(f"at f = {f} there is an invariant curve, and the area inside as claimed")

    def words(self) -> str:
        """Return the theorem in one line."""
        parts = [self.told(_SYSTEM), *map(_line, self.claims["islands"])]
        unclaimed = [f"{each['f']} ({each['reason']})" for each in self.hints["open"]]
        return "; ".join(
            parts + ["nothing is claimed of f = " + ", ".join(unclaimed)] * bool(unclaimed)
        )


def _line(claims: dict[str, Any]) -> str:
    """Return what is claimed at one f."""
    f, name, alpha, area = claims["f"], claims["map"], told.turns(claims), claims["area"]
    two = " twice" if claims["disks"] == 2 else ""
    between = told.fraction(claims)
    orbits = "" if between is None else f", p/q as {between}"
    return f"f = {f}: {name}, alpha = {alpha}, area in {area}{two}{orbits}"


_SYSTEM = (
    "x'' = F cos(omega t) - f sgn x' with F = {F}, omega = {omega}, and elastic walls at l = {l} "
    "and r = {r}; let T = 2 pi/omega, Phi be the map over a period from t = 0, and sigma that "
    "over half a period, followed by (x, v) -> (l + r - x, -v): for each f below the map named "
    "has a fixed point P*, and an invariant analytic closed curve without double points around "
    "P*, on which it is conjugate to the rotation by alpha turns; the open disk inside the curve "
    "is invariant, and has the area given; every motion that starts in it at t = 0 has a "
    "velocity that never vanishes, for all times, forward and backward, and hits the right wall "
    "once in each (nT, nT + T/2) and the left wall once in each (nT + T/2, nT + T); where the "
    "area is there twice, the images of these motions by (x, v, t) -> (l + r - x, -v, t + T/2) "
    "start at t = 0 in another disk, disjoint from it, with the same property; where a fraction "
    "p/q is given as an example, it lies between alpha and the rotation number at P* (both in "
    "one sense), and for each such fraction in lowest terms the disk contains at least two "
    "periodic orbits of the map, of minimal period q"
)

THEOREM = Islands
