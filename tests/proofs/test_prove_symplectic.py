"""The theorem ``symplectic``: against orbits that are followed exactly, and where it is refused."""

import mpmath
import pytest
import sympy as sp
from support import proving, seeded

from cap import prove_theorem
from cap.errors import BadInput, NotProved
from cap.proofs import symbolic, symplectic, symplectic_events, symplectic_tiling
from cap.proofs.identities import identity, need
from cap.proofs.symplectic_events import Masses

SIGNS = [  # before, after, of the two masses that collide: (v1, v2) as the masses say
    ((1, 1), (1, 1)),
    ((1, -1), (-1, 1)),
    ((1, -1), (1, 1)),
    ((-1, -1), (-1, 1)),
]


EVERY_PAIR = sp.Matrix(sp.BlockMatrix([[sp.zeros(3), -sp.ones(3)], [sp.ones(3), sp.zeros(3)]]))


def numbers(signs, random):
    """Return values for the symbols of two masses: an orbit about to collide, v1 > v2."""
    p = Masses.symbols(2)
    draw = [sp.Rational(random.randint(3, 30), 10) for _ in range(7)]
    v2 = sp.Rational(random.randint(-20, 20), 10)
    values = (*draw[:6], v2 + draw[6], v2, *signs[0], *signs[1])
    symbols = (*p.m, *p.f, *p.c, *p.v, *p.before, *p.after)
    return p, dict(zip(symbols, values, strict=True))


def followed(p, at, start):
    """Follow two masses with constant forces from the time -1/9, through their contact, to 1/9."""
    m, f, c, before, after = (
        [mpmath.mpf(at[s].p) / at[s].q if hasattr(at[s], "p") else at[s] for s in group]
        for group in (p.m, p.f, p.c, p.before, p.after)
    )
    x, v, time = list(start[:2]), list(start[2:]), mpmath.mpf(1) / 9
    a, b = ([(c[i] - f[i] * s[i]) / m[i] for i in (0, 1)] for s in (before, after))
    far, speed, bend = x[1] - x[0], v[0] - v[1], (a[0] - a[1]) / 2
    hit = 2 * far / (speed + mpmath.sqrt(speed**2 + 4 * bend * far))
    x = [x[i] + v[i] * hit + a[i] * hit**2 / 2 for i in (0, 1)]
    v = [v[i] + a[i] * hit for i in (0, 1)]
    mean = (m[0] * v[0] + m[1] * v[1]) / (m[0] + m[1])  # velocity of the centre, which is kept
    v, left = [2 * mean - each for each in v], 2 * time - hit
    return [
        *(x[i] + v[i] * left + b[i] * left**2 / 2 for i in (0, 1)),
        *(v[i] + b[i] * left for i in (0, 1)),
    ]


def measured(p, at):
    """Return the derivative of `followed` at the orbit that meets at time 0, by differences."""
    v = [mpmath.mpf(at[s].p) / at[s].q for s in p.v]
    m, f, c, s = ([at[x] for x in group] for group in (p.m, p.f, p.c, p.before))
    time, h = mpmath.mpf(1) / 9, mpmath.mpf(10) ** -16
    a = [sp.Rational((c[i] - f[i] * s[i]) / m[i]) for i in (0, 1)]
    a = [mpmath.mpf(each.p) / each.q for each in a]
    start = [
        *(-v[i] * time + a[i] * time**2 / 2 for i in (0, 1)),
        *(v[i] - a[i] * time for i in (0, 1)),
    ]
    columns = []
    for j in range(4):
        ends = [
            followed(p, at, [x + sign * h * (i == j) for i, x in enumerate(start)])
            for sign in (1, -1)
        ]
        columns.append([(q - r) / (2 * h) for q, r in zip(*ends, strict=True)])
    return mpmath.matrix(columns).T


@pytest.mark.parametrize("signs", SIGNS)
def test_the_derivative_of_a_collision(signs):
    """Orbits followed with 50 digits have the derivative shear · S · shear, also for odd signs."""
    with mpmath.workdps(50):
        p, at = numbers(signs, seeded(11))
        S = symplectic_events.saltation(p, p.collision, p.normal).subs(at)
        d = sp.Rational(1, 9)
        shear = sp.Matrix(sp.BlockMatrix([[sp.eye(2), d * sp.eye(2)], [sp.zeros(2), sp.eye(2)]]))
        stated, found = shear * S * shear, measured(p, at)
        for i in range(4):
            for j in range(4):
                assert abs(found[i, j] - mpmath.mpf(stated[i, j].p) / stated[i, j].q) < 1e-25


