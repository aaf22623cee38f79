"""Section 6: what is concluded from the Melnikov function."""

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import symbols
from cap.audit.means.balls import pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.verdict import Verdict, corrected, imprecise, refuted


@claim(
    "eq:Melnikov-final",
    Kind.STEP,
    stated="the Melnikov theorem guarantees a transverse intersection",
)
def exponentially_small_splitting() -> Verdict:
    """A simple zero of M guarantees a transverse intersection of W^s and W^u."""
    w, lam = symbols("omega lambda")
    splitting = (w / lam) / sp.sinh(sp.pi * w / (2 * lam))
    need(sp.limit(splitting.subs(w, 1) / lam**8, lam, 0, "+") == 0, "the splitting is a power")
    return refuted(
        "not here: the splitting A is smaller than every power of λ*, hence of μ, while the error "
        "of the first-order method is a power of μ. Exponentially small splitting needs its own "
        "theory",
        "A/λ*⁸ tends to 0, by sympy; likewise for every power. The textbook theorem has H₀ fixed "
        "while the perturbation tends to 0.",
        proof="melnikov.md#splitting-beyond-all-orders",
    )


@claim("thm:melnikov", Kind.THEOREM, stated="an invariant hyperbolic Cantor set, Bernoulli shift")
def horseshoe() -> Verdict:
    """Near a saddle Φ has an invariant hyperbolic Cantor set in Ω_NS on which an iterate is
    conjugate to the shift on two symbols.
    """
    found = stored("homoclinic.json")
    need(at_the_paper(found), "it is at other parameters")
    need(found.claims["trace"].lower > 2, "it is no saddle")
    points = found.claims["points"]
    need(len(points) > 0, "there is no homoclinic point")
    x, v = found.claims["x"], found.claims["v"]
    angles = " and ".join(pair(each["angle"], 2) for each in points)
    return corrected(
        "of such a set there is one at the paper's parameters, by another proof: the curves of the "
        f"saddle with x in {pair(x, 4)}, v in {pair(v, 4)} cross transversely, at angles in "
        f"{angles} degrees, in points from which orbits never stop, so (Smale and Birkhoff) some "
        "iterate of Φ has a horseshoe of such states. Neither a fold nor a Melnikov function is "
        "near, and which iterate it is, is not known",
        "Stored certificate of transverse homoclinic points.",
        certificate="homoclinic.json",
    )


@claim("thm:melnikov", Kind.STEP, stated="Smale-Birkhoff for f = Φ^N")
def smale_birkhoff() -> Verdict:
    """If the hyperbolic fixed point has a transverse homoclinic point, some iterate is conjugate to
    the shift on two symbols on an invariant Cantor set.
    """
    growth = max(sp.Matrix([[1, 1], [1, 1]]).eigenvals())
    need(growth == 2, "the shift on two symbols has another growth rate")
    return imprecise(
        "true as a theorem (Smale-Birkhoff), Φ being a diffeomorphism near the saddle; its "
        "hypotheses are not shown here (they are in homoclinic.json). Two symbols for Φ^N mean an "
        "entropy of at least (log 2)/N for Φ, and N is not given, so no rate follows",
        "h(Φ^N) = N h(Φ).",
    )


@claim("def:melnikov", Kind.STEP, stated="absolute convergence, as {H₀, H₁} vanishes at the saddle")
def convergence() -> Verdict:
    """The integral converges absolutely because {H₀, H₁} vanishes at the saddle at an exponential
    rate, by eq:varphi-tanh.
    """
    s = symbols("s")
    stated = sp.pi - 2 * sp.atan(sp.sinh(s))
    need(sp.simplify(sp.limit(stated, s, sp.oo)) == 0, "the profile tends elsewhere")
    rate = sp.limit(sp.sech(s) * sp.exp(s), s, sp.oo)
    need(rate == 2, "the decay is another")
    return corrected(
        "true for the separatrix φ = 2 arctan sinh(λt), which tends to the saddle like exp(-λ|t|); "
        "eq:varphi-tanh tends to the center",
        "Limits by sympy.",
    )
