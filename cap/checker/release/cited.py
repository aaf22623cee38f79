"""What is cited about the entropy of a map of an interval with one critical point."""

from __future__ import annotations

from cap.checker.kernel.citation import cite

_POSITIVE = (
    "only where the lower end of entropy is positive: then the entropy of the continuous map G of "
    "the interval is"
)
# fmt: off
ENTROPY = (
    cite(
        "Milnor-Thurston",
        "Milnor and Thurston, On iterated maps of the interval, Springer LNM 1342, 1988",
        ("unimodal", "G is continuous on the interval, maps it into itself, and has one "
         "critical point there, on both sides of which it is strictly monotone",
         "interval, itinerary, critical_point"),
        ("order", "the kneading sequence of G is decided up to where it differs from those of "
         "the tent maps with the slopes exp(lower) and exp(upper), lower and upper the ends "
         "of entropy (if lower = 0, from none; if upper = 0, from the limit of period "
         "doubling)", "kneading, entropy"),
    ),
    cite(
        "Misiurewicz",
        "Misiurewicz, Horseshoes for mappings of the interval, Bull. Acad. Polon. Sci. 27, "
        "1979",
        ("positive", _POSITIVE, "entropy"),
    ),
    cite(
        "Li-Yorke",
        "Li and Yorke, Period three implies chaos, Amer. Math. Monthly 82, 1975; Block and "
        "Coppel, Dynamics in One Dimension, Springer LNM 1513, 1992",
        ("positive", _POSITIVE, "entropy"),
    ),
)
# fmt: on
