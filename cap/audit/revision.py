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
from cap.audit.comparison import digits, rounded
from cap.audit.manuscript import Manuscript
from cap.audit.verdict import Outcome
from cap.errors import BadInput

_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?")
WRONG = Outcome.CORRECTED, Outcome.REFUTED
PRINTED = Kind.FORMULA, Kind.NUMBER, Kind.INEQUALITY  # of which each wrong one has a change


class State(StrEnum):
    """What became of a sentence."""

    STANDS = "as it was"
    CORRECTED = "corrected"  # as the erratum has it, or a number that is the one found
    CHANGED = "changed"  # another number, or a part of the erratum
    GONE = "gone"


def sentence(name: str, manuscript: Manuscript, before: Manuscript) -> tuple[State, str]:
    """Return the state of the sentence of a claim, and what is seen of it.

    ``before``: the text without the changes that it has.  What is recorded says what number is
    right.
    """
    piece, done = ledger.quotes()[name], [each.made(manuscript) for each in errata.of(name)]
    alone = before.count(piece) > 0
    if done and all(done):
        seen = "as the erratum has it" if alone else "corrected, and another besides"
        return State.CORRECTED if alone else State.CHANGED, seen
    if manuscript.count(piece):
        return State.STANDS, "corrected elsewhere only" if any(done) else ""
    if any(done):
        return State.CHANGED, "corrected in some places, not in all"
    if alone:
        return State.CORRECTED, "as the erratum has it, for other claims"
    numbers = _numbers(piece, manuscript)
    if not (changed := [new for old, new in numbers if Fraction(old) != Fraction(new)]):
        return State.GONE, " ".join(piece.split())
    state = State.CORRECTED if _right(name, numbers) else State.CHANGED
    return state, f"now {', '.join(changed)}; found: {recorded.recorded()[name].found}"


def _numbers(piece: str, manuscript: Manuscript) -> list[tuple[str, str]]:
    """Return the numbers of a piece, old and new, if but for them it is in the text."""
    words = [_NUMBER.split(word) for word in piece.split()]
    number = r"([-+]?\d+(?:\.\d+)?)"
    pattern = r"\s+".join(number.join(map(re.escape, parts)) for parts in words)
    found = list(re.finditer(pattern, manuscript.text))
    if len(found) != 1:
        return []
    return list(zip(_NUMBER.findall(piece), found[0].groups(), strict=True))


def _right(name: str, numbers: list[tuple[str, str]]) -> bool:
    """Return whether each number of a sentence, old and new, is a right one now, or is as it was.

    It is one of those found, rounded, to as many digits as before: the one that it was; else, if
    it is the number that a wrong claim states, one that no other number of the sentence was.
    """
    verdict, claim = recorded.recorded()[name], ledger.claims()[name]
    known, stated = set(_NUMBER.findall(verdict.found)), _NUMBER.findall(claim.stated)
    were = [{each for each in known if _agree(old, each)} for old, _ in numbers]
    wrong = verdict.outcome in WRONG and claim.kind is Kind.NUMBER
    others = known.difference(*were) if wrong else set()
    return all(
        Fraction(old) == Fraction(new)
        or (digits(new) >= digits(old) and any(_agree(new, each) for each in own or left))
        for (old, new), own in zip(numbers, were, strict=True)
        for left in [others if old in stated else set()]
    )


def _agree(printed: str, number: str) -> bool:
    """Return whether a number is this one rounded; of an integer, whether it is this."""
    whole = digits(printed) == 0 < digits(number)
    return not whole and rounded(printed, *[Fraction(number)] * 2) is Outcome.CONFIRMED


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
    """Return, in lines, which sentences are others now, and how many wrong ones are left.

    Raises `BadInput` if it has none of the sentences.
    """
    known, claims, text = recorded.recorded(), ledger.claims(), manuscript.printed
    before = errata.undone(text)
    found = {name: sentence(name, text, before) for name in ledger.quotes()}
    if {state for state, _ in found.values()} == {State.GONE}:
        raise BadInput("this is another text: no sentence of the paper is in it")
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
    erratum = subject.file("errata.toml")
    changes = erratum.read_bytes() if erratum.is_file() else b""
    return hashlib.sha256(own + changes).hexdigest()


def fitted(path: Path) -> labels.Paper:
    """Return the places of a TeX file that every quotation and every change fits, or `BadInput`."""
    manuscript, places = Manuscript.read(path), labels.read(path)
    known = {place.label for place in places.places}
    if missing := [name for name, each in ledger.claims().items() if each.where not in known]:
        raise BadInput(f"no label in {path}: where {', '.join(sorted(missing))} are taken from")
    found = {name: manuscript.printed.lines(piece) for name, piece in ledger.quotes().items()}
    if missing := [name for name, lines in found.items() if len(lines) != 1]:
        raise BadInput(f"not once in {path}: what is quoted by {', '.join(sorted(missing))}")
    for each in errata.corrected(manuscript)[1]:
        raise BadInput(errata.misfit(each))
    for each in errata.changes():
        others = manuscript.replaced(each.old, "")
        if others != manuscript and others.count(each.new):
            raise BadInput(f"{path} has elsewhere what is new for {each.claims[0]}: {each.new}")
    lines = {name: line for name, (line,) in found.items()}
    return replace(places, lines=lines, bound=bound())
