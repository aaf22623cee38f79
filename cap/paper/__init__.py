"""The figures of the paper, computed again, with all numbers that the paper states about them.

One module for each figure, or for a few that belong together; `cap.paper.registry` lists them.
"""
