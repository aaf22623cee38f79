"""Coverings between parallelograms under a planar map; what follows for orbits and entropy."""
