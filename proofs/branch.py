"""Theorem (branch).  Let ρ = Rω²/F < (π² - 4)/2, and let the least speed at the
pitchfork be positive (it is for ρ > 0.70407).  Consider the asymmetric T-periodic orbits of

    x'' = F cos ωt - f sgn x',   l < x < r,   elastic walls,   T = 2π/ω,

whose velocity never vanishes and that hit each wall once per period, for all f at once.

 (i)   They are born in the pitchfork at ``f_start`` as f decreases, in pairs: mirror images under
       (x, v, t) -> (l + r - x, -v, t + T/2).  For every f in ``f_range`` there is exactly one
       pair; it is analytic in f.
 (ii)  Its trace and its least speed grow with f.  The least speed vanishes at ``f_end``, where the
       pair ends; without ``f_end`` it is positive throughout ``f_range``.
 (iii) Its trace is 2 cos(2πp/q) for the p/q listed, q <= 8, once each, at an f enclosed, where an
       elliptic orbit has the rotation number p/q; and at no f of ``f_range`` for another one.
 (iv)  For every f in ``f_range`` where the trace is greater than -2, outside the ``exceptions``,
       both orbits are elliptic, without resonance of order <= 4, and τ_1 != 0: by Moser's twist
       theorem each is stable and surrounded by invariant curves.  Each of ``twist_zeros`` contains
       an f with τ_1 = 0.

Proof.  In scaled units the pair is explicit in a parameter δ, half of what the time between the
hits exceeds T/2, and α = f/F decreases in δ on (0, δ_max) (`cap.one_one.closed_form`): uniqueness
and (i) follow where the least speed is positive.  The rest is computed: cells [δ', δ''] cover [0,
δ_end]. On each, the closed form is evaluated over Taylor models in δ, with the derivatives by δ as
a jet over them:

 - after the right hit u has its local minimum on the flight; it is less than u at the hits and at
   the other local minimum (on the first cell, where these are equal at δ = 0, by the derivative),
   so it is the least speed; and its derivative is negative;
 - the trace T has T'(0) = 0, as it is even in δ, T'' < 0 on the first cell, and T' < 0 on the
   others;
 - (1 + T) τ_1, which has no pole at the resonance 1/3, from jets of order three of the two impacts
   over Taylor models (`cap.one_one.transport`, `cap.maps.twist`): its values, where they exclude 0.

Changes of sign of T - 2 cos 2πp/q, of the least speed, and of (1 + T) τ_1 are enclosed by
evaluation at exact δ.  Twist and Moser's theorem are about the map from one right hit to the next,
in (E, t); Φ is conjugate to it, also where the hit is at t = 0.  The ``exceptions`` are the values
of f on cells without a sign, and those at resonances of order <= 4.
"""

from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import ceil
from typing import NamedTuple

from cap.certificate import NONE
from cap.errors import BadInput, NotProved
from cap.floats import candidates
from cap.maps.twist import regular_twist
from cap.one_one.closed_form import asymmetric
from cap.one_one.transport import period_jet
from cap.proofs.branch_curve import Bracket, Curve, Part, decimals
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.one_one import Scale, lemma_1_closed_form
from cap.proofs.options import JOBS, JOURNAL, RANGE_OF_F, range_of_f
from cap.proofs.pitchfork import lemma_2_parabolic, parameters
from cap.sets import interval
from cap.sets.interval import Ball
from cap.sets.jet import Jet
from cap.sets.taylor_model import Domain, TaylorModel
from cap.subdivision import UNDECIDED, Cell, cells_between, subdivide

SUMMARY = "the pair born at the pitchfork, for all f of a range: trace, resonances, twist, end"
GROUP = "family"
SEARCH = candidates.closed_form
OPTIONS = (*RANGE_OF_F, JOBS, JOURNAL)
CHECK = range_of_f

