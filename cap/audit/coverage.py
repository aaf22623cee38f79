"""Which places of the paper claims are taken from; it fails if a place is forgotten."""

from dataclasses import dataclass, replace
from pathlib import Path

from cap.audit import labels, ledger, subject
from cap.audit.labels import Place


@dataclass(frozen=True)
class Coverage:
    """The places with the ids of their claims; ``wrong``: what must not be, in words."""

    claims: dict[str, list[str]]
    wrong: tuple[str, ...]

    def lines(self) -> list[str]:
        """Return one line for each place, and what is wrong."""
        paper = labels.stored()
        shown = [_line(place, self.claims[place.label]) for place in paper.places]
        taken = sum(bool(ids) for ids in self.claims.values())
        total = sum(len(ids) for ids in self.claims.values())
        summary = (
            f"{len(paper.places)} places: {taken} with {total} claims, {len(_reasons())} with a "
            "reason for none"
        )
        return [*shown, "", summary, *(f"WRONG: {each}" for each in self.wrong)]


def _reasons() -> dict[str, str]:
    """Return why no claim is taken from some places."""
    found: dict[str, str] = subject.paper()["none"]
    return found


def coverage() -> Coverage:
    """Compare the places with the claims and the reasons."""
    found: dict[str, list[str]] = {place.label: [] for place in labels.stored().places}
    wrong = []
    for claim in ledger.claims().values():
        if claim.where in found:
            found[claim.where].append(claim.id)
        else:
            wrong.append(f"claim {claim.id} is taken from {claim.where!r}, which is no place")
    reasons = _reasons()
    wrong += [
        f"a reason is given for {each!r}, which is no place" for each in reasons.keys() - found
    ]
    for label, ids in found.items():
        if ids and label in reasons:
            wrong.append(f"{label} has claims, and a reason for having none")
        if not ids and label not in reasons:
            wrong.append(f"{label} is forgotten: it has neither claims nor a reason for none")
    return Coverage(found, tuple(wrong))


def _line(place: Place, ids: list[str]) -> str:
    name = f"{place.kind} {place.number}".strip()
    words = ", ".join(ids) if ids else f"none: {_reasons().get(place.label, 'FORGOTTEN')}"
    return f"{place.label:<28} {name:<20} {words}"


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
