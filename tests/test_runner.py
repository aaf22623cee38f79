"""The runner of pieces: order, executors, the journal, ctrl-C, progress, bounded numbers."""

import json
import os
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from itertools import count, islice
from multiprocessing import get_context
from threading import get_ident

import pytest

from cap.errors import BadInput, NotProved
from cap.runner import AHEAD, Plan, Runner, within


def square(n):
    """Return a square."""
    return n * n


def interrupting(after):
    """Return a function of numbers that is interrupted from one on."""

    def function(n):
        if n >= after:
            raise KeyboardInterrupt
        return square(n)

    return function


def process(_):
    """Return the number of the process that does this, as a string."""
    return str(os.getpid())


def dying(n):
    """End the process."""
    os._exit(n + 1)


@pytest.mark.parametrize(("jobs", "processes"), [(1, False), (3, False), (2, True)])
def test_results_are_in_the_order_of_the_tasks(jobs, processes):
    """Here, in threads, in processes."""
    found = Runner(jobs).map(square, list(range(20)), "test", processes=processes)
    assert found == [n * n for n in range(20)]
    assert Runner(jobs).map(square, [], "test", processes=processes) == []


def unproved(n):
    """Fail to prove something."""
    raise NotProved("Lemma 4", "too many", {"cells": n})


@pytest.mark.parametrize("jobs", [1, 2])
def test_what_is_not_proved_in_a_process(jobs):
    """It is not proved here either, and says where."""
    with pytest.raises(NotProved, match=r"too many.*cells = ") as caught:
        Runner(jobs).map(unproved, [7, 7], "", processes=True)
    assert (caught.value.step, caught.value.sets) == ("Lemma 4", {"cells": 7})


@pytest.mark.parametrize("jobs", [1, 3])
def test_ctrl_c_keeps_what_is_done(jobs):
    """The first results; and from then on nothing begins."""
    runner = Runner(jobs)
    found = runner.map(interrupting(5), list(range(20)), "test")
    assert runner.interrupted
    assert found == [n * n for n in range(len(found))]
    assert len(found) <= 5
    assert runner.map(square, [1], "test") == []


def test_where_the_work_is_done():
    """Here if alone; else in threads, if that may be, or processes; an executor's if it may."""
    here = process(None)
    with ProcessPoolExecutor(1, get_context("spawn")) as executor:
        for runner, plan, is_here in (
            (Runner(), Plan(), True),
            (Runner(2), Plan(), False),
            (Runner(2), Plan(threads=True), True),
            (Runner(executor=executor), Plan(threads=True), False),
            (Runner(2, executor=executor), Plan(threads=True, inside=True), True),
        ):
            assert all((n == here) == is_here for _, n in runner.run(process, range(2), plan))
    threads = {n for _, n in Runner(2).run(lambda _: get_ident(), range(9), Plan(threads=True))}
    assert get_ident() not in threads
    assert len(threads) <= 2


def test_ctrl_c_of_what_is_done_whole_or_not_at_all():
    """It passes."""
    runner = Runner(whole=True)
    with pytest.raises(KeyboardInterrupt):
        runner.map(interrupting(5), list(range(20)), "test")
    assert runner.interrupted


def test_the_caller_may_leave_early():
    """Tasks without end: only those asked for are done, and a few ahead of them."""
    begun = []

    def noted(n):
        begun.append(n)
        return n

    with ThreadPoolExecutor(2) as executor:
        results = Runner(executor=executor).run(noted, count(), Plan())
        assert len(list(islice(results, 10))) == 10
        results.close()
    assert len(begun) <= 10 + 2 * AHEAD + 1


def test_results_call_for_more_tasks():
    """Each of them is done once."""

    def more(n, _result):
        return (2 * n, 2 * n + 1) if n < 8 else ()

    for runner in (Runner(), Runner(2)):
        done = [n for n, _ in runner.run(square, [1], Plan(more=more, threads=True))]
        assert sorted(done) == list(range(1, 16))


def test_a_journal_is_gone_on_with(tmp_path):
    """After an interrupt only the rest is computed; another computation is refused."""
    plan = Plan(key="squares", decode=int)
    runner = Runner(journal=tmp_path / "journal")
    before = dict(runner.run(interrupting(3), range(6), plan))
    assert before == {0: 0, 1: 1, 2: 4}
    again = []

    def rest(n):
        again.append(n)
        return square(n)

    runner = Runner(journal=tmp_path / "journal")
    assert dict(runner.run(rest, range(6), plan)) == {n: n * n for n in range(6)}
    assert again == [3, 4, 5]
    with pytest.raises(BadInput, match="something else"):
        list(runner.run(square, range(6), Plan(key="cubes", decode=int)))


def test_workers_write_what_a_journal_keeps(tmp_path):
    """It may take long; so it is not left to the process that asks."""
    path = tmp_path / "journal"
    with ProcessPoolExecutor(1, get_context("spawn")) as executor:
        found = dict(
            Runner(executor=executor, journal=path).run(process, [0], Plan(encode=process))
        )
    (line,) = path.read_text(encoding="ascii").splitlines()[1:]
    assert json.loads(line) == ["0", found[0]]


def test_progress():
    """Parts grow to the whole, under the name given; nothing is told without a name."""
    told = []
    runner = Runner(tell=lambda words, part: told.append((words, part)))
    runner.map(square, list(range(4)), "squares")
    assert told == [("squares", part) for part in (0.25, 0.5, 0.75, 1.0)]
    told.clear()
    list(runner.run(square, range(4), Plan()))
    assert told == []
    weighed = Plan(words="squares", weight=float, total=6)
    list(runner.run(square, range(4), weighed))
    assert [part for _, part in told] == [0, 1 / 6, 3 / 6, 1]


def test_a_phase_of_a_longer_computation():
    """Its parts are between two of the whole; words without a part stay without."""
    told = []
    inner = within(within(lambda *each: told.append(each), 0.5, 1, "check: "), 0, 0.5)
    for part in (0, 0.5, 1, None):
        inner("cells", part)
    assert told == [("check: cells", part) for part in (0.5, 0.625, 0.75, None)]


def test_a_process_that_dies():
    """One line."""
    with pytest.raises(BadInput, match="killed"):
        Runner(2).map(dying, [1, 2], "test", processes=True)


def test_what_is_raised_is_raised():
    """An error is no interrupt."""

    def fails(_):
        raise BadInput("no")

    for jobs in (1, 2):
        runner = Runner(jobs)
        with pytest.raises(BadInput, match="no"):
            runner.map(fails, [1, 2, 3], "test")
        assert not runner.interrupted
