"""A test tool: valid certificates of ``periodic`` and ``persistence``, made in mpmath.

Nothing here is rigorous: margins are guessed, and the tests show that the checker accepts them.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import pairwise, product

from mpmath import mp, mpf

from cap.checker.theorems import load
from checker.forge import _decimal
from checker.hybrid import Flow

PAPER = {"F": "1", "omega": "1", "f": "2/5", "l": "-1", "r": "1"}
STRONG = PAPER | {"F": "3", "e": "1", "mu": "0"}
PERIODIC = {
    "focus": {"parameters": STRONG, "orbit": ("0.40644183147672164", "-0.6707588001659407")},
    "saddle": {"parameters": STRONG, "orbit": ("0.1992", "-1.4002"), "radius": "1e-4"},
    "stick": {
        "parameters": PAPER | {"f": "1/10", "e": "7/10", "mu": "1/5"},
        "orbit": ("-0.11635826810914318", "0.763498901925953"),
    },
    "viscous": {
        "parameters": STRONG | {"e": "7/10", "mu": "1/5"},
        "orbit": ("0.8678394622458008", "2.4906758279041306"),
    },
    "elliptic": {
        "parameters": PAPER | {"e": "1", "mu": "0"},
        "orbit": ("0.10027988984419", "0.54194333067646"),
    },
    "damped": {
        "parameters": PAPER | {"e": "999/1000", "mu": "1/1000"},
        "orbit": ("0.1003", "0.5419"),
        "basin": "0.00002",
    },
    "double": {
        "parameters": PAPER | {"f": "1/10", "e": "9/10", "mu": "0"},
        "orbit": ("0.43316403872607256", "-0.8356078724754201"),
        "periods": 2,
        "radius": "0.00001",
        "basin": "0.000001",
    },
    "captured": {
        "parameters": PAPER | {"l": "-3/20", "r": "3/20", "e": "3/10", "mu": "0"},
        "orbit": ("0.0437114115213679", "0.4528033467002044"),
        "below": "0.05",
        "held": ["0.7", "3.85"],
    },
}


def fixed_point(flow, x, v, periods=1, below=None):
    """Return the fixed point near (x, v) by Newton's method."""
    z = mp.matrix([mpf(x), mpf(v)])
    for _ in range(14):
        _, end, J = flow.run(z[0], z[1], periods, below)
        step = mp.lu_solve(J - mp.eye(2), mp.matrix(end) - z)
        z = z - step
        if mp.norm(step) < mpf(10) ** (8 - mp.dps):
            break
    return z


def claim(value, digits, unit=1):
    """Return an enclosure of the value that is as narrow as its digits demand."""
    size = max(abs(value), mpf(unit)) * mpf(10) ** -(digits + 1)
    return [_decimal(value - 3 * size, digits + 10), _decimal(value + 3 * size, digits + 10)]


def around(value, reach, places=25):
    """Return an interval around a value."""
    return [_decimal(value - reach, places), _decimal(value + reach, places)]


def windows(flows, box, periods=1, *, captures=(None, None), margin="1e-7"):
    """Return time windows of the events of all orbits from a box, and the itinerary.

    Captures are a speed below which they are assumed, and the times at which their windows end.
    """
    corners, (below, held) = list(product(*box)), captures
    runs = [flow.run(x, v, periods, below)[0] for flow in flows for x, v in corners]
    words = [e.word for e in runs[0]]
    result, held = [], list(held or ())
    for n, word in enumerate(words):
        times = [run[n].t for run in runs]
        reach = (max(times) - min(times)) / 5 + mpf(margin)
        result.append([_decimal(min(times) - reach, 15), _decimal(max(times) + reach, 15)])
        if word.startswith("capture"):
            result[-1] = [result[-2][0], held.pop(0)]
    return result, words


def multipliers(J, digits, exact):
    """Return the claims about the eigenvalues, the larger modulus first."""
    trace, det = J[0, 0] + J[1, 1], J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
    if exact == 0:
        return [claim(trace, digits), ["0", "0"]]
    root = trace**2 / 4 - det
    if root < 0:
        im = mp.sqrt(-root)
        parts = [(trace / 2, im), (trace / 2, -im)]
        return [{"re": claim(a, digits), "im": claim(b, digits)} for a, b in parts]
    larger = trace / 2 + mp.sign(trace) * mp.sqrt(root)
    return [claim(larger, digits), claim(det / larger, digits)]


def kind_of(trace, det, exact):
    """Return the type of a fixed point."""
    if abs(trace) >= 1 + det:
        return "saddle" if trace > 0 else "flip saddle"
    if exact is not None:
        return "elliptic" if exact else "superstable"
    return "sink focus" if trace**2 < 4 * det else "sink node"


def adapted(J, size):
    """Return a matrix W for which W J W^-1 is nearly normal, and a contraction."""
    if mp.norm(J) == 0:
        S, modulus = mp.eye(2), 0
    else:
        values, vectors = mp.eig(J)
        columns = [vectors[:, 0], vectors[:, 1]]
        if abs(mp.im(values[0])) > 0:
            columns = [columns[0].apply(mp.re), columns[0].apply(mp.im)]
        S = mp.matrix([[mp.re(q[i]) for q in columns] for i in (0, 1)])
        modulus = max(abs(q) for q in values)
    W = S**-1 / size
    rows = [[_decimal(W[i, j], 12) for j in (0, 1)] for i in (0, 1)]
    return {"matrix": rows, "contraction": _decimal((3 + modulus) / 4, 6)}


