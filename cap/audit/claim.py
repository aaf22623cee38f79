"""A claim of the paper, and the decorator that makes one of a function that decides it.

    @claim("eq:saltation-turn", FORMULA, stated="(F cos ωt - f)/(F cos ωt + f)")
    def turning_factor() -> Verdict:
        '''At a turning point from the left, velocities are multiplied by this factor.'''
        ...

The docstring is the claim, in our words.  The function decides it: it computes, and returns a
verdict that follows from what it computed, or raises `NotProved`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from inspect import cleandoc

from cap.audit.verdict import Verdict


class Kind(StrEnum):
    """What a claim is."""

    THEOREM = "statement"
    STEP = "step of a proof"
    FORMULA = "formula"
    NUMBER = "number"
    INEQUALITY = "inequality"
    DEFINITION = "definition"
    CONSISTENCY = "consistency"
    WORDS = "description"


Decide = Callable[[], Verdict]


@dataclass(frozen=True)
class Claim:
    """A claim: its place, a label of the paper; in our words; the value stated; who decides it."""

    id: str
    where: str
    kind: Kind
    says: str
    stated: str
    decide: Decide
    by: str = ""  # the module of the function, if it does not say it itself

    @property
    def module(self) -> str:
        """The module of the function that decides it."""
        return self.by or self.decide.__module__


_DECLARED: dict[str, list[Claim]] = {}


def claim(where: str, kind: Kind, stated: str = "") -> Callable[[Decide], Decide]:
    """Declare the function as what decides a claim; its id is made of its module and its name."""

    def declare(decide: Decide) -> Decide:
        group = decide.__module__.rpartition(".")[2]
        name = f"{group}.{decide.__name__}".replace("_", "-")
        says = " ".join(cleandoc(decide.__doc__ or "").split())
        declared = _DECLARED.setdefault(decide.__module__, [])
        declared[:] = [each for each in declared if each.id != name]
        declared.append(Claim(name, where, kind, says, stated, decide))
        return decide

    return declare


def declared_in(module: str) -> tuple[Claim, ...]:
    """Return the claims that a module declares, in its order."""
    return tuple(_DECLARED.get(module, ()))
