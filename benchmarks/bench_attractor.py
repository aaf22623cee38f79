"""Speed of the release map: in floats, over balls and Taylor models, and in the checker.

    python -m pytest -n0 benchmarks/bench_attractor.py --benchmark-columns=min,median,ops

A kneading sequence takes one image for each symbol: 171 of them, with 282 bits, for 30 digits of
the entropy at the paper's parameters.  The whole proof, search and checks included, takes about
4000 images by `test_balls[282]` for 30 digits, 10 000 for 100 (8 and 18 seconds of a busy core).
"""

from fractions import Fraction
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import cap
from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.theorems.attractor import Attractor
from cap.floats.engine.releases import images
from cap.flow.strobe import oscillator
from cap.parameters import PAPER
from cap.release.cell import cell
from cap.release.passage import foreseen, image
from cap.sets import interval

STORED = Path(__file__).parents[1] / "certificates/attractor.json"


def test_floats(benchmark):
    """Ten thousand places at once."""
    x = np.linspace(-0.99, 0.99, 10_000)
    assert len(benchmark(images, PAPER, x).value) == 10_000


@pytest.mark.parametrize("bits", [80, 282, 800])
def test_balls(benchmark, bits):
    """One image, in mean value form, of a thin ball."""
    events = foreseen(PAPER, -0.5)[0]
    with interval.workprec(bits):
        osc = oscillator(PAPER)
        x = interval.around(Fraction(-1, 2), Fraction(1, 10**20))
        benchmark(image, osc, x, events)


@pytest.mark.parametrize("curved", [False, True])
def test_cell(benchmark, curved):
    """G and G', or G'' as well, over a cell of the width 1/100, by Taylor models."""
    events = foreseen(PAPER, -0.5)[0]
    with interval.workprec(80):
        osc = oscillator(PAPER)
        benchmark(cell, osc, Fraction(-1, 2), Fraction(-49, 100), events, curved=curved)


def test_cell_of_the_checker(benchmark):
    """A cell, with jets of order 4 in mean value form, in pure Python."""
    proof = Attractor(read(STORED.read_bytes()), lambda _: None)
    hint = proof.hints["cells"][0]
    windows = [w[:2] for w in hint["events"]]
    benchmark(proof.cell, proof.claims["interval"].lower, hint["to"], windows)


def test_image_of_the_checker(benchmark):
    """One image of a thin interval, at the precision of the certificate."""
    proof = Attractor(read(STORED.read_bytes()), lambda _: None)
    low = proof.claims["interval"].lower + Fraction(1, 1000)
    x = Interval.enclosing(low, low + Fraction(1, 10**20), proof.hints["bits"])
    windows = [w[:2] for w in proof.hints["cells"][0]["events"]]
    benchmark(proof.image, x, windows, 1)


@pytest.mark.parametrize("digits", [30, 100])
def test_prove(benchmark, digits):
    """The whole theorem: search, proof, and the independent check."""
    run = partial(cap.prove_theorem, "attractor", digits=digits)
    assert benchmark.pedantic(run, rounds=1).theorem == "attractor"
