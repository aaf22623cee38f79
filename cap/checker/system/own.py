"""What theorems about a system that the certificate holds share."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.kernel.theorem import Theorem
from cap.checker.system.given import SYSTEM, model
from cap.checker.system.model import Model

MOST_KNOWN = 8  # systems that are kept
_known = dict[str, Model]()


class OwnSystem(Theorem):
    """A theorem whose parameters are a system; its claims have no units."""

    PARAMETERS: ClassVar[dict[str, Any]] = SYSTEM
    units: Mapping[str, Fraction] = {}

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Model:
        """Return the system; those of certificates about one system are one object."""
        text = repr(given)  # strings, and a number: nothing else
        if text not in _known:
            if len(_known) == MOST_KNOWN:
                _known.clear()
            _known[text] = model(given)
        return _known[text]