def forge_periodic(name="focus", *, theorem="periodic", digits=20, **changes):
    """Return a valid certificate of a periodic orbit."""
    given = {"periods": 1, "radius": "0.001", "basin": "0.0002", "below": None, "held": None}
    given |= PERIODIC[name] | changes
    periods, below, held = (given[k] for k in ("periods", "below", "held"))
    with mp.workdps(2 * digits + 30):
        below = below and mpf(below)
        p, rho = given["parameters"], mpf(given["radius"])
        flow = Flow(p)
        x, v = fixed_point(flow, *given["orbit"], periods, below)
        events, _, J = flow.run(x, v, periods, below)
        box = [(q - rho, q + rho) for q in (x, v)]
        times, words = windows([flow], box, periods, captures=(below, held))
        R, w = flow.r - flow.l, flow.omega
        kinds = {word.split()[0] for word in words}
        exact = 0 if kinds & {"stick", "capture"} else None
        if flow.e == 1 and flow.mu == 0 and kinds == {"hit"}:
            exact = 1
        trace, det = J[0, 0] + J[1, 1], J[0, 0] * J[1, 1] - J[0, 1] * J[1, 0]
        turns = [abs(e.force) for e in events if e.word.startswith("turn")]
        units = [[1, 1 / w], [w, 1]]
        claims = {
            "period": str(periods),
            "itinerary": words,
            "box": {
                k: [_decimal(a, 25), _decimal(b, 25)] for k, (a, b) in zip("xv", box, strict=True)
            },
            "x": claim(x, digits, R),
            "v": claim(v, digits, R * w),
            "event_times": [
                times[n] if e.word.startswith("capture") else claim(e.t, digits, 1 / w)
                for n, e in enumerate(events)
            ],
            "hit_speeds": [
                claim(e.speed, digits, R * w) for e in events if e.word.startswith("hit")
            ],
            "turning_factors": [claim((a - flow.f) / (a + flow.f), digits) for a in turns],
            "jacobian": [[claim(J[i, j], digits, units[i][j]) for j in (0, 1)] for i in (0, 1)],
            "trace": claim(trace, digits),
            "determinant": claim(det, digits) if exact is None else [str(exact)] * 2,
            "multipliers": multipliers(J, digits, exact),
            "type": kind_of(trace, det, exact),
        }
        if claims["type"] in ("superstable", "sink focus", "sink node"):
            claims["basin"] = adapted(J, mpf(given["basin"]))
        hints = hints_of(J, (x, v), digits + 10) | {
            "bits": str(int(digits * 3.33) + 110),
            "radius": _decimal(mpf(10) ** -(digits // 2 + 5), digits + 20),
            "events": times,
        }
    return envelope(theorem, p, digits, claims, hints)


@cache
def valid(name):
    """Return the valid certificate of an orbit, which must not be changed."""
    return forge_periodic(name)


def hints_of(J, centre, places):
    """Return centre and preconditioner."""
    C = (J - mp.eye(2)) ** -1
    return {
        "centre": [_decimal(q, places) for q in centre],
        "preconditioner": [[_decimal(C[i, j], places) for j in (0, 1)] for i in (0, 1)],
    }


def envelope(theorem, p, digits, claims, hints):
    """Return the certificate with these claims and hints."""
    return {
        "format": "cap-certificate/1",
        "theorem": theorem,
        "parameters": dict(p),
        "digits": str(digits),
        "claims": claims,
        "hints": hints,
        "cites": list(load(theorem).CITES),
        "provenance": {"tool": "forge_hybrid"},
    }


def forge_persistence(
    name="damped", *, epsilon=("0", "1/2000", "1/1000"), mu=("0", "1/2000", "1/1000"), reach=8
):
    """Return a valid certificate of the persistence of an orbit with hits."""
    certificate = forge_periodic(name, theorem="persistence")
    p, orbit = certificate["parameters"], PERIODIC[name]["orbit"]
    boxes, cells = [], []
    with mp.workdps(25):
        sides = [list(pairwise(q)) for q in (epsilon, mu)]
        for e, m in product(*sides):
            ends = [[str(1 - Fraction(q)) for q in e], m]
            flows = [Flow(p | {"e": a, "mu": b}) for a, b in product(*ends)]
            middle = [str(sum(map(Fraction, q)) / 2) for q in ends]
            flow = Flow(p | dict(zip(("e", "mu"), middle, strict=True)))
            z = fixed_point(flow, *orbit)
            corners = [fixed_point(q, *z) for q in flows]
            half = [reach * max(abs(q[i] - z[i]) for q in corners) for i in (0, 1)]
            box = [(q - r, q + r) for q, r in zip(z, half, strict=True)]
            boxes.append({k: around(q, r, 20) for k, q, r in zip("xv", z, half, strict=True)})
            cells.append(
                hints_of(flow.run(*z)[2], z, 20) | {"events": windows(flows, box, margin="0.03")[0]}
            )
    certificate["claims"]["range"] = {"epsilon": list(epsilon), "mu": list(mu), "boxes": boxes}
    certificate["hints"]["cells"] = cells
    return certificate
