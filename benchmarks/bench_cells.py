"""Speed of the flow of cells, in processor time, all in one run.

    python benchmarks/bench_cells.py [cells] [existence] [linear] [memory] [workers]

*cells*: boxes of random states, |x| < 1, |v| < 2, at the paper's parameters, followed for a period
through any events; certified with the derivative are those counted.  *existence*: Krawczyk's proof
of the elliptic orbit over a box of half-width 1e-9, with itinerary, trace and rotation number.
*linear*: time per cell of more and more cells.  *memory*: what a sweep adds to the largest memory
of a process.  *workers*: the same sweep here, on two threads and on two processes, in wall time,
which needs a quiet machine at least once in the rounds.
"""

import multiprocessing
import resource
import sys
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from cap.boxes.existence import fixed_points
from cap.boxes.flow import SMOOTH, flow
from cap.boxes.sweep import Grid, Sweep, sweep
from cap.parameters import PAPER
from cap.runner import Runner

ELLIPTIC = 0.1002798898441967, 0.5419433067664595
COUNT = 50_000
ROUNDS = 6


def random_cells(count, width):
    random = np.random.default_rng(0)
    x, v = random.uniform(-1, 1 - width, count), random.uniform(-2, 2 - width, count)
    return np.stack([x, x + width, v, v + width], axis=1)


def seconds(function, rounds=3):
    """Return the least processor time of a call, and its result."""
    best, result = float("inf"), None
    for _ in range(rounds):
        began = time.process_time()
        result = function()
        best = min(best, time.process_time() - began)
    return best, result


def cells():
    for width in (1e-6, 1e-4, 1e-3, 1e-2):
        boxes = random_cells(COUNT, width)
        took, images = seconds(lambda boxes=boxes: flow(PAPER, boxes, 1))
        smooth = int((images.verdict == SMOOTH).sum())
        print(
            f"cells {width:g} wide: {COUNT / took:9.0f} a second, {smooth / COUNT:6.1%} of them "
            f"with the derivative: {smooth / took:9.0f} a second"
        )


def existence():
    (x, v), half = ELLIPTIC, 1e-9
    boxes = np.tile([x - half, x + half, v - half, v + half], (COUNT, 1))
    took, found = seconds(lambda: fixed_points(PAPER, boxes))
    assert found.proved.all()
    print(f"existence: {took / COUNT * 1e6:.2f} us each")
    shifts = np.random.default_rng(0).uniform(-1e-6, 1e-6, (COUNT, 1))
    frictions = 0.4 + np.hstack([shifts, shifts])
    took, _ = seconds(lambda: fixed_points(PAPER, boxes, frictions=frictions))
    print(f"existence, each at its own friction: {took / COUNT * 1e6:.2f} us each")


def linear():
    for count in (1_000, 10_000, 100_000, 400_000):
        boxes = random_cells(count, 1e-3)
        took, _ = seconds(lambda boxes=boxes: flow(PAPER, boxes, 1))
        print(f"{count:7} cells: {took / count * 1e6:.2f} us each")


def grid(columns, rows):
    return Sweep(
        PAPER, Grid((Fraction(-1), Fraction(1)), (Fraction(-2), Fraction(2)), columns, rows)
    )


def swept(request, runner):
    return sum(part.stop - part.start for part, _ in sweep(request, runner))


def grown(count, answer):
    """Tell by how many megabytes a sweep raises the largest memory, once it has begun."""
    swept(grid(1_000, 50), Runner())
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    swept(grid(1_000, count // 1_000), Runner())
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    answer.put((after - before) / 1024)


def memory():
    context = multiprocessing.get_context("spawn")
    for count in (100_000, 400_000, 1_600_000):
        answer = context.Queue()
        process = context.Process(target=grown, args=(count, answer))
        process.start()
        print(f"memory of {count:8} cells: {answer.get():.1f} MB more")
        process.join()


def processor():
    """Return the processor time of this process and its children that have ended."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used)


def pool():
    return ProcessPoolExecutor(2, multiprocessing.get_context("spawn"))


def on_fresh_processes(request):
    with pool() as executor:
        swept(request, Runner(executor=executor))


def timed(work):
    """Return the wall time and the processor time of a call."""
    began, used = time.perf_counter(), processor()
    work()
    return time.perf_counter() - began, processor() - used


def workers():
    """Print the least wall time of each way; the rounds go through all ways in turns."""
    request, took = grid(1_000, 1_000), {}
    with TemporaryDirectory() as folder, pool() as started:
        journal = Path(folder, "journal")
        ways = {
            "here": lambda: swept(request, Runner()),
            "two threads": lambda: swept(request, Runner(2)),
            "two processes that have begun": lambda: swept(request, Runner(executor=started)),
            "two processes": lambda: on_fresh_processes(request),
            "here, with a journal": lambda: swept(request, Runner(journal=journal)),
            "two threads, with a journal": lambda: swept(request, Runner(2, journal=journal)),
        }
        for _ in range(ROUNDS):
            for name, work in ways.items():
                took.setdefault(name, []).append(timed(work))
                journal.unlink(missing_ok=True)
    alone = {end: min(took[f"here{end}"])[0] for end in ("", ", with a journal")}
    for name, times in took.items():
        wall, used = min(times)
        ratio = alone[", with a journal" if "journal" in name else ""] / wall
        print(f"{name}: {wall:.2f} s, {ratio:.2f} times as fast, {used:.2f} s of the processor")


WORK: dict[str, Callable[[], None]] = {
    each.__name__: each for each in (cells, existence, linear, memory, workers)
}

if __name__ == "__main__":
    for name in sys.argv[1:] or WORK:
        WORK[name]()
