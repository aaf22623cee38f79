"""Which tests repeat others, or are long and guard no theorem: they are left to the slow ones.

    python tests/repeated.py    (writes repeated.txt and long.txt beside it; the time of all tests)

Of the checker: each place where it rejects, with the words that it says (but for the numbers in
them), is to be reached by a test of the quick ones, and each theorem is to say its sentence in one
of them.  A test repeats others if it takes longer than `QUICK`, reaches only places and sentences
that quicker tests reach, and neither changes a certificate number by number nor is about the words
of a sentence.

Of the prover, of floats, pictures, commands and the audit: what is proved is verified by the
checker, and a stored certificate is made again by its command.  All else that takes longer than
`LONG`, in a fresh clone, where functions are to be compiled, is listed: it is added to the list,
for without it another test may be the first that waits for a compiled function.

The longest tests are listed by hand in longest.txt, if a smaller example or another step of
`.ci/run` tests the same code.

In collection such tests are marked slow, the longest also beside: `.ci/run` leaves these out,
`.ci/beside` runs them (`conftest`).  As a plugin of pytest this
module notes for each test its time, the places, and the theorems told: `-p repeated`.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
LIST, LENGTHY, LONGEST = (TESTS / f"{name}.txt" for name in ("repeated", "long", "longest"))
ROOMS = "tests/checker/", "tests/certificate/"
QUICK = 0.12  # seconds of processor time
ALWAYS = (  # who changes numbers, reads words: no repetition
    *("every_number", "every_end", "every_claim", "each_comparison"),
    "sentence",
)
LONG = 0.2  # seconds of processor time, with that of the processes begun
GUARDING = *ROOMS, "tests/formal/"
GUARDS = (  # of other rooms: who looks at certificates, at what is refused, or at the sources
    *("reproduced", "same_bytes", "satisfy_the_schema", "elliptic_proves", "truth"),
    *("reject", "refuse", "wrong", "imports", "flights_stand"),
)
NOTES = "CAP_REPEATED"  # where they go: a directory


def listed(file):
    """Return the names of tests in a list."""
    return frozenset(file.read_text("utf-8").split("\n")) - {""}


def repeating(notes):
    """Return the names of tests that reach only places and sentences which quicker ones reach."""
    reached, found = set(), []
    for name, seconds, places, told in sorted(notes, key=lambda note: note[1]):
        there = {*map(tuple, places), *told}
        new = there - reached
        kept = new or any(word in name for word in ALWAYS)
        if there and not kept and seconds > QUICK and name.startswith(ROOMS):
            found.append(name)
        else:
            reached |= new
    return sorted(found)


def lengthy(notes):
    """Return the names of tests that are long, and guard no theorem."""
    return sorted(
        name
        for name, seconds, *_ in notes
        if seconds > LONG and not name.startswith(GUARDING) and not any(w in name for w in GUARDS)
    )


def main():
    """Run all quick tests and those listed; write the lists."""
    LIST.write_text("", "utf-8")
    with tempfile.TemporaryDirectory() as place:
        path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
        words = [sys.executable, "-m", "pytest", "-p", "repeated"]
        env = {**os.environ, NOTES: place, "PYTHONPATH": path}
        subprocess.run(words, check=True, cwd=TESTS.parent, env=env)
        notes = [
            json.loads(line)
            for file in Path(place).iterdir()
            for line in file.read_text("utf-8").splitlines()
        ]
    checking = [note for note in notes if note[0].startswith(ROOMS)]
    long = sorted({*listed(LENGTHY), *lengthy(notes)})
    for file, names in ((LIST, repeating(checking)), (LENGTHY, long)):
        file.write_text("".join(f"{name}\n" for name in names), "utf-8")


if NOTES in os.environ:
    from cap.checker import verdict
    from cap.checker.kernel import rejection

    _places: set[tuple[str, str]] = set()
    _theorems: set[str] = set()
    _words = verdict.words

    def _noted(self, *words):
        Exception.__init__(self, *words)
        frame = sys._getframe(1)
        while frame.f_code.co_filename == rejection.__file__:
            frame = frame.f_back
        where = f"{frame.f_code.co_filename}:{frame.f_lineno}"
        said = re.sub(r"[0-9]+", "0", str(words[0]) if words else "")  # whichever event, or item
        _places.add((where, said))

    def _told(certificate):
        _theorems.add(certificate.theorem)
        return _words(certificate)

    rejection.Rejected.__init__, verdict.words = _noted, _told

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(item, nextitem):
        """Note the time of a test, where the checker rejected in it, and what theorems it told."""
        _places.clear()
        _theorems.clear()
        start = sum(os.times()[:4])
        try:
            return (yield)
        finally:
            took = sum(os.times()[:4]) - start
            note = item.nodeid, took, sorted(_places), sorted(_theorems)
            with (Path(os.environ[NOTES]) / str(os.getpid())).open("a", encoding="utf-8") as file:
                file.write(json.dumps(note) + "\n")


if __name__ == "__main__":
    main()
