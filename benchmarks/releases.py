"""The table of the release map, below 1e-6 of R: how much is left, and how long it takes.

PYTHONPATH=. python benchmarks/releases.py
"""

import time
from dataclasses import replace
from fractions import Fraction

from cap.parameters import PAPER
from cap.release.table import table

E, MU = Fraction(9, 10), Fraction(1, 20)
SYSTEMS = {
    "paper": (PAPER, (2, 4, 6, 8)),
    "e = 9/10": (replace(PAPER, e=E), (2, 4)),
    "mu = 1/20": (replace(PAPER, mu=MU), (2, 4)),
    "both": (replace(PAPER, e=E, mu=MU), (2, 4)),
}


def main():
    table(PAPER, 2, Fraction(1, 1000))  # compiles
    for name, (p, numbers) in SYSTEMS.items():
        for periods in numbers:
            began = time.process_time()
            found = table(p, periods)
            seconds = time.process_time() - began
            left = float(found.undecided / p.R)
            told = f"{len(found.branches)} branches, {left:.3g} of R undecided, {seconds:.1f} s"
            print(f"{name}, {periods} periods: {told}", flush=True)


if __name__ == "__main__":
    main()
