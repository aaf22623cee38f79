"""Two by two matrices over any scalar, as tuples of rows."""

from cap.sets.scalar import S

Matrix = tuple[tuple[S, S], tuple[S, S]]


def product(m: Matrix[S], n: Matrix[S]) -> Matrix[S]:
    """Return the matrix product m n."""
    (a, b), (c, d) = m
    (p, q), (r, s) = n
    return (a * p + b * r, a * q + b * s), (c * p + d * r, c * q + d * s)


def apply(m: Matrix[S], vector: tuple[S, S]) -> tuple[S, S]:
    """Return the product of m with a column."""
    (a, b), (c, d) = m
    x, y = vector
    return a * x + b * y, c * x + d * y


def minus_identity(m: Matrix[S]) -> Matrix[S]:
    """Return m - 1."""
    (a, b), (c, d) = m
    return (a - 1, b), (c, d - 1)


def determinant(m: Matrix[S]) -> S:
    """Return ad - bc."""
    (a, b), (c, d) = m
    return a * d - b * c


def trace(m: Matrix[S]) -> S:
    """Return a + d."""
    return m[0][0] + m[1][1]


def inverse(m: Matrix[S]) -> Matrix[S]:
    """Return the inverse of m; over balls, indeterminate where m may be singular."""
    (a, b), (c, d) = m
    det = determinant(m)
    return (d / det, -b / det), (-c / det, a / det)


def adjugate(m: Matrix[S]) -> Matrix[S]:
    """Return the inverse of m times its determinant."""
    (a, b), (c, d) = m
    return (d, -b), (-c, a)
