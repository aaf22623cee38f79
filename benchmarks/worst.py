"""What the worst certificate known of each theorem costs to check: processor time and memory.

    python benchmarks/worst.py [THEOREM ...]

A certificate is made of the largest stored one of its theorem, with as many bits as the checker
admits (certificates/FORMAT.md); those of `elliptic` have order 9, too, those of `persistence` more
rectangles, those of `contact_basin` more cells.  Each is checked in a process of its own.  `mixed`
and `conservative` would take hours at their limits of work: there the stored one is checked, and
its time for a unit of work, in that part of the proof in which it is the longest, is multiplied by
the units that are admitted.  Their memory is that of the stored one and, for `conservative`, of the
longest families that are read.
"""

from __future__ import annotations

import base64
import json
import resource
import subprocess
import sys
import time
import zlib
from collections.abc import Callable
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

from cap.checker.folded import tree
from cap.checker.folded.regions import flights
from cap.checker.kernel.certificate import read
from cap.checker.kernel.parabolas import BYTES
from cap.checker.kernel.rejection import Rejected
from cap.checker.kernel.theorem import MAX_BITS
from cap.checker.resting.fates import FLIES, RESTS
from cap.checker.strips import strips
from cap.checker.strips.columns import LONGEST, columns
from cap.checker.theorems import NAMES, conservative, mixed
from cap.checker.verdict import check

HALVINGS = 8  # more are too many cells
STORED = Path(__file__).parents[1] / "certificates"
OWN = Path(__file__).parents[1] / "tests/certificates/own"
Content = dict[str, Any]


def stored(theorem: str) -> Content:
    """Return the largest stored certificate of a theorem."""
    known = [path.read_bytes() for path in (*STORED.glob(f"{theorem}*.json"), *OWN.glob("*.json"))]
    contents = [each for each in map(json.loads, known) if each["theorem"] == theorem]
    found: Content = max(contents, key=lambda content: len(json.dumps(content)))
    return found


def data(content: Content) -> bytes:
    """Return a certificate as it would be stored."""
    return json.dumps(content).encode()


def admitted(content: Content) -> bool:
    """Return whether the checker would begin with a certificate."""
    try:
        read(data(content))
    except Rejected:
        return False
    return True


