"""Theorem (horseshoe).  Let e = 1, μ = 0, 0 < f < F, and Φ the map of (x, v) over the period T.

σ is the flow over half a period from t = 0, followed by the symmetry (x, v) -> (l + r - x, -v):
σ² = Φ.  If the lemmas succeed, there is a compact set Λ with σ(Λ) = Λ = Φ(Λ) such that

 (i)   motions from Λ never have the velocity 0, neither later nor before;
 (ii)  the topological entropy of Φ on Λ is at least ``entropy``;
 (iii) for each n, σⁿ has at least tr(Aⁿ)/mu fixed points in Λ, A the matrix of the coverings.

With ``--sets disjoint`` the sets are disjoint: then mu = 1, and σ on Λ is semiconjugate onto the
subshift of A.  The entropy is smaller then.  With ``--sets hyperbolic`` cones are mapped into cones
along all coverings, too: Λ is hyperbolic, and σ on it conjugate to the two-sided subshift (Lemma 3:
`cap.proofs.cones`).

Proof.  Parallelograms cover each other under σ (Lemma 1).  Along each path of coverings there is an
orbit.  Sets may overlap; no two different paths with the same ends have all their sets between
overlapping (Lemma 2): so the orbits along the paths from i to j are apart at some time, and h >=
log ρ(A).  ρ(A) is bounded from below by an integer vector.  What the lemmas say, and why they
suffice: `cap.checker.coverings.covering`, `.graph`, `.half_period`.

The sets are found in floats, and nothing rests on that: pieces of the unstable manifold of a
saddle, told apart by words of symbols before and after, are made into parallelograms, whose sizes
grow until they cover those that follow them.  ``--effort`` is the length of the words.
"""

from fractions import Fraction

from cap.areas.parallelograms import planar
from cap.checker.coverings.half_period import HalfPeriod
from cap.errors import BadInput
from cap.floats import candidates
from cap.option import Option, choice, count
from cap.proofs.coverings import ABOUT, WHICH, Asked, Proved, first_that_grows
from cap.proofs.fixed_point import Proof, Setting, settled
from cap.proofs.options import JOBS
from cap.runner import Runner

SUMMARY = "entropy of motions that never stop: parallelograms that cover each other"
GROUP = "states"
SEARCH = candidates.every_motion
CHECKING = 0.3

USUAL = 8
EFFORT = Option(
    "effort",
    count(1, 9),
    f"length of the words by which sets are told apart, 1 to 9 (default {USUAL}); longer ones give "
    "more sets, often more entropy, and take longer",
    "N",
    default=USUAL,
)
SETS = Option(
    "sets",
    choice(*WHICH),
    ABOUT,
    "WHICH",
    default="any",
)
OPTIONS = (EFFORT, SETS, JOBS)


def prove(setting: Setting) -> Proof:
    """Prove the theorem; there is no box whose size is left to choose."""
    p = setting.parameters
    if not (p.f > 0 and p.conserves):
        raise BadInput("the theorem horseshoe needs f > 0, e = 1 and mu = 0")
    best = _best(setting, p.f / p.F, p.R * p.omega**2 / (2 * p.F))
    claims, hints = best.claims(2), best.hints()
    return settled("horseshoe", setting, p.elastic_strings(), (claims, hints))


def _best(setting: Setting, phi: Fraction, a: Fraction) -> Proved:
    """Return what is proved at the first saddle whose family grows."""
    runner: Runner = setting.runner
    tell = lambda words: runner.tell(words, None)  # noqa: E731
    sigma = candidates.half_period(float(phi), float(a))
    found = candidates.families(sigma, setting.of(EFFORT), tell)
    g = Asked(HalfPeriod(phi, a), planar.half_period(phi, a))
    return first_that_grows(g, found, runner, setting.of(SETS))
