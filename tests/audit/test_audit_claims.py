"""Every claim of the audit, decided anew, against what is recorded."""

import pytest

from cap.audit import ledger, recorded
from cap.audit.decide import decided

HEAVY = {"persistence", "basin", "introduction", "melnikov"}  # large certificates, float search


MODULES = [
    pytest.param(name, marks=[pytest.mark.slow] if name in HEAVY else []) for name in ledger.MODULES
]


@pytest.mark.parametrize("module", MODULES)
def test_claims_are_decided_as_recorded(module):
    """Verdict, strength and what was found; nothing is taken from the cache."""
    claims = [each for each in ledger.claims().values() if each.id.startswith(f"{module}.")]
    assert claims
    verdicts = {each.id: decided(each, fresh=True) for each in claims}
    assert recorded.changes(verdicts, whole=False) == []
