"""Section 5.2: the twist theorem, its measure estimate, and the islands."""

from cap.audit.means.need import need
from cap.audit.papers.mixed_dynamics.means.orbits import States


def pattern_of_the_gallery() -> None:
    starts = (("0.10028", "0.54194"), ("0.10328", "0.54194"), ("0.11228", "0.54194"))
    for x, v in starts:
        orbits = States(x, v).follow(4)
        need(orbits.words == ("hit r", "hit l") * 4, f"({x}, {v}) does something else")
    row_d = States("0.1502798898441954", "0.5919433067664584").follow(8)
    need(row_d.words == ("hit r", "hit l") * 8, "row (d) does something else", w=row_d.words)
