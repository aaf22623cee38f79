"""Pictures of what `cap.floats` computes, drawn by matplotlib.

Each function draws one findings on a figure, or a subfigure, that it is given.
"""
