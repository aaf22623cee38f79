"""Decide claims: from the cache or anew, one after the other or on several processes."""

from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import replace
from functools import partial

from cap.audit import cache, ledger, subject
from cap.audit.claim import Claim
from cap.audit.means import stored
from cap.audit.means.need import noted
from cap.audit.means.written import exists
from cap.audit.verdict import Outcome, Strength, Verdict
from cap.runner import Plan, Runner

Progress = Callable[[str], None]
Part = tuple[str, ...]  # ids of claims that are decided together: the rows of a table, or one


def decided(claim: Claim, *, fresh: bool = False) -> Verdict:
    """Return the verdict on a claim; whatever goes wrong makes it undecided, and says why."""
    if not fresh and (found := cache.known(claim)) and _proof_is_there(found):
        return found
    noted()
    try:
        verdict = claim.decide()
    except Exception as failure:  # noqa: BLE001 (a claim that cannot be decided is no crash)
        verdict = _undecided(f"{type(failure).__name__}: {failure}")
    steps = noted()
    certificates = {name: stored.digest(name) for name in steps if name}
    if not claim.table:
        verdict = _rested(verdict, certificates, made=bool(steps))
    cache.keep(claim, verdict, certificates)
    return verdict


def _rested(verdict: Verdict, certificates: Collection[str], *, made: bool) -> Verdict:
    """Return the verdict with the strength of what it rests on.

    That is a written proof, which must be there; else the certificates that were asked for; else
    the steps that were made; else the reading of the text.  What is numerical, or read by
    steps, or not decided, says so itself.
    """
    if not _proof_is_there(verdict):
        return _undecided(f"the written proof {verdict.proof} is missing")
    if verdict.certificate and verdict.certificate not in certificates:
        return _undecided(f"the certificate {verdict.certificate} is named, and was not checked")
    if verdict.strength in (Strength.NUMERICAL, Strength.READ, Strength.NONE):
        return verdict
    if verdict.proof:
        return replace(verdict, strength=Strength.BY_ARGUMENT)
    if certificates:
        return replace(verdict, strength=Strength.CERTIFIED)
    return replace(verdict, strength=Strength.PROVED if made else Strength.READ)


def _proof_is_there(verdict: Verdict) -> bool:
    return not verdict.proof or exists(verdict.proof)


def _undecided(why: str) -> Verdict:
    return Verdict(outcome=Outcome.UNDECIDED, evidence=why[:500], strength=Strength.NONE)


def all_decided(
    claims: Iterable[Claim], progress: Progress, *, jobs: int = 1, fresh: bool = False
) -> dict[str, Verdict]:
    """Return the verdicts by id, in the order of the claims; ``progress`` hears each id."""
    asked = list(claims)
    part = partial(_part, subject.chosen(), fresh)
    found: dict[str, Verdict] = {}
    for _, verdicts in Runner(jobs, whole=True).run(part, _told(_parts(asked), progress), Plan()):
        found |= verdicts
    return {each.id: found[each.id] for each in asked}


def _parts(asked: list[Claim]) -> list[Part]:
    """Return what is decided together; the tables come first."""
    together: dict[str, Part] = {}
    for each in sorted(asked, key=lambda each: not each.table):
        key = each.table or each.id
        together[key] = (*together.get(key, ()), each.id)
    return list(together.values())


def _told(parts: list[Part], progress: Progress) -> Iterator[Part]:
    left = sum(map(len, parts))
    for part in parts:
        progress(f"{left} claims to decide; {part[0]}")
        yield part
        left -= len(part)


def _part(paper: str, fresh: bool, names: Part) -> dict[str, Verdict]:
    """Decide claims of a paper by their ids, which any process knows."""
    subject.choose(paper)
    cache.sources()  # as they are now, not as they may be edited meanwhile
    return {name: decided(ledger.claims()[name], fresh=fresh) for name in names}
