"""All claims, in the order of the paper."""

from itertools import takewhile

from cap.audit import given, labels, subject, tables
from cap.audit.claim import Claim
from cap.audit.subject import cached
from cap.errors import BadInput
from cap.words import meant


@cached
def claims() -> dict[str, Claim]:
    """Return all claims by their ids: place after place, and there in the order of the groups.

    The rows of tables come after the other claims of their places.
    """
    found: list[Claim] = []
    for group in subject.paper().get("groups", []):
        path, module = subject.file(f"claims/{group}.toml"), subject.module(f"claims.{group}")
        if not path.is_file():
            raise BadInput(f"the group {group!r} of paper.toml has no file: {path}")
        found += given.claims(path, module)
    found += tables.claims()
    order = {place.label: k for k, place in enumerate(labels.stored().places)}
    found.sort(key=lambda each: order.get(each.where, len(order)))
    return {each.id: each for each in found}


@cached
def quotes() -> dict[str, str]:
    """Return the pieces of TeX that the claims are taken from, each once in the paper, by ids."""
    return {name: each.quote for name, each in claims().items()}


def sections() -> dict[str, str]:
    """Return the sections of the paper, in its order: their titles by their numbers."""
    front = {"0": "Abstract"}
    headings = (place for place in labels.stored().places if place.kind == "section")
    return front | {place.number: place.title for place in headings}


def chosen(only: str | None, section: str | None) -> list[Claim]:
    """Return the claims that are asked for: one, those of a group, those of a section.

    Raises `BadInput` if there are none of this name.
    """
    found = list(claims().values())
    if only is not None:
        found = [each for each in found if only in (each.id, each.id.partition(".")[0])]
        if not found:
            raise BadInput(f"there is no claim {only!r}{_near(only)}")
    if section is not None:
        inside = _inside(section)
        found = [each for each in found if each.where in inside]
        if not found:
            raise BadInput(f"no claim is taken from section {section}")
    return found


def _inside(text: str) -> set[str]:
    """Return the labels in a section, or in a subsection that has a label.

    Either is given by its number or its label, a section by any other label in it, too.
    """
    places = labels.stored().places
    parts = {place.number: k for k, place in enumerate(places) if place.kind == "subsection"}
    known = {place.label: k for k, place in enumerate(places)}
    first = parts.get(text, known.get(text))
    if first is not None and places[first].kind == "subsection":
        rest = takewhile(lambda each: "section" not in each.kind, places[first + 1 :])
        return {places[first].label, *(each.label for each in rest)}
    section = text if first is None else places[first].section
    if section not in sections():
        raise BadInput(f"the paper has no section {text!r}{_near(text)}")
    return {place.label for place in places if place.section == section}


def _near(text: str) -> str:
    """Return a guess of what was meant."""
    return meant(text, [*claims(), *(place.label for place in labels.stored().places)])
