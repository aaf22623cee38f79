"""The ten findings that matter most, with their consequences for the theorems of the paper."""

from dataclasses import dataclass

from cap.audit.verdict import Outcome


@dataclass(frozen=True)
class Finding:
    """A claim, the verdict for which the consequence was written, and this consequence."""

    claim: str
    expected: Outcome
    consequence: str


FINDINGS = (
    Finding(
        "ansatz.bijection",
        Outcome.REFUTED,
        "Theorem 4.2 describes no orbit. With it fall Theorem 4.8 (b) and (c), Proposition 4.10, "
        "and whatever Sections 5 and 6 take from them. The symmetric orbits that exist never turn, "
        "and their closed form is simpler.",
    ),
    Finding(
        "roots.universality",
        Outcome.REFUTED,
        "The saddle-center of symmetric orbits is at f = 2F/π, whatever the gap, as GKR2019 has it "
        "according to the paper: the correction has to be withdrawn. Multipliers there go with the "
        "fourth root of the distance, not the square root.",
    ),
    Finding(
        "wellposed.no-accumulation",
        Outcome.REFUTED,
        "Theorem 2.5 stands when changed: with a contact law at the walls, and captures, at which "
        "infinitely many hits accumulate, as part of the statement: (F1) to (F3) do not determine "
        "the motion of a mass at rest at a wall. Steps 4 to 6 of its proof fall.",
    ),
    Finding(
        "saltation.contraction-almost-everywhere",
        Outcome.REFUTED,
        "Corollary 3.4 and Proposition 7.2 fall for Ω_dissip = X \\ Ω_NS: on an open part of it Φ "
        "preserves area. Both stand for the states that stop in their first period.",
    ),
    Finding(
        "birkhoff.value-of-the-twist",
        Outcome.REFUTED,
        "The sign of the twist is wrong, and the conclusion of Theorem 5.6 at the paper's "
        "parameters is right: τ₁ != 0 is certified, so Proposition 10.2 holds without its "
        "condition. Proposition 5.4 needs another family and another proof; there is one.",
    ),
    Finding(
        "kam.invariant-curves",
        Outcome.CONFIRMED,
        "Theorem 5.6 is right about the islands, and its clause |F cos ωt*| > f is not needed; its "
        "constants depend on more than it says.",
    ),
    Finding(
        "existence.elliptic-fixed-point",
        Outcome.CONFIRMED,
        "Theorem 10.1 stands: the fixed point exists, is unique and elliptic, by other methods and "
        "code. The proof as described leaves out that nothing else happens on the flights, and the "
        "printed intervals do not follow from its steps; the certified ones replace them.",
    ),
    Finding(
        "melnikov.vanishing-integral",
        Outcome.REFUTED,
        "With the parities exchanged, the residue wrong, B = 0, and A smaller than every power of "
        "μ, nothing is left of the proof of Theorem 6.4: the horseshoe is open here, not shown.",
    ),
    Finding(
        "particles.never-stopping-set-is-empty",
        Outcome.REFUTED,
        "Theorem 9.4 and Corollary 9.5 are about the empty set. With the right condition at "
        "collisions, Σ f_i Δs_i = 0, and the form Σ m_i dv_i ∧ dx_i the theorem becomes true and "
        "useful.",
    ),
    Finding(
        "persistence.asymptotic-stability",
        Outcome.CORRECTED,
        "Theorem 8.2 stands when changed, and is certified for an explicit rectangle of (ε, μ); "
        "its saltation entry has the wrong sign, and ρ is a rate, no threshold.",
    ),
)
