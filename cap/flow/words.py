"""The words of all events; where arrays have numbers for them, these are their places here."""

WORDS = (
    "hit r",
    "hit l",
    "turn right",
    "turn left",
    "stick",
    "capture r",
    "capture l",
    "release right",
    "release left",
)
