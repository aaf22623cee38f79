"""Floats, from which nothing is proved: the command line of the float mode."""
