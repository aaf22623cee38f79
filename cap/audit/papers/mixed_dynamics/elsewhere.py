"""Rows of the figures' tables that a claim of the ledger decides already, with better evidence."""

DECIDED_BY = {
    ("fig:cover", "period of W"): "cover.triangular-wave",
    ("fig:cover", "reflections become"): "cover.smooth-passage",
    (
        "fig:cover",
        "jump of q'' at an integer (proof of Lemma lift-flow: 2f/R)",
    ): "cover.jump-of-the-field",
    ("fig:orbit", "non-sticking fixed points"): "existence.number-of-fixed-points",
    ("fig:impulse-bound", "F_imp = pi f/2"): "linearization.value-of-the-bound",
    (
        "fig:impulse-bound",
        "rotation number varies smoothly with F",
    ): "linearization.smooth-rotation-number",
    ("fig:impulse-bound", "rotation number 1/4"): "linearization.resonances-on-the-way",
    ("fig:impulse-bound", "rotation number 1/3"): "linearization.resonances-on-the-way",
    ("fig:impulse-bound", "rotation number 1/2"): "linearization.resonances-on-the-way",
    (
        "fig:impulse-bound",
        "F = 0.62: every orbit enters Omega_dissip",
    ): "linearization.below-the-bound",
    ("fig:kam-gallery", "hits per period, panels (a) to (d), 4 T"): "kam.pattern-of-the-gallery",
    ("fig:kam-gallery", "displacement of panel (d)"): "kam.displacement",
    ("fig:decomp-schematic", "Omega_dissip"): "decomposition.stop-in-every-period",
    ("fig:decomp-schematic", "attractor"): "decomposition.funnel",
    ("fig:decomp-schematic", "Omega_NS has positive measure"): "decomposition.curves-in-the-set",
    ("fig:bifurcation", "what happens at f_sc"): "fold.colliding-orbits",
    ("fig:continuation", "saddle-center: where"): "roots.universality",
    ("fig:multi-particle", "the collision is an involution"): "particles.collision-algebra",
    ("fig:multi-particle", "momentum and energy"): "particles.collision-algebra",
    (
        "fig:multi-particle",
        "a collision preserves sum dv_i dx_i (Theorem multiparticle)",
    ): "particles.invariant-form",
    ("fig:multi-particle", "volume"): "particles.volume",
    **{
        (table, f"F = {F}: {what}"): f"gallery.{name}"
        for table, F, name in (
            ("fig:hist-gallery-low", "1.5", "orbit-at-three-halves"),
            ("fig:hist-gallery-low", "3", "orbit-at-three"),
            ("fig:hist-gallery-low", "4.5", "orbit-at-nine-halves"),
            ("fig:hist-gallery-high", "6", "orbit-at-six"),
        )
        for what in ("x_*", "v_*", "trace", "determinant")
    },
    ("fig:hist-chatter", "time between events"): "conclusion.bound-of-the-conclusion",
}
