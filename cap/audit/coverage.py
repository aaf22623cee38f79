"""Which places of the paper claims are taken from; something is wrong if a place is forgotten."""

from collections.abc import Iterator

from cap.audit import labels, ledger, subject


def taken() -> dict[str, list[str]]:
    """Return the ids of the claims that are taken from each place, by its label."""
    found: dict[str, list[str]] = {place.label: [] for place in labels.stored().places}
    for claim in ledger.claims().values():
        found.setdefault(claim.where, []).append(claim.id)
    return found


def reasons() -> dict[str, str]:
    """Return why no claim is taken from some places."""
    found: dict[str, str] = subject.paper().get("none", {})
    return found


def wrong() -> Iterator[str]:
    """Give in words what must not be."""
    places, why = {place.label for place in labels.stored().places}, reasons()
    for label, ids in taken().items():
        if label not in places:
            yield f"claim {', '.join(ids)} is taken from {label!r}, which is no place"
        elif ids and label in why:
            yield f"{label} has claims, and a reason for having none"
        elif not ids and label not in why:
            yield f"{label} is forgotten: it has neither claims nor a reason for none"
    for label in why.keys() - places:
        yield f"a reason is given for {label!r}, which is no place"


def lines() -> list[str]:
    """Return one line for each place, and what is wrong."""
    places, ids, why = labels.stored().places, taken(), reasons()
    shown = []
    for place in places:
        name = f"{place.kind} {place.number}".strip()
        words = ", ".join(ids[place.label]) or f"none: {why.get(place.label, 'FORGOTTEN')}"
        shown.append(f"{place.label:<28} {name:<20} {words}")
    claims, some = len(ledger.claims()), sum(bool(ids[place.label]) for place in places)
    summary = (
        f"{len(places)} places: {some} with {claims} claims, {len(why)} with a reason for none"
    )
    return [*shown, "", summary, *(f"WRONG: {each}" for each in wrong())]
