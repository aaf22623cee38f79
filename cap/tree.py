"""The folders of the tree that belong to the package: ``proofs`` and ``certificates``."""

from pathlib import Path

ROOT = Path(__file__).parent


def inside(name: str) -> Path:
    """Return one of them: inside `cap`, or beside it in a checkout without symbolic links."""
    own = ROOT / name
    return own if own.is_dir() else ROOT.parent / name
