"""The flow folded by its symmetry: forwards from places of release, backwards from sticks."""
