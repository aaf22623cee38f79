"""Several masses between two walls, in balls: orbits in event unknowns, derivative, normal form."""
