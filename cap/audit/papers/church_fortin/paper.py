"""What the audit has to know of these tables: their claims are data."""

from collections.abc import Sequence

from cap.audit import given, subject
from cap.audit.claim import Claim
from cap.audit.papers.church_fortin import deciding
from cap.audit.statements import Statement

FIGURES = False
GROUPS: tuple[str, ...] = ()
STATEMENTS: tuple[Statement, ...] = ()
REASONS = {"tables": "heading; its claims are taken from the tables"}


def more() -> Sequence[Claim]:
    """Return the claims of ``claims.toml``."""
    return given.claims(subject.file("claims.toml"), deciding)
