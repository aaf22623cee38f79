"""How far a long computation is: one line on a terminal, and in a log a line now and then."""

import sys
import time
from collections.abc import Callable

from cap.command.console import columns
from cap.errors import BadInput
from cap.words import printable, say

PATIENCE = 1.0  # seconds without a bar
REFRESH = 0.1  # seconds between two states of the line on a terminal
SELDOM = 30.0  # seconds between two lines in a log, and before the first
WORDS, BAR = 40, 16  # characters


class Progress:
    """The line of one command, on standard error.

    One computation may have phases, with words of their own: as long as the part that is done
    grows, all of it counts for the time that the rest may take.
    """

    def __init__(self) -> None:
        now = time.monotonic()
        self._began, self._shown, self._logged = now, 0.0, now
        self._first = self._part = 1.0  # what was done when it began, and what is done now
        self._on_the_line = False

    def tell(self, words: str, part: float | None = None) -> None:
        """Say what is done, and of ``part`` of it how long the rest may take; "" clears the line.

        What has a part is shown when it has taken a second.
        """
        if sys.stderr is None:
            return
        if not words:
            self.clear()
            return
        now = time.monotonic()
        if part is not None and (part < self._part or self._part == 1):
            self._first, self._began = part, now
        self._part = self._part if part is None else part
        if not sys.stderr.isatty():
            self._log(words, part, now)
        elif now - self._shown >= REFRESH and (part is None or now - self._began >= PATIENCE):
            self._shown, self._on_the_line = now, True
            self._write(self._line(words, part, now))

    def clear(self) -> None:
        """Empty the line on a terminal."""
        if self._on_the_line:
            self._write("")
            self._on_the_line = False

    def _log(self, words: str, part: float | None, now: float) -> None:
        if now - self._logged >= SELDOM:
            self._logged = now
            shown = words if part is None else f"{words}: {part:.0%}{self._left(part, now)}"
            print(shown, file=sys.stderr, flush=True)

    def _line(self, words: str, part: float | None, now: float) -> str:
        if part is None:
            return words
        bar = "#" * round(BAR * part)
        return f"{words:<{WORDS}.{WORDS}} [{bar:<{BAR}}] {part:4.0%}{self._left(part, now)}"

    def _left(self, part: float, now: float) -> str:
        """Return how long the rest may take, if that is known."""
        if not self._first < part < 1:
            return ""
        left = (now - self._began) * (1 - part) / (part - self._first)
        return f"  {_duration(left)} left"

    def _write(self, line: str) -> None:
        """Write over the line on the terminal, and no further than to its end."""
        width = (columns(sys.stderr) or 80) - 1
        print(f"\r{line[:width]:<{width}}\r", end="", file=sys.stderr, flush=True)


def _duration(seconds: float) -> str:
    """Return a time for people: 50 s, 3 min, 2 h."""
    for unit, name in ((3600, "h"), (60, "min")):
        if seconds >= 2 * unit:
            return f"{seconds / unit:.0f} {name}"
    return f"{seconds:.0f} s"


def answered(run: Callable[[], int], progress: Progress) -> int:
    """Run a command and return its status; bad input becomes one line, and the status 2."""
    try:
        return run()
    except BadInput as error:
        progress.clear()
        say(f"error: {printable(str(error))}", sys.stderr)
        return 2
    finally:
        progress.clear()
