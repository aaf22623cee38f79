"""A system with impacts and dry friction as data, and what follows from it by exact algebra.

`polynomial`  exact polynomials in the state, the clock and pi
`model`       modes, guards, resets; Lie derivatives; `validation` refuses what is none
`form`        the model as JSON, both ways; `files` reads it, or Python, from a file
`flight`      the closed form of the flights of a mode, for any scalar
`exponential` all flights in balls, of springs as well
`lemmas`      why a guard that is not the next event stays positive
`friction`    one mass with dry friction between two walls, `masses` several on a line
"""
