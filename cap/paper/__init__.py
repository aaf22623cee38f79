"""The figures of the paper, computed again, with all numbers that the paper states about them.

One module for each figure, or for a few that belong together.  Its functions find what the rows of
the figure's table ask for, the files ``tables/`` of the audit, each with no more work than that
takes: what several of them need is computed once in a run.
"""
