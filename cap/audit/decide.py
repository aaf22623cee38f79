"""Decide claims: from the cache or anew, one after the other or on several processes."""

import signal
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, ProcessPoolExecutor, wait

from cap.audit import cache, ledger
from cap.audit.claim import Claim
from cap.audit.means import stored
from cap.audit.means.written import exists
from cap.audit.verdict import Outcome, Strength, Verdict
from cap.errors import BadInput

Progress = Callable[[str], None]


def decided(claim: Claim, *, fresh: bool = False) -> Verdict:
    """Return the verdict on a claim; whatever goes wrong makes it undecided, and says why."""
    if not fresh and (found := cache.known(claim)):
        return found
    stored.asked_for()
    try:
        verdict = claim.decide()
        if verdict.proof and not exists(verdict.proof):
            verdict = _undecided(f"the written proof {verdict.proof} is missing")
    except Exception as failure:  # noqa: BLE001 (a claim that cannot be decided is no crash)
        verdict = _undecided(f"{type(failure).__name__}: {failure}")
    cache.keep(claim, verdict, stored.asked_for())
    return verdict


def _undecided(why: str) -> Verdict:
    return Verdict(outcome=Outcome.UNDECIDED, found="", evidence=why[:500], strength=Strength.NONE)


def all_decided(
    claims: Iterable[Claim], progress: Progress, *, jobs: int = 1, fresh: bool = False
) -> dict[str, Verdict]:
    """Return the verdicts by id, in the order of the claims; ``progress`` hears each id."""
    ids = [each.id for each in claims]
    run = _one_by_one(ids, progress, fresh) if jobs == 1 else _at_once(ids, progress, fresh, jobs)
    found = dict(run)
    return {name: found[name] for name in ids}


def _one_by_one(ids: list[str], progress: Progress, fresh: bool) -> Iterator[tuple[str, Verdict]]:
    for left, name in zip(range(len(ids), 0, -1), ids, strict=True):
        progress(f"{left} claims to decide; {name}")
        yield name, _by_id(name, fresh)


def _at_once(
    ids: list[str], progress: Progress, fresh: bool, jobs: int
) -> Iterator[tuple[str, Verdict]]:
    """Decide on processes; an interrupt reaches this one only."""
    ignore = signal.SIGINT, signal.SIG_IGN
    with ProcessPoolExecutor(jobs, initializer=signal.signal, initargs=ignore) as executor:
        todo = {executor.submit(_by_id, name, fresh): name for name in ids}
        try:
            while todo:
                done, _ = wait(todo, return_when=FIRST_COMPLETED)
                for each in done:
                    name = todo.pop(each)
                    progress(f"{len(todo)} claims to decide; {name}")
                    yield name, each.result()
        except BrokenExecutor:
            raise BadInput("a process of --jobs was killed (what was decided is kept)") from None
        except BaseException:
            executor.shutdown(wait=False, cancel_futures=True)
            raise


def _by_id(name: str, fresh: bool) -> Verdict:
    """Decide a claim by its id, which any process knows."""
    return decided(ledger.claims()[name], fresh=fresh)
