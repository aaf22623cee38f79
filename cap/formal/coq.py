"""Coq, run with limits of memory and time.

    missing()          why Coq cannot be run here, or ""
    library(tell)      where the library of ``proofs/formal`` is, compiled
    prove(text, where) what Coq says to a file

All processes are killed when this one is interrupted.
"""

import os
import re
import resource
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from cap import proofs
from cap.errors import NotProved

MEMORY = 4 << 30  # bytes of a process; the prototype took a quarter of it
SECONDS = 1800  # of computing, of a process
FROM_DEBIAN = "apt-get install --no-install-recommends coq libcoq-interval libcoq-coquelicot make"
CLASSICAL_REALS = (  # as Coq 8.16 prints them, without breaks of lines
    "ClassicalDedekindReals.sig_not_dec : forall P : Prop, {~ ~ P} + {~ P}",
    "ClassicalDedekindReals.sig_forall_dec : forall P : nat -> Prop, "
    "(forall n : nat, {P n} + {~ P n}) -> {n : nat | ~ P n} + {forall n : nat, P n}",
    "FunctionalExtensionality.functional_extensionality_dep : forall (A : Type) (B : A -> Type) "
    "(f g : forall x : A, B x), (forall x : A, f x = g x) -> f = g",
    "Classical_Prop.classic : forall P : Prop, P \\/ ~ P",
)

COMMAND = ("coqc", "-q", "-w", "-ambiguous-paths")
_PROBE = "From Interval.Interval Require Import Float_full.\nFrom Coquelicot Require Coquelicot.\n"
_RECORD = ".compiled"  # by this module, and from what
_NEXT = re.compile(r"\n(?=\S)")  # a line that begins with a space belongs to the line before


class Answer(NamedTuple):
    """The exit status of a program, and what it printed."""

    status: int
    text: str


def missing() -> str:
    """Return in a line how to get what is missing of Coq, or "" if nothing is."""
    lacking = [name for name in ("coqc", "coqdep", "make") if shutil.which(name) is None]
    if not lacking and not _finds_libraries():
        lacking = ["Coq's libraries Coquelicot and Interval"]
    if not lacking:
        return ""
    return f"{' and '.join(lacking)} not found; Debian has them: {FROM_DEBIAN}"


@contextmanager
def library(tell: Callable[[str, float | None], None]) -> Iterator[Path]:
    """Give the directory of the library, compiled: a copy, where files cannot be written."""
    home = Path(proofs.__file__).with_name("formal")
    if os.access(home, os.W_OK):
        yield _compiled(home, tell)
        return
    with _scratch() as copy:
        shutil.copytree(home, copy, dirs_exist_ok=True)
        yield _compiled(copy, tell)


def prove(text: str, compiled: Path) -> Answer:
    """Return what Coq says to this text, which may use the library."""
    with _scratch() as place:
        return _file(text, place, "-Q", str(compiled), "Cap")


def axioms(answer: Answer) -> str:
    """Return the axioms that Coq printed; raise `NotProved` unless they are all that it printed.

    Each of them is known, with its type.  `Print Assumptions` says the rest in sentences ("hole is
    assumed to be guarded."), under other headings ("Section Variables:", "Theory:"), or as axioms.
    """
    heading, *found = (" ".join(said.split()) for said in _NEXT.split(answer.text.strip("\n")))
    others = [axiom for axiom in found if axiom not in CLASSICAL_REALS]
    if answer.status or heading != "Axioms:" or not found or others:
        said = others[0] if heading == "Axioms:" and others else heading
        raise NotProved("Coq", f'it prints other things than the axioms of its reals: "{said}"')
    return answer.text.strip("\n").partition("\n")[2]


def _finds_libraries() -> bool:
    """Return whether Coq finds the libraries that ours uses."""
    with _scratch() as place:
        return not _file(_PROBE, place).status


def _compiled(home: Path, tell: Callable[[str, float | None], None]) -> Path:
    """Compile what is not compiled yet, or has changed."""
    _forget(home)
    planned = run(["make", "-n", "library"], home).text
    waiting, done = sum(map(_compiles, planned.splitlines())), 0

    def heard(line: str) -> None:
        nonlocal done
        done += _compiles(line)
        tell("library", min(done / max(waiting, 1), 1.0))

    answer = run(["make", "-j2", "library"], home, heard)
    if answer.status:
        raise NotProved("library", "it does not compile", {"Coq": last_words(answer)})
    (home / _RECORD).write_text("\n".join(_digests(home).values()), "utf-8")
    return home


def _forget(home: Path) -> None:
    """Remove what was not compiled here from these sources: make goes by times, which may lie."""
    record = home / _RECORD
    compiled = set(record.read_text("utf-8").splitlines()) if record.exists() else set[str]()
    for product, digest in _digests(home).items():
        if digest not in compiled:
            product.unlink(missing_ok=True)


def _digests(home: Path) -> dict[Path, str]:
    """Return a line for each compiled file: its name, and digests of its source and of itself."""
    lines = {}
    for source in sorted(home.glob("*.v")):
        product = source.with_suffix(".vo")
        both = (file.read_bytes() if file.exists() else b"" for file in (source, product))
        lines[product] = " ".join([source.stem, *(sha256(each).hexdigest() for each in both)])
    return lines


def _compiles(line: str) -> bool:
    """Return whether a line of make runs Coq."""
    return line.startswith("coqc")


def last_words(answer: Answer) -> str:
    """Return the end of what was printed, in a line, and what a limit did."""
    limits = {-signal.SIGXCPU: f"over {SECONDS} s", -signal.SIGKILL: "killed"}
    lines = [limits.get(answer.status, ""), *answer.text.splitlines()[-6:]]
    return " ".join(" ".join(lines).split())


@contextmanager
def _scratch() -> Iterator[Path]:
    """Give a directory that is gone afterwards."""
    with tempfile.TemporaryDirectory(prefix="cap-coq-") as name:
        yield Path(name)


def _file(text: str, place: Path, *options: str) -> Answer:
    """Run Coq on a text."""
    (place / "Certified.v").write_text(text, "utf-8")
    return run([*COMMAND, *options, "Certified.v"], place)


def run(words: Sequence[str], place: Path, heard: Callable[[str], None] = lambda _: None) -> Answer:
    """Run a program within the limits, and tell its lines as they come."""
    with subprocess.Popen(  # noqa: S603
        words,
        cwd=place,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        text=True,
        errors="replace",
        start_new_session=True,
        preexec_fn=_limit,  # noqa: PLW1509 (there are no threads)
    ) as process:
        try:
            lines = list[str]()
            for line in process.stdout or ():
                lines.append(line)
                heard(line)
            return Answer(process.wait(), "".join(lines))
        except BaseException:
            os.killpg(process.pid, signal.SIGTERM)
            raise


def _limit() -> None:
    """Limit this process and its children."""
    for what, most in ((resource.RLIMIT_AS, MEMORY), (resource.RLIMIT_CPU, SECONDS)):
        hard = resource.getrlimit(what)[1]
        soft = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(what, (soft, hard))