FIRST = Fraction(1, 1000)  # the first cell, at most; no twist is asked for there, where it is
GROWTH = Fraction(6, 5)  # like 1/δ²; those after it grow
LONGEST = Fraction(1, 100)  # to this length
SMALLEST = Fraction(1, 10**9)  # the shortest cell
ORDER = 6  # of the Taylor models
BITS = 120
SHARP = 20  # values are so many times the error of their model; the checker grants a tenth


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    lemma_1_closed_form()
    with interval.workprec(setting.bits):
        scale = Scale(setting)
        branch = Curve(scale, lemma_2_parabolic(scale).alpha)
        end, last = branch.end()
        limits = branch.range(end, last)
        resonances = branch.resonances(last)
        steps = lemma_3_monotone(setting, last, resonances.get(Fraction(1, 2)))
        cells = lemma_4_twist(setting, steps)
        claims, zeros = branch.claims(end, limits, resonances, cells)
    hints = {
        "bits": str(max(setting.checker_bits, BITS)),
        "end": decimals(end) if end else NONE,
        "resonances": [decimals(ends) for ends in resonances.values()],
        "twist_zeros": [decimals(ends) for ends in zeros],
    }
    return settled("branch", setting, parameters(setting), (claims, hints))


class Steps(NamedTuple):
    """Cells that cover the branch: the first, those where it is elliptic, and those beyond."""

    first: Cell
    elliptic: list[Cell]
    beyond: list[Cell]


def lemma_3_monotone(setting: Setting, last: Fraction, parabolic: Bracket | None) -> Steps:
    """*Statement.* Trace and least speed decrease in δ on [0, last].

    *Computed.* `decreases` on cells that grow from the birth on.  One begins where the trace may be
    below -2, at the bracket ``parabolic``, if there is one.
    """
    elliptic = parabolic[0] if parabolic else last
    first, *others = cells_between(_ends(elliptic))
    beyond = cells_between([elliptic, *_steps(elliptic, last)]) if parabolic else []
    p = setting.parameters
    step = partial(examine_monotone, p.R * p.omega**2 / p.F)
    runner = replace(setting.runner, journal=None)
    found = dict(subdivide(step, [first, *others, *beyond], SMALLEST, runner, ""))
    for cell, verdict in found.items():
        if verdict == UNDECIDED:
            words = "trace and least speed may not be monotone in the asymmetry"
            raise NotProved("Lemma 3", words, {"delta": tuple(map(float, cell))})
    first, *rest = found
    return Steps(
        first,
        [cell for cell in rest if cell.upper <= elliptic],
        [cell for cell in rest if cell.upper > elliptic],
    )


def lemma_4_twist(setting: Setting, steps: Steps) -> list[Part]:
    """*Statement.* (1 + T) τ_1 lies in explicit intervals without 0, on cells.

    *Computed.* `examine_twist` on the cells where the pair is elliptic, halved until a sharp
    enclosure excludes 0 or they are short.  The journal is for this, which takes the longest.
    """
    p = setting.parameters
    rho = p.R * p.omega**2 / p.F
    step = partial(examine_twist, rho)
    found = subdivide(step, steps.elliptic, SMALLEST, setting.runner, journal_key(rho))
    signs = [Part(cell, _enclosure(verdict)) for cell, verdict in found]
    others = [Part(cell, None) for cell in (steps.first, *steps.beyond)]
    return sorted(_merged(signs) + others)


def journal_key(rho: Fraction) -> str:
    """Return what the verdicts of a journal depend on, besides the cell."""
    return f"twist along the branch of rho = {rho}, order {ORDER}, {BITS} bits, error 1/{SHARP}"


def _merged(parts: list[Part]) -> list[Part]:
    """Return the cells with neighbours that have no sign made one."""
    merged: list[Part] = []
    for cell, sign in parts:
        if merged and sign is None and merged[-1].twist is None:
            merged[-1] = Part(Cell(merged[-1].cell.lower, cell.upper), None)
        else:
            merged.append(Part(cell, sign))
    return merged


