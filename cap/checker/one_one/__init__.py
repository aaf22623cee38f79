"""The closed form of the (1,1) orbits, transcribed for the checker."""
