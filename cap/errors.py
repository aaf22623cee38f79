"""The two ways in which a request can end without a theorem."""

from collections.abc import Mapping


class BadInput(ValueError):
    """The request itself makes no sense; the message is one line for its author."""


class NotProved(Exception):
    """A proof step did not succeed.  This never says that the statement is false.

    ``step`` names the step, ``reason`` says what was not established, and ``sets`` holds the
    enclosures at which it failed, by name.
    """

    def __init__(self, step: str, reason: str, sets: Mapping[str, object] | None = None) -> None:
        self.step = step
        self.reason = reason
        self.sets = dict(sets or {})
        super().__init__(self.__str__())

    def __str__(self) -> str:
        """One line: the step, what failed, and the sets."""
        sets = ", ".join(f"{name} = {value}" for name, value in self.sets.items())
        return f"{self.step}: {self.reason}" + (f"  [{sets}]" if sets else "")
