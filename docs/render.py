"""Run a script of prose and cells, and write what they print and draw into a page of Markdown.

In the script a line ``# %% [markdown]`` begins prose, in comments, and ``# %%`` a cell.  A cell is
Python, or commands in comments ``# !python -m ...``, in which ``python`` is the running one.  With
``tags=["raises-exception"]`` its commands must fail.  All is run in an empty directory with a
directory ``pictures``; the page must show each picture that is written there.
"""

import argparse
import io
import math
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import textwrap
from contextlib import chdir, redirect_stdout
from difflib import unified_diff
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).resolve().parent.parent
WIDTH = 120  # of what is shown
LARGEST = 300_000  # bytes of a picture
NUMBER = re.compile(r"-?(?:\d+\.\d*(?:e[-+]?\d+)?|\d+|inf|nan)")
README = Path(__file__).parents[1] / "README.md"
PICTURE = re.compile(r"!\[[^]]*\]\((?:docs/)?(pictures/[^)]+)\)")


class Failure(Exception):
    """The page cannot be written, or is not the one that is stored."""


class Cell(NamedTuple):
    """What follows a line ``# %%``: the rest of that line, and the lines below."""

    head: str
    body: str

    @property
    def prose(self) -> str:
        """The comments without their signs."""
        return re.sub(r"^# ?", "", self.body, flags=re.MULTILINE)

    @property
    def commands(self) -> list[str]:
        """The commands of a cell that has no Python."""
        prose = self.head.startswith("[markdown]")
        return [] if prose else re.findall(r"^# !(.*)$", self.body, flags=re.MULTILINE)


def cells(script: str) -> list[Cell]:
    """Return the cells of a script; what comes before the first is not shown."""
    found = re.split(r"^# %%(.*)\n", script, flags=re.MULTILINE)[1:]
    pairs = zip(found[::2], found[1::2], strict=True)
    return [Cell(head.strip(), body.strip()) for head, body in pairs]


def rendered(script: str) -> str:
    """Run the cells in the working directory; return the page."""
    scope: dict[str, Any] = {"__name__": "tutorial"}
    parts = []
    for cell in cells(script):
        if cell.head.startswith("[markdown]"):
            parts.append(cell.prose)
        elif cell.commands:
            fails = "raises-exception" in cell.head
            shown = "\n\n".join(_command(words, fails=fails) for words in cell.commands)
            parts.append(f"```console\n{shown}\n```")
        else:
            parts.append(f"```python\n{cell.body}\n```\n\n```text\n{_python(cell, scope)}\n```")
    return "\n\n".join(parts) + "\n"


def _command(words: str, *, fails: bool) -> str:
    """Run a command; return it with what it prints: on standard error, only if it is to fail.

    What else is there, how far a computation is, depends on how busy the machine is.
    """
    program, *rest = shlex.split(words)
    path = os.pathsep.join([str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])])
    run = subprocess.run(  # noqa: S603 (the script is ours)
        [sys.executable if program == "python" else program, *rest],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": path},
        check=False,
    )
    if (run.returncode != 0) != fails:
        raise Failure(f"exit status {run.returncode}: {words}\n{run.stdout}{run.stderr}")
    return f"$ {words}\n{_wrapped(run.stdout + run.stderr * fails)}"


def _python(cell: Cell, scope: dict[str, Any]) -> str:
    """Run Python in a scope; return what it prints."""
    with redirect_stdout(io.StringIO()) as printed:
        exec(compile(cell.body, "a cell of the tutorial", "exec"), scope)  # noqa: S102
    return _wrapped(printed.getvalue())


def _wrapped(text: str) -> str:
    """Break long lines between words."""
    lines = [
        line if len(line) <= WIDTH else
        textwrap.fill(line, WIDTH, subsequent_indent="    ", break_on_hyphens=False)
        for line in text.rstrip().splitlines()
    ]  # fmt: skip
    return "\n".join(line.rstrip() for line in lines)


class Line(str):
    """A line that equals another if the words are the same and the numbers nearly so.

    Integers are the same; decimals agree to one part in 10^5, or to 10^-5: other processors may
    round otherwise.
    """

    __slots__ = ()

    def __hash__(self) -> int:
        return hash(self._words())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Line) or self._words() != other._words():
            return False
        pairs = zip(NUMBER.findall(self), NUMBER.findall(other), strict=True)
        return all(a == b or _near(a, b) for a, b in pairs)

    def _words(self) -> str:
        return " ".join(NUMBER.sub("#", self).split())


def _near(a: str, b: str) -> bool:
    if a.lstrip("-").isdigit() and b.lstrip("-").isdigit():
        return False
    return math.isclose(float(a), float(b), rel_tol=1e-5, abs_tol=1e-5)


def difference(stored: str, now: str) -> str:
    """Return where two pages differ in more than rounding; empty if nowhere."""
    old, new = ([Line(line) for line in text.splitlines()] for text in (stored, now))
    return "\n".join(unified_diff(old, new, "stored", "now", lineterm=""))


def check_pictures(page: str, folder: Path) -> None:
    """Check that the pictures of a page exist in ``folder``, not large, and that it has no other.

    The README may show others.  Raises `Failure` with those that are wrong.
    """
    linked, others = (set(PICTURE.findall(t)) for t in (page, README.read_text(encoding="utf-8")))
    there = {f"pictures/{path.name}" for path in (folder / "pictures").iterdir()}
    if wrong := (linked - there) | (there - linked - others):
        raise Failure(f"pictures missing or not shown: {', '.join(sorted(wrong))}")
    for name in sorted(linked):
        if not 1000 < (size := (folder / name).stat().st_size) < LARGEST:
            raise Failure(f"{name}: {size} bytes")


def main(file: str, arguments: list[str] | None = None) -> int:
    """Write the page and the pictures of a script beside it, or compare with those stored."""
    parser = argparse.ArgumentParser(description=f"Run {Path(file).name} and write its page.")
    parser.add_argument("--check", action="store_true", help="only compare with the stored page")
    check = parser.parse_args(arguments).check
    script = Path(file).resolve()
    page = script.with_suffix(".md")
    try:
        with tempfile.TemporaryDirectory() as name, chdir(name):
            Path("pictures").mkdir()
            text = rendered(script.read_text(encoding="utf-8"))
            check_pictures(text, Path(name))
            if not check:
                page.write_text(text, encoding="utf-8")
                shutil.copytree("pictures", page.parent / "pictures", dirs_exist_ok=True)
        check_pictures(text, page.parent)
        differing = difference(page.read_text(encoding="utf-8"), text)
        if differing:
            raise Failure(f"{page.name} is not what its script prints now:\n{differing}")
    except Failure as failure:
        print(failure, file=sys.stderr)
        return 1
    print(f"{page.name}: {'as stored' if check else 'written'}")
    return 0
