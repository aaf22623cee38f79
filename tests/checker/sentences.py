"""The theorem of every certificate that is kept, in words: sentences.txt, to be read.

    python tests/checker/sentences.py

writes it anew.  Its difference shows which words have changed, and where numbers or cases are told
otherwise.
"""

import textwrap
from pathlib import Path

from cap.checker.kernel.certificate import read
from cap.checker.verdict import words

ROOT = Path(__file__).parents[2]
FILE = Path(__file__).with_suffix(".txt")
FOLDERS = "certificates", "tests/certificates/accept"
WIDTH = 100


def paths():
    """Return the paths of the certificates, from the root."""
    found = [path for folder in FOLDERS for path in (ROOT / folder).glob("*.json")]
    return sorted(str(path.relative_to(ROOT)) for path in found)


def sentence(path):
    """Return the words of a certificate, in lines."""
    told = words(read((ROOT / path).read_bytes()))
    return textwrap.fill(told, WIDTH, break_long_words=False, break_on_hyphens=False)


def kept():
    """Return the sentences that are recorded, each by its path."""
    parts = FILE.read_text("utf-8").strip().split("\n\n")
    return dict(part.split("\n", 1) for part in parts)


if __name__ == "__main__":
    FILE.write_text("\n\n".join(f"{path}\n{sentence(path)}" for path in paths()) + "\n", "utf-8")
