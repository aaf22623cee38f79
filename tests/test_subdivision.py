"""Adaptive subdivision: order and covering, executors, the journal, interruption."""

import json
import os
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from fractions import Fraction
from functools import partial
from itertools import pairwise
from multiprocessing import get_context

import pytest
from support import rounds, seeded

from cap.errors import BadInput
from cap.runner import Runner
from cap.sets import interval
from cap.subdivision import UNDECIDED, Cell, cells_between, subdivide

HERE = Runner()
SMALLEST = Fraction(1, 1000)
ENDS = [Fraction(0), Fraction(1, 7), Fraction(1, 2), Fraction(1)]
ROOTS = Fraction(1, 3), Fraction(5, 7)


def sign(cell):
    """Return the sign of (x - 1/3)(x - 5/7) on a cell, where it has one."""
    if any(cell.lower <= root <= cell.upper for root in ROOTS):
        return UNDECIDED
    return "+" if sum(cell.lower > root for root in ROOTS) % 2 == 0 else "-"


def counted(directory, cell):
    """The same, leaving a file for each cell examined, whichever process does it."""
    name = f"{cell.lower} {cell.upper}".replace("/", "_")
    (directory / name).write_text("")
    return sign(cell)


def failing(after, error, cell):
    """Raise an error from a certain point on."""
    if cell.lower >= after:
        raise error
    return sign(cell)


def dying(cell):
    """Kill the process that examines this cell."""
    if cell.lower >= Fraction(1, 2):
        os._exit(3)
    return sign(cell)


def run(examine=sign, runner=HERE, key="signs", cells=None):
    """Subdivide the cells between `ENDS`."""
    return subdivide(examine, cells or cells_between(ENDS), SMALLEST, runner, key)


def covers(found, ends):
    """Check that the cells are in order, without gap, and those undecided are short."""
    cells = [cell for cell, _ in found]
    assert cells[0].lower == ends[0]
    assert cells[-1].upper == ends[-1]
    assert all(cell.lower < cell.upper for cell in cells)
    assert all(a.upper == b.lower for a, b in pairwise(cells))
    assert set(ends) <= {end for cell in cells for end in cell}


def test_the_cells_cover_in_order():
    """Each has its verdict; those undecided are shorter than twice the smallest."""
    found = run()
    covers(found, ENDS)
    for cell, verdict in found:
        assert verdict == sign(cell)
        assert verdict != UNDECIDED or cell.upper - cell.lower < 2 * SMALLEST
    undecided = [cell for cell, verdict in found if verdict == UNDECIDED]
    for root in ROOTS:
        assert any(cell.lower <= root <= cell.upper for cell in undecided)
    assert len(found) < 60


def test_nothing_to_do():
    """No cells, all decided, none ever decided."""
    assert subdivide(sign, [], SMALLEST, HERE, "") == []
    decided = run(lambda _cell: "+")
    assert decided == [(cell, "+") for cell in cells_between(ENDS)]
    never = subdivide(lambda _cell: UNDECIDED, cells_between(ENDS), Fraction(1, 20), HERE, "")
    covers(never, ENDS)
    assert all(cell.upper - cell.lower < Fraction(1, 10) for cell, _ in never)


def test_halves():
    """They make up the cell, meet well inside it, at a decimal that is short for the length."""
    random = seeded(1)
    for _ in range(rounds(200)):
        length = Fraction(random.randint(1, 999), 10 ** random.randint(0, 40))
        lower = Fraction(random.randint(-(10**6), 10**6), random.randint(1, 10**6))
        cell = Cell(lower, lower + length)
        one, other = cell.halves()
        assert (one.lower, one.upper, other.upper) == (cell.lower, other.lower, cell.upper)
        assert abs(one.upper - (cell.lower + cell.upper) / 2) <= length / 1000
        unit = Fraction(1)
        while (one.upper / unit).denominator != 1:
            unit /= 10
        assert unit >= min(length / 10**5, Fraction(1, 100))


def test_threads():
    """The same as here, on two threads."""
    with ThreadPoolExecutor(2) as executor:
        assert run(runner=Runner(executor=executor)) == run()


