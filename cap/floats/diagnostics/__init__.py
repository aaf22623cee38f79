"""Float mode, diagnostics: portraits, attractors, exponents, manifolds, diagrams."""