def _ends(last: Fraction) -> list[Fraction]:
    """Return the ends of cells that grow up to the longest."""
    first = min(FIRST, interval.short(last / 8))
    ends, step = [Fraction(0), first], first * (GROWTH - 1)
    while ends[-1] + 2 * step < last and step < LONGEST:
        ends.append(ends[-1] + Fraction(f"{float(step):.1e}"))
        step *= GROWTH
    return ends + _steps(ends[-1], last)


def _steps(first: Fraction, last: Fraction) -> list[Fraction]:
    """Return the ends of equal cells from ``first`` to ``last``, but for the first."""
    number = max(1, ceil((last - first) / LONGEST))
    return [*(round(first + (last - first) * k / number, 6) for k in range(1, number)), last]


def examine_monotone(rho: Fraction, cell: Cell) -> str:
    """Return "-" if trace and least speed certainly decrease on a cell, else `UNDECIDED`."""
    with interval.workprec(BITS):
        delta = _model(cell)
        return "-" if decreases(delta, interval.ball(rho), first=not cell.lower) else UNDECIDED


def examine_twist(rho: Fraction, cell: Cell) -> str:
    """Return an enclosure of (1 + T) τ_1 on a cell without 0, or `UNDECIDED`.

    It is larger by a hundredth than what is proved, so that a looser arithmetic agrees, and
    comes from a sharp model, so that a sharper arithmetic finds it no wider than its width rule
    allows.
    """
    with interval.workprec(BITS):
        E, t = period_jet(asymmetric(_model(cell), interval.ball(rho)), 3)
        lower_left = _sign(t[1, 0].bound())
        if not lower_left:
            return UNDECIDED
        N = regular_twist(E, t, lower_left)
        values = N.bound()
        wider = values + interval.symmetric(values) / 100
        if not (_sign(wider) and is_sharp(N)):
            return UNDECIDED
        size = interval.ends(abs(wider))[1]
        return " ".join(interval.outward(wider, 6 - interval.decade(size)))


def is_sharp(model: TaylorModel) -> bool:
    """Return whether the remainder is certainly a small part of the largest value."""
    return bool(abs(model.remainder) * SHARP < interval.upper(abs(model.bound())))


def _sign(x: Ball) -> int:
    return 1 if x > 0 else -1 if x < 0 else 0


def _enclosure(verdict: str) -> Bracket | None:
    """Return the enclosure that a verdict of `examine_twist` gives."""
    if verdict == UNDECIDED:
        return None
    try:
        low, high = map(interval.stated, verdict.split())
    except (ValueError, ZeroDivisionError):
        low, high = Fraction(0), Fraction(0)
    if not (low <= high and low * high > 0):
        raise BadInput(f"the journal is damaged: {verdict[:40]!r}; remove it")
    return low, high


def _model(cell: Cell) -> TaylorModel:
    """Return δ on a cell."""
    half, middle = (cell.upper - cell.lower) / 2, (cell.upper + cell.lower) / 2
    (delta,) = Domain([interval.ball(half)], ORDER).variables((interval.ball(middle),))
    return delta


def decreases(delta: TaylorModel, rho: Ball, *, first: bool) -> bool:
    """Return whether it is certain that trace and least speed decrease on a cell; see above.

    ``first``: the cell begins at δ = 0, where T' = 0 and both local minima are equal.
    """
    (variable,) = Jet.variables((delta,), 2)
    orbit = asymmetric(variable, rho)
    least, other = orbit.slowest()
    _, u2 = orbit.speeds  # the lower one, as δ > 0
    delay, duration = orbit.delays()[0], orbit.durations[0]

    def certainly(jet: Jet, power: int = 0) -> bool:
        """Return whether this derivative is positive on the cell."""
        return bool(jet.coefficients[power].bound() > 0)

    return (
        all(certainly(q) for q in (delay, duration - delay, u2, u2 - least))
        and certainly(other - least, 1 if first else 0)
        and certainly(-orbit.trace(), 2 if first else 1)
        and certainly(-least, 1)
    )
