"""Every claim of the audit but the rows of tables, against what is recorded.

The whole audit, tables included, is a step of ``.ci/run``, which decides everything anew: so these
are run beside it.
"""

import pytest

from cap.audit import ledger, recorded, subject
from cap.audit.decide import decided

TOGETHER = (("persistence", "basin"), ("birkhoff", "kam"), ("gallery", "diagnostics"))
GROUPS = [
    *TOGETHER,
    *(
        (name,)
        for name in subject.paper()["groups"]
        if not any(name in group for group in TOGETHER)
    ),
]


@pytest.mark.slow
@pytest.mark.beside
@pytest.mark.parametrize("modules", GROUPS, ids=" ".join)
def test_claims_are_decided_as_recorded(modules):
    """Verdict, strength and what was found."""
    claims = [each for each in ledger.claims().values() if each.id.partition(".")[0] in modules]
    assert claims
    verdicts = {each.id: decided(each) for each in claims}
    assert recorded.changes(verdicts, whole=False) == []
