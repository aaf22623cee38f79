"""Decide claims: from the cache or anew, one after the other or on several processes."""

import signal
from collections.abc import Callable, Collection, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, ProcessPoolExecutor, wait
from dataclasses import replace
from functools import partial

from cap.audit import cache, ledger, tables
from cap.audit.claim import Claim
from cap.audit.dependencies import digest
from cap.audit.given import as_in_the_erratum
from cap.audit.means import accepted, stored
from cap.audit.means.need import steps
from cap.audit.means.written import exists
from cap.audit.steps import Steps
from cap.audit.tables import Row
from cap.audit.verdict import Outcome, Strength, Verdict
from cap.errors import BadInput, NotProved

Progress = Callable[[str], None]
Part = tuple[dict[str, Verdict], dict[str, str]]  # verdicts, and the certificates noted meanwhile


def decided(claim: Claim, *, fresh: bool = False) -> Verdict:
    """Return the verdict on a claim; whatever goes wrong makes it undecided, and says why."""
    if isinstance(claim, Row):
        return _of_a_table(claim, fresh)
    if not fresh and (found := cache.known(claim)):
        return found
    stored.asked_for()
    steps()
    try:
        verdict = claim.decide()
    except Exception as failure:  # noqa: BLE001 (a claim that cannot be decided is no crash)
        verdict = _undecided(f"{type(failure).__name__}: {failure}")
    asked = stored.asked_for()
    verdict = _rested(verdict, asked.keys(), steps())
    cache.keep(claim, verdict, asked)
    return verdict


def _rested(verdict: Verdict, certificates: Collection[str], made: int) -> Verdict:
    """Return the verdict with the strength of what it rests on.

    That is a written proof, which must be there; else the certificates that were asked for; else
    the steps that were made; else the reading of the text.  What is numerical, or not decided,
    says so itself.
    """
    if verdict.proof and not exists(verdict.proof):
        return _undecided(f"the written proof {verdict.proof} is missing")
    if verdict.certificate and verdict.certificate not in certificates:
        return _undecided(f"the certificate {verdict.certificate} is named, and was not checked")
    if verdict.strength in (Strength.NUMERICAL, Strength.NONE):
        return verdict
    if verdict.proof:
        return replace(verdict, strength=Strength.BY_ARGUMENT)
    if certificates:
        return replace(verdict, strength=Strength.CERTIFIED)
    return replace(verdict, strength=Strength.PROVED if made else Strength.READ)


def _of_a_table(row: Row, fresh: bool) -> Verdict:
    """Return the verdict on a row; its table is computed once, and the cache keeps the table."""
    try:
        tables.rows(row.table, fresh=fresh)
        as_in_the_erratum(row.id, Steps())
        return row.decide()
    except NotProved as failure:
        return _undecided(str(failure))


def _undecided(why: str) -> Verdict:
    return Verdict(outcome=Outcome.UNDECIDED, found="", evidence=why[:500], strength=Strength.NONE)


def all_decided(
    claims: Iterable[Claim], progress: Progress, *, jobs: int = 1, fresh: bool = False
) -> dict[str, Verdict]:
    """Return the verdicts by id, in the order of the claims; ``progress`` hears each id."""
    asked = list(claims)
    for module in {each.module for each in asked}:
        digest(module)  # of the sources as they are now, not as they may be edited meanwhile
    parts = _parts(asked)
    done = _one_by_one if jobs == 1 else partial(_at_once, jobs=jobs)
    found: dict[str, Verdict] = {}
    for verdicts, notes in done(parts, progress, fresh):
        found |= verdicts
        accepted.give(notes)
    return {each.id: found[each.id] for each in asked}


def _parts(asked: list[Claim]) -> list[list[str]]:
    """Return what is decided together: the rows of each table, which come first; one claim."""
    together: dict[str, list[str]] = {}
    for each in asked:
        if isinstance(each, Row):
            together.setdefault(each.table, []).append(each.id)
    return [*together.values(), *([each.id] for each in asked if not isinstance(each, Row))]


def _one_by_one(parts: list[list[str]], progress: Progress, fresh: bool) -> Iterator[Part]:
    left = sum(map(len, parts))
    for part in parts:
        progress(f"{left} claims to decide; {part[0]}")
        yield _by_ids(part, fresh)
        left -= len(part)


def _at_once(parts: list[list[str]], progress: Progress, fresh: bool, jobs: int) -> Iterator[Part]:
    """Decide on processes; an interrupt reaches this one only."""
    ignore = signal.SIGINT, signal.SIG_IGN
    with ProcessPoolExecutor(jobs, initializer=signal.signal, initargs=ignore) as executor:
        todo = {executor.submit(_by_ids, part, fresh): part for part in parts}
        try:
            while todo:
                done, _ = wait(todo, return_when=FIRST_COMPLETED)
                for each in done:
                    part = todo.pop(each)
                    progress(f"{sum(map(len, todo.values()))} claims to decide; {part[0]}")
                    yield each.result()
        except BrokenExecutor:
            raise BadInput("a process of --jobs was killed (what was decided is kept)") from None
        except BaseException:
            executor.shutdown(wait=False, cancel_futures=True)
            raise


def _by_ids(names: list[str], fresh: bool) -> Part:
    """Decide claims by their ids, which any process knows."""
    verdicts = {name: decided(ledger.claims()[name], fresh=fresh) for name in names}
    return verdicts, accepted.taken()
