"""How claims are decided: algebra, balls, quadrature, orbits, stored certificates."""
