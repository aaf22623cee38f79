"""Where the folders are that belong to the package and are no packages below `cap` in every tree."""

from pathlib import Path

ROOT = Path(__file__).parent


def inside(name: str) -> Path:
    """Return ``proofs`` or ``certificates``: inside `cap`, or, where there are no links, beside it."""
    own = ROOT / name
    return own if own.is_dir() else ROOT.parent / name
