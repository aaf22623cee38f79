"""What the audit has to know of these tables."""

from collections.abc import Sequence

from cap.audit.claim import Claim
from cap.audit.statements import Statement

FIGURES = False
GROUPS = ("tables",)
STATEMENTS: tuple[Statement, ...] = ()
REASONS = {"tables": "heading; its claims are taken from the tables"}


def more() -> Sequence[Claim]:
    """Return no other claims."""
    return ()
