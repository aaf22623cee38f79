"""A version of the paper: what became of the sentence that each claim was taken from.

Each piece that is quoted is in the paper once, so that its line follows, and so that a piece which
is gone from another version says that the claim has to be looked at again.
"""

import hashlib
import json
import re
from dataclasses import dataclass, replace
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


@dataclass(frozen=True)
class Sentence:
    """The state of a claim's sentence, and what is seen."""

    claim: str
    state: State
    seen: str = ""


def sentence(name: str, manuscript: Manuscript) -> Sentence:
    """Return the state of the sentence of a claim; what is recorded says what number is right."""
    piece, wanted = ledger.quotes()[name], errata.of(name)
    done = [each.made(manuscript) for each in wanted]
    if wanted and all(done):
        return Sentence(name, State.CORRECTED, "as the erratum has it")
    if manuscript.count(piece):
        return Sentence(name, State.STANDS, "" if not any(done) else "corrected elsewhere only")
    if any(done):
        return Sentence(name, State.CHANGED, "corrected in some places, not in all")
    if others := _others(piece, manuscript):
        return Sentence(name, State.CORRECTED, f"the erratum has it, for {', '.join(others)}")
    if not (numbers := _numbers(piece, manuscript)):
        return Sentence(name, State.GONE, " ".join(piece.split()))
    found = recorded.recorded()[name].found
    right = all(agrees(each, found) for each in numbers)
    state = State.CORRECTED if right else State.CHANGED
    return Sentence(name, state, f"now {', '.join(numbers)}; found: {found}")


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
    before, now = ({p.label: replace(p, line=0) for p in paper.places} for paper in (own, new))
    lines = [f"gone: {label}" for label in before.keys() - now]
    lines += [f"new: {label}" for label in now.keys() - before]
    changed = [label for label in before.keys() & now if before[label] != now[label]]
    lines += [f"moved or changed: {label}" for label in changed]
    if own.sha256 != new.sha256:
        lines.append(f"the file has the digest {new.sha256}, not {own.sha256}")
    return sorted(lines)


def told(manuscript: Manuscript) -> list[str]:
    """Return, in lines, which sentences are others now, and how many wrong ones are left."""
    all_ = [sentence(name, manuscript) for name in ledger.quotes()]
    others = [each for each in all_ if each.state is not State.STANDS or each.seen]
    known, claims = recorded.recorded(), ledger.claims()
    wrong = [each for each in all_ if known[each.claim].outcome in WRONG]
    left = [claims[each.claim].kind for each in wrong if each.state is State.STANDS]
    stand = sum(each.state is State.STANDS for each in all_)
    return [
        *sorted(f"{each.state}: {each.claim}: {each.seen}" for each in others),
        f"{stand} of {len(all_)} sentences are in this file as they were. Of {len(wrong)} that the "
        f"audit corrects or refutes {len(left)} are left, {sum(kind in PRINTED for kind in left)} "
        "of them formulas and numbers",
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
