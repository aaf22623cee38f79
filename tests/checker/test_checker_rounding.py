"""Doubles that are not rounded to nearest prove nothing: in no process, and in no thread."""

from __future__ import annotations

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from cap.areas.folded.constants import system_of
from cap.areas.folded.next_releases import next_releases
from cap.checker.folded import motion
from cap.checker.folded.basins import Basins
from cap.checker.kernel.certificate import read
from cap.checker.kernel.processes import each
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.rounding import NUMBERS, as_it_should, in_doubles, rounds_to_nearest
from cap.checker.verdict import check
from cap.errors import NotProved
from cap.parameters import PAPER
from checker.rounding_modes import ALL, only_where_known, set_and_return, set_mode

ROOT = Path(__file__).parents[2]
SMALL = ROOT / "tests/certificates/accept/conservative_by_three_flights.json"
STORED = ROOT / "certificates/segment.json"
PLACES = np.array([[0.1, 0.10001]])


class Rounded:
    """A number whose sums, products and quotients are rounded by a function of Fractions."""

    __hash__ = None

    def __init__(self, value, rounding):
        self.value, self.rounding = Fraction(value), rounding

    def result(self, value):
        """Return a result, rounded."""
        return Rounded(self.rounding(value), self.rounding)

    def __neg__(self):
        return Rounded(-self.value, self.rounding)

    def __add__(self, y):
        return self.result(self.value + y.value)

    def __sub__(self, y):
        return self.result(self.value - y.value)

    def __mul__(self, y):
        return self.result(self.value * y.value)

    def __truediv__(self, y):
        return self.result(self.value / y.value)

    def __eq__(self, y):
        return self.value == y.value

    def __lt__(self, y):
        return self.value < (y.value if isinstance(y, Rounded) else y)

    def __gt__(self, y):
        return self.value > (y.value if isinstance(y, Rounded) else y)


def to_bits(bits, direction, x, least=-1074):
    """Return x rounded to so many bits; ``direction`` takes a Fraction to an integer near it."""
    if x == 0:
        return x
    exponent = len(bin(abs(x.numerator))) - len(bin(x.denominator))
    while abs(x) >= Fraction(2) ** (exponent + 1):
        exponent += 1
    while abs(x) < Fraction(2) ** exponent:
        exponent -= 1
    unit = Fraction(2) ** max(exponent - bits + 1, least)
    return direction(x / unit) * unit


def away(x):
    """Round to nearest, ties away from 0."""
    return (1 if x > 0 else -1) * int(abs(x) + Fraction(1, 2))


def flushed(x):
    """Round to nearest, and small numbers to 0."""
    return to_bits(53, round, x) if abs(x) >= Fraction(2) ** -1022 else Fraction(0)


OTHERS = {
    "upward": partial(to_bits, 53, lambda x: -(-x // 1)),
    "downward": partial(to_bits, 53, lambda x: x // 1),
    "to zero": partial(to_bits, 53, int),
    "ties away from zero": partial(to_bits, 53, away),
    "to 64 bits before": lambda x: to_bits(53, round, to_bits(64, round, x, -16445)),
    "to 24 bits": partial(to_bits, 24, round),
    "flushed": flushed,
}


def asked(rounding):
    """Return what is answered for arithmetic with a rounding."""
    return as_it_should(*(Rounded(float.fromhex(x), rounding) for x in NUMBERS))


def test_which_arithmetic_is_accepted():
    """That of IEEE 754, rounded to nearest, and no other: not if rounded twice, as on an x87."""
    assert rounds_to_nearest()
    assert asked(partial(to_bits, 53, round))
    for name, rounding in OTHERS.items():
        assert not asked(rounding), name


def with_no_small_operands(x):
    """Take a small operand for 0."""
    return x if abs(x) >= 2.0**-1022 else 0.0


def test_small_operands_that_are_taken_for_zero():
    """Even if results are not flushed."""
    assert as_it_should(*map(float.fromhex, NUMBERS))
    assert not as_it_should(*map(with_no_small_operands, map(float.fromhex, NUMBERS)))


def in_another(mode, f):
    """Do something in a thread that is set otherwise."""

    def task():
        set_mode(mode)
        return f()

    with ThreadPoolExecutor(1) as pool:
        return pool.submit(task).result()


REFUSED = {
    "the checker": lambda: check(SMALL.read_bytes(), lambda _: None),
    "the folded flow": lambda: motion.Releases(read(STORED.read_bytes()).parameters),
    "a task": lambda: list(each(1, abs, [1])),
}


@only_where_known
@pytest.mark.parametrize("mode", ALL)
def test_another_mode_is_refused(mode):
    """By each door to what is proved in doubles; and the next thread is not concerned."""
    for name, f in REFUSED.items():
        with pytest.raises(Rejected, match="not those of IEEE 754 here"):
            in_another(mode, f)
        assert name == "the checker" or f()
    assert not in_another(mode, rounds_to_nearest)
    assert rounds_to_nearest()


@pytest.mark.slow
@only_where_known
@pytest.mark.parametrize("mode", ALL)
def test_the_compiled_flow_of_the_prover_refuses_it(mode):
    """In each thread, as the checker does."""
    f = partial(next_releases, system_of(PAPER, forwards=True), Basins(), PLACES)
    assert len(f().kinds) == 1
    with pytest.raises(NotProved, match="round to nearest"):
        in_another(mode, f)


@only_where_known
@pytest.mark.parametrize("jobs", [1, 2])
def test_a_mode_that_changes_is_noticed(jobs):
    """When the task ends that changed it, in each process."""
    with pytest.raises(Rejected, match="not those of IEEE 754 here"):
        in_another("to zero", lambda: set_mode("upward") or list(each(1, abs, [1])))
    with ThreadPoolExecutor(1) as pool:
        changed = pool.submit(lambda: list(each(jobs, set_and_return, ["upward"])))
        with pytest.raises(Rejected, match="not those of IEEE 754 here"):
            changed.result()


@only_where_known
def test_a_proof_during_which_the_mode_changes_is_refused():
    """When it ends."""

    def proof():
        with in_doubles():
            set_mode("upward")

    with ThreadPoolExecutor(1) as pool, pytest.raises(Rejected, match="IEEE 754"):
        pool.submit(proof).result()


@only_where_known
@pytest.mark.parametrize(
    "words",
    [
        ("verify", str(SMALL)),
        pytest.param(("prove", "mixed", "conservative"), marks=pytest.mark.slow),
    ],
)
@pytest.mark.parametrize("mode", [ALL[-1], "upward"] if ALL else [])
def test_commands_refuse_it_in_a_line(mode, words):
    """A whole process in another mode: one line for each theorem, and no traceback."""
    command, *names = words
    for name in names:
        program = (
            f"import sys; sys.path.insert(0, {str(ROOT / 'tests')!r})\n"
            "from checker.rounding_modes import set_mode\n"
            f"from cap import {command}\n"
            f"set_mode({mode!r})\n"
            f"sys.exit({command}.main([{name!r}]))"
        )
        run = subprocess.run(
            [sys.executable, "-c", program],
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        told = run.stdout + run.stderr
        assert run.returncode == 1, told
        assert "Traceback" not in told
        assert [line for line in told.splitlines() if "to nearest" in line] == [
            told.splitlines()[-1]
        ]
