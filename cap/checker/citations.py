"""The theorems on paper that are used, their hypotheses, and the claims that discharge these."""

from __future__ import annotations


def _cite(theorem: str, reference: str, *hypotheses: tuple[str, str, str]) -> dict[str, object]:
    """Return a citation; a hypothesis is (name, statement, claims separated by commas)."""
    stated = [{"name": n, "statement": s, "by": by.split(", ")} for n, s, by in hypotheses]
    return {"theorem": theorem, "reference": reference, "hypotheses": stated}


def _krawczyk(smooth: str, inclusion: str, by: str) -> dict[str, object]:
    """Return the citation of Krawczyk with its hypotheses, discharged by these claims."""
    return _cite(
        "Krawczyk",
        "Neumaier, Interval Methods for Systems of Equations, 1990, Section 5.1",
        ("smooth", smooth, by),
        ("inclusion", inclusion, by),
    )


_KRAWCZYK = _krawczyk(
    "Phi is continuously differentiable on the box: "
    "all hits are transverse and no velocity vanishes",
    "K(box) lies in the interior of the box",
    "box",
)
_PERIODIC = _krawczyk(
    "Phi^n, n the period, is continuously differentiable on the box: all hits and stops are "
    "transverse, and every stick and capture ends at a fixed time",
    "K(box) lies in the interior of the box",
    "box",
)
_PERSISTENCE = _krawczyk(
    "Phi is continuously differentiable on box, and on each box of range for all its epsilon and "
    "mu: all hits are transverse and no velocity vanishes",
    "K(box) lies in the interior of the box, and so does K of each box of range, formed with all "
    "its epsilon and mu",
    "box, range",
)
_MOSER = _cite(
    "Moser twist theorem",
    "Siegel and Moser, Lectures on Celestial Mechanics, 1971, Chapter III; "
    "Theorem kam of the paper",
    (
        "H1",
        "the orbit has finitely many hits, all transverse, no turning and no sticking",
        "hit_times, hit_speeds, least_speed",
    ),
    (
        "H2",
        "Phi is exact symplectic near the fixed point: "
        "flights and hits preserve dx^dv, and a disk is simply connected",
        "box",
    ),
    (
        "H3",
        "Phi is real analytic near the fixed point: "
        "the hit times are, by the implicit function theorem",
        "hit_speeds",
    ),
    ("H4", "the eigenvalues of the Jacobian are exp(+-i Theta), 0 < |Theta| < pi", "trace"),
    ("H5", "no resonance of order at most four", "rotation_number, resonance_distances"),
    ("H6", "the first Birkhoff twist coefficient does not vanish", "twist"),
)
_HADAMARD_PERRON = _cite(
    "Hadamard-Perron",
    "Katok and Hasselblatt, Introduction to the Modern Theory of Dynamical Systems, 1995, "
    "Theorem 6.2.8",
    (
        "smooth",
        "Phi is real analytic near the fixed point: "
        "all hits are transverse and no velocity vanishes",
        "hit_speeds, least_speed",
    ),
    (
        "hyperbolic",
        "one eigenvalue of the Jacobian lies outside the unit circle and one inside",
        "multipliers",
    ),
)
_MOORE = _cite(
    "Moore",
    "Neumaier, Interval Methods for Systems of Equations, 1990, Section 5.1",
    (
        "inclusion",
        "Newton's operator of Psi, m - Psi(m)/Psi'(X), maps X into X: "
        "X contains exactly one zero of Psi",
        "paper_roots",
    ),
)
_MOSER_ON_A_BRANCH = _cite(
    "Moser twist theorem",
    "Siegel and Moser, Lectures on Celestial Mechanics, 1971, Chapter III; "
    "Theorem kam of the paper",
    (
        "H1",
        "for every f in f_range, both orbits of the pair hit each wall once in a period, "
        "transversely, and never turn or stick",
        "f_range, cells",
    ),
    (
        "H2",
        "the map from one hit of r to the next, in time and energy, to which Phi is conjugate, is "
        "exact symplectic near the fixed point: flights and hits preserve dx^dv, and a disk is "
        "simply connected",
        "f_range, cells",
    ),
    (
        "H3",
        "this map is real analytic near the fixed point: "
        "the hit times are, by the implicit function theorem",
        "f_range, cells",
    ),
    (
        "H4",
        "trace > -2 is assumed and trace < 2 is proved: "
        "the eigenvalues of the Jacobian are exp(+-i Theta), 0 < |Theta| < pi",
        "cells, resonances",
    ),
    (
        "H5",
        "no resonance of order at most four, for f outside the exceptions",
        "resonances, exceptions",
    ),
    (
        "H6",
        "the first Birkhoff twist coefficient does not vanish, for f outside the exceptions",
        "cells, twist_zeros, exceptions",
    ),
)
CITES: dict[str, list[dict[str, object]]] = {
    "elliptic": [_KRAWCZYK, _MOSER],
    "saddle": [_KRAWCZYK, _HADAMARD_PERRON],
    "periodic": [_PERIODIC],
    "persistence": [_PERSISTENCE],
    "capture": [],
    "symmetric": [_MOORE],
    "pitchfork": [],
    "branch": [_MOSER_ON_A_BRANCH],
    "impulse": [],
}
