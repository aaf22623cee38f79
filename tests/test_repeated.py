"""The list of tests that repeat others: it names tests that there are, and is made as it says."""

import subprocess
import sys
from pathlib import Path

import pytest
import repeated

ROOT = Path(__file__).parents[1]


def test_what_repeats():
    """Who is quicker reaches a place first; what reaches nothing, has a sentence, or is quick,
    repeats nothing."""
    one, two = ["a.py:1", "no"], ["a.py:2", "nor"]
    at = "tests/checker/test_x.py::"
    notes = [
        (f"{at}slow", 2.0, [one], False),
        (f"{at}quick", 0.1, [one], False),
        (f"{at}other words", 3.0, [["a.py:1", "not"]], False),
        (f"{at}two places", 4.0, [one, two], False),
        (f"{at}both again", 5.0, [two, one], False),
        (f"{at}a sentence", 5.5, [two, one], True),
        (f"{at}nothing", 6.0, [], False),
        (f"{at}quick again", 0.1, [one], False),
        ("tests/proofs/test_y.py::elsewhere", 7.0, [one], False),
    ]
    assert repeated.repeating(notes) == [f"{at}both again", f"{at}slow"]


@pytest.mark.slow
def test_all_that_are_listed_exist():
    """Each name is that of a test."""
    words = ["-m", "pytest", "-n0", "--collect-only", "-m", "", *repeated.ROOMS]
    told = subprocess.run(
        [sys.executable, *words], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert repeated.listed()
    assert repeated.listed() <= set(told.stdout.splitlines())
