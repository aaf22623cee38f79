"""Theorem (window).  Let G be the release map of `cap.proofs.attractor`, on an interval I where it
is unimodal, with the critical point c.  If the lemmas below succeed, then, besides (i), (ii), (iv)
and (v) of that theorem,

 (iii) G has a cycle of the least period p with a multiplier in (-1, 1); it attracts an explicit
       interval J, and c: some Gᵏ(c) lies in J.  So the whole kneading sequence is known: after the
       first symbols it repeats p symbols for ever.

The entropy is that of a sequence known without an end; it may be zero, as it is for p = 1, 2, 4, ..
in the first cascade of period doublings, or positive.

Proof of (iii).  G^p takes J into its interior and |(G^p)'| < 1 on J.  Each of J, G(J), ... lies on
one side of c.
"""

from fractions import Fraction
from typing import Any, NamedTuple

from cap.errors import NotProved
from cap.floats import candidates
from cap.flow.model import Oscillator
from cap.flow.strobe import oscillator
from cap.proofs.attractor import Kneading, Unimodal, claims_of, lemma_2_into_itself
from cap.proofs.certified import Content
from cap.proofs.fixed_point import Proof, Setting, bits, inside, settled
from cap.release import kneading
from cap.release.cycle import Round, contracted, foreseen_cycle, refined
from cap.release.passage import image
from cap.release.unimodal import critical, nearby
from cap.sets import bisection, interval
from cap.sets.interval import Ball

SUMMARY = "a cycle that attracts the critical point of the map of releases: its entropy"
GROUP = "releases"
SEARCH = candidates.releasing
LATEST = 2000  # iterates of the critical point until it lies in J


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no size left to choose."""
    found = foreseen_cycle(setting.parameters, setting.start.x)
    if not found:
        raise NotProved("Lemma 3", "no cycle is found that attracts the critical point")
    proved = Unimodal(setting)
    with interval.workprec(setting.checker_bits):
        claims, hints = certified(proved, found)
    return settled("window", setting, setting.parameters.strings(), (claims, hints))


class Attracted(NamedTuple):
    """J, the images of J, and the symbols of the critical point before and after it is in J."""

    ends: tuple[Fraction, Fraction]
    first: str
    repeated: str


def certified(proved: Unimodal, cycle: tuple[float, ...]) -> Content:
    """Return claims and hints, at the current precision."""
    setting, trap = proved.setting, proved.trap
    p, osc = setting.parameters, oscillator(setting.parameters)
    c = critical(osc, trap.critical, trap.events, proved.turn, bits(setting.digits + 4))
    image_of_c = lemma_2_into_itself(p, osc, trap, c)
    branches = "RL" if proved.turn > 0 else "LR"  # to the left of c, to the right
    J = lemma_3_cycle(setting, osc, cycle, c.ball, image_of_c, branches)
    symbols = J.first + J.repeated * (8 * bits(setting.digits) // len(J.repeated) + 8)
    known = Kneading(c, symbols, setting.checker_bits)
    slopes = kneading.slopes(symbols, bits(setting.digits + 3))
    numbers = claims_of(setting, known, image_of_c, slopes, proved.halves)
    ends, round_ = lemma_4_point(setting, osc, J, len(cycle))
    pair, length = setting.rounding.pair, setting.units.length
    claims, hints = proved.certified(numbers | {"kneading": J.first}, known)
    claims |= {
        "repeated": J.repeated,
        "cycle": [pair(x, length) for x in round_.images[:-1]],
        "multiplier": pair(round_.slope),
        "around": [interval.exact_decimal(end) for end in J.ends],
    }
    return claims, hints | {"point": [str(end) for end in ends]}


def lemma_3_cycle(
    setting: Setting,
    osc: Oscillator[Any],
    cycle: tuple[float, ...],
    c: Ball,
    x: Ball,
    branches: str,
) -> Attracted:
    """*Statement.* G^p contracts J, each image of J lies on one branch, and G^(n+1)(c) lies in J.

    *Computed.* The images of J and of c, in mean value form.  Of the intervals around a point of
    the cycle nearly the largest is taken.
    """
    p, period = setting.parameters, len(cycle)
    middle = interval.rational(refined(osc, p, cycle[0], period))

    def branch(y: Ball) -> str:
        if not (y < c or y > c):
            raise NotProved("Lemma 3", "an image may be the critical point", {"image": y})
        return branches[0] if y < c else branches[1]

    def around(size: Fraction) -> Attracted:
        low, high = (Fraction(end) for end in inside(middle, size * p.R))
        found = contracted(osc, p, (low, high), period)
        return Attracted((low, high), "", "".join(map(branch, found.images[:-1])))

    size = bisection.largest(around, Fraction(1, 16), 6)
    if size is None:
        raise NotProved("Lemma 3", "no interval around the cycle is found that G contracts")
    J = around(size * Fraction(3, 4))
    low, high = map(interval.ball, J.ends)
    first = branch(x)
    for _ in range(LATEST):
        x = image(osc, x, nearby(p, float(x.mid())))[0]
        if low < x < high:
            return J._replace(first=first)
        first += branch(x)
    raise NotProved("Lemma 3", "the images of the critical point do not come close to the cycle")


def lemma_4_point(
    setting: Setting, osc: Oscillator[Any], J: Attracted, period: int
) -> tuple[tuple[Fraction, Fraction], Round]:
    """*Statement.* The cycle and its multiplier, enclosed.

    *Computed.* G^p takes a short interval in J into its interior; so the point of the cycle in J
    lies there.
    """
    p = setting.parameters
    middle = refined(osc, p, float(sum(J.ends) / 2), period)
    grid = 2 ** (interval.working_bits() * 2 // 3)
    near = Fraction(round(interval.rational(middle) * grid), grid)
    ends = near - Fraction(16, grid), near + Fraction(16, grid)
    return ends, contracted(osc, p, ends, period)
