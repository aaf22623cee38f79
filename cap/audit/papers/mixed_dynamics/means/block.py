"""A block around a hyperbolic fixed point S of Φ: what its local dynamics proves, elementarily.

Coordinates (ξ, η): z = S + ξ a + η b, a and b near the unstable and the stable direction.  The
block is B = {|ξ| <= h, |η| <= k}.  In balls are proved, for all z in B:

 (1) the orbit from z only hits walls in [0, T];
 (2) Φ'(z) = ((p, q), (r, s)) in these coordinates, with A <= |p|, |q| <= Q, |r| <= C, |s| <= D.

*Cone.*  If c > 0 satisfies C + D c <= c (A - Q c) and A - Q c > 1, then of two points of B with
|Δη| <= c |Δξ| the images satisfy the same, and |Δξ'| >= (A - Q c)|Δξ|: mean value theorem.

*Covering.*  If A h - Q k - e > h and C h + D k + e < k, where S is fixed up to e, then Φ takes
{ξ = ±h} to opposite sides of {|ξ| <= h}, and B into {|η| < k}.  So every arc in B from ξ = -h to
ξ = h contains a closed arc whose image is such an arc again; the nested arcs have a common point,
whose whole forward orbit lies in B: by (1) it never stops.

*Escape.*  Every neighbourhood of S contains a segment from S in the direction ξ.  Its iterates are
arcs from S in the cone, whose length in ξ grows by A - Q c until they reach ξ = ±h, with |η| <= c h
< k; so does the segment in the direction -ξ.  So every neighbourhood of S contains a point that
reaches a given one of the edges {ξ = ±h, |η| <= c h}: if all orbits from this edge stop, S is no
interior point of Ω_NS.
"""

from dataclasses import dataclass
from fractions import Fraction

from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval, matrix
from cap.sets.interval import Ball, Box
from cap.sets.matrix import Matrix

BITS = 160
CONE = Fraction(1, 10)
HEIGHT = Fraction(8, 10**9)  # of the block around the saddle, half


@dataclass(frozen=True)
class Block:
    """The block of half-widths ``h`` and ``k`` around ``centre``, with the frame (a, b)."""

    centre: Box
    frame: Matrix[Ball]
    h: Fraction
    k: Fraction

    def box(self, xi: Ball, eta: Ball) -> Box:
        """Return a box around the points with these coordinates."""
        x, v = matrix.apply(self.frame, (xi, eta))
        return self.centre[0] + x, self.centre[1] + v

    def coordinates(self, state: Box) -> Box:
        """Return (ξ, η) of states."""
        difference = state[0] - self.centre[0], state[1] - self.centre[1]
        return matrix.apply(matrix.inverse(self.frame), difference)

    def covers_itself(self) -> None:
        """Prove the hypotheses of the cone, of covering and of escape, or raise `NotProved`."""
        h, k, c = (interval.ball(q) for q in (self.h, self.k, CONE))
        image = after_periods(PAPER, *self.box(interval.symmetric(h), interval.symmetric(k)), 1)
        hits = all(event.word.startswith("hit") for event in image.events)
        need(hits, "not all orbits from the block only hit walls")
        (p, q), (r, s) = self.conjugated(image.monodromy)
        A, Q, C, D = interval.lower(abs(p)), *(interval.upper(abs(each)) for each in (q, r, s))
        defect = self.coordinates(after_periods(PAPER, *self.centre, 1).state)
        e = interval.upper(abs(defect[0])) + interval.upper(abs(defect[1]))
        need(C + D * c <= c * (A - Q * c), "the cone is not mapped into itself")
        need(A - Q * c > 1, "the cone is not expanded")
        need(A * h - Q * k - e > h, "the block is not stretched across itself", A=A, Q=Q)
        need(C * h + D * k + e < k, "the block is not squeezed into its height", C=C, D=D)
        need(c * h < k, "the cone leaves the block through the wrong side")

    def conjugated(self, m: Matrix[Ball]) -> Matrix[Ball]:
        """Return a derivative in the coordinates of the block."""
        return matrix.product(matrix.inverse(self.frame), matrix.product(m, self.frame))

    def edge(self, side: int) -> Box:
        """Return a box around {ξ = side h, |η| <= c h}."""
        return self.box(
            interval.ball(side * self.h), interval.symmetric(interval.ball(self.h * CONE))
        )


def from_an_edge(periods: int) -> list[str]:
    """Return the events of all orbits from an edge of the block around the saddle.

    Every neighbourhood of the saddle contains a point whose orbit reaches this edge.
    """
    with interval.workprec(BITS):
        around = around_the_saddle(HEIGHT, 2 * HEIGHT)
        around.covers_itself()
        image = after_periods(PAPER, *around.edge(-1), int(periods))
    return [event.word for event in image.events]


def along_an_arc(x: Fraction, v: Fraction, reach: Fraction, periods: int) -> list[list[str]]:
    """Return the events of all orbits from an arc |v' - v| <= ``reach`` before T; stops later on.

    After these periods its image crosses the block around the saddle from side to side, so one of
    the orbits stays in the block for ever.
    """
    with interval.workprec(BITS):
        around = around_the_saddle(HEIGHT, 2 * HEIGHT)
        around.covers_itself()
        start, h, k = interval.ball(x), interval.ball(HEIGHT), interval.ball(2 * HEIGHT)
        arc, left, right = (
            after_periods(PAPER, start, each, int(periods))
            for each in (
                interval.around(v, reach),
                interval.ball(v - reach),
                interval.ball(v + reach),
            )
        )
        need(abs(around.coordinates(arc.state)[1]) < k, "the arc is not within the block's height")
        ends = around.coordinates(left.state)[0], around.coordinates(right.state)[0]
        need(ends[0] > h and ends[1] < -h, "the arc does not cross the block", ends=ends)
        early = [bool(event.time < 2 * interval.pi()) for event in arc.events]
    words = [event.word for event in arc.events]
    later = [word for word in words[sum(early) :] if not word.startswith("hit")]
    return [words[: sum(early)], later]


def around_the_saddle(h: Fraction, k: Fraction) -> Block:
    """Return a block around the saddle of ``saddle.json``; build it inside ``workprec(BITS)``."""
    claims = stored("saddle.json").claims
    ends = [claims[name] for name in ("x", "v")]
    x, v = (interval.ball((each.lower + each.upper) / 2) for each in ends)
    (a, b), (_, d) = after_periods(PAPER, x, v, 1).monodromy
    trace = a + d
    outer = (trace + (trace * trace - 4).sqrt()) / 2
    directions = [_unit((b, multiplier - a)) for multiplier in (outer, 1 / outer)]
    (p, r), (q, s) = directions
    return Block((x, v), ((p, q), (r, s)), h, k)


def _unit(vector: Box) -> Box:
    """Return a vector of about length one, exact, in the same direction."""
    length = (vector[0] * vector[0] + vector[1] * vector[1]).sqrt()
    return interval.point(vector[0] / length), interval.point(vector[1] / length)