def with_most_bits(content: Content) -> Content:
    """Give a certificate as many bits as it may have, in the order of their names."""
    for name in ("bits", "cell_bits"):
        if name in content["hints"]:
            least, more = int(content["hints"][name]), MAX_BITS + 1
            while more - least > 1:
                content["hints"][name] = str((least + more) // 2)
                if admitted(content):
                    least = (least + more) // 2
                else:
                    more = (least + more) // 2
            content["hints"][name] = str(least)
    return content


def of_highest_order() -> Content:
    """Return an elliptic orbit with a normal form of order 9."""
    from cap.maps.fixed_point import Start  # noqa: PLC0415 (slow to load)
    from cap.parameters import PAPER  # noqa: PLC0415
    from cap.proofs import theorems  # noqa: PLC0415
    from cap.proofs.fixed_point import Setting  # noqa: PLC0415

    start = Start.non_sticking(0.10027988984, 0.54194330676, (1.0991729107, 3.5160904414))
    ask = Setting(PAPER, start, 30, options={"order": 9})
    return with_most_bits(theorems.accepted(theorems.THEOREMS["elliptic"], ask))


def of_many_rectangles() -> Content:
    """Return `persistence` with rectangles cut in two until there are 360."""
    content = stored("persistence")
    grid, hints = content["claims"]["range"], content["hints"]
    marks = {"epsilon": halved(grid["epsilon"], 12), "mu": halved(grid["mu"], 3)}
    width = len(grid["mu"]) - 1
    kept = [i * width + j for i, _ in marks["epsilon"] for j, _ in marks["mu"]]
    hints["cells"] = [hints["cells"][n] for n in kept]
    grid["boxes"] = [grid["boxes"][n] for n in kept]
    for name, ends in marks.items():
        grid[name] = [*(str(q) for _, q in ends), grid[name][-1]]
    return with_most_bits(content)


def halved(marks: list[str], count: int) -> list[tuple[int, Fraction]]:
    """Return intervals, each by its number and its lower end, the first ones cut in two."""
    ends = list(map(Fraction, marks))
    return [
        (n, a + (b - a) * k / 2)
        for n, (a, b) in enumerate(pairwise(ends))
        for k in range(2 if n < count else 1)
    ]


MADE: dict[str, Callable[[], Content]] = {
    "elliptic": of_highest_order,
    "persistence": of_many_rectangles,
}


def measured(theorem: str) -> Content:
    """Return what the check of the worst certificate takes."""
    if theorem in BY_WORK:
        return BY_WORK[theorem](data(stored(theorem)))
    made = MADE.get(theorem, lambda: with_most_bits(stored(theorem)))()
    return {"what": f"{made['hints']['bits']} bits", "seconds": timed(data(made))}


def timed(certificate: bytes, tell: Callable[[str, float], None] = lambda *_: None) -> float:
    """Return the processor time of a check, which must succeed."""
    began = time.process_time()
    check(certificate, lambda _step: None, tell=tell)
    return time.process_time() - began


def by_phase(certificate: bytes) -> dict[str, float]:
    """Return the processor time of each phase of a check."""
    spent, last = dict[str, float](), ["", time.process_time()]

    def tell(words: str, _part: float) -> None:
        now = time.process_time()
        spent[words] = spent.get(words, 0.0) + now - float(last[1])
        last[:] = words, now

    timed(certificate, tell)
    return spent


def of_mixed(certificate: bytes) -> Content:
    """Return what `mixed` would take with as many flights and places as are admitted."""
    spent = by_phase(certificate)
    hints = read(certificate).hints
    places = len(tree.nodes(hints["places"]["tree"]))
    names = {name: mixed.BACK.format(name) for name in ("late", "early")} | {"turns": mixed.TURNS}
    rates = [
        spent[words] / flights(hints["stops"][name], parted=name == "turns")
        for name, words in names.items()
    ]
    seconds = tree.MOST / places * spent[mixed.PLACES] + mixed.MOST_FLIGHTS * max(rates)
    return {"what": told(sum(spent.values())), "seconds": seconds}


def of_conservative(certificate: bytes) -> Content:
    """Return what `conservative` would take with as much work as is admitted."""
    worlds = list[strips.World]()

    class World(strips.World):
        def __init__(self, *each: Any) -> None:
            super().__init__(*each)
            worlds.append(self)

    conservative.World = World  # type: ignore[misc]
    spent = by_phase(certificate)
    rate = max(
        spent[f"{name} cells are followed"] / world.work
        for name, world in zip(("forward", "backward"), worlds, strict=True)
    )
    text = longest_family()
    families = columns(text), columns(text)
    edges = sum(len(run.edges) for family in families for column in family for run in column)
    what = f"{told(sum(spent.values()))}; {edges} edges"
    return {"what": what, "seconds": 2 * strips.MOST * rate}


def of_basin(certificate: bytes) -> Content:
    """Return what `contact_basin` takes with its cells halved as often as is admitted."""
    for times in range(HALVINGS, 0, -1):
        content = with_most_bits(json.loads(certificate))
        tree = content["hints"]["tree"]
        for n in range(times):
            halves = {letter: f"{n % 2}{letter}{letter}" for letter in (RESTS, FLIES)}
            tree = "".join(halves.get(letter, letter) for letter in tree)
        content["hints"]["tree"] = tree
        cells = tree.count(RESTS) + tree.count(FLIES)
        try:
            seconds = timed(data(content))
        except Rejected:  # before cells are followed: there are too many
            continue
        return {"what": f"{content['hints']['bits']} bits, {cells} cells", "seconds": seconds}
    raise Rejected("its cells cannot be halved")


def longest_family() -> str:
    """Return a family of as many edges as are admitted, 9 units apart, and no cells."""
    edges = LONGEST - 1
    number = BYTES // (4 * edges)
    count = bytes([2 * number % 128 + 128, 2 * number // 128])
    heads = (bytes([2 * 4]) * (edges - 1) + bytes([2 * 6])) * number
    deltas = bytes([2 * 9]) * (edges * number) + bytes(2 * edges * number)
    return base64.b85encode(zlib.compress(count + heads + deltas)).decode()


def told(seconds: float) -> str:
    """Say how long the stored certificate takes."""
    return f"from the stored one: {seconds:.0f} s"


BY_WORK = {"mixed": of_mixed, "conservative": of_conservative, "contact_basin": of_basin}


def main(words: list[str]) -> None:
    """Print a table, a line for each theorem; or measure one, in this process."""
    if words[:1] == ["--one"]:
        found = measured(words[1])
        found["memory"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(json.dumps(found))
        return
    print("| theorem | certificate | seconds | MiB |\n|---|---|---|---|")
    for theorem in words or NAMES:
        command = [sys.executable, __file__, "--one", theorem]
        out = subprocess.run(command, check=True, capture_output=True, text=True).stdout  # noqa: S603
        each = json.loads(out.splitlines()[-1])
        seconds, memory = each["seconds"], each["memory"]
        row = f"| `{theorem}` | {each['what']} | {float(f'{seconds:.2g}'):g} | {memory:.0f} |"
        print(row, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
