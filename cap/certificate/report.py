"""A certificate in words, for people: its theorem as the checker states it, a table of its numbers,
and what it cites.

Every number printed is one that the certificate claims; what they are called is in the theorem's
own table, in `cap.checker.theorems`.
"""

import json
import textwrap
from collections.abc import Iterator
from typing import Any

from cap.certificate.table import aligned, rows
from cap.checker.kernel.certificate import read
from cap.checker.theorems import load
from cap.checker.verdict import words

WIDTH = 110  # of a line of prose


def theorem(certificate: dict[str, Any], width: int = WIDTH) -> str:
    """Return the theorem that a certificate of this package states, with its numbers."""
    kind = certificate["theorem"]
    statement = words(read(json.dumps(certificate).encode()))
    lines = [f"Theorem ({kind}).", *_clauses(statement, width), ""]
    lines += aligned(rows(load(kind).CLAIMS, certificate["claims"]))
    lines += ["", *_citations(certificate)]
    return "\n".join(lines).rstrip()


def _clauses(sentence: str, width: int) -> Iterator[str]:
    """Give the clauses of a sentence, each from the beginning of a line."""
    clauses = sentence.split("; ")
    for n, clause in enumerate(clauses, start=1):
        end = ";" if n < len(clauses) else "."
        yield textwrap.fill(clause + end, width, subsequent_indent="  ", break_long_words=False)


def _citations(certificate: dict[str, Any]) -> Iterator[str]:
    """Give the lines that name what is cited, hypothesis by hypothesis."""
    for cited in certificate["cites"]:
        yield f"Cited: {cited['theorem']} ({cited['reference']})."
        for hypothesis in cited["hypotheses"]:
            by = ", ".join(hypothesis["by"])
            yield f"  {hypothesis['name']:<10} {hypothesis['statement']}  <- {by}"
