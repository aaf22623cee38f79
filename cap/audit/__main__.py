"""Audit the paper, claim by claim: ``python -m cap.audit``.  See `cap.audit.command`."""

from collections.abc import Sequence

from cap.command import entry


def main(words: Sequence[str] | None = None) -> int:
    """Run the command line; return its exit status."""
    return entry.run("cap.audit.command:main", words)


if __name__ == "__main__":
    entry.leave(main())
