"""The two ways in which a request can end without a theorem."""

from collections.abc import Mapping
from typing import Any

DIGITS = 10  # of a number in a message


class BadInput(ValueError):
    """The request itself makes no sense; the message is one line for its author."""


class NotProved(Exception):
    """A proof step did not succeed.  This never says that the statement is false.

    ``step`` names the step, ``reason`` says what was not established, and ``sets`` holds the
    enclosures at which it failed, by name: as they are; in the message numbers have ten digits,
    rounded outwards.
    """

    def __init__(self, step: str, reason: str, sets: Mapping[str, object] | None = None) -> None:
        self.step = step
        self.reason = reason
        self.sets = dict(sets or {})
        shown = ", ".join(f"{name} = {_shown(value)}" for name, value in self.sets.items())
        super().__init__(f"{step}: {reason}" + (f"  [{shown}]" if shown else ""))

    def __reduce__(self) -> tuple[Any, ...]:
        """Let it be raised in another process."""
        return type(self), (self.step, self.reason, self.sets)


def _shown(value: object) -> str:
    """Return a number, or several, for people; balls are known by their method, as none is here."""
    if isinstance(value, list | tuple):
        return f"({', '.join(map(_shown, value))})"
    digits = getattr(value, "str", None)
    return str(digits(DIGITS) if digits else value)


class TooFewDigits(NotProved):
    """What was proved is not sharp enough for the digits claimed; more precision may help."""
