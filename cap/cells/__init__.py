"""The flow of cells: boxes of states, by the million, through all events, in doubles that prove."""
