"""Fixed points of the map over n periods: existence, claims, Birkhoff's normal form."""
