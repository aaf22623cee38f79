"""The twist matrix: of maps with known normal forms, of equal masses, and what is refused."""

from dataclasses import replace
from fractions import Fraction

import particle_orbits
import pytest
from support import holds, width

from cap.errors import NotProved
from cap.floats.candidates import Request, non_sticking
from cap.floats.masses import particle_candidates
from cap.floats.masses.particle_orbits import from_equal_masses
from cap.floats.masses.particles import Particles
from cap.flow.jet_transport import strobe_jet
from cap.flow.strobe import oscillator
from cap.maps import fixed_point, normal_form, twist_matrix
from cap.maps.twist_matrix import Frame
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Ball, ComplexBall
from cap.sets.jet import Jet

ANGLES = Fraction(1, 7), Fraction(31, 40)  # rotations by 2πθ
MATRIX = (Fraction(3, 2), Fraction(-2, 3)), (Fraction(-2, 3), Fraction(5, 7))
MASSES = Fraction(2), Fraction(3, 5)


def balls(masses):
    """Return masses as balls."""
    return [interval.ball(m) for m in masses]


def potential_kick(u, coefficients):
    """Return (x, v + grad V(x)/m), V a cubic form in x_1, x_2: it preserves Σ m dv ∧ dx."""
    x, y = u[0], u[1]
    a, b, c, d = map(interval.ball, coefficients)
    first = x * x * (3 * a) + x * y * (2 * b) + y * y * c
    second = x * x * b + x * y * (2 * c) + y * y * (3 * d)
    m = balls(MASSES)
    return [u[0], u[1], u[2] + first / m[0], u[3] + second / m[1]]


def position_kick(u, coefficients):
    """Return (x + grad W(mv), v)."""
    m = balls(MASSES)
    p, q = u[2] * m[0], u[3] * m[1]
    a, b, c, d = map(interval.ball, coefficients)
    first = p * p * (3 * a) + p * q * (2 * b) + q * q * c
    second = p * p * b + p * q * (2 * c) + q * q * (3 * d)
    return [u[0] + first, u[1] + second, u[2], u[3]]


KICKS = [
    (potential_kick, (Fraction(1, 3), Fraction(-1, 5), Fraction(1, 2), Fraction(1, 7))),
    (position_kick, (Fraction(-1, 4), Fraction(2, 3), Fraction(1, 9), Fraction(1, 6))),
]


def twisted():
    """Return the jets of w_j -> w_j exp(i (2πθ_j + (B|w|²)_j)) in coordinates (x, v), kicked.

    w = sqrt(m/2) (v + ix), so that i dw ∧ dw̄ = m dv ∧ dx.
    """
    m = balls(MASSES)
    u = list(Jet.variables([Ball(0)] * 4, 3))
    for kick, c in KICKS:
        u = kick(u, c)
    actions = [(u[j] * u[j] + u[2 + j] * u[2 + j]) * (m[j] / 2) for j in range(2)]
    x, v = [], []
    for j in range(2):
        shift = actions[0] * interval.ball(MATRIX[j][0]) + actions[1] * interval.ball(MATRIX[j][1])
        angle = 2 * interval.pi() * interval.ball(ANGLES[j])
        sin, cos = (shift + angle).sin_cos()
        # v + ix turns by the angle
        v.append(u[2 + j] * cos - u[j] * sin)
        x.append(u[2 + j] * sin + u[j] * cos)
    w = [*x, *v]
    for kick, c in reversed(KICKS):
        w = kick(w, [-q for q in c])
    return w


def derivative(jets):
    """Return the linear part of jets."""
    return [[Ball(j.coefficients[1 + k]) for k in range(4)] for j in jets]


def test_a_known_normal_form():
    """Rotations with a twist, in coordinates bent by symplectic maps: θ and B are found again."""
    with interval.workprec(200):
        jets = twisted()
        D, masses = derivative(jets), balls(MASSES)
        z = twist_matrix.reduced_traces(D)
        frame = twist_matrix.frame(D, masses, z)
        theta = [
            twist_matrix.angle(q, above=bool(e.imag > 0))
            for q, e in zip(z, frame.multipliers, strict=True)
        ]
        B = twist_matrix.twist_matrix(jets, frame)
    order = (0, 1) if z[0].overlaps(2 * (2 * interval.pi() / 7).cos()) else (1, 0)
    for j in range(2):
        assert holds(theta[j], ANGLES[order[j]])
        for k in range(2):
            assert holds(B[j][k], MATRIX[order[j]][order[k]])
            assert width(B[j][k]) < 1e-45


