"""The flow folded by its symmetry, over boxes of states, in quadratic models."""
