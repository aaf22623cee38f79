"""A peer: the same proof written straightforwardly in mpmath.iv, to compare speeds with.

mpmath.iv is not rigorous (its exp, log and atan fail at rounding level), and this is no proof: it
checks neither the sign of the velocity nor that no other event happens.
"""

from mpmath import iv

GUESS = ("0.10027988984419672", "0.54194330676645946")
HITS = ("1.09917291071222059", "3.51609044140710519")
C = (("-1.0488173549", "1.3363206259"), ("-0.34247556510", "0.048817354932"))


def strobe(x, v, windows, alpha):
    """Return (x, v) at T and the monodromy, for hits in ``windows``, naive interval products."""
    A, B, s, now = v, x + 1, 1, iv.mpf(0)
    m = [[iv.mpf(1), iv.mpf(0)], [iv.mpf(0), iv.mpf(1)]]
    for window in windows:
        t, wall = window, iv.mpf(s)
        for _ in range(3):
            c = iv.mpf(t.mid)
            gap = B + A * c - iv.cos(c) - s * alpha * c * c / 2 - wall
            t = c - gap / (A + iv.sin(t) - s * alpha * t)
        sin, cos = iv.sin(t), iv.cos(t)
        (a, b), (c, d) = m
        a, b = a + (t - now) * c, b + (t - now) * d
        salt = 2 * cos / (A + sin - s * alpha * t)
        m = [[-a, -b], [salt * a - c, salt * b - d]]
        A, s, now = -A - 2 * sin, -s, t
        B = wall - A * t + cos + s * alpha * t * t / 2
    T = 2 * iv.pi
    (a, b), (c, d) = m
    m = [[a + (T - now) * c, b + (T - now) * d], [c, d]]
    return B + A * T - 1 - s * alpha * T * T / 2, A - s * alpha * T, m


def existence(radius="1e-9"):
    """Return K - m, the trace and cos Θ over the box of half-width ``radius`` around the guess."""
    alpha = iv.mpf(2) / 5
    r = iv.mpf(["-" + radius, radius])
    centre = [iv.mpf(g) for g in GUESS]
    windows = [iv.mpf(t) + 40 * r for t in HITS]
    x, v, m = strobe(centre[0] + r, centre[1] + r, windows, alpha)
    x, v, _ = strobe(*centre, windows, alpha)
    g, h = x - centre[0], v - centre[1]
    c = [[iv.mpf(q) for q in row] for row in C]
    (a, b), (e, d) = m
    slope = [[a - 1, b], [e, d - 1]]
    k = []
    for i in range(2):
        p = c[i][0] * slope[0][0] + c[i][1] * slope[1][0]
        q = c[i][0] * slope[0][1] + c[i][1] * slope[1][1]
        k.append(-(c[i][0] * g + c[i][1] * h) + ((i == 0) - p) * r + ((i == 1) - q) * r)
    return k, a + d, (a + d) / 2
