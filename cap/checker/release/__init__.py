"""The map from one release to the next, over intervals of places and of f."""
