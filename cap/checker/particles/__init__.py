"""Two masses between two walls: flights, contacts, periodic orbits, the normal form."""
