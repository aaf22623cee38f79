"""Results by name in a file, one a line: what was done remains when the rest was not."""

import json
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import TracebackType
from typing import IO, Self

from cap.errors import BadInput
from cap.words import quoted


class Journal:
    """A file whose first line says what it is about, and each other line a name and a result.

    A last line that was cut short is removed; a journal about something else is refused.
    """

    def __init__(self, path: Path, key: str) -> None:
        self.path, self.key = path, key
        self.known: dict[str, str] = {}
        self.file: IO[str] | None = None

    def __enter__(self) -> Self:
        header = json.dumps({"journal of": self.key}) + "\n"
        with self._usable():
            self._read(header)
            self.file = self.path.open("a", encoding="ascii")
            if not self.path.stat().st_size:
                self.file.write(header)
                self.file.flush()
        return self

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        _error: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        with suppress(OSError):  # all that was written has been flushed
            if self.file is not None:
                self.file.close()

    def get(self, name: str) -> str | None:
        """Return the result of this name, if it is known."""
        return self.known.get(name)

    def put(self, name: str, result: str) -> None:
        """Write a result down."""
        with self._usable():
            if self.file is not None:
                self.file.write(json.dumps([name, result]) + "\n")
                self.file.flush()

    @contextmanager
    def _usable(self) -> Iterator[None]:
        """Turn an error of the file into one line."""
        try:
            yield
        except OSError as error:
            raise BadInput(
                f"cannot use the journal {quoted(self.path)}: {error.strerror}"
            ) from None

    def _read(self, header: str) -> None:
        if not self.path.exists():
            return
        if not self.path.is_file():
            raise BadInput(f"the journal {quoted(self.path)} is no regular file")
        text = self.path.read_text(encoding="ascii", errors="replace")
        whole = text[: text.rfind("\n") + 1]
        if not (whole.startswith(header) or (not whole and header.startswith(text))):
            raise BadInput(
                f"{quoted(self.path)} is no journal, or one about something else: give another file"
            )
        for line in whole.splitlines()[1:]:
            name, result = self._entry(line)
            self.known[name] = result
        if whole != text:
            self.path.write_text(whole, encoding="ascii")

    def _entry(self, line: str) -> tuple[str, str]:
        with suppress(ValueError, TypeError, RecursionError):
            name, result = json.loads(line)
            if isinstance(name, str) and isinstance(result, str):
                return name, result
        raise BadInput(f"the journal {quoted(self.path)} is damaged: remove it")
