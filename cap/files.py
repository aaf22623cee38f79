"""Files that are written whole or not at all."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from errno import EACCES, EISDIR, ENOTDIR
from pathlib import Path
from typing import IO


@contextmanager
def replacing(path: Path) -> Iterator[IO[bytes]]:
    """Open a file that becomes ``path`` at the end; after any failure the old one is there."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".cap-")
    try:
        with os.fdopen(handle, "wb") as file:
            yield file
        Path(name).chmod(0o644)
        Path(name).replace(path)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def tried(path: Path) -> None:
    """Raise `OSError` if a file certainly cannot be written to ``path``, which is not touched.

    Directories that are missing are not made.
    """
    if path.is_dir():
        raise IsADirectoryError(EISDIR, os.strerror(EISDIR))
    above = path.absolute().parent
    while not (above.exists() or above.is_symlink()):
        above = above.parent
    if not above.is_dir():
        raise NotADirectoryError(ENOTDIR, os.strerror(ENOTDIR))
    if not os.access(above, os.W_OK | os.X_OK):
        raise PermissionError(EACCES, os.strerror(EACCES))
    if above == path.absolute().parent:
        with tempfile.TemporaryFile(dir=above):
            pass
