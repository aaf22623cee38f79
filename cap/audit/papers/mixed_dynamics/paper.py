"""What the audit has to know of this paper."""

from collections.abc import Sequence

from cap.audit import tables
from cap.audit.claim import Claim
from cap.audit.papers.mixed_dynamics.reasons import REASONS
from cap.audit.papers.mixed_dynamics.statements import STATEMENTS

__all__ = ["FIGURES", "GROUPS", "REASONS", "STATEMENTS", "more"]

FIGURES = True  # that `cap.paper` computes: rows of their tables are claims

GROUPS = (
    *("introduction", "inclusion", "stops", "wellposed", "strobe"),
    *("cover", "lifting", "symplectic", "saltation"),
    *("ansatz", "roots", "fold", "linearization"),
    *("smoothness", "birkhoff", "kam"),
    *("slow", "melnikov", "homoclinic"),
    *("decomposition", "impulse"),
    *("persistence", "basin"),
    *("particles", "tori"),
    *("integrator", "diagnostics", "existence", "enclosure", "conclusion"),
    *("gallery", "mirror", "wording"),
)


def more() -> Sequence[Claim]:
    """Return the rows of the tables of its figures."""
    return tables.claims()
