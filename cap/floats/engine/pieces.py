"""Orbits in pieces, each so short that an interrupt need not wait and that all states have room."""

from collections.abc import Callable

from cap.runner import Runner

PIECE = 500  # orbits: few enough that `cap.floats.engine.swarm` follows them in one thread
KEPT = 500_000  # orbits x periods of a piece: half a second; all these states have room


def in_pieces(
    runner: Runner, count: int, function: Callable[[slice], None], words: str, periods: int
) -> None:
    """Call ``function`` for slices of ``count`` orbits that are followed for so many periods."""
    runner.map(function, cut(count, periods), words)


def cut(count: int, periods: int, most: int = PIECE) -> list[slice]:
    """Return slices of ``count`` orbits, at most ``most`` in each, and `KEPT` / ``periods``."""
    length = max(1, min(most, KEPT // periods))
    return [slice(k, min(k + length, count)) for k in range(0, count, length)]