@pytest.mark.parametrize("signs", SIGNS)
def test_the_form_along_orbits(signs):
    """The defect measured is Σ f Δs over the closing speed, the volume is kept."""
    with mpmath.workdps(50):
        p, at = numbers(signs, seeded(12))
        D = measured(p, at)
        form = p.form.subs(at)
        J = mpmath.matrix([[mpmath.mpf(e.p) / e.q for e in form.row(i)] for i in range(4)])
        defect = D.T * J * D - J
        rate = (p.jump / (p.v[0] - p.v[1])).subs(at)
        assert abs(mpmath.det(D) - 1) < 1e-25
        # pulled back by the flight before it, dx1^dx2 is d(x1 + v1/9)^d(x2 + v2/9)
        assert abs(defect[1, 0] - mpmath.mpf(rate.p) / rate.q) < 1e-25
        assert abs(defect[3, 2] - mpmath.mpf(rate.p) / rate.q / 81) < 1e-25


def order(masses, i, most=60):
    """Return the order of the product of the reflections in faces i and i + 1, or None."""
    a, b = (sp.Matrix(symplectic_tiling._normals(masses)[k]).evalf(30) for k in (i, i + 1))
    turn = sp.eye(len(masses))
    for n in (a, b):
        turn *= sp.eye(len(masses)) - 2 * n * n.T / (n.T * n)[0]
    power = turn
    for k in range(1, most):
        if (power - sp.eye(len(masses))).norm() < 1e-20:
            return k
        power *= turn
    return None


@pytest.mark.parametrize("name", symplectic_tiling.GROUPS)
def test_reflections_of_the_groups(name):
    """Products of neighbouring reflections have the orders that the angles tell."""
    labels, masses = symplectic_tiling.GROUPS[name]
    numbers = [sp.Integer(m) for m in masses]
    assert tuple(order(numbers, i) for i in range(len(labels))) == labels


def test_reflections_at_nine_tenths():
    """At the paper's masses no power up to 60 of the product is the identity."""
    assert order([sp.Integer(1), sp.Rational(9, 10)], 0) is None


def test_identity_refuses():
    """What is false, or unknown, is not proved."""
    x, y = sp.symbols("x y")
    assert identity("true", (x**2 - y**2) / (x - y), x + y) == "true"
    for left, right in ((x, y), (x / y, x / y + sp.Rational(1, 10**30)), (sp.sin(x), x)):
        with pytest.raises(NotProved):
            identity("false", left, right)
    for unsure in (None, 1, sp.true):
        with pytest.raises(NotProved):
            need(unsure, "not exactly True")


@pytest.mark.parametrize(
    ("attribute", "wrong", "lemma"),
    [
        ("jump", lambda p: p.f[0] * (p.after[0] - p.before[0]), symplectic_events.symplectic),
        ("jump", lambda p: 2 * p.f[0], symplectic_events.exact_defect),
        ("collision", lambda p: sp.eye(len(p.m)), symplectic_events.volume),
        ("collision", lambda p: -sp.eye(len(p.m)), symplectic_events.symplectic),
        ("form", lambda _p: EVERY_PAIR, symplectic_events.hits),
    ],
)
def test_wrong_formulas(monkeypatch, attribute, wrong, lemma):
    """With another jump, another rule of collision or another form the lemmas are refused."""
    monkeypatch.setattr(Masses, attribute, property(wrong))
    with pytest.raises(NotProved):
        lemma()


def test_wrong_masses(monkeypatch):
    """Other masses for F~4 are refused."""
    monkeypatch.setitem(symplectic_tiling.GROUPS, "F~4", ((3, 3, 4, 3), (6, 2, 1, 4)))
    with pytest.raises(NotProved):
        symplectic_tiling.tiling()


def test_the_command(capsys, tmp_path, monkeypatch):
    """It prints statement and lemmas, writes nothing, and takes no options."""
    monkeypatch.chdir(tmp_path)
    status, out, err = proving(capsys, "symplectic")
    assert (status, err) == (0, "")
    assert symplectic.__doc__.strip() in out
    assert out.count("\nLemma ") == len(symplectic.LEMMAS)
    for words in (("--f", "1/3"), ("--all",), ("--digits", "20")):
        status, out, err = proving(capsys, "symplectic", *words)
        assert (status, out, err.count("\n")) == (2, "", 1)
    assert list(tmp_path.iterdir()) == []


def test_from_python():
    """The interface, which returns certificates, says where the proof is printed."""
    with pytest.raises(BadInput, match=r"python -m cap\.prove symplectic"):
        prove_theorem("symplectic")


def test_the_command_fails(capsys, monkeypatch):
    """A lemma that fails is one line, and the status 1."""
    monkeypatch.setattr(Masses, "jump", property(lambda _p: sp.Integer(0)))
    status, out, err = proving(capsys, "symplectic")
    assert (status, out, err.count("\n")) == (1, "", 1)
    assert err.startswith("NOT PROVED (symplectic)")


def test_names():
    """Every symbolic theorem has a statement, a summary and lemmas."""
    for name in symbolic.NAMES:
        module = symbolic.proof(name)
        assert module.__doc__.startswith(f"Theorem ({name})")
        assert module.SUMMARY
        assert module.LEMMAS
