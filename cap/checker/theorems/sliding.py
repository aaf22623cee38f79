"""The theorem about sliding: two masses that touch neither wall nor each other, and a basin.

*Momenta.*  While nothing is touched the momentum p = m_i x_i' of each mass obeys p' = F cos wt - f
sgn p.  That is the equation of a mass 1, whose periodic solution is v* of `cap.checker.flow.free`
(mu = 0).  So in a T-periodic orbit that touches nothing m_i x_i' = v*, x_i = x_i(0) + X(t)/m_i, X
the integral of v* from 0 to t: it takes the values from -below to above = stroke - below, below the
integral of v* from its turn right, before 0, to 0.

*Orbits.*  Let q = 1/m_2 - 1/m_1.  Nothing is touched if and only if for all t

    x_1(0) + X/m_1 > l,      x_2(0) + X/m_2 < r,      x_2(0) - x_1(0) + q X > 0, that is

    x_1(0) > left = l + below/m_1,      x_2(0) < right = r - above/m_2,
    x_2(0) - x_1(0) > gap = max(q below, -q above).

If L = right - left - gap > 0 these places are an open triangle of the area L^2/2: fixed points of
the time-T map, whose derivative there is ((1, *), (0, m)) for each mass, m = ((c - f)/(c + f))^2.

*A basin.*  Let m_i v_i(0) = v*(0) + u_i, |u_i| < d.  While nothing is touched x_i differs from the
orbit with the same x_i(0) by an integral of the sign of u_i that is monotone in time and, in size,
below e_i = D(|u_i|)/m_i.  So if

    x_1(0) > left + [u_1 < 0] e_1,      x_2(0) < right - [u_2 > 0] e_2,
    x_2(0) - x_1(0) > gap + [u_1 > 0] e_1 + [u_2 < 0] e_2,

nothing is ever touched, and the orbit tends to one of these.  For given u this is a triangle of the
area (L - e_1 - e_2)^2/2, if e_1 + e_2 <= L.  So, as v_i = (v*(0) + u_i)/m_i, these states are an
open set of the volume

    2/(m_1 m_2) times the integral over 0 < U_1, U_2 < d of (L - D(U_1)/m_1 - D(U_2)/m_2)^2
      = 2/(m_1 m_2) (L^2 d^2 - 2 L d I_1 s_1 + d I_2 s_2 + 2 I_1^2/(m_1 m_2)),

s_k = m_1^-k + m_2^-k, with I_1 = a d^2/2 + b d^3/3 and I_2 = a^2 d^3/3 + a b d^4/2 + b^2 d^5/5, the
integrals of D = a U + b U^2 and of D^2.
"""

from __future__ import annotations

from fractions import Fraction

from cap.checker.flow.free import Free, Velocity
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.reading import number
from cap.checker.kernel.rejection import need
from cap.checker.kernel.shapes import Field, Quantity
from cap.checker.kernel.theorem import BITS
from cap.checker.system.masses import TwoMasses


