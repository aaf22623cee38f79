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
    wrong += [
        f"a reason is given for {each!r}, which is no place" for each in _reasons().keys() - found
    ]
    for place in labels.stored().places:
        wrong += _wrong(place, found[place.label])
    return Coverage(found, tuple(wrong))


def _wrong(place: Place, ids: list[str]) -> list[str]:
    if ids and place.label in _reasons():
        return [f"{place.label} has claims, and a reason for having none"]
    if not ids and place.label not in _reasons():
        return [f"{place.label} is forgotten: it has neither claims nor a reason for none"]
    return []


def _line(place: Place, ids: list[str]) -> str:
    name = f"{place.kind} {place.number}".strip()
    words = ", ".join(ids) if ids else f"none: {_reasons().get(place.label, 'FORGOTTEN')}"
    return f"{place.label:<28} {name:<20} {words}"


def compared(path: Path) -> list[str]:
    """Return how the places of a TeX file differ from those that are stored."""
    own, new = labels.stored(), labels.read(path)
    old_places, new_places = ({p.label: p for p in paper.places} for paper in (own, new))
    lines = [f"gone: {label}" for label in old_places.keys() - new_places]
    lines += [f"new: {label}" for label in new_places.keys() - old_places]
    common = old_places.keys() & new_places
    lines += [
        f"moved or changed: {k}"
        for k in common
        if replace(old_places[k], line=0) != replace(new_places[k], line=0)
    ]
    if own.sha256 != new.sha256:
        lines.append(f"the file has the digest {new.sha256}, not {own.sha256}")
    return sorted(lines)
