"""Theorem (map_horseshoe).  Let g be a map of the plane or of a torus, given by formulas.  If the
lemmas succeed, there is a compact set Λ with g(Λ) = Λ such that

 (i)   the topological entropy of g on Λ is at least ``entropy``;
 (ii)  for each n, gⁿ has at least tr(Aⁿ)/mu fixed points in Λ, A the matrix of the coverings.

With ``--sets disjoint`` mu = 1, and g on Λ is semiconjugate onto the one-sided subshift of A; with
``--sets hyperbolic`` Λ is hyperbolic, too, and g on orbits conjugate to the two-sided subshift.

Proof.  That of `cap.proofs.horseshoe`, with another map (`cap.checker.coverings.formulas`).  The
sets are told apart by words of symbols: the cells of a grid, and whether g keeps the orientation of
the unstable directions.  Nothing rests on that.
"""

from typing import Any

from cap.areas.parallelograms import planar
from cap.checker.coverings.formulas import Map as Doubles
from cap.checker.coverings.formulas import formulas
from cap.checker.kernel.shapes import matched
from cap.checker.theorems.map_horseshoe import MapHorseshoe
from cap.floats import candidates
from cap.proofs.certified import certified
from cap.proofs.contacts import terms
from cap.proofs.coverings import Asked, Which, first_that_grows
from cap.runner import Runner
from cap.system.planar import Map


def prove(given: Map, effort: int, runner: Runner, which: Which) -> dict[str, Any]:
    """Return a certificate, which the checker accepts; raise `NotProved`."""
    parameters = as_parameters(given)
    exact = Doubles(formulas(matched(parameters, MapHorseshoe.PARAMETERS, "the map")))
    g = Asked(exact, planar.formulas(given))
    tell = lambda words: runner.tell(words, None)  # noqa: E731
    found = candidates.families_by_cells(candidates.formulas(given), effort, tell)
    best = first_that_grows(g, found, runner, which)
    return certified("map_horseshoe", parameters, (best.claims(1), best.hints()), runner)


def as_parameters(given: Map) -> dict[str, Any]:
    """Return a map in the form that a certificate holds."""
    image = {z: terms(q, f"the image of {z}") for z, q in given.image.items()}
    return {
        "state": list(given.state),
        "image": image,
        **({"torus": "1"} if given.torus else {}),
    }