class Sliding(TwoMasses, Free):
    """Two masses that touch nothing."""

    HINTS = (BITS,)
    # fmt: off
    CLAIMS = (
        Field("v", [Quantity("R omega")] * 2, "v at t = 0", "v", "velocities of the two masses"),
        Field("strokes", [Quantity("R")] * 2, "stroke", "s", "by which x_1 and x_2 vary"),
        Field("turning_times", [Quantity("omega^-1")] * 2, "turn", "t_k",
              "of the turn left and the turn right of both masses, in (0, T)"),
        Field("places", {"left": Quantity("R"), "gap": Quantity("R"), "right": Quantity("R")},
              "bound of the places", "x", "T-periodic orbits that touch nothing are those with "
              "these v and left < x_1, x_2 - x_1 > gap, x_2 < right at t = 0"),
        Field("places_area", Quantity("R^2"), "area of the places", "A_p",
              "L^2/2, L = right - left - gap > 0"),
        Field("multiplier", Quantity(), "multiplier", r"\lambda",
              "((c - f)/(c + f))^2, c the force at the turns; the multipliers are it and 1, twice"),
        Field("basin", {"speed": number, "drift": [number] * 2}, "", "",
              "d and a, b: let m_i (v_i - v_i*) = u_i, |u_i| < d, and e_i = (a |u_i| + b u_i^2)/m_i"
              ": orbits from x_1 > left + [u_1 < 0] e_1, x_2 < right - [u_2 > 0] e_2, x_2 - x_1 > "
              "gap + [u_1 > 0] e_1 + [u_2 < 0] e_2 touch nothing and tend to one of these"),
        Field("basin_volume", Quantity("R^4 omega^2"), "volume of the basin", "V",
              "of these states, in the coordinates x_1, x_2, v_1, v_2"),
    )
    # fmt: on

    def prove(self) -> None:
        """Prove the theorem."""
        self.inverse = [1 / m for m in self.p.masses]
        found = self.velocity()
        self.orbits(found)
        self.confirm(multiplier=self.multiplier(found))
        multiplier = self.claims["multiplier"]
        need(multiplier.lower > 0 and multiplier.upper < 1, "the multiplier is not in (0, 1)")
        self.step("the multipliers are 1, twice, and one in (0, 1), twice")
        self.basin(self.side(found))

    def of_masses(self, q: Interval) -> list[Interval]:
        """Return q/m_1 and q/m_2."""
        return [q * self.number(share) for share in self.inverse]

    def places(self, found: Velocity) -> dict[str, Interval]:
        """Return the bounds of x_1, x_2 - x_1 and x_2 at t = 0."""
        above = found.stroke - found.below
        q = self.inverse[1] - self.inverse[0]
        return {
            "left": self.number(self.p.l) + self.of_masses(found.below)[0],
            "gap": self.number(abs(q)) * (found.below if q > 0 else above),
            "right": self.number(self.p.r) - self.of_masses(above)[1],
        }

    def side(self, found: Velocity) -> Interval:
        """Return L."""
        places = self.places(found)
        return places["right"] - places["left"] - places["gap"]

    def orbits(self, found: Velocity) -> None:
        """Compare what is claimed of the orbits."""
        self.confirm(turning_times=self.turning_times(found))
        self.confirm(v=self.of_masses(found.v), strokes=self.of_masses(found.stroke))
        self.confirm(places=self.places(found))
        L = self.side(found)
        need(L.is_positive(), "there may be no room for two masses")
        self.confirm(places_area=L.square() / 2)
        need(self.claims["places_area"].lower > 0, "the area of the places is not positive")
        self.step("the T-periodic orbits that touch nothing are those claimed, and no others")

    def basin(self, L: Interval) -> None:
        """Prove that the basin is one, and compare its volume."""
        self.drift()
        d, (a, b) = self.claims["basin"]["speed"], self.claims["basin"]["drift"]
        first, second = self.inverse[0] + self.inverse[1], sum(s**2 for s in self.inverse)
        room = L - self.number((a * d + b * d**2) * first)
        need(room.lower >= 0, "the drift may bring the masses to a wall, or together")
        I_1 = a * d**2 / 2 + b * d**3 / 3
        I_2 = a**2 * d**3 / 3 + a * b * d**4 / 2 + b**2 * d**5 / 5
        product = self.inverse[0] * self.inverse[1]
        rest = d * I_2 * second + 2 * I_1**2 * product
        volume = L.square() * self.number(d**2) - L * self.number(2 * d * I_1 * first)
        self.confirm(basin_volume=(volume + self.number(rest)) * self.number(2 * product))
        need(self.claims["basin_volume"].lower > 0, "the volume of the basin is not positive")
        self.step("all orbits from the basin tend to orbits that touch nothing")

    def words(self) -> str:
        """Return the theorem in one line."""
        d, (a, b) = self.claims["basin"]["speed"], self.claims["basin"]["drift"]
        masses: tuple[Fraction, ...] = self.p.masses
        return self.told(_SYSTEM + _ORBITS + _BASIN, d=d, a=a, b=b, m=masses)


_SYSTEM = (
    "m_i x_i'' = F cos(omega t) - f sgn x_i', l < x_1 < x_2 < r, with F = {F}, omega = {omega}, f "
    "= {f}, m_1 = {m[0]}, m_2 = {m[1]}, l = {l}, r = {r}, whatever happens at the walls and when "
    "the masses meet: with T = 2 pi/omega, "
)
_ORBITS = (
    "the T-periodic orbits on which the masses touch neither a wall nor each other are those with "
    "v_1 = v_1* in {v[0]}, v_2 = v_2* in {v[1]} at t = 0 and x_1 > left, x_2 - x_1 > gap, x_2 < "
    "right, left in {places[left]}, gap in {places[gap]}, right in {places[right]}: places with an "
    "area in {places_area}; both masses turn left at a time in {turning_times[0]} and right at one "
    "in {turning_times[1]}, never stick, and have strokes in {strokes[0]} and {strokes[1]}; at "
    "these fixed points of the time-T map, which are not isolated, its derivative has the "
    "multiplier 1, twice, and one in {multiplier}, twice"
)
_BASIN = (
    "; let v_i = v_i* + u_i/m_i, e_i = ({a} |u_i| + {b} u_i^2)/m_i: every orbit with |u_i| < {d}, "
    "x_1 > left + [u_1 < 0] e_1, x_2 < right - [u_2 > 0] e_2, x_2 - x_1 > gap + [u_1 > 0] e_1 + "
    "[u_2 < 0] e_2 at t = 0 touches nothing and tends to one of these orbits; these states are an "
    "open set with a volume in {basin_volume}"
)

THEOREM = Sliding
