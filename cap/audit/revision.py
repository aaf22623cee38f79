"""A version of the paper: what became of the sentence that each claim was taken from.

Each piece that is quoted is in the paper once, so that its line follows, and so that a piece which
is gone from another version says that the claim has to be looked at again.
"""

import hashlib
import json
import re
from dataclasses import replace
from enum import StrEnum
from fractions import Fraction
from pathlib import Path

from cap.audit import errata, labels, ledger, recorded, subject
from cap.audit.claim import Kind
from cap.audit.comparison import rounded
from cap.audit.manuscript import Manuscript
from cap.audit.verdict import Outcome
from cap.errors import BadInput

_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?")
LEAST = 12  # characters that two pieces have in common
WRONG = Outcome.CORRECTED, Outcome.REFUTED
PRINTED = Kind.FORMULA, Kind.NUMBER, Kind.INEQUALITY  # of which each wrong one has a change


class State(StrEnum):
    """What became of a sentence."""

    STANDS = "as it was"
    CORRECTED = "corrected"  # as the erratum has it, or a number that is the one found
    CHANGED = "changed"  # another number, or a part of the erratum
    GONE = "gone"


def sentence(name: str, manuscript: Manuscript) -> tuple[State, str]:
    """Return the state of the sentence of a claim, and what is seen of it.

    What is recorded says what number is right.
    """
    piece, wanted = ledger.quotes()[name], errata.of(name)
    done = [each.made(manuscript) for each in wanted]
    if wanted and all(done):
        return State.CORRECTED, "as the erratum has it"
    if manuscript.count(piece):
        return State.STANDS, "corrected elsewhere only" if any(done) else ""
    if any(done):
        return State.CHANGED, "corrected in some places, not in all"
    if others := _others(piece, manuscript):
        return State.CORRECTED, f"the erratum has it, for {', '.join(others)}"
    if not (numbers := _numbers(piece, manuscript)):
        return State.GONE, " ".join(piece.split())
    found = recorded.recorded()[name].found
    right = all(agrees(each, found) for each in numbers)
    state = State.CORRECTED if right else State.CHANGED
    return state, f"now {', '.join(numbers)}; found: {found}"


def _others(piece: str, manuscript: Manuscript) -> list[str]:
    """Return the claims whose changes, as the erratum has them, are why a piece is gone."""
    own = " ".join(piece.split())
    names: dict[str, None] = {}
    for each in errata.changes():
        old = " ".join(each.old.split())
        if old in own:
            new = own.replace(old, " ".join(each.new.split()))
            done = manuscript.count(new) > 0
        else:
            done = own in old or _overlap(old, own) or _overlap(own, old)
        if done and each.made(manuscript):
            names |= dict.fromkeys(each.claims)
    return list(names)


def _overlap(first: str, second: str) -> bool:
    """Return whether one ends with what the other begins with, more than a word of it."""
    return any(first.endswith(second[:k]) for k in range(LEAST, min(len(first), len(second))))


def _numbers(piece: str, manuscript: Manuscript) -> list[str]:
    """Return the numbers that are others where, but for its numbers, the piece is in the text."""
    words = [_NUMBER.split(word) for word in piece.split()]
    number = r"([-+]?\d+(?:\.\d+)?)"
    pattern = r"\s+".join(number.join(map(re.escape, parts)) for parts in words)
    found = list(re.finditer(pattern, manuscript.text))
    if len(found) != 1:
        return []
    both = zip(_NUMBER.findall(piece), found[0].groups(), strict=True)
    return [new for old, new in both if Fraction(new) != Fraction(old)]


def agrees(number: str, found: str) -> bool:
    """Return whether a printed number is one of those found, rounded to its last digit."""
    numbers = map(Fraction, _NUMBER.findall(found))
    return any(rounded(number, each, each) is Outcome.CONFIRMED for each in numbers)


def compared(path: Path) -> list[str]:
    """Return how the places of a TeX file differ from those that are stored."""
    own, new = labels.stored(), labels.read(path)
    before, now = ({place.label: place for place in paper.places} for paper in (own, new))
    lines = [f"gone: {label}" for label in before.keys() - now]
    lines += [f"new: {label}" for label in now.keys() - before]
    changed = [label for label in before.keys() & now if before[label] != now[label]]
    lines += [f"moved or changed: {label}" for label in changed]
    if own.sha256 != new.sha256:
        lines.append(f"the file has the digest {new.sha256}, not {own.sha256}")
    return sorted(lines)


def told(manuscript: Manuscript) -> list[str]:
    """Return, in lines, which sentences are others now, and how many wrong ones are left."""
    known, claims = recorded.recorded(), ledger.claims()
    found = {name: sentence(name, manuscript) for name in ledger.quotes()}
    stand = {name for name, (state, _) in found.items() if state is State.STANDS}
    others = {name: each for name, each in found.items() if name not in stand or each[1]}
    wrong = [name for name in claims if known[name].outcome in WRONG]
    left = [claims[name].kind for name in wrong if name in stand]
    return [
        *sorted(f"{state}: {name}: {seen}" for name, (state, seen) in others.items()),
        f"{len(stand)} of {len(found)} sentences are in this file as they were. Of {len(wrong)} "
        f"that the audit corrects or refutes {len(left)} are left, "
        f"{sum(kind in PRINTED for kind in left)} of them formulas and numbers",
    ]


def bound() -> str:
    """Return a digest of the quotations and the erratum as they are stored."""
    own = json.dumps(ledger.quotes(), sort_keys=True).encode()
    return hashlib.sha256(own + subject.file("errata.toml").read_bytes()).hexdigest()


def fitted(path: Path) -> labels.Paper:
    """Return the places of a TeX file that every quotation and every change fits, or `BadInput`."""
    manuscript = Manuscript.read(path)
    found = {name: manuscript.lines(piece) for name, piece in ledger.quotes().items()}
    if missing := [name for name, lines in found.items() if len(lines) != 1]:
        raise BadInput(f"not once in {path}: what is quoted by {', '.join(sorted(missing))}")
    for each in errata.corrected(manuscript)[1]:
        raise BadInput(errata.misfit(each))
    lines = {name: line for name, (line,) in found.items()}
    return replace(labels.read(path), lines=lines, bound=bound())
