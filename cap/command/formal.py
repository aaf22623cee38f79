"""The command ``python -m cap.verify --formal FILE...``: theorems proved by Coq's kernel.

For each certificate ``PROVED BY COQ: <the theorem> ("FILE")`` and the axioms that Coq prints, or
``NOT PROVED BY COQ: "FILE": <where it fails>`` or ``CANNOT READ: "FILE": <the reason>``.  Exit
status 0 if every theorem is proved, 1 if one is not, 2 without Coq or if a file cannot be read.
"""

import re
import sys
from collections.abc import Sequence
from pathlib import Path

from cap.checker.kernel.certificate import Certificate, read
from cap.checker.kernel.rejection import Rejected
from cap.command.console import Parser
from cap.command.progress import Progress
from cap.errors import NotProved
from cap.formal import coq, theorem
from cap.words import printable, quoted, say, unread

_TESTS = re.compile(r"=\s*\[?(.*?)\]?\s*:\s*list test", re.DOTALL)


def write(words: Sequence[str]) -> int:
    """Print the Coq file of a certificate."""
    parser = Parser(prog="python -m cap.formal", description="Write the Coq file of a certificate.")
    parser.add_argument("file", metavar="CERTIFICATE", help="of an elliptic orbit or a saddle")
    name = parser.parse_args(words).file
    try:
        print(theorem.theorem(_read(name)), end="")
    except (NotProved, Rejected, OSError) as reason:
        say(f"error: {quoted(name)}: {_why(reason)}", sys.stderr)
        return 2
    return 0


def prove(names: Sequence[str]) -> int:
    """Prove the theorems of these certificates, by Coq."""
    if lacking := coq.missing():
        say(f"error: {lacking}", sys.stderr)
        return 2
    progress = Progress()
    try:
        with coq.library(progress.tell) as library:
            return max([_prove(name, library, progress) for name in names])
    except NotProved as reason:
        progress.clear()
        say(f"error: {_why(reason)}", sys.stderr)
        return 2
    finally:
        progress.clear()


def _prove(name: str, library: Path, progress: Progress) -> int:
    """Prove one theorem, print what became of it, and return the exit status."""
    try:
        certificate = _read(name)
        progress.tell(f"Coq computes, half a minute or so: {quoted(name)}")
        printed = _axioms(certificate, library)
    except (OSError, ValueError) as error:
        progress.clear()
        say(unread(name, error), sys.stdout)
        return 2
    except (NotProved, Rejected) as reason:
        progress.clear()
        say(f"NOT PROVED BY COQ: {quoted(name)}: {_why(reason)}", sys.stdout)
        return 1
    progress.clear()
    say(f"PROVED BY COQ: {theorem.words(certificate)} ({quoted(name)})", sys.stdout)
    say(f"  with these axioms, as Coq prints them:\n{printed}", sys.stdout)
    sys.stdout.flush()
    return 0


def _axioms(certificate: Certificate, library: Path) -> str:
    """Return the axioms of the theorem, as Coq prints them; raise `NotProved` if it refuses."""
    answer = coq.prove(theorem.theorem(certificate), library)
    if not answer.status:
        return coq.axioms(answer)
    found = _TESTS.search(coq.prove(theorem.failures(certificate), library).text)
    if found and found[1] not in ("", "nil"):
        raise NotProved("Coq", "these tests of Check.v fail: " + " ".join(found[1].split()))
    raise NotProved("Coq", coq.last_words(answer))


def _read(name: str) -> Certificate:
    """Return the certificate in a file."""
    return read(Path(name).read_bytes())


def _why(reason: Exception) -> str:
    """Return a reason in one line."""
    if isinstance(reason, OSError):
        return f"cannot be read ({reason.strerror})"
    return printable(str(reason))[:600]
