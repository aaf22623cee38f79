"""All (1,1) orbits at given parameters: T-periodic, with a velocity that never vanishes and one hit
of each wall per period.  Orbits that hit each wall once and turn or stick are not among them.

By `cap.one_one.closed_form` they are at most four: the symmetric ones, plus and minus, and one
asymmetric pair. Each is decided in balls: whether it exists, and its type.
"""

from fractions import Fraction
from typing import NamedTuple

from cap.errors import NotProved
from cap.one_one.closed_form import Orbit, symmetric
from cap.proofs.one_one import pair_at
from cap.sets import interval
from cap.sets.interval import Ball

BITS = 160
PLACES = 25


class Member(NamedTuple):
    """A (1,1) orbit: ``plus``, ``minus``, or ``pair`` for two; its type, trace and least speed.

    The speed is in units of F/ω.
    """

    name: str
    kind: str
    trace: Ball
    least_speed: Ball


def census(alpha: Fraction, rho: Fraction) -> list[Member]:
    """Return all (1,1) orbits, whose velocity never vanishes, for f = αF, R = ρF/ω², 0 < α < 1.

    Raises `NotProved` if for one of them existence or type is not certain.
    """
    with interval.workprec(BITS):
        a, ratio = interval.ball(alpha), interval.ball(rho)
        found = [_symmetric(name, a, ratio, sign) for name, sign in (("plus", 1), ("minus", -1))]
        pair = pair_at(a, ratio, PLACES, "census")
        found += [_member("pair", pair[1])] if pair else []
        return [member for member in found if member]


def _symmetric(name: str, alpha: Ball, rho: Ball, sign: int) -> Member | None:
    bound = 2 / interval.pi()
    if alpha > bound:
        return None
    if not alpha < bound:
        raise NotProved("census", "f may be 2F/pi")
    orbit = symmetric(alpha, rho, sign)
    if orbit.mean_speed < 0:
        return None
    return _member(name, orbit)


def _member(name: str, orbit: Orbit) -> Member | None:
    least = orbit.least_speed()
    if least < 0:
        return None
    trace: Ball = orbit.trace()
    elliptic, saddle = -2 < trace < 2, trace > 2 or trace < -2
    if not (least > 0 and (elliptic or saddle)):
        sets = {"least speed": least, "trace": trace}
        raise NotProved("census", f"{name}: existence or type is not certain", sets)
    return Member(name, "elliptic" if elliptic else "saddle", trace, least)
