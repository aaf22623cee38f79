"""Tables as claims: each row is one, decided when its table is computed.

``paper.toml`` names the module that computes them, which has ``LABELS``, and of each label the
``module`` with what is computed and the ``rows``; and the command that, with a label, does
``compute`` them.  ``tables.json`` lists the rows, so that claims
can be named without computing.  ``--record`` writes it, and a table whose rows are not those of the
list decides nothing.
"""

import re
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, replace
from functools import partial
from importlib import import_module
from typing import Protocol, cast

from cap.audit import cache as kept
from cap.audit import subject
from cap.audit.claim import Claim, Kind
from cap.audit.comparison import PROVED, Comparison
from cap.audit.comparison import Kind as Compared
from cap.audit.subject import cached
from cap.audit.verdict import Outcome, Strength, Verdict
from cap.errors import NotProved

LONGEST = 60  # end of an id
_KINDS = {Compared.VALUE: Kind.NUMBER, Compared.WORDS: Kind.WORDS}


@dataclass(frozen=True)
class Row(Claim):
    """A claim that a row of a table decides."""

    table: str = ""


class Source(Protocol):
    """What computes the tables of a paper."""

    LABELS: tuple[str, ...]

    def module(self, label: str) -> str:
        """Return the module with what is computed for a table."""

    def rows(self, label: str) -> tuple[Comparison, ...]:
        """Compute a table."""


def source() -> Source | None:
    """Return what computes the tables of the paper; none if it has none."""
    name = subject.paper().get("tables")
    return cast(Source, import_module(name)) if name else None


def labels() -> tuple[str, ...]:
    """Return the labels of the tables, in the order of the paper."""
    found = source()
    return found.LABELS if found else ()


@cached
def listed() -> dict[str, list[list[str]]]:
    """Return what, the paper's value, the place and the kind of each row, by tables."""
    return subject.data("tables.json")


def claims() -> tuple[Row, ...]:
    """Return the claims of all tables; not the rows that another claim decides."""
    elsewhere, quotes = subject.paper().get("elsewhere", {}), subject.data("quotes.toml")
    return tuple(
        Row(
            id=(name := f"{group(label)}.{_slug(what)}"),
            where=where,
            kind=Kind(kind),
            says=f"{what[0].upper()}{what[1:]}.",
            stated=paper,
            decide=partial(_decided, label, what),
            quote=quotes.get(name, ""),
            module=_module(label),
            table=label,
        )
        for label, entries in listed().items()
        for what, paper, where, kind in entries
        if what not in elsewhere.get(label, {})
    )


def _module(label: str) -> str:
    found = source()
    return found.module(label) if found else ""


def group(label: str) -> str:
    """Return what the ids of the rows of a table begin with."""
    return label.replace(":", "-").lower()


def _slug(text: str) -> str:
    """Return whole words of a text, as the end of an id."""
    words = re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")
    return words if len(words) <= LONGEST else words[: LONGEST + 1].rpartition("-")[0]


def _decided(label: str, what: str) -> Verdict:
    return verdict({row.what: row for row in rows(label)}[what])


def verdict(row: Comparison) -> Verdict:
    """Return what a comparison says of the paper.

    A number that is another one is corrected, words that are not so are refuted; what the paper
    says too roughly, or of a procedure that it does not give, is imprecise; where it does not say
    what is to be computed, nothing is decided.
    """
    outcome = Outcome.REFUTED if row.kind is Compared.WORDS else Outcome.CORRECTED
    strength = Strength.PROVED if row.rigorous else Strength.NUMERICAL
    found = row.ours.replace(PROVED, "")
    if row.unstated:
        outcome, strength, found = Outcome.UNCHECKABLE, Strength.NONE, f"here: {found}"
    elif row.agrees:
        outcome = Outcome.CONFIRMED
    elif row.imprecise:
        outcome = Outcome.IMPRECISE
    evidence = f"{row.reason}." if row.reason else ""
    return Verdict(outcome=outcome, strength=strength, found=found, evidence=evidence)


def rows(label: str, *, fresh: bool = False) -> tuple[Comparison, ...]:
    """Return the rows of a table, computed once in a process, or kept on disk.

    Raises `NotProved` if they cannot be computed, or are not those that are listed.
    """
    if label not in _FOUND:
        _FOUND[label] = _rows(label, fresh)
    found = _FOUND[label]
    if isinstance(found, str):
        raise NotProved("audit", found)
    return found


_FOUND: dict[str, tuple[Comparison, ...] | str] = {}


def _rows(label: str, fresh: bool) -> tuple[Comparison, ...] | str:
    try:
        found = _computed_once(label, fresh)
    except Exception as failure:  # noqa: BLE001 (a table that cannot be computed is no crash)
        return f"the table of {label}: {type(failure).__name__}: {failure}"
    if _listing(label, found) != listed().get(label):
        return f"the table of {label} has other rows than tables.json: look, and use --record"
    return found


def computed(label: str) -> tuple[Comparison, ...]:
    """Compute a table."""
    found = source()
    if not found:
        raise NotProved("audit", "the paper has no tables that are computed")
    return found.rows(label)


def _computed_once(label: str, fresh: bool) -> tuple[Comparison, ...]:
    """Return the rows that are kept on disk, or compute and keep them."""
    entry = None if fresh else kept.read(label, _module(label))
    if isinstance(entry, list):
        rows = (Comparison(**each) for each in entry)
        return tuple(replace(row, kind=Compared(row.kind)) for row in rows)
    found = computed(label)
    kept.write(label, _module(label), [asdict(row) for row in found])
    return found


def _listing(label: str, found: Iterable[Comparison]) -> list[list[str]]:
    return [[row.what, row.paper, row.where or label, str(_KINDS[row.kind])] for row in found]


def record(progress: Callable[[str], None], wanted: Iterable[str], *, fresh: bool) -> None:
    """List the rows of some tables anew."""
    new = {label: listed()[label] for label in labels() if label in listed()}
    for label in wanted:
        progress(f"the table of {label}")
        _FOUND[label] = found = _computed_once(label, fresh)
        new[label] = _listing(label, found)
    subject.store("tables.json", subject.dumps(new))