def at_its_precision(cell):
    """Find out whether another thread changes the precision of balls meanwhile."""
    before = interval.working_bits()
    with interval.workprec(60 + int(100 * cell.lower)):
        time.sleep(0.001)
        kept = interval.working_bits() == 60 + int(100 * cell.lower)
    return "+" if kept and interval.working_bits() == before else "-"


def test_threads_share_the_precision():
    """So they take turns: a verdict does not depend on what else is examined, nothing is leaked."""
    cells = cells_between([Fraction(k, 50) for k in range(51)])
    with interval.workprec(90), ThreadPoolExecutor(4) as executor:
        found = subdivide(at_its_precision, cells, SMALLEST, Runner(executor=executor), "")
        assert interval.working_bits() == 90
    assert {verdict for _, verdict in found} == {"+"}


def test_processes(tmp_path):
    """The same on two processes, each cell examined once."""
    with ProcessPoolExecutor(2, get_context("spawn")) as executor:
        found = run(partial(counted, tmp_path), Runner(executor=executor))
    assert found == run()
    assert len(list(tmp_path.iterdir())) >= len(found)


@pytest.mark.slow
def test_a_cluster(tmp_path):
    """The executor of a cluster serves unchanged, with a journal."""
    distributed = pytest.importorskip("distributed")
    journal = tmp_path / "journal"
    cluster = distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=True,
        dashboard_address=None,
        worker_dashboard_address=None,
        silence_logs=50,
        local_directory=str(tmp_path / "space"),
    )
    with cluster, distributed.Client(cluster) as client:
        assert run(runner=Runner(executor=client.get_executor(), journal=journal)) == run()
    assert run(forbidden, Runner(journal=journal)) == run()


def forbidden(cell):
    """Fail: nothing is left to be examined."""
    raise AssertionError(f"{cell} was examined again")


def test_the_journal_is_gone_on_with(tmp_path):
    """What it holds is not computed again, not even undecided cells."""
    journal = tmp_path / "journal"
    found = run(runner=Runner(journal=journal))
    first, *lines = journal.read_text("utf-8").splitlines()
    assert json.loads(first) == {"journal of": "signs"}
    assert len(lines) >= len(found)
    assert run(forbidden, Runner(journal=journal)) == found
    assert journal.read_text("utf-8").splitlines() == [first, *lines]
    with ThreadPoolExecutor(2) as executor:
        assert run(forbidden, Runner(executor=executor, journal=journal)) == found


@pytest.mark.parametrize("keep", [0, 1, 4, 15, 17, 18, 30, 200, 10**6])
def test_a_journal_that_was_cut_short(tmp_path, keep):
    """At any character: the whole lines are used, the rest is removed and computed again."""
    whole, journal = tmp_path / "whole", tmp_path / "cut"
    found = run(runner=Runner(journal=whole))
    text = whole.read_text("utf-8")
    journal.write_text(text[:keep])
    assert run(runner=Runner(journal=journal)) == found
    assert sorted(journal.read_text("utf-8").splitlines()) == sorted(text.splitlines())
    for line in journal.read_text("utf-8").splitlines():
        json.loads(line)


def test_a_finer_subdivision_goes_on_from_a_coarser(tmp_path):
    """What was undecided and small is halved further."""
    journal, cells = tmp_path / "journal", cells_between(ENDS)
    subdivide(sign, cells, Fraction(1, 10), Runner(journal=journal), "signs")
    assert run(runner=Runner(journal=journal)) == run()


def test_the_journal_of_something_else(tmp_path):
    """It is left as it is."""
    journal = tmp_path / "journal"
    run(runner=Runner(journal=journal), key="one")
    before = journal.read_text("utf-8")
    with pytest.raises(BadInput, match="something else"):
        run(runner=Runner(journal=journal), key="other")
    assert journal.read_text("utf-8") == before


