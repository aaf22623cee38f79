"""Sweeps: every cell once, the same however they are cut and wherever they are followed."""

import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from copy import copy
from dataclasses import fields, replace
from fractions import Fraction
from multiprocessing import get_context

import numpy as np
import pytest

from cap.boxes import sweep as sweeping
from cap.boxes.flow import Goals, Images, flow
from cap.boxes.sweep import Grid, Sweep, sweep
from cap.errors import BadInput
from cap.parameters import PAPER
from cap.runner import Runner

# compiled anew in a fresh clone: tens of seconds; no theorem uses it
pytestmark = pytest.mark.slow

GRID = Grid((Fraction(-1), Fraction(1)), (Fraction(-2), Fraction(2)), 30, 20)
REQUEST = Sweep(PAPER, GRID, 2, goals=Goals(stops=1))


def collected(runner, piece=150, request=REQUEST):
    """Return all images of a sweep in the order of the cells."""
    parts = sorted(sweep(request, runner, piece), key=lambda pair: pair[0].start)
    ends = [part.stop for part, _ in parts]
    assert [part.start for part, _ in parts] == [0, *ends[:-1]]
    assert ends[-1] == request.grid.count
    return Images.joined([images for _, images in parts])


def same(one, other):
    """Return whether images agree in every bit."""
    names = [field.name for field in fields(Images)]
    return all(np.array_equal(getattr(one, k), getattr(other, k), equal_nan=True) for k in names)


@pytest.fixture(scope="module")
def whole():
    """Return the images of all cells, followed as one array."""
    return flow(PAPER, GRID.cells(slice(0, GRID.count)), 2, goals=REQUEST.goals)


def test_cells_of_a_grid():
    """They are the rectangle: neighbours share edges, the outer ones are not inside of it."""
    grid = Grid((Fraction(-1, 3), Fraction(1, 3)), (Fraction(0), Fraction(1)), 7, 5)
    cells = grid.cells(slice(0, 35)).reshape(5, 7, 4)
    assert (cells[:, :-1, 1] == cells[:, 1:, 0]).all()
    assert (cells[:-1, :, 3] == cells[1:, :, 2]).all()
    assert Fraction(cells[0, 0, 0]) <= Fraction(-1, 3)
    assert Fraction(cells[0, -1, 1]) >= Fraction(1, 3)
    assert np.array_equal(grid.cells(slice(10, 30)), cells.reshape(35, 4)[10:30])


@pytest.mark.parametrize("piece", [1, 77, 10_000])
def test_cuts_do_not_matter(piece):
    """Nor does the order."""
    request = Sweep(PAPER, Grid(GRID.x, GRID.v, 6, 5), 2, goals=REQUEST.goals)
    cells = request.grid.cells(slice(0, 30))
    one = collected(Runner(), piece, request)
    assert same(one, flow(PAPER, cells, 2, goals=REQUEST.goals))


def test_executors_do_not_matter(whole):
    """Workers of our own, which are threads; a pool's threads, or processes."""
    assert same(collected(Runner()), whole)
    assert same(collected(Runner(2), 50), whole)
    with ThreadPoolExecutor(2) as executor:
        assert same(collected(Runner(executor=executor)), whole)
    with ProcessPoolExecutor(1, get_context("spawn")) as executor:
        assert same(collected(Runner(executor=executor), 300), whole)


def test_who_only_asks_does_not_load_the_compiler():
    """Where the work is done elsewhere; it takes longer to load than all else."""
    code = "import sys, cap.boxes.sweep; sys.exit('numba' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_images_are_pickled_in_few_bytes(whole):
    """They come out as they went in, whatever the size of the numbers; also those of no cell."""
    assert len(pickle.dumps(whole)) < 120 * len(whole)
    large = replace(whole, label=whole.label + 2**61, itinerary=whole.itinerary // 2 * 2**40)
    for images in (whole, large, Images.unknown(0)):
        found = copy(images)  # by what is pickled
        assert same(found, images)
        for field in fields(Images):
            assert getattr(found, field.name).dtype == getattr(images, field.name).dtype


def test_a_cluster(whole):
    """Dask's, of processes of its own."""
    distributed = pytest.importorskip("distributed")
    options = {"dashboard_address": None, "processes": True, "threads_per_worker": 1}
    with (
        distributed.LocalCluster(n_workers=1, **options) as cluster,
        distributed.Client(cluster) as client,
    ):
        assert same(collected(Runner(executor=client.get_executor()), 300), whole)


def test_ctrl_c_and_the_journal(whole, tmp_path, monkeypatch):
    """What is done is kept; the rest is done later; another sweep is refused."""
    done, followed = [], sweeping.flow

    def interrupted(*arguments, **options):
        if len(done) == 2:
            raise KeyboardInterrupt
        done.append(1)
        return followed(*arguments, **options)

    monkeypatch.setattr(sweeping, "flow", interrupted)
    runner = Runner(journal=tmp_path / "journal")
    assert len(list(sweep(REQUEST, runner, 150))) == 2
    assert runner.interrupted
    monkeypatch.setattr(sweeping, "flow", lambda *a, **k: (done.append(1), followed(*a, **k))[1])
    assert same(collected(Runner(journal=tmp_path / "journal")), whole)
    assert len(done) == 4
    other = Sweep(PAPER, GRID, 3, goals=REQUEST.goals)
    for request, piece in ((other, 150), (REQUEST, 100)):
        with pytest.raises(BadInput, match="something else"):
            collected(Runner(journal=tmp_path / "journal"), piece, request)


def test_pieces_are_smaller_where_there_are_more_periods(monkeypatch):
    """So that an interrupt does not wait for long; but not so small that the rest counts."""
    monkeypatch.setattr(sweeping, "flow", lambda _p, cells, *_, **__: Images.unknown(len(cells)))
    grid = Grid(GRID.x, GRID.v, 1000, 60)
    for periods, most in ((Fraction(1, 2), 25_000), (1, 25_000), (10, 2_500), (10**4, 1_000)):
        parts = [part for part, _ in sweep(Sweep(PAPER, grid, periods), Runner())]
        assert max(part.stop - part.start for part in parts) == most


def test_progress():
    """It tells which part of the cells is done."""
    told = []
    collected(Runner(tell=lambda words, part: told.append((words, part))))
    assert told == [("cells", part) for part in (0.25, 0.5, 0.75, 1.0)]


def test_memory_is_bounded():
    """Of a sweep without end nothing is made before it is asked for, and nothing kept."""
    grid = Grid(GRID.x, GRID.v, 10**3, 10**12)
    results = sweep(Sweep(PAPER, grid), Runner(), 20)
    starts = [next(results)[0].start for _ in range(3)]
    assert starts == [0, 20, 40]
    results.close()


def test_what_is_no_grid():
    """One line each."""
    one, unit = Fraction(1), (Fraction(0), Fraction(1))
    for bad, words in (
        (((one, one), unit, 3, 3), "left to right"),
        ((unit, unit, 0, 3), "at least"),
        ((unit, (one, one + Fraction(1, 2**50)), 3, 10**6), "too small"),
    ):
        with pytest.raises(BadInput, match=words):
            Grid(*bad).cells(slice(0, 3))
    with pytest.raises(BadInput, match="must have cells"):
        list(sweep(REQUEST, Runner(), 0))
