"""The orbits with one hit of each wall whose velocity never vanishes, in closed form."""
