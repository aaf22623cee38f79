"""Files that are written whole or not at all."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from errno import EISDIR
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

    Its directory must be there: none is made.
    """
    if path.is_dir():
        raise IsADirectoryError(EISDIR, os.strerror(EISDIR))
    with tempfile.TemporaryFile(dir=path.absolute().parent):
        pass
