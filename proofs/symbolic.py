"""Theorems whose proofs are identities, decided by computer algebra: they have no certificate.

A certificate holds numbers, each of which the checker encloses again.  These theorems are about all
parameters, and have none: their proof is printed, lemma by lemma, with the identities on which it
rests (`cap.proofs.identities`).
"""

from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import NamedTuple

NAMES = ("symplectic",)


class Lemma(NamedTuple):
    """A lemma: its statement in a line, and the identities decided, in words."""

    statement: str
    identities: tuple[str, ...]


def proof(name: str) -> ModuleType:
    """Return the module of a theorem: its docstring, its ``SUMMARY``, its ``LEMMAS``."""
    return import_module(f"cap.proofs.{NAMES[NAMES.index(name)]}")


def lemmas(name: str) -> list[Lemma]:
    """Prove all lemmas of a theorem; raise `NotProved` at the first that fails."""
    steps: tuple[Callable[[], Lemma], ...] = proof(name).LEMMAS
    return [step() for step in steps]


def lines(name: str) -> list[str]:
    """Prove a theorem and return its statement and the proof in lines."""
    steps = lemmas(name)
    text = [(proof(name).__doc__ or "").strip(), ""]
    for k, lemma in enumerate(steps, start=1):
        text += [
            f"Lemma {k}.  {lemma.statement}",
            *(f"    {each}" for each in lemma.identities),
            "",
        ]
    count = sum(len(lemma.identities) for lemma in steps)
    how = f"{len(steps)} lemmas, whose {count} steps are confirmed by computer algebra (sympy)"
    return [*text, f"Proved: {how}.  There are no numbers, so there is no certificate."]
