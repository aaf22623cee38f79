"""Compiled code is kept where it can be, and compiled all the same where it cannot."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numba.core.caching import FunctionCache

from cap.flow import flight
from cap.sets.compiled import files
from cap.sets.kept import kept

ROOT = Path(__file__).parents[2]
IMPORTED = re.compile(r"from cap\.sets\.compiled import (\([^)]*\)|[^\n]*)")


def twice(numbers):
    """Double numbers."""
    for k in range(len(numbers)):
        numbers[k] *= 2


def test_it_is_kept():
    """A second dispatcher of the same function loads what the first has compiled."""
    numbers = np.array([1.0, 2.0])
    kept(twice)(numbers)
    again = kept(twice)
    again(numbers)
    assert list(numbers) == [4, 8]
    assert sum(again.stats.cache_hits.values()) == 1


@pytest.mark.parametrize(("digest", "loaded"), [("same", 1), ("other", 0)])
def test_what_was_compiled_of_other_sources_is_not_loaded(digest, loaded):
    """Numba sees no change of a function that is compiled into another: the digest does."""
    numbers = np.array([1.0, 2.0])
    kept(twice, "same")(numbers)
    again = kept(twice, digest + ("" if loaded else str(os.getpid())))
    again(numbers)
    assert list(numbers) == [4, 8]
    assert sum(again.stats.cache_hits.values()) == loaded


@pytest.mark.parametrize("method", ["_save_overload", "_load_overload"])
def test_a_cache_that_fails(monkeypatch, method):
    """A full disk, a file that may not be read: it is compiled and used."""

    def failing(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(FunctionCache, method, failing)
    numbers = np.array([1, 2])
    kept(twice)(numbers)
    assert list(numbers) == [2, 4]


@pytest.mark.parametrize("kind", ["nbi", "nbc"])
def test_a_damaged_file(kind):
    """It is no error: the function is compiled, and the files are whole again."""
    numbers = np.array([1.0, 2.0])
    first = kept(twice, f"damaged {kind}")
    first(numbers)
    for file in Path(first.stats.cache_path).glob(f"test_kept.twice-*.{kind}"):
        whole = file.read_bytes()
        file.write_bytes(whole[: len(whole) // 2] + b"n" * 100)
    hits = []
    for _ in range(2):
        again = kept(twice, f"damaged {kind}")
        again(numbers)
        hits.append(sum(again.stats.cache_hits.values()))
    assert (list(numbers), hits) == ([8, 16], [0, 1])


def test_the_digest_is_of_all_that_may_be_compiled():
    """Whatever is compiled by `compiled` or `kernel` lies in a file that the digest covers."""
    users = {
        path
        for path in (ROOT / "cap").rglob("*.py")
        for names in IMPORTED.findall(path.read_text(encoding="utf-8"))
        if re.search(r"\b(compiled|kernel)\b", names)
    }
    assert users <= set(files())
    assert Path(flight.__file__) in files()
    assert {path.name for path in files()} >= {"paths.py", "levels.py", "compiled.py"}


def test_no_place_to_keep_anything(tmp_path):
    """A package where nothing can be written and no home directory: it loads, and works."""
    shutil.copytree(ROOT / "cap", tmp_path / "cap", ignore=shutil.ignore_patterns("__pycache__"))
    folders = [tmp_path / "cap", *(path for path in (tmp_path / "cap").rglob("*") if path.is_dir())]
    for folder in folders:
        (folder / "__pycache__").write_text("a file where numba wants a directory")
    env = {**os.environ, "HOME": "/proc/none", "PYTHONPATH": str(tmp_path)}
    env.pop("XDG_CACHE_HOME", None)
    program = (
        "import cap, cap.floats.engine.swarm\n"
        "from cap.sets.compiled import compiled\n"
        "from cap.sets.doubles import hull\n"
        "print(cap.__file__, type(compiled(hull)._cache).__name__)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        env=env,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    assert done.stdout.split() == [str(tmp_path / "cap" / "__init__.py"), "NullCache"]
