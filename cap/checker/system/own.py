"""What theorems about a system that the certificate holds share."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, ClassVar

from cap.checker.kernel.theorem import Theorem
from cap.checker.system.given import SYSTEM, model
from cap.checker.system.model import Model


class OwnSystem(Theorem):
    """A theorem whose parameters are a system; its claims have no units."""

    PARAMETERS: ClassVar[dict[str, Any]] = SYSTEM
    units: Mapping[str, Fraction] = {}

    @classmethod
    def parameters(cls, given: dict[str, Any]) -> Model:
        """Return the system."""
        return model(given)
