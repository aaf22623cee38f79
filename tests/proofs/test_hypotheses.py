"""Hypotheses on the parameters alone that fail are bad requests; numbers in messages are short."""

import re

import pytest
from support import proving

from cap.errors import NotProved
from cap.sets import interval
from cap.sets.interval import Ball

FAILING = [
    ("impulse", "f/F > 2/pi"),
    ("segment --f 7/10", "f/F < 2/sqrt(4 + pi^2)"),
    ("segment --f 7/10 --mu 1/10", "stick"),
    ("segment --l=-1/4 --r 1/4", "their stroke is 1.555912368"),
    ("sliding --masses 1,9/10 --f 7/10", "f/F < 2/sqrt(4 + pi^2)"),
    ("sliding --masses 1,1/10", "do not fit"),
    ("pitchfork --r 3", "R omega^2/F < 2.9348"),
    ("pitchfork --r=-1/2", "R omega^2/F > 0.70407"),
    ("branch --r 3", "R omega^2/F < 2.9348"),
    ("branch --from 1/2", "f < 0.465904 only"),
    ("symmetric --f 0", "f > 0"),
    ("symmetric --e 9/10", "elastic"),
    ("inventory --f 0", "f > 0"),
    ("conservative --mu 1/10", "mu = 0"),
    ("conservative --f 0", "f > 0"),
    ("mixed --e 9/10", "elastic"),
    ("mixed --f 0", "f > 0"),
    ("attractor --f 0", "f > 0"),
    ("attractor --from 1/2 --to 3/2", "below F"),
    ("window --f 0", "f > 0"),
    ("cascade --from 1/2 --to 3/2", "below F"),
    ("elliptic --mu 1/10", "dry friction"),
    ("saddle --e 9/10", "elastic"),
    ("persistence", "nothing is lost"),
    ("particles --masses 1,9/10 --e 9/10", "elastic"),
    ("particles_limits --masses 1,9/10", "equal masses"),
]


@pytest.mark.parametrize(("words", "why"), FAILING, ids=[words for words, _ in FAILING])
def test_a_hypothesis_that_fails(words, why, tmp_path, capsys):
    """Status 2, one line, no long number, no certificate."""
    status, _, err = proving(capsys, *words.split(), "--out", str(tmp_path / "x.json"))
    assert status == 2
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert why in err
    assert not re.search(r"\d{12}", err)
    assert not list(tmp_path.iterdir())


def test_numbers_in_a_message():
    """Ten digits, rounded outwards; the sets are kept as they are."""
    with interval.workprec(233):
        sets = {"pi": interval.pi(), "both": (Ball(2), 1 / Ball(3)), "f": "2/5"}
        failure = NotProved("Lemma 1", "it fails", sets)
    assert failure.sets == sets
    shown = re.fullmatch(
        r"Lemma 1: it fails  \[pi = (\[.*?\]), both = \((.*?), (\[.*?\])\), f = 2/5\]", str(failure)
    )
    pi, two, third = map(Ball, shown.groups())
    assert pi.contains(sets["pi"])
    assert two == 2
    assert third.contains(sets["both"][1])
    assert len(str(failure)) < 150
