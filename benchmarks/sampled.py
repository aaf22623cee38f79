"""Which mutants `mutation.py` tries, and its table."""

from __future__ import annotations

import subprocess
from collections import Counter, defaultdict
from pathlib import Path
from random import Random

from mutants import Mutant

ROOT = Path(__file__).parents[1]
TARGET = "cap/checker"


def files(since: str | None) -> list[Path]:
    """Return the files of the checker, or those of which half is new since a commit."""
    every = sorted((ROOT / TARGET).rglob("*.py"))
    if since is None:
        return every
    command = ["git", "diff", "--numstat", "--find-renames", "--diff-filter=AM", since]
    found = subprocess.run([*command, "--", TARGET], cwd=ROOT, capture_output=True, check=True)  # noqa: S603
    rows = (line.split("\t") for line in found.stdout.decode().splitlines())
    added = {name: int(count) for count, _, name in rows}
    size = {path: path.read_text("utf-8").count("\n") for path in every}
    return [path for path in every if 2 * added.get(str(path.relative_to(ROOT)), -1) >= size[path]]


def drawn(
    found: dict[Path, list[Mutant]], part: float, random: Random
) -> list[tuple[Mutant, Path]]:
    """Return a sample: of each file the same part, in any first portion of the sample, too."""
    order = list[tuple[float, Mutant, Path]]()
    for path, all_of_it in found.items():
        shuffled = random.sample(all_of_it, len(all_of_it))
        places = ((n + random.random()) / len(shuffled) for n in range(len(shuffled)))
        order += zip(places, shuffled, [path] * len(shuffled), strict=False)
    order.sort()
    return [(mutant, path) for _, mutant, path in order[: round(part * len(order))]]


def unnoticed() -> set[str]:
    """Return the names of the mutants that no test can or need notice."""
    lines = (Path(__file__).parent / "equivalent.txt").read_text("utf-8").splitlines()
    return {line for line in lines if line and not line.startswith("#")}


def table(tried: list[Mutant], by: dict[str, str]) -> str:
    """Return a line for each module, then the survivors."""
    equivalent = unnoticed()
    rows, survivors = defaultdict(Counter), []
    for mutant in tried:
        kind = "caught" if by[mutant.name] else "survived"
        kind = "equivalent" if kind == "survived" and mutant.name in equivalent else kind
        survivors += [f"line {mutant.line}, {mutant.name}"] if kind == "survived" else []
        for row in (mutant.module, "all"):
            rows[row][kind] += 1
    text = [f"{'module':32} caught  survived  equivalent   score"]
    for module, n in rows.items():
        score = 100 * n["caught"] / max(1, n["caught"] + n["survived"])
        cells = f"{n['caught']:6} {n['survived']:9} {n['equivalent']:11} {score:7.1f}"
        text.append(f"{module:32} {cells}")
    return "\n".join([*text, "", *survivors])