def test_the_frame():
    """D e = λ e, Ω(e, ē) = i, Ω(e_1, ē_2) = Ω(e_1, e_2) = 0."""
    orbit = particle_orbits.orbit()
    with interval.workprec(orbit.setting.bits):
        D = orbit.monodromy
        frame = twist_matrix.frame(D, orbit.masses, twist_matrix.reduced_traces(D))
        for multiplier, e in zip(frame.multipliers, frame.vectors, strict=True):
            image = [sum((a * b for a, b in zip(row, e, strict=True)), Ball(0)) for row in D]
            assert all((p - multiplier * q).contains(0) for p, q in zip(image, e, strict=True))
            own = twist_matrix.form(frame.masses, e, [q.conjugate() for q in e])
            assert (own - ComplexBall(0, 1)).contains(0)
        first, second = frame.vectors
        for other in (second, [q.conjugate() for q in second]):
            assert twist_matrix.form(frame.masses, first, other).contains(0)


def test_equal_masses():
    """Two masses that exchange names: B is diagonal, -2 τ_1 of one mass alone, twice.

    The multipliers are double there, so the frame is that of the planes of the two orbits.
    """
    equal = Fraction(1), Fraction(1)
    system = Particles(PAPER, equal)
    found = particle_candidates._of_masses(system, next(from_equal_masses(system)))
    asked = replace(particle_orbits.setting(), parameters=PAPER, guess=found.guess)
    with interval.workprec(asked.bits):
        orbit = particle_orbits.located(asked, found.particles)
        jets = orbit.jet(3)
        masses = balls(equal)
        D = orbit.monodromy
        B = twist_matrix.twist_matrix(jets, planes(D, masses))
        assert all(D[i][j].contains(0) for i in (0, 2) for j in (1, 3))
        with pytest.raises(NotProved, match="double"):
            twist_matrix.reduced_traces(D)
        tau = one_mass_twist()
        assert (B[0][0] + 2 * tau).contains(0)
        assert (B[1][1] + 2 * tau).contains(0)
        assert B[0][1].contains(0)
        assert width(B[0][0]) < 1e-30


def planes(D, masses):
    """Return the frame of a D that maps the planes (x_j, v_j) into themselves."""
    multipliers, vectors = [], []
    for j in range(2):
        a, b, d = D[j][j], D[j][2 + j], D[2 + j][2 + j]
        half = (a + d) / 2
        root = ComplexBall(0, (1 - half * half).sqrt())
        for multiplier in (half + root, half - root):
            e = [ComplexBall(0)] * 4
            e[j], e[2 + j] = ComplexBall(b), multiplier - a
            kappa = (twist_matrix.form(masses, e, [q.conjugate() for q in e]) / 1j).real
            if kappa > 0:
                multipliers.append(multiplier)
                vectors.append([q / kappa.sqrt() for q in e])
    return Frame(tuple(masses), tuple(multipliers), tuple(vectors))


def one_mass_twist():
    """Return τ_1 of the elliptic orbit of one mass, by the normal form in the plane."""
    start = non_sticking(Request("elliptic", PAPER)).candidates[0].start
    osc = oscillator(PAPER)
    point = fixed_point.prove(osc, start, 45)
    return normal_form.twists(*strobe_jet(osc, point.box, point.orbit, 3))[0]


def test_what_is_refused():
    """Complex quadruples, real pairs, double pairs; a resonance of order 3; no symplectic map."""
    rotation = twisted()
    with interval.workprec(200):
        D = derivative(rotation)
        double = [[Ball(int(i == j)) for j in range(4)] for i in range(4)]
        with pytest.raises(NotProved, match="double"):
            twist_matrix.reduced_traces(double)
        with pytest.raises(NotProved, match="unit circle"):
            twist_matrix.eigenvector(D, balls(MASSES), Ball(3), Ball(1))
        z = twist_matrix.reduced_traces(D)
        with pytest.raises(NotProved, match="Krein"):
            twist_matrix.eigenvector(double, balls(MASSES), z[0], z[1])
        frame = twist_matrix.frame(D, balls(MASSES), z)
        third = ComplexBall(-1, 3 * Ball(0) + interval.ball(3).sqrt()) / 2
        resonant = replace(frame, multipliers=(third, frame.multipliers[1]))
        with pytest.raises(NotProved, match="resonance"):
            twist_matrix.twist_matrix(rotation, resonant)
        lossy = [j * interval.ball(Fraction(1)) for j in rotation]
        u = Jet.variables([Ball(0)] * 4, 3)
        lossy[0] = lossy[0] + u[0] * u[0] * u[0] * Ball(1)
        with pytest.raises(NotProved, match=r"not real|not symmetric"):
            twist_matrix.twist_matrix(lossy, frame)
