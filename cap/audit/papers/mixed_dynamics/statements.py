"""What became of each statement of the paper, and what may be cited in its place."""

from cap.audit.statements import statement

STATEMENTS = (
    statement(
        "lem:vzero",
        "stops.differentiable-at-a-turn",
        "stops.tangency-times",
        instead="The lemma with one-sided derivatives at a turn and the four tangency times; part "
        "(c) without 'almost every' (proofs/audit/setup.md).",
    ),
    statement("lem:wall", "stops.wall-reflection", instead="The lemma itself."),
    statement(
        "thm:wellposed",
        "inclusion.rest-at-a-wall",
        "inclusion.outward-data",
        "wellposed.no-accumulation",
        instead="Existence and uniqueness for all states with a contact law at the walls, captures "
        "included (proofs/audit/setup.md, The contact law); theorem capture (capture.json).",
    ),
    statement(
        "prop:Om-NS-invariant", "strobe.forward-invariance", instead="The proposition itself."
    ),
    statement(
        "lem:lift-flow",
        "cover.transition-is-the-identity",
        "cover.lifted-flow-is-unique",
        instead="For p > 0, as long as p stays positive: existence, uniqueness, and area "
        "preservation by the determinant 1 of the crossings.",
    ),
    statement(
        "thm:lift",
        "lifting.lift-exists",
        "lifting.lift-is-unique",
        "lifting.converse",
        instead="The proposition with p > 0 in the converse, the lift unique up to even integers.",
    ),
    statement(
        "thm:symplectic",
        "symplectic.symplectic",
        "symplectic.exactness-descends",
        instead="Φ is analytic, injective and symplectic where orbits do not stop in [0, T]; exact "
        "on every part in which no closed curve goes around the annulus, with flux -2fRT around it "
        "(proofs/audit/lift.md).",
    ),
    statement(
        "cor:det-Phi",
        "saltation.contraction-almost-everywhere",
        "saltation.determinant-of-a-period",
        instead="The product formula, with 0 after a capture too; |det Φ'| < 1 on X \\ Ω_NS^[0,T]. "
        "Explicit determinants: theorem periodic (periodic-1.json to periodic-12.json).",
    ),
    statement(
        "thm:symmetric",
        "ansatz.bijection",
        instead="Theorem symmetric (symmetric.json): the symmetric orbits with one hit of each "
        "wall, which never stop, in closed form; all such orbits: cap.proofs.census.",
    ),
    statement(
        "prop:two-solutions",
        "roots.number-of-roots",
        instead="The proposition, as a statement about the roots of an equation; they are no "
        "orbits.",
    ),
    statement(
        "thm:saddlecenter",
        "fold.colliding-orbits",
        "fold.normal-form",
        instead="(a) as a statement about roots. Of orbits: saddle-center at f = 2F/π with "
        "multipliers 1 ± c ν^(1/4) (theorem symmetric), pitchfork at f = 0.46590355.. "
        "(pitchfork.json).",
    ),
    statement(
        "prop:DPhi-structure",
        "linearization.elliptic-branch",
        instead="The trace of the symmetric orbits, (2 - k)² - 2, and of the pair for all its f, "
        "with its resonances (branch.json).",
    ),
    statement(
        "prop:smooth-NS",
        "smoothness.smooth-near-the-orbit",
        "smoothness.forcing-at-hits",
        instead="Φ is real analytic near a never-stopping T-periodic orbit without a hit at 0 or "
        "T.",
    ),
    statement(
        "prop:birkhoff",
        "birkhoff.remainder-of-the-normal-form",
        instead="The normal form with the remainder O(|z|⁴), or with kθ* not in 2πZ for k <= 5.",
    ),
    statement(
        "prop:twist-nondeg",
        "birkhoff.analytic-family",
        "birkhoff.value-of-the-twist",
        instead="For the pairs: τ₁ != 0 for almost all parameters (proofs/audit/kam.md); at the "
        "paper's F, ω, R for all f but four short intervals (branch.json); τ₁ = 0.113477.. at f = "
        "2/5 (elliptic.json).",
    ),
    statement(
        "prop:moser-quantitative",
        "kam.smoothness-class",
        instead="Moser's twist theorem (Siegel and Moser 1971), without a rate; for a rate, "
        "Pöschel (1982) with its own hypotheses.",
    ),
    statement(
        "thm:kam",
        "kam.invariant-curves",
        "kam.constants",
        "birkhoff.twist-per-action",
        instead="(H1) without its clause, (H4) to (H6): invariant curves of density one. Its "
        "hypotheses are certified at the paper's parameters (elliptic.json) and along the branch "
        "(branch.json); one curve is explicit, with its rotation number (island.json).",
    ),
    statement(
        "cor:Hamilton-island",
        "kam.area-of-the-curves",
        "kam.measure-estimate",
        instead="The corollary, given the measure estimate; without it: density one. At its "
        "parameters an invariant disk inside an explicit curve, with its area (island.json).",
    ),
    statement(
        "prop:slow-Ham",
        "slow.equilibria-do-not-collide",
        "slow.equilibria-leave",
        instead="Near a saddle-center: y²/2 + x³/3 - μx (proofs/audit/melnikov.md).",
    ),
    statement(
        "lem:tanh-profile",
        "slow.separatrix-angle",
        "slow.separatrix-action",
        instead="φ = 2 arctan sinh(λt), I - I_sad = ±(2β₀/α₀)^(1/2) sech(λt), λ² = 2α₀β₀μ, for the "
        "pendulum H₀; it is not the slow Hamiltonian of a fold.",
    ),
    statement(
        "thm:melnikov",
        "melnikov.vanishing-integral",
        "melnikov.friction-integral",
        "melnikov.amplitudes",
        instead="Theorem homoclinic (homoclinic.json): at the paper's parameters a saddle has "
        "transverse homoclinic points whose orbits never stop, hence a horseshoe of such states.",
    ),
    statement(
        "thm:OmNS-structure",
        "decomposition.curves-in-the-set",
        "decomposition.neighbourhood-in-the-set",
        "symplectic.symplectic",
        instead="Forward invariance, symplecticity as above, invariant curves with their insides; "
        "of saddles, the horseshoe of theorem homoclinic (homoclinic.json).",
    ),
    statement(
        "prop:contraction",
        "decomposition.contraction",
        instead="Leb(Φ(A)) < Leb(A) for A of positive measure in X \\ Ω_NS^[0,T] on which Φ is "
        "differentiable.",
    ),
    statement(
        "prop:Omdissip-flag",
        "decomposition.not-forward-invariant",
        "impulse.eventual-entry",
        instead="Ω_dissip is not forward invariant at the paper's parameters (with another proof); "
        "for f > 2F/π every orbit comes to rest again and again, within an explicit time (theorem "
        "impulse, impulse-1.json).",
    ),
    statement(
        "prop:persist-orbit",
        "persistence.persistence-of-the-orbit",
        instead="The proposition; explicit: theorem persistence (persistence.json).",
    ),
    statement(
        "thm:persistence",
        "persistence.asymptotic-stability",
        "persistence.eigenvalues",
        instead="For small (ε, μ) != 0: |λ±|² = exp(-μT)(1 - ε)^(2n*) < 1; for all 0 <= ε <= "
        "0.031, 0 <= μ <= 0.0285 (persistence.json).",
    ),
    statement(
        "cor:island-basin",
        "basin.small-neighbourhoods",
        "basin.replacement-of-the-island",
        instead="A neighbourhood of P(ε, μ) in its basin, an explicit ellipse (persistence.json); "
        "the same for the mirror image.",
    ),
    statement("lem:collision-algebra", "particles.collision-algebra", instead="The lemma itself."),
    statement("lem:massweight", "particles.mass-weighted-collision", instead="The lemma itself."),
    statement(
        "thm:multiparticle",
        "particles.symplecticity",
        "particles.invariant-form",
        instead="Φ^(N) preserves Σ m_i dv_i ∧ dx_i where Σ f_i Δs_i = 0 at all collisions of the "
        "first period (proofs/audit/particles.md); volume always.",
    ),
    statement(
        "cor:multi-KAM",
        "tori.hypothesis-k1",
        "tori.orbits-of-the-corollary",
        instead="For two masses invariant tori by theorem particles (particles.json, "
        "particles-2.json): f = 91/200, or walls ±11/10, not the paper's parameters; for two equal "
        "masses products of the invariant curves of P*.",
    ),
    statement(
        "conj:Ninfty",
        "tori.conjecture",
        instead="Nothing: the question has to be posed for a box of states and unequal masses.",
    ),
    statement(
        "thm:CAP-elliptic",
        "existence.elliptic-fixed-point",
        "enclosure.entries-and-trace",
        "enclosure.enclosure-over-the-box",
        "enclosure.determinant-is-certified",
        instead="Theorem elliptic (elliptic.json): with the whole itinerary, and enclosures to "
        "thirty digits.",
    ),
    statement(
        "thm:CAP-KAM",
        "existence.kam-at-the-point",
        instead="Theorem elliptic without the condition: τ₁ = 0.113477.. != 0, invariant curves of "
        "density one around P*.",
    ),
    statement(
        "prop:hist-sigma",
        "mirror.square-of-sigma",
        "mirror.step-of-the-proof",
        instead="σ = reflection after the flow from 0 to T/2: σ² = Φ, for all walls (theorem "
        "pitchfork, pitchfork.json).",
    ),
)
