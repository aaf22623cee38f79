"""What decides claims on the tables: every row is proved, by `cap.proofs.published`."""

from functools import cache
from pathlib import Path

import cap
from cap.audit.means.need import made, need
from cap.audit.steps import Words
from cap.audit.verdict import Outcome
from cap.proofs import published
from cap.proofs.published import Row
from cap.system.files import read

ROOT = Path(cap.__file__).resolve().parents[1] / "examples"
MODEL, DATA = ROOT / "billiard.py", ROOT / "data" / "church-fortin"
PLACES = 1  # units of the last printed place


@cache
def _rows(table: str, **changes: str) -> list[Row]:
    """Return the rows of a table, at the parameters of its label or others."""
    need(MODEL.is_file() and DATA.is_dir(), "the tables are in a checkout of the repository only")
    label = {part[0]: part[1:] for part in table.split("-")}
    return published.rows(read(str(MODEL), label | changes), DATA / f"{table}.csv")


def _is_orbit(row: Row) -> bool:
    """Return whether there is an orbit with the printed numbers, and the checker accepts it."""
    made()
    found = published.verdict(row)
    return found.proved and found.places <= PLACES


def every_row(table: str, *, e: str = "") -> Words:
    """All rows of a table are orbits, at its label's restitution or another."""
    rows = _rows(table, **({"e": e} if e else {}))
    bad = [row.name for row in rows if not _is_orbit(row)]
    at = f" at e = {e}" if e else ""
    evidence = "Each row proved by a Krawczyk box and the lemmas 'no other contact', and checked."
    if not bad:
        found = f"all {len(rows)} rows are orbits{at}, in all printed places"
        return _words(Outcome.CONFIRMED, found, evidence)
    found = f"{len(rows) - len(bad)} of {len(rows)} rows are; not the rows {', '.join(bad)}"
    return _words(Outcome.CORRECTED, found, evidence)


def one_row(table: str, *, row: int) -> Words:
    """A row of a table is an orbit with two impacts and no others."""
    each = _rows(table)[row - 1]
    found = published.verdict(each)
    if found.proved and found.places <= PLACES:
        return _words(Outcome.CONFIRMED, "it is, in all printed places", "Proved, and checked.")
    need(not found.proved, "the orbit that is found has other numbers")
    need("is negative" in found.reason, "that it is no orbit is not shown")
    return _words(
        Outcome.REFUTED,
        "the equations of the impacts have a solution there, on which the ball is below the table "
        "in between",
        f"The prover: {found.reason.partition('[')[0].strip()}.",
    )


def label(table: str, *, row: int, e: str) -> Words:
    """A table has the restitution of its label; ``e`` is the other one that is tried."""
    own, other = (_is_orbit(_rows(table, **at)[row - 1]) for at in ({}, {"e": e}))
    if own:
        evidence = f"Row {row} is an orbit at the parameters of the label."
        return _words(Outcome.CONFIRMED, "so it is", evidence)
    need(other, "it is an orbit at neither")
    return _words(
        Outcome.CORRECTED,
        f"e = {e}: there its rows are orbits",
        f"Row {row} is an orbit at e = {e}; at the e of the label Newton's iteration leads to none "
        "with the numbers that are printed.",
    )


def _words(verdict: Outcome, found: str, evidence: str) -> Words:
    return {"verdict": verdict, "found": found, "evidence": evidence}
