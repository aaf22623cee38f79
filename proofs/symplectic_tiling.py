"""Lemmas of `cap.proofs.symplectic`: the polytope of configurations, and when its mirrors tile.

In ξ_i = sqrt(m_i) x_i the configurations l <= x_1 <= .. <= x_N <= r are a simplex with N + 1 faces:
the wall l, the contacts of i and i + 1, the wall r, in this order.  Faces that are not neighbours
in it are orthogonal.  If its reflections have it as a fundamental domain, its angles are π/k, k =
2, 3, ..; conversely, if they are, it is one (Coxeter; Humphreys, Reflection Groups and Coxeter
Groups, chapter 4).  For N = 2 the angles make an elementary equation: π/j + π/k = π/2, that is (j -
2)(k - 2) = 4.  For any N the diagram is a path of N + 1 nodes without a label 2, so by the
classification of the affine groups (same book, chapters 2 and 4) it is C̃_N, or G̃_2, or F̃_4.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import sympy as sp

from cap.proofs.identities import identity, need
from cap.proofs.symbolic import Lemma

GROUPS = {  # the labels k of neighbouring faces, whose angle is π/k, and the masses
    "C~2": ((4, 4), (1, 1)),
    "G~2": ((3, 6), (3, 1)),
    "C~3": ((4, 3, 4), (1, 1, 1)),
    "C~4": ((4, 3, 3, 4), (1, 1, 1, 1)),
    "F~4": ((3, 3, 4, 3), (6, 2, 1, 3)),
}


def squares(m: Sequence[Any]) -> list[Any]:
    """Return cos² of the angles of neighbouring faces, from their normals."""
    inner = [sp.Matrix(normal) for normal in _normals(m)]
    return [
        sp.cancel((a.T * b)[0] ** 2 / ((a.T * a)[0] * (b.T * b)[0])) for a, b in pairwise(inner)
    ]


def _normals(m: Sequence[Any]) -> list[list[Any]]:
    """Return the normals of the faces, outwards, in the coordinates ξ."""
    n, root = len(m), [1 / sp.sqrt(each) for each in m]
    rows = [[0] * n for _ in range(n + 1)]
    rows[0][0], rows[n][n - 1] = -1, 1
    for i in range(1, n):
        rows[i][i - 1], rows[i][i] = root[i - 1], -root[i]
    return rows


def angles() -> Lemma:
    """*Statement.* The dihedral angles of the polytope, for all masses."""
    m = sp.symbols("m1:5", positive=True)
    wall, contact, _, last = squares(m[:3])[0], *squares(m)[1:3], squares(m)[-1]
    normals = [sp.Matrix(row) for row in _normals(m)]
    apart = [
        (a.T * b)[0] for i, a in enumerate(normals) for j, b in enumerate(normals) if j > i + 1
    ]
    return Lemma(
        "The angles of the polytope: wall and contact, contacts of neighbours; all others pi/2.",
        (
            identity("wall l, contact 12: cos^2 = m2/(m1 + m2)", wall, m[1] / (m[0] + m[1])),
            identity(
                "contacts 12, 23: cos^2 = m1 m3/((m1 + m2)(m2 + m3))",
                contact,
                m[0] * m[2] / ((m[0] + m[1]) * (m[1] + m[2])),
            ),
            identity("contact, wall r: cos^2 = m3/(m3 + m4)", last, m[2] / (m[2] + m[3])),
            identity(
                "faces that are not neighbours are orthogonal", sp.Matrix(apart), _zeros(apart)
            ),
        ),
    )


def _zeros(entries: Sequence[Any]) -> Any:
    return sp.zeros(len(entries), 1)


def tiling() -> Lemma:
    """*Statement.* N = 2: the reflections tile if and only if m_2/m_1 is 1, 3 or 1/3.

    *Proof.* (j - 2)(k - 2) = 4 with j, k >= 3 has the solutions (3, 6), (4, 4), (6, 3); the angle
    π/j at the wall l has tan² = m_1/m_2, by `angles`.  For more masses the classification gives the
    labels, and each label the ratio to the next mass: equal masses, and 6 : 2 : 1 : 3, reversed or
    not, for N = 4.
    """
    pairs = [(j, k) for j in range(3, 7) for k in range(3, 7) if (j - 2) * (k - 2) == 4]
    ratios = {sp.tan(sp.pi / j) ** 2 for j, _ in pairs}
    tangent = 1 / squares(sp.symbols("m1:3", positive=True))[0] - 1
    m1, m2 = sp.symbols("m1:3", positive=True)
    return Lemma(
        "The reflections have the polytope as a fundamental domain if and only if all masses are "
        "equal, or N = 2 and m1 : m2 = 3 : 1, or N = 4 and m = 6 : 2 : 1 : 3, or these reversed.",
        (
            identity("N = 2: tan^2 of the angle at l is m1/m2", tangent, m1 / m2),
            need(ratios == {1, 3, sp.Rational(1, 3)}, "1/j + 1/k = 1/2: m1/m2 = 1, 3, 1/3"),
            *_equal(),
            *(_group(name) for name in GROUPS),
        ),
    )


def _equal() -> tuple[str, ...]:
    """The angles of C̃_N, from the wall l on, are those of equal masses and of no others."""
    m, n = sp.symbols("m n", positive=True)  # n the mass after those that are equal to m
    at_wall, between = squares((m, n))[0] - sp.Rational(1, 2), squares((m, m, n))[1]
    return (
        identity("C~N: cos^2 = 1/2 at l only if m2 = m1", at_wall, (n - m) / (m + n) / 2),
        identity(
            "C~N: then cos^2 = 1/4 only if the next mass is m1, and so on",
            between - sp.Rational(1, 4),
            (n - m) / (m + n) / 4,
        ),
        identity("C~N: and cos^2 = 1/2 at r", squares((m, m))[1], sp.Rational(1, 2)),
    )


def masses_of(labels: Sequence[int]) -> list[Any]:
    """Return the masses, the first 1, that have these angles; the last label is not used."""
    cosine = [sp.cos(sp.pi / k) ** 2 for k in labels]
    m = [sp.Integer(1), cosine[0] / (1 - cosine[0])]
    for square in cosine[1:-1]:
        weight = square * (m[-2] + m[-1]) / m[-2]  # = m3/(m2 + m3)
        m.append(sp.nsimplify(weight * m[-1] / (1 - weight)))
    return m


def _group(name: str) -> str:
    labels, masses = GROUPS[name]
    only = [each * masses[0] for each in masses_of(labels)]
    need(only == list(masses), f"{name}: other masses", found=only)
    return identity(
        f"{name}: angles pi/{', pi/'.join(map(str, labels))} at m = {masses}, and at no others",
        sp.Matrix(squares(masses)),
        sp.Matrix([sp.cos(sp.pi / k) ** 2 for k in labels]),
    )
