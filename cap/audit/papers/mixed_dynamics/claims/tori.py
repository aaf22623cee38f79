"""Section 9: KAM tori for particles, two particles, and the conjecture."""

from fractions import Fraction

from cap.audit.means.need import need
from cap.audit.means.stored import stored
from cap.audit.steps import Words
from cap.parameters import PAPER

TWO_PARTICLES = "particles.json"  # an elliptic orbit, and the one that the paper expects
NOT_ELLIPTIC = "particles_saddle.json"
LIMITS = "particles_limits.json"  # down to which masses the orbit is elliptic


def hypothesis_k1() -> None:
    k = (1, 0, 0)
    turns = Fraction(k[0])  # Σ k_j θ_j in units of 2π, whatever θ₁, .., θ_N are
    need(any(k) and turns.denominator == 1, "this vector does not violate (K1)")
    need(sum(map(abs, k)) <= 2 * 2 + 4, "it is too long")


def neighbourhood_of_tori() -> None:
    for n in (1, 2, 3):
        separates = n == 2 * n - 1  # an n-torus has codimension one in a section of dimension 2n
        need(separates is (n == 1), "the dimensions are others")


def twist_matrix_of_equal_masses() -> None:
    twist = stored("elliptic.json").claims["twist"]
    need(twist.lower > 0, "the twist may vanish")
    angle = stored("elliptic.json").claims["rotation_number"]
    other = stored("elliptic-2.json").claims["rotation_number"]
    need(angle.lower <= other.upper and other.lower <= angle.upper, "the rotation numbers differ")


def elliptic_orbit_of_two_particles() -> Words:
    masses = Fraction(1), Fraction(9, 10)
    elliptic, other = stored(TWO_PARTICLES), stored(NOT_ELLIPTIC)
    need(elliptic.parameters["masses"] == other.parameters["masses"] == masses, "other masses")
    paper = {key: other.parameters[key] for key in PAPER.elastic_strings()}
    need(paper == {key: getattr(PAPER, key) for key in paper}, "other parameters")
    determinant = elliptic.claims["twist_determinant"]
    need(not determinant.lower <= 0 <= determinant.upper, "the twist matrix may be singular")
    limits = stored(LIMITS)
    need({key: limits.parameters[key] for key in paper} == paper, "other parameters of the limits")
    need(limits.parameters["masses"] == (1, 1), "other masses of the limits")
    flip, stop = limits.claims["flip"], limits.claims["stop"]
    need(flip.lower > masses[1] > stop.upper, "9/10 is not between the limits")
    outer = other.claims["multipliers"][0]
    need(outer.upper < -1, "the outer multiplier may be on the unit circle")
    f, speed = elliptic.parameters["f"], other.claims["least_speeds"][1]
    return {
        "speed": speed,
        "outer": outer,
        "flip": flip,
        "stop": stop,
        "f": f,
        "determinant": determinant,
    }
