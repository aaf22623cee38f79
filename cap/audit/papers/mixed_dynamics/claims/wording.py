"""Sentences here and there that a reading of the whole text stops at."""

from cap.audit import labels
from cap.audit.means.need import need
from cap.audit.steps import Words


def bibliography() -> Words:
    own = labels.stored()
    need(own.cited > 0 and own.references == 0, "there is a bibliography")
    return {"cited": own.cited}


def pictures() -> Words:
    own = labels.stored()
    need(own.pictures > 0, "all pictures have files")
    return {"pictures": own.pictures}
