"""The lists of tests left to the slow ones: of tests that there are, made as they say."""

import subprocess
import sys
from pathlib import Path

import pytest
import repeated

ROOT = Path(__file__).parents[1]


def test_what_repeats():
    """Who is quicker reaches a place first, and tells a theorem; what reaches nothing, reads the
    words, or is quick, repeats nothing."""
    one, two = ["a.py:1", "no"], ["a.py:2", "nor"]
    at = "tests/checker/test_x.py::"
    notes = [
        (f"{at}slow", 2.0, [one], []),
        (f"{at}quick", 0.1, [one], []),
        (f"{at}other words", 3.0, [["a.py:1", "not"]], []),
        (f"{at}two places", 4.0, [one, two], []),
        (f"{at}both again", 5.0, [two, one], []),
        (f"{at}a theorem", 5.5, [two, one], ["saddle"]),
        (f"{at}the theorem again", 5.7, [one], ["saddle"]),
        (f"{at}another theorem", 5.8, [], ["elliptic"]),
        (f"{at}the sentence", 5.9, [], ["saddle"]),
        (f"{at}every_number", 5.9, [one], []),
        (f"{at}nothing", 6.0, [], []),
        (f"{at}quick again", 0.1, [one], []),
        ("tests/proofs/test_y.py::elsewhere", 7.0, [one], []),
    ]
    assert repeated.repeating(notes) == [f"{at}both again", f"{at}slow", f"{at}the theorem again"]


def test_what_is_long():
    """Not what is quick, is of the checker, or looks at certificates that are written."""
    names = "proofs/x.py::a", "proofs/x.py::quick", "proofs/x.py::b_reproduced", "checker/x.py::c"
    notes = [(f"tests/{name}", 0.1 if "quick" in name else 2.0, [], []) for name in names]
    assert repeated.lengthy(notes) == ["tests/proofs/x.py::a"]


@pytest.mark.slow
def test_all_that_are_listed_exist():
    """Each name is that of a test."""
    words = ["-m", "pytest", "-n0", "--collect-only", "-m", ""]
    told = subprocess.run(
        [sys.executable, *words], cwd=ROOT, capture_output=True, text=True, check=True
    )
    names = set(told.stdout.splitlines())
    for file in (repeated.LIST, repeated.LENGTHY, repeated.LONGEST):
        assert repeated.listed(file)
        assert repeated.listed(file) <= names