@pytest.mark.parametrize(
    "text",
    [
        "some notes without an end of line",
        "some notes\n",
        '{"journal of": "other"}\n',
        "[]\n",
        "17\n",
        '{"journal of": "signs"}\n["0 1/7"]\n',
        '{"journal of": "signs"}\n["0 1/7", "+", "+"]\n',
        '{"journal of": "signs"}\n[null, "+"]\n',
        '{"journal of": "signs"}\n[Infinity, "+"]\n',
        '{"journal of": "signs"}\n[NaN, "+"]\n',
        '{"journal of": "signs"}\n5\n',
        '{"journal of": "signs"}\n{"0 1/7": "+"}\n',
        '{"journal of": "signs"}\n' + "[" * 100000 + "\n",
        '{"journal of": "signs"}\n["0 1/7", null]\n',
        '{"journal of": "signs"}\n["0 1/7", "+"] ["0 1/7", "+"]\n',
        "\0\n",
    ],
    ids=range(16),
)
def test_files_that_are_no_journal(tmp_path, text):
    """They are refused in one line, and not a character of them is changed."""
    journal = tmp_path / "journal"
    journal.write_text(text)
    with pytest.raises(BadInput) as caught:
        run(runner=Runner(journal=journal))
    assert "\n" not in str(caught.value)
    assert journal.read_text("utf-8") == text


def test_a_journal_that_is_no_text(tmp_path):
    """Bytes of something else."""
    journal = tmp_path / "journal"
    for data in (b"\xff\xfe\x00\x01", b"\xff\xfe\n\x00\x01"):
        journal.write_bytes(data)
        with pytest.raises(BadInput):
            run(runner=Runner(journal=journal))
        assert journal.read_bytes() == data


def test_where_no_journal_can_be(tmp_path):
    """A directory; a path in a directory that is not there."""
    for path in (tmp_path, tmp_path / "no" / "journal"):
        with pytest.raises(BadInput, match="journal"):
            run(runner=Runner(journal=path))


@pytest.mark.parametrize("error", [KeyboardInterrupt(), ValueError("wrong"), OSError(5, "disk")])
@pytest.mark.parametrize("threads", [0, 2])
def test_interruption(tmp_path, error, threads):
    """What is raised is raised, as it is; the journal has all that was done, and goes on."""
    journal = tmp_path / "journal"
    executor = ThreadPoolExecutor(threads) if threads else None
    stopping = partial(failing, Fraction(1, 2), error)
    with pytest.raises(type(error)) as caught:
        run(stopping, Runner(executor=executor, journal=journal, whole=True))
    assert caught.value is error
    if executor:
        executor.shutdown()
    done = [tuple(map(Fraction, name.split())) for name, _ in map(json.loads, _lines(journal))]
    assert all(lower < Fraction(1, 2) for lower, _ in done)
    if not threads:
        assert done[:2] == [(0, ENDS[1]), (ENDS[1], ENDS[2])]
    again = []

    def rest(cell):
        again.append(tuple(cell))
        return sign(cell)

    assert run(rest, Runner(journal=journal)) == run()
    assert not set(again) & set(done)


def _lines(journal):
    """Return the lines of a journal but for the first."""
    return journal.read_text("utf-8").splitlines()[1:]


def test_what_has_not_begun_is_cancelled():
    """After the first failure no thread begins another cell."""
    begun, gate = [], threading.Event()

    def examine(cell):
        begun.append(cell)
        if len(begun) == 1:
            raise KeyboardInterrupt
        gate.wait(5)
        return "+"

    cells = cells_between([Fraction(k) for k in range(101)])
    with ThreadPoolExecutor(2) as executor:
        with pytest.raises(KeyboardInterrupt):
            subdivide(examine, cells, SMALLEST, Runner(executor=executor), "")
        gate.set()
    assert len(begun) < 20


def test_a_process_that_dies(tmp_path):
    """It is an error, not a verdict; the journal goes on."""
    journal = tmp_path / "journal"
    with (
        ProcessPoolExecutor(1, get_context("spawn")) as executor,
        pytest.raises(BadInput, match="killed"),
    ):
        run(dying, Runner(executor=executor, journal=journal))
    assert run(runner=Runner(journal=journal)) == run()


def test_progress_is_told():
    """As each verdict comes."""
    told = []
    found = run(runner=Runner(tell=lambda words, _: told.append(words)))
    assert len(told) >= len(found)
    assert all("cells decided" in words for words in told)
