"""Theorem (contact_horseshoe).  Let a system be given as data, with a state of two variables, and
g the map from one contact with a guard, just before it, to the next one, if until then nothing else
happens.  If the lemmas succeed, there is a compact set Λ with g(Λ) = Λ such that

 (i)   the topological entropy of g on Λ is at least ``entropy``;
 (ii)  for each n, gⁿ has at least tr(Aⁿ)/mu fixed points in Λ, A the matrix of the coverings;
 (iii) the flow of the motions whose contacts are orbits of g in Λ has at least the topological
       entropy ``per_period``, over one period of the clock.

With ``--sets disjoint`` mu = 1, and g on Λ is semiconjugate onto the one-sided subshift of A; with
``--sets hyperbolic`` Λ is hyperbolic, too, and g on orbits conjugate to the two-sided subshift.

Proof.  (i), (ii): that of `cap.proofs.horseshoe`, with another map; that no other contact, guard or
rest comes before is part of its enclosure (`cap.checker.coverings.contact_map`).  (iii): no flight
from a set lasts longer than a bound; these weigh the paths of coverings
(`cap.checker.coverings.timed`).  The sets are found as in `cap.proofs.map_horseshoe`.
"""

import math
from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

from cap.checker.coverings.contact_map import ContactMap
from cap.checker.coverings.contact_map import Section as Checked
from cap.checker.coverings.covering import Parallelogram
from cap.checker.coverings.timed import confirm_timed
from cap.checker.kernel.doubles import between
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.shapes import matched
from cap.checker.system.given import SYSTEM, model
from cap.checker.system.model import Model
from cap.checker.theorems.contact_horseshoe import WORK, per_unit
from cap.errors import NotProved
from cap.floats import candidates
from cap.maps.graphs import in_time
from cap.proofs.certified import certified
from cap.proofs.contacts import as_parameters
from cap.proofs.coverings import PLACES, SCALE, Asked, Proved, Which, proved
from cap.runner import Runner
from cap.sets import interval
from cap.system.model import System
from cap.system.section import Section, sections

FAR = Fraction(1000)  # no bound of times, at first
PARTS = 4  # of a set, in each direction, on which times are bounded
UNIT = 1000  # times are multiples of 1/UNIT
ROOM, SMALL = Fraction(1, 200), 1 / 64  # of a time; of a part


def prove_any(system: System, effort: int, runner: Runner, which: Which) -> dict[str, Any]:
    """Return a certificate about the contacts with a guard; the guards are tried one by one."""
    reasons = list[str]()
    for section in sections(system):
        try:
            return prove(section, effort, runner, which)
        except NotProved as failure:
            reasons.append(f"contacts with {section.guard} of {section.mode}: {failure}")
    raise NotProved("search", "; ".join(reasons))


def prove(section: Section, effort: int, runner: Runner, which: Which) -> dict[str, Any]:
    """Return a certificate, which the checker accepts; raise `NotProved`."""
    parameters = as_parameters(section.system)
    given = Checked(model(matched(parameters, SYSTEM, "the system")), section.mode, section.guard)
    tell = lambda words: runner.tell(words, None)  # noqa: E731
    reason = "no saddle of the map from contact to contact is found in floats"
    for middle, found in candidates.families_of_contacts(section, effort, tell):
        if found.growth <= 1:
            reason = "no sets that cover each other in two loops are found: more --effort may help"
            continue
        g = ContactMap(given, middle, [FAR] * len(found.sets), WORK // len(found.sets))
        try:
            best = proved(Asked(g), found, runner, which)
            return certified("contact_horseshoe", parameters, _content(g, best, middle), runner)
        except NotProved as failure:
            reason = str(failure)
    raise NotProved("search", reason)


def _content(g: ContactMap, best: Proved, middle: Fraction) -> tuple[Any, Any]:
    """Return claims and hints."""
    times = lemma_3_times(g, best)
    per_period, vector = _in_time(best, times, g.model)
    claims = {
        "mode": g.section.mode,
        "guard": g.section.key,
        **best.claims(1),
        "per_period": interval.decimal(per_period, PLACES),
    }
    hints = {
        **best.hints(),
        "middle": interval.exact_decimal(middle),
        "times": [interval.exact_decimal(tau) for tau in times],
        "timed_vector": [str(v) for v in vector],
    }
    return claims, hints


def lemma_3_times(g: ContactMap, best: Proved) -> list[Fraction]:
    """*Statement.* From a contact in a set it takes at most so long to the next one.

    *Computed.* Flights from parts of the set, which are halved until they have a certain end.
    """
    return [_bound(g.on(i), Parallelogram(numbers)) for i, numbers in enumerate(best.sets)]


def _bound(g: ContactMap, source: Parallelogram) -> Fraction:
    """Return a bound that leaves the checker, which looks at other parts, some room."""
    ends = np.linspace(-1, 1, PARTS + 1).tolist()
    waiting = [(*p, *q) for p in pairwise(ends) for q in pairwise(ends)]
    most = Fraction(0)
    while waiting:
        a, b, c, d = waiting.pop()
        x, y = source.points(between(a, b), between(c, d))
        try:
            flown = g.flown(x, y)
        except Rejected as reason:
            if b - a < SMALL:
                why = f"a flight from a set has no certain end: {reason}"
                raise NotProved("Lemma 3", why) from None
            m, n = (a + b) / 2, (c + d) / 2
            waiting += [(*p, *q) for p in ((a, m), (m, b)) for q in ((c, n), (n, d))]
        else:
            most = max(most, Fraction(flown.duration.upper))
    return Fraction(math.ceil(most * (1 + ROOM) * UNIT), UNIT)


def _in_time(best: Proved, times: Sequence[Fraction], system: Model) -> tuple[Fraction, list[int]]:
    """Return the most entropy per period, to `PLACES`, that an integer vector shows, with it."""
    source = [i for i, targets in enumerate(best.edges) for _ in targets]
    target = [j for targets in best.edges for j in targets]
    v = in_time(np.array(source), np.array(target), np.array([float(tau) for tau in times]))
    vector = [int(Fraction(float(x)) * SCALE) for x in v]
    rates = [
        math.log(sum(vector[j] for j in targets) / n) / float(tau)
        for targets, n, tau in zip(best.edges, vector, times, strict=True)
        if n > 0
    ]
    turns, unit = per_unit(system), Fraction(1, 10**PLACES)
    found = unit * math.ceil(min(rates) / float(turns) / unit)
    while not _holds(best.edges, vector, found * turns, times):
        found -= unit
        if found <= 0:
            raise NotProved("Lemma 3", "the entropy of the flow is not seen to be positive")
    return found, vector


def _holds(
    edges: list[list[int]], vector: list[int], rate: Fraction, times: Sequence[Fraction]
) -> bool:
    try:
        confirm_timed(edges, vector, rate, times)
    except Rejected:
        return False
    return True
