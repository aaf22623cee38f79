"""K. E. M. Church and C. Fortin: seven tables of orbits of a vibrating gravitational billiard."""
