"""The flow of cells and that of balls on many random cells at random parameters: do they agree?

    PYTHONPATH=. python benchmarks/agree_cells.py [COUNT [SEED]]

Each cell is checked as in `tests/boxes/test_cell_flow.py`; what was found is told now and then.
"""

import sys
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from cells.test_cell_flow import OPEN, SMOOTH, UNION, compared
from support import seeded

NAMES = {SMOOTH: "smooth", UNION: "union", OPEN: "open"}


def main(count=100_000, seed=1):
    random, found = seeded(seed), Counter()
    for k in range(1, count + 1):
        found[compared(random)] += 1
        if k % 5_000 == 0 or k == count:
            both = {f"{NAMES[v]}, {'proved' if b else 'open'}": n for (v, b), n in found.items()}
            print(f"{k} cells agree (in doubles, in balls): {both}", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
