"""Float mode for several masses: their flow, orbits, portraits and attractors."""
