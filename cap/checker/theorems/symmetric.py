"""The theorem about symmetric (1,1) orbits: all of them, from the closed form.

A symmetric orbit has sin phi = -c with c > 0 ("plus") or c < 0 ("minus"), W > 0, and a least speed
> 0: then it is genuine.  If f > 2F/pi there is none; f = 2F/pi is impossible as pi is irrational.

*Besides*: the roots of the paper's equation for other orbits (``paper_equation``).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, ClassVar

from cap.checker.kernel.choices import Cases, OrNone
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.later import Later, loaded
from cap.checker.kernel.optional import Maybe
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity, Word
from cap.checker.kernel.theorem import BITS
from cap.checker.one_one.closed_form import Symmetric, birth, friction, half_turn
from cap.checker.one_one.scaled import STATE, SYSTEM, Scaled

PAPER_EQUATION = "cap.checker.one_one.paper_equation"
# fmt: off
ORBIT = (
    *STATE,
    Field("half_trace", Quantity(), "trace of half map", "2 - k", "of the map over half a period, "
          "then the reflection: 2 - k, k = 2 pi^2 c/(rho + 2c)"),
    Field("trace", Quantity(), "trace", r"\operatorname{tr} D\Phi", "of Phi': (2 - k)^2 - 2"),
    Field("type", Word(("elliptic", "saddle")), "", "", "|trace| < 2 or |trace| > 2"),
)
# fmt: on
GENUINE = {field.name: field.shape for field in ORBIT}
NOT_GENUINE = {"hit_speed": Quantity("R omega"), "least_speed": Quantity("R omega")}
BRANCH = OrNone(Cases("genuine", {"yes": GENUINE, "no": NOT_GENUINE}))


class SymmetricOrbits(Scaled):
    """All symmetric (1,1) orbits at given parameters."""

    PARTS: ClassVar[dict[str, str]] = {"paper_roots": PAPER_EQUATION}
    HINTS = (BITS,)
    # fmt: off
    CLAIMS = (
        Field("branches", {"plus": BRANCH, "minus": BRANCH}, "", "",
              'the orbits with c > 0, c < 0; "none" if f > 2F/pi or the hit speed is not positive'),
        Field("saddle_center", Quantity("F"), "plus and minus meet", r"2F/\pi", "2F/pi"),
        Field("pitchfork", OrNone(Quantity("F")), "asymmetric pair is born", "f_0",
              'f where c = 2 rho/(pi^2 - 4), trace Phi\' = 2; "none" if rho >= (pi^2 - 4)/2'),
        Field("minus_identity", OrNone(Quantity("F")), "Phi' = -1", "f_{-1}",
              'f where c = rho/(pi^2 - 2), trace Phi\' = -2; "none" if rho >= pi^2 - 2'),
        Field("paper_roots", Maybe(Later(lambda: loaded(PAPER_EQUATION).CLAIM)),
              "paper's root", r"\theta", "all roots in (0, pi), ascending, two or none, of F pi "
              "sin theta = 2F + R omega^2 - f pi^2/2 + f theta (pi - theta); velocity = -(F/omega) "
              "sin theta - (f/omega)(pi - theta), negative"),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        need(self.p.f > 0, "0 < f does not hold")
        limit = self.number(2) / self.pi()
        below = self.alpha.is_before(limit)
        need(below or limit.is_before(self.alpha), "f may be 2F/pi")
        for name, sign in (("plus", 1), ("minus", -1)):
            self.branch(name, Symmetric.of(self.alpha, self.rho, sign) if below else None)
        self.bifurcations(limit)
        if "paper_roots" in self.claims:
            loaded(self.PARTS["paper_roots"])(self).prove()

    def branch(self, name: str, orbit: Symmetric | None) -> None:
        """Prove what is claimed about the orbit of the formula; None if there is no such orbit."""
        claims, where = self.claims["branches"][name], f"branches.{name}"
        if orbit is None or (-orbit.hit_speed).is_positive():
            need(claims is None, f"{where}: a hit speed is not positive: there is no orbit")
            self.step(f"there is no orbit '{name}'")
            return
        need(orbit.hit_speed.is_positive(), f"{where}: the sign of the hit speed is not decided")
        need(claims is not None, f"{where}: the formula gives an orbit")
        genuine, slow = claims["genuine"] == "yes", claims["least_speed"]
        for quantity, value in (self.linear(orbit) if genuine else self.speeds(orbit)).items():
            self.compare(f"{where}.{quantity}", claims[quantity], value)
        if genuine:
            need(slow.lower > 0, f"{where}.least_speed is not positive")
            low, high = claims["trace"][:2]
            types = {"elliptic": low > -2 and high < 2, "saddle": low > 2 or high < -2}
            need(types[claims["type"]], f"{where}.trace is not that of the type claimed")
            self.step(f"the orbit '{name}' is genuine: {claims['type']}")
        else:
            need(slow.upper < 0, f"{where}.least_speed is not negative")
            self.step(f"the orbit '{name}' of the formula is not genuine")

    def linear(self, orbit: Symmetric) -> dict[str, Any]:
        """Return what is claimed of a genuine orbit: its state, its speeds, and its linear part."""
        half = -orbit.k + 2
        return self.state(orbit) | {"half_trace": half, "trace": half.square() - 2}

    def bifurcations(self, limit: Interval) -> None:
        """Compare the values of f at which the type changes."""
        F, at = self.number(self.p.F), {"pitchfork": birth, "minus_identity": half_turn}
        self.confirm(saddle_center=F * limit)
        for name, c in ((name, find(self.rho)) for name, find in at.items()):
            agree = (c is None) == (self.claims[name] is None)
            need(agree, f"{name} exists, or not, against the claim")
            if c is not None:
                self.confirm(**{name: F * friction(c)})
        self.step("the values of f at which the symmetric orbits change contain what is computed")

    def words(self) -> str:
        """Return the theorem in one line."""
        return self.told("".join(self.sentences()))

    def sentences(self) -> Iterable[str]:
        """Yield the sentences."""
        claims, orbits = self.claims, self.claims["branches"]
        genuine = [name for name, orbit in orbits.items() if orbit and orbit["genuine"] == "yes"]
        count = ("zero (1,1) orbits have", "one (1,1) orbit has", "two (1,1) orbits have")
        yield SYSTEM
        yield f"exactly {count[len(genuine)]} x(t + T/2) = l + r - x(t) for all t"
        for name in genuine:
            yield _SYMMETRIC.format_map(orbits[name] | {"name": name})
        for name, orbit in orbits.items():
            if orbit and orbit["genuine"] == "no":
                yield _NOT_GENUINE.format_map(orbit | {"name": name})
        yield _VALUES
        for trace, name in (("2", "pitchfork"), ("-2", "minus_identity")):
            where = f"at f in {claims[name]} only" if claims[name] else "nowhere"
            yield f"; for 0 < f < 2F/pi the trace of the formula for 'plus' is {trace} {where}"
        if "paper_roots" in claims:
            yield from loaded(self.PARTS["paper_roots"])(self).words()


_SYMMETRIC = (
    "; '{name}' has x in {x}, v in {v} at t = 0, hits r and then l at times in {hit_times[0]} and "
    "{hit_times[1]} with a speed in {hit_speed}, has a least speed in {least_speed}, and the "
    "time-T map Phi has at it a trace in {trace}: {type}"
)
_NOT_GENUINE = (
    "; the formula for '{name}', with a speed in {hit_speed} at the hits, has a least speed in "
    "{least_speed}, so it is no (1,1) orbit"
)
_VALUES = (
    "; as f varies, the formulas are defined for f up to 2F/pi in {saddle_center}, where they "
    "meet, and are orbits where their least speed is positive"
)
THEOREM = SymmetricOrbits
