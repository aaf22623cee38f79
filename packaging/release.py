"""Build what a release consists of: archive of the sources, wheel, and the checker in one file.

    python packaging/release.py DIRECTORY        (of a release)
    python packaging/release.py --try DIRECTORY  (of any state: to see whether it would do)

The wheel is made from the archive, and the checker twice: the bytes have to be the same.  Then the
wheel is installed in a fresh environment, proves a theorem, and the file with bare Python checks
the certificate.  What a release needs before is in CONTRIBUTING.md.
"""

import argparse
import re
import subprocess
import sys
import tempfile
import venv
from hashlib import sha256
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SDIST = "import sys; from setuptools.build_meta import build_sdist; print(build_sdist(sys.argv[1]))"


def version() -> str:
    """Return the version of the tree."""
    text = (ROOT / "cap/__init__.py").read_text("utf-8")
    (found,) = re.findall(r'^__version__ = "(.*)"$', text, re.MULTILINE)
    return str(found)


def refusals(number: str, changes: str, status: str) -> list[str]:
    """Return what is missing for a release of a version, given CHANGELOG.md and ``git status``."""
    found = []
    if not re.fullmatch(r"\d+\.\d+\.\d+", number):
        found.append(f"{number} is no release: write the version without .dev")
    if f"\n## {number}\n" not in changes:
        found.append(f"CHANGELOG.md has no heading {number}")
    if status:
        found.append("the tree has changes that are not committed")
    return found


def run(*words: object, into: Path | None = None) -> str:
    """Run a command in the tree; return the last line it prints."""
    done = subprocess.run(  # noqa: S603 (commands of this file)
        [str(word) for word in words], cwd=into or ROOT, check=True, capture_output=True, text=True
    )
    return (done.stdout.strip().splitlines() or [""])[-1]


def built(directory: Path) -> list[Path]:
    """Build the three files."""
    directory.mkdir(parents=True, exist_ok=True)
    archive = directory / run(sys.executable, "-c", SDIST, directory)
    pip = (sys.executable, "-m", "pip", "wheel", "-q", "--no-deps", "--no-build-isolation")
    run(*pip, "-w", directory, archive)
    (wheel,) = directory.glob(f"*-{version()}-*.whl")
    checker = directory / f"cap-check-{version()}.pyz"
    copies = []
    for _ in range(2):
        run(sys.executable, "-m", "cap.command.archive", checker)
        copies.append(checker.read_bytes())
    if copies[0] != copies[1]:
        raise SystemExit("error: the checker in one file is not built the same twice")
    return [archive, wheel, checker]


def tried(wheel: Path, checker: Path) -> None:
    """Install the wheel in a fresh environment; prove a theorem, and check it with bare Python."""
    with tempfile.TemporaryDirectory() as place:
        elsewhere = Path(place)
        venv.create(elsewhere / "venv", with_pip=True)
        binary = next(p for p in (elsewhere / "venv").iterdir() if p.name in ("bin", "Scripts"))
        run(binary / "python", "-m", "pip", "install", "-q", wheel, into=elsewhere)
        run(binary / "cap-prove", "elliptic", "--out", "elliptic.json", into=elsewhere)
        bare = (sys.executable, "-I", "-S", checker.resolve(), "elliptic.json")
        print(run(*bare, into=elsewhere)[:60] + " ..")


def main() -> None:
    """Build a release, or try."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--try", action="store_true", dest="trial", help="of any state of the tree")
    parser.add_argument("directory", type=Path)
    given = parser.parse_args()
    changes = (ROOT / "CHANGELOG.md").read_text("utf-8")
    missing = refusals(version(), changes, run("git", "status", "--porcelain"))
    if missing and not given.trial:
        raise SystemExit("error: " + "; ".join(missing))
    files = built(given.directory)
    tried(files[1], files[2])
    for path in files:
        print(
            f"{sha256(path.read_bytes()).hexdigest()}  {path.name}  {path.stat().st_size:,} bytes"
        )


if __name__ == "__main__":
    main()
