"""The flow folded by its symmetry: forwards from places of release, both ways from first stops."""
