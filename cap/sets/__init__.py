"""What encloses: intervals of doubles, rounded outwards.  (No import: each user loads its own.)"""
