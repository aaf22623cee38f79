"""The explorer's command line: the order of words, files, figures of the paper, compiled code."""

import os
import subprocess
import sys
import time
from pathlib import Path
from threading import Thread

import pytest

from cap.command.entry import INTERRUPTED
from cap.explore import __main__ as explore
from cap.explore import paper as command
from cap.floats.engine import compiled
from cap.floats.engine.compiled import announced
from cap.pictures.paper import sketches

ROOT = Path(__file__).parents[2]


def test_files_named_first(tmp_path):
    """``--out FILE`` before the command is as good as after it, and both are written."""
    first, second = tmp_path / "first.csv", tmp_path / "second.csv"
    assert explore.main(["--out", str(first), "orbit", "--out", str(second)]) == 0
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--paper", "fig:cover", "orbit"], "give --paper or orbit: not both"),
        (["--paper", "fig:cover", "--paper", "fig:sali"], "one figure at a time"),
        (["--paper", "all", "--out", "a", "--out", "b"], "one directory"),
        (["--paper", "all", "--out", "a.png"], 'cannot write into "a.png"'),
        (["--paper", "all", "--out", "a/b"], 'cannot write "a/b": No such file or directory: "a"'),
        (["--f", "3/10", "orbit"], "--f comes after it"),
        (["--size=4", "orbit"], "--size comes after it"),
        (["--out", "a.bmp", "orbit"], "cannot tell what to write"),
        (["orbit", "--out", "x" * 300 + ".csv"], "File name too long"),
        (
            ["inventory", "--certificates", "/dev/null/x"],
            'cannot write "/dev/null/x": Not a dir',
        ),
        (
            ["inventory", "--certificates", "a/b"],
            'cannot write "a/b": No such file or directory: "a"',
        ),
        (["inventory", "--certificates", "a.txt"], 'cannot write into "a.txt"'),
    ],
    ids=lambda words: " ".join(words)[:40] if isinstance(words, list) else "",
)
def test_words_that_make_no_sense(words, complaint, tmp_path, monkeypatch, capsys):
    """Nothing is left out in silence: one line, status 2, nothing written."""
    monkeypatch.chdir(tmp_path)
    assert explore.main(words) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert complaint in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_figure_in_several_files(tmp_path, capsys):
    """``--out`` may be repeated for a figure of the paper, too."""
    files = [tmp_path / name for name in ("a.csv", "a.md")]
    how = [path for file in files for path in ("--out", str(file))]
    assert explore.main(["--paper", "fig:cover", *how]) == 0
    assert all(file.stat().st_size > 100 for file in files)


@pytest.mark.slow
def test_an_interrupt_while_a_picture_is_written(tmp_path, monkeypatch, capsys):
    """The tables of the figures before are there: they are written after each."""

    def interrupted(_data, _figure):
        raise KeyboardInterrupt

    monkeypatch.setattr(command, "labelled", lambda _: ["fig:cover", "fig:multi-particle"])
    monkeypatch.setattr(sketches, "particles", interrupted)
    status = command.run("all", [tmp_path], lambda _words, _part: None, quick=True)
    assert status == INTERRUPTED
    assert "## fig:cover" in (tmp_path / "comparison.md").read_text("utf-8")
    assert {path.name for path in tmp_path.iterdir()} == {"cover.png", "cover.pdf", "comparison.md"}


def add(numbers):
    """Add one to numbers."""
    for k in range(len(numbers)):
        numbers[k] += 1


@pytest.mark.slow
def test_a_word_while_one_waits(monkeypatch, capsys):
    """One line if the first call takes long, of however many threads; none later."""

    def slow(numbers):
        time.sleep(0.3)
        add(numbers)

    monkeypatch.setattr(compiled, "kept", lambda *_, **__: slow)
    monkeypatch.setattr(compiled, "PATIENCE", 0.1)
    monkeypatch.setattr(compiled._Announced, "said", False)
    function, numbers = announced(add), [[0], [0], [0]]
    threads = [Thread(target=function, args=(each,)) for each in numbers]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    function(numbers[0])
    assert numbers == [[2], [1], [1]]
    announced(add)([0])  # another one
    assert capsys.readouterr().err == f"{compiled.WORDS}\n"


def test_no_word_while_it_works(monkeypatch, capsys):
    """It is loaded, or compiled, and what is asked of it takes long."""

    def slow(numbers):
        time.sleep(0.3)
        add(numbers)

    slow.signatures = [("array",)]
    monkeypatch.setattr(compiled, "kept", lambda *_, **__: slow)
    monkeypatch.setattr(compiled, "PATIENCE", 0.1)
    monkeypatch.setattr(compiled._Announced, "said", False)
    announced(add)([0])
    assert capsys.readouterr().err == ""


@pytest.mark.slow
def test_a_home_that_does_not_exist(tmp_path):
    """A picture is drawn, and nothing is said about caches."""
    path = tmp_path / "orbit.png"
    env = {**os.environ, "HOME": "/proc/none", "PYTHONPATH": str(ROOT), "TMPDIR": str(tmp_path)}
    for name in ("XDG_CACHE_HOME", "XDG_CONFIG_HOME", "MPLCONFIGDIR"):
        env.pop(name, None)
    words = [sys.executable, "-m", "cap.explore", "orbit", "--out", str(path)]
    done = subprocess.run(words, env=env, capture_output=True, check=False)
    assert done.returncode == 0
    assert path.stat().st_size > 3000
    assert done.stderr in (b"", f"{compiled.WORDS}\n".encode())
