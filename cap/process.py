"""What a process is among others: whose signals it hears, and whether it has a home directory.

Nothing is imported here that takes time to load.
"""

import os
import signal

_NAMES = ("SIGINT", "SIGTERM", "SIGHUP")
SIGNALS: list[signal.Signals] = [getattr(signal, name) for name in _NAMES if hasattr(signal, name)]
"""Those that ask a process to end, as far as the system has them."""


def as_worker() -> None:
    """Take the signals of a process that works for another: that one hears ctrl-C."""
    for number in SIGNALS:
        ignored = number == signal.SIGINT or signal.getsignal(number) is signal.SIG_IGN
        signal.signal(number, signal.SIG_IGN if ignored else signal.SIG_DFL)


def at_home() -> bool:
    """Return whether there is a home directory; where not, libraries would make one called `~`."""
    return os.path.expanduser("~") != "~"  # noqa: PTH111 (pathlib raises an exception)
