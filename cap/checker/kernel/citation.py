"""What is proved on paper and only cited: theorems with their hypotheses, one by one."""

from __future__ import annotations

from typing import Any

Citation = dict[str, Any]

NEUMAIER = "Neumaier, Interval Methods for Systems of Equations, 1990, Section 5.1"


def cite(theorem: str, reference: str, *hypotheses: tuple[str, str, str]) -> Citation:
    """Return a citation; a hypothesis is (name, statement, the claims that discharge it)."""
    stated = [{"name": n, "statement": s, "by": by.split(", ")} for n, s, by in hypotheses]
    return {"theorem": theorem, "reference": reference, "hypotheses": stated}
