"""Theorem (ball_curve).  Let a ball bounce elastically on a table,

    y'' = -g,   y > A sin ωt,     0 < A ω² < g,

and let α be a quadratic irrational, n >= 0.  If the lemmas succeed, then

 (i)   the map from impact to impact, of (ωt mod 2π, v), v > 0 the speed after an impact, relative
       to the table, has an invariant analytic curve that goes around once, near an explicit
       trigonometric polynomial in (ωt, v²ω²/(2g²)), on which it is conjugate to a rotation; the
       table oscillates n + α times between two impacts, on average;
 (ii)  on it v lies between explicit bounds: so no motion goes from speeds below the first to speeds
       above the second, or back, whenever;
 (iii) an explicit motion below the curve goes from v = u to v >= u', and one above it from v = w to
       v <= w': so no invariant curve that goes around once lies in u <= v < u' or w' < v <= w;
 (iv)  of the invariant curves that go around once, above the one motion or through it, the greatest
       lower bound of max v is at least u', and at most the upper bound of (ii); of those below the
       other or through it, the least upper bound of min v is at most w', and at least the lower.

Proof.  docs/invariant-curve-proof.md, with `cap.tori.bouncing`; `cap.proofs.cylinder`; (iii) Lemma
2: such a curve separates the cylinder, and both motions would cross it.  (iv) The vertical line
through the last state of the one motion meets each such curve there or above; so does that of the
other one there or below; the curve of (i) is one of either kind.
"""

from fractions import Fraction
from math import ceil, floor, pi
from typing import Any, NamedTuple

from cap.errors import BadInput, NotProved
from cap.floats.candidates import passage, spanning
from cap.proofs.certified import certified
from cap.proofs.cylinder import DIGITS, Sought, bounds, proved
from cap.runner import Runner
from cap.sets import interval
from cap.sets.fourier import Circle
from cap.tori.bouncing import Bouncing, impact
from cap.tori.rotation import Quadratic

BITS = 128 + 8 * passage.IMPACTS  # of motions
PLACES = 6  # decimals of the speed at the end


class Table(NamedTuple):
    """The parameters A, ω and g."""

    A: Fraction = Fraction(1, 5)
    omega: Fraction = Fraction(1)
    g: Fraction = Fraction(1)

    @property
    def a(self) -> Fraction:
        """The reduced acceleration A ω²/g."""
        return self.A * self.omega**2 / self.g

    def checked(self) -> "Table":
        """Return it; raise `BadInput` unless 0 < A ω² < g."""
        if not all(q > 0 for q in self):
            raise BadInput("A, omega and g must be positive")
        if not self.a < 1:
            raise BadInput(
                "A omega^2 < g is needed, that a flight ends at the first height 0: here A omega^2 "
                f"is {float(self.a):.6g} g"
            )
        return self


def prove(table: Table, q: Quadratic, whole: int, runner: Runner) -> dict[str, Any]:
    """Return a certificate, which the checker accepts; raise `NotProved`."""
    a, scale = table.checked().a, table.g / table.omega
    runner.tell(f"a curve with the rotation number {whole} + {q} is looked for", None)
    ball = spanning.Ball(float(a))
    curve, decay = spanning.found(ball, 2 * pi * (whole + float(q.value())))
    rows = [row.tolist() for row in ball.hints(curve)]

    def mapped(circle: Circle) -> Bouncing:
        return Bouncing.of(circle, interval.ball(a), rows)

    found, at = proved(Sought(q, whole, curve, decay), mapped, runner)
    with interval.workprec(at.bits):
        speeds = ((2 * w).sqrt() * interval.ball(scale) for w in (found.low, found.high))
        claims = {**found.claims, "turns": str(whole), "speeds": bounds(*speeds)}
    runner.tell("motions that come near the curve are looked for", None)
    low, high = (Fraction(text) for text in claims["speeds"])
    claims["rise"] = lemma_2_passage(table, passage.rising(float(a), float(low / scale)), 1)
    claims["fall"] = lemma_2_passage(table, passage.falling(float(a), float(high / scale)), -1)
    content = claims, {**found.hints, "bits": str(BITS)}
    about = as_parameters(table)
    return certified("ball_curve", about, content, runner, digits=DIGITS, bits=at.bits)


def lemma_2_passage(table: Table, starts: list[passage.Start], sign: int) -> dict[str, str]:
    """*Statement.* The motion from a start has, after so many impacts, at least a speed.

    At most, if ``sign`` is -1.  *Computed.* The motion of each start, impact by impact, in balls of
    `BITS` bits; the one that gains most is returned.
    """
    scale, found = table.g / table.omega, []
    with interval.workprec(BITS):
        a, to = interval.ball(table.a), Fraction(10) ** PLACES
        for start in starts:
            first = Fraction(start.speed)
            t, v = interval.ball(Fraction(start.phase)), interval.ball(first)
            for n in range(passage.IMPACTS):
                t, v = impact(a, t, v)
                ends = interval.ends(v * interval.ball(scale))
                last = Fraction(floor(ends[0] * to) if sign > 0 else ceil(ends[1] * to)) / to
                found.append((last / (first * scale), last, n + 1, start))
    best = max if sign > 0 else min
    ratio, last, count, start = best(found, key=lambda each: each[0])
    if not sign * (ratio - 1) > 0:
        raise NotProved("motion", "none found goes far", {"ratio": interval.ball(ratio)})
    speed = str(Fraction(start.speed) * scale)
    return {"phase": start.phase, "speed": speed, "impacts": str(count), "to": str(last)}


def as_parameters(table: Table) -> dict[str, str]:
    """Return the parameters in the form that a certificate holds."""
    return {name: str(value) for name, value in table._asdict().items()}
