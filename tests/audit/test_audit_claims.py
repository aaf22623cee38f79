"""Every claim of the audit but the rows of tables, against what is recorded.

The whole audit, tables included, is part of ``.ci/run``, which decides everything anew; what the
cache knows from there was decided by the same sources and certificates.  Elsewhere this takes many
minutes, since it verifies certificates: only a few claims are decided by the README's command.
"""

import pytest

from cap.audit import ledger, recorded, subject
from cap.audit.decide import decided

TOGETHER = (("persistence", "basin"), ("birkhoff", "kam"), ("gallery", "diagnostics"))
SOON = {"inclusion", "lifting", "symplectic"}
GROUPS = [
    *TOGETHER,
    *(
        (name,)
        for name in subject.paper()["groups"]
        if not any(name in group for group in TOGETHER)
    ),
]
MODULES = [
    pytest.param(group, marks=[] if SOON & set(group) else [pytest.mark.slow], id=" ".join(group))
    for group in GROUPS
]


@pytest.mark.slow
@pytest.mark.parametrize("modules", MODULES)
def test_claims_are_decided_as_recorded(modules):
    """Verdict, strength and what was found."""
    claims = [each for each in ledger.claims().values() if each.id.partition(".")[0] in modules]
    assert claims
    verdicts = {each.id: decided(each) for each in claims}
    assert recorded.changes(verdicts, whole=False) == []
