"""Which cells of states come to rest at a wall, and which still fly: in doubles."""
