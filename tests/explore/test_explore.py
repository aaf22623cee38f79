"""The command line that explores: every command, its files, its complaints."""

import csv
import json
import os
import signal
import struct
import subprocess
import sys
import time
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from support import only

from cap import verify
from cap.command.entry import INTERRUPTED
from cap.errors import NotProved
from cap.explore import __main__ as explore
from cap.explore import explorer, export, inventory
from cap.explore.arrays import load
from cap.explore.commands import COMMANDS
from cap.floats.diagnostics import fate
from cap.floats.engine import swarm
from cap.floats.engine.pieces import in_pieces
from cap.floats.search import cycles
from cap.parameters import PAPER
from cap.proofs import theorems
from cap.runner import Runner

TINY = {
    "orbit": ["--F", "3", "--orbit", "0.4", "-0.67", "--periods", "2"],
    "portrait": ["--orbits", "12", "--periods", "20"],
    "sali": ["--points", "9"],
    "gali": ["--points", "9"],
    "basin": ["--points", "9", "--periods", "5"],
    "basin-entropy": ["--points", "24", "--periods", "10"],
    "lyapunov": ["--orbits", "3", "--periods", "50"],
    "rotation": ["--orbits", "20", "--periods", "200"],
    "continuation": ["--range", "0.38", "0.42", "--branches", "1"],
    "plane": ["--points", "3"],
    "inventory": ["--F", "17/20"],
    "gallery": ["--values", "4.5", "--periods", "1"],
    "chatter": [],
    "manifolds": ["--length", "0.5", "--spacing", "0.02", "--periods", "8"],
    "release": ["--points", "60", "--iterates", "3"],
    "attractor": ["--points", "4", "--transient", "50", "--F", "3"],
}


def run(*words):
    """Run a command on one core; return its status."""
    return explore.main([*words, "--jobs", "1"])


def tiny(name, *words):
    """Run a command on its tiny case."""
    return run(name, *TINY[name], *words)


def table(path):
    """Return the columns of a table."""
    rows = [line for line in path.read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    names, *values = csv.reader(rows)
    return dict(zip(names, zip(*values, strict=True), strict=True))


def test_every_command_has_a_tiny_case():
    """No command is left out below."""
    assert set(TINY) == set(COMMANDS)


@pytest.mark.parametrize("name", only(COMMANDS, "orbit", "portrait", "plane", "sali"))
def test_data_and_picture(name, tmp_path, capsys):
    """Each command says, writes and draws something, the same again."""
    files = [tmp_path / f"{name}.{kind}" for kind in ("png", "npz", "csv")]
    outputs = [word for file in files for word in ("--out", str(file))]
    assert tiny(name, *outputs, "--size", "5", "4", "--dpi", "50") == 0
    said = capsys.readouterr().out
    width, height = struct.unpack(">II", files[0].read_bytes()[16:24])
    assert (width, height) == (250, 200)
    assert files[0].stat().st_size > 3000
    assert load(files[1])["parameters"].omega == 1
    with np.load(files[1]) as data:
        numbers = [data[key] for key in data if data[key].dtype.kind in "fi"]
        assert any(np.isfinite(array).any() for array in numbers if array.size)
    assert len(next(iter(table(files[2]).values()))) > 0
    again = tmp_path / "again.csv"
    assert tiny(name, "--out", str(again)) == 0
    assert again.read_bytes() == files[2].read_bytes()
    assert capsys.readouterr().out.splitlines()[0] == said.splitlines()[0]


@pytest.mark.slow
@pytest.mark.parametrize("kind", only(["pdf", "svg"], "svg"))
def test_vector_pictures(kind, tmp_path):
    """They are what they are called, and the same bytes every time."""
    files = [tmp_path / f"{k}.{kind}" for k in range(2)]
    for file in files:
        assert tiny("orbit", "--out", str(file), "--size", "4", "3") == 0
    first, second = (file.read_bytes() for file in files)
    assert first == second
    if kind == "svg":
        root = ElementTree.fromstring(first)  # noqa: S314 (our own file)
        assert root.get("width") == "288pt"
    else:
        assert first.startswith(b"%PDF")


BAD = {
    "f >= F": ["orbit", "--f", "1"],
    "no gap": ["orbit", "--l", "1"],
    "nan": ["orbit", "--F", "nan"],
    "huge": ["portrait", "--F", "1e400"],
    "huge state": ["orbit", "--orbit", "0", "1e30"],
    "outside": ["orbit", "--orbit", "2", "0"],
    "bad orbit": ["portrait", "--orbit", "7", "1"],
    "suffix": ["orbit", "--out", "orbit.bmp"],
    "no suffix": ["orbit", "--out", "orbit"],
    "no directory": ["orbit", "--out", "nowhere/orbit.png"],
    "a directory": ["orbit", "--out", "taken.png"],
    "count": ["sali", "--points", "-3"],
    "fraction": ["sali", "--points", "2.5"],
    "zero periods": ["basin", "--periods", "0"],
    "empty box": ["basin", "--box", "0.5", "-0.5", "0", "1"],
    "box outside": ["basin", "--box", "-3", "3", "0", "1"],
    "box size": ["basin-entropy", "--points", "8", "--boxes", "9"],
    "parameter": ["continuation", "--parameter", "g"],
    "range": ["continuation", "--range", "0.5", "0.6"],
    "no elliptic": ["rotation", "--mu", "1/10"],
    "hyperbolic": ["rotation", "--orbit", "0.3435", "0.7753"],
    "no saddle": ["manifolds", "--orbit", "0.1003", "0.5419"],
    "axes": ["plane", "--axes", "f", "f"],
    "no capture": ["chatter", "--orbit", "0.1002798898", "0.5419433068"],
    "size": ["orbit", "--size", "0", "4"],
    "what": ["orbits"],
    "nothing": [],
    "too much": ["portrait", "--orbits", "100000", "--periods", "1000000"],
    "value": ["gallery", "--values", "0.1"],
    "too long": ["orbit", "--periods", "1e30"],
    "too long a chatter": ["chatter", "--periods", "1e9"],
    "too long a gallery": ["gallery", "--values", "1.5", "--periods", "1e6"],
    "too coarse": ["manifolds", "--spacing", "1e9"],
    "too wide": ["portrait", "--radius", "1e30"],
    "too many pixels": ["orbit", "--size", "100", "100", "--dpi", "2000"],
    "too many seeds": ["attractor", "--points", "2000"],
    "too fast, basin": ["basin", "--F", "1e30"],
    "too fast, exponents": ["lyapunov", "--F", "1e30"],
    "too fast, attractors": ["attractor", "--l", "0", "--r", "1e-12"],
    "too weak a saddle": ["manifolds", "--omega", "1e12"],
    "saddle that sticks": ["manifolds", "--F", "3", "--orbit", "0.85396", "0.52267"],
    "losses": ["manifolds", "--e", "1/2"],
    "too near": ["rotation", "--near", "1e-20", "--radius", "1e-19"],
    "no place": ["inventory", "--certificates", "file"],
}


@pytest.mark.parametrize("words", BAD.values(), ids=BAD)
def test_bad_input(words, tmp_path, monkeypatch, capsys):
    """One line, exit status 2, no file."""
    monkeypatch.chdir(tmp_path)
    Path("taken.png").mkdir()
    Path("file").touch()
    try:
        status = explore.main(words)
    except SystemExit as end:
        status = end.code
    said = capsys.readouterr().err.splitlines(keepends=True)
    complaint = "".join(line for line in said if not line.startswith("compiling the engine"))
    assert status == 2
    assert complaint.startswith("error: ")
    assert complaint.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "taken.png"]


@pytest.mark.slow
@pytest.mark.parametrize("words", [
    ["sali", "--f", "7/10"],
    ["lyapunov", "--e", "1e-30"],
    ["manifolds", "--l", "-1e30", "--r", "1e30"],
    ["basin", "--omega", "1e30"],
    ["rotation", "--f", "0"],
    ["attractor", "--mu", "1e30"],
])  # fmt: skip
def test_odd_parameters(words, tmp_path, capsys):
    """A picture or one line; no warning."""
    status = tiny(words[0], *words[1:], "--out", str(tmp_path / "odd.png"))
    assert status in (0, 2)
    assert capsys.readouterr().err.count("\n") == (status == 2)


def test_files_that_cannot_be_written(tmp_path, capsys):
    """A directory in which nobody may write."""
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o500)
    status = tiny("orbit", "--out", str(closed / "orbit.csv"))
    assert status in (0, 2)  # 0: of a superuser
    assert status == 0 or "cannot write" in capsys.readouterr().err


def test_a_failure_leaves_the_old_file(tmp_path, monkeypatch):
    """A file is replaced whole or not at all."""
    path = tmp_path / "orbit.csv"
    path.write_text("old")
    monkeypatch.setattr("csv.writer", lambda _: (_ for _ in ()).throw(KeyboardInterrupt))
    assert tiny("orbit", "--out", str(path)) == INTERRUPTED
    assert path.read_text("utf-8") == "old"
    assert [each.name for each in tmp_path.iterdir()] == ["orbit.csv"]


def interrupting(calls, function):
    """Return ``function``, which is interrupted after some calls."""
    left = iter(range(calls))

    def wrapped(*words, **options):
        if next(left, None) is None:
            raise KeyboardInterrupt
        return function(*words, **options)

    return wrapped


def test_ctrl_c_keeps_what_is_done(tmp_path, monkeypatch, capsys):
    """The pieces that were done are written; the status says so."""
    path = tmp_path / "basin.npz"
    arguments = ["--box", "-1", "1", "-2", "2", "--points", "50", "--periods", "3"]
    monkeypatch.setattr(fate, "require_followed", lambda *_: None)
    monkeypatch.setattr(swarm, "follow", interrupting(2, swarm.follow))
    assert run("basin", *arguments, "--out", str(path)) == INTERRUPTED
    assert "interrupted" in capsys.readouterr().err
    with np.load(path) as data:
        assert not data["complete"]
        assert (data["fate"].ravel()[:1000] >= 0).all()
        assert (data["fate"].ravel()[1000:] == -1).all()


@pytest.mark.parametrize("name", [name for name in COMMANDS if name not in ("orbit", "chatter")])
def test_ctrl_c_at_once(name, tmp_path, monkeypatch, capsys):
    """Even nothing can be written and drawn, or there is one line that says why not."""
    monkeypatch.setattr(Runner, "map", lambda self, *_, **__: interrupted(self))
    monkeypatch.setattr(explorer.Progress, "tell", interrupting(0, None))
    small = ("--size", "5", "4", "--dpi", "50")
    files = ("--out", str(tmp_path / "a.png"), "--out", str(tmp_path / "a.csv"))
    status = tiny(name, *files, *small)
    captured = capsys.readouterr()
    assert status == INTERRUPTED
    assert "interrupted" in captured.err


def interrupted(runner):
    """Do as ctrl-C before the first piece."""
    runner.interrupted = True
    return []


@pytest.mark.slow
def test_more_jobs_change_nothing(tmp_path):
    """Threads and processes give the same numbers."""
    for name in ("sali", "plane"):
        files = [tmp_path / f"{name}-{jobs}.csv" for jobs in (1, 2)]
        for jobs, file in enumerate(files, 1):
            words = [name, *TINY[name], "--points", "3", "--out", str(file)]
            assert explore.main([*words, "--jobs", str(jobs)]) == 0
        assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("words", [
    ["basin", "--box", "-1", "1", "-2", "2", "--points", "2000", "--periods", "1000"],
    ["plane", "--points", "200"],
    ["lyapunov", "--periods", "1000000", "--orbits", "50"],
])  # fmt: skip
def test_a_signal_stops_a_process(words, tmp_path):
    """Ctrl-C in a terminal, to threads, processes or a loop: no traceback, and a file."""
    path = tmp_path / "part.npz"
    command = [sys.executable, "-m", "cap.explore", *words, "--jobs", "2", "--out", str(path)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True, text=True)
    time.sleep(6)  # modules are loaded
    os.killpg(process.pid, signal.SIGINT)
    _, complaint = process.communicate(timeout=10)  # not when the pieces begun are done
    assert process.returncode == INTERRUPTED
    assert complaint == "interrupted; what was done is kept\n"
    with np.load(path) as data:
        assert not data["complete"]


def test_help_teaches(capsys):
    """Every command has an example, and the examples can be parsed."""
    with pytest.raises(SystemExit) as end:
        explore.main(["--help"])
    assert end.value.code == 0
    said = capsys.readouterr().out
    parser = explorer.parser()
    for name, command in COMMANDS.items():
        assert command.line(name) in said
        assert parser.parse_args(command.line(name).split()[3:]).command == name
        with pytest.raises(SystemExit):
            explore.main([name, "--help"])
        assert command.line(name) in capsys.readouterr().out


def test_help_needs_no_library():
    """Neither numba nor matplotlib nor numpy are loaded for it."""
    program = (
        "import sys, json; from cap.explore import __main__ as explore\n"
        "try: explore.main(['sali', '--help'])\n"
        "except SystemExit: print(json.dumps([m for m in ('numba', 'matplotlib', 'numpy', "
        "'flint') if m in sys.modules]))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, check=True, text=True
    )
    assert json.loads(done.stdout.splitlines()[-1]) == []


@pytest.mark.slow
def test_data_need_no_matplotlib(tmp_path):
    """It is loaded where something is drawn."""
    program = (
        "import sys; from cap.explore import __main__ as explore\n"
        f"explore.main(['orbit', '--out', {str(tmp_path / 'a.csv')!r}])\n"
        "print('matplotlib' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, check=True, text=True
    )
    assert done.stdout.splitlines()[-1] == "False"


def test_inventory_hands_over_to_the_prover(capsys):
    """The two orbits at F = 17/20 are proved, the checker accepts them."""
    assert run("inventory", "--F", "17/20", "--prove") == 0
    *_, orbit, family = capsys.readouterr().out.splitlines()
    assert orbit.endswith("proved")
    assert "a family of orbits that touch no wall, not counted" in family


@pytest.mark.slow
def test_certificates_of_an_inventory(tmp_path, capsys):
    """They are of the very parameters typed, and go where they are told; one value once."""
    words = ["--parameter", "F", "--values", "0.85", "17/20", "--certificates", str(tmp_path / "c")]
    assert run("inventory", *words) == 0
    assert capsys.readouterr().out.count("proved") == 2
    files = sorted((tmp_path / "c").iterdir())
    assert [file.name for file in files] == [
        "periodic-F=17_20-x=-0.666836-v=0.567744.json",
        "periodic-F=17_20-x=0.273982-v=0.705495.json",
    ]
    for file in files:
        assert json.loads(file.read_text(encoding="utf-8"))["parameters"]["F"] == "17/20"
        assert verify.main([str(file)]) == 0


@pytest.mark.slow
def test_a_smaller_box_is_claimed_where_the_checker_needs_it():
    """At F = 2 there is an orbit with a tenth of whose largest box it cannot follow."""
    p = replace(PAPER, F=Fraction(2))
    cycle = cycles.near(p, 0.745802068, 0.7214654933)
    entry = inventory._entry(p, 2.0, cycle)
    shown, proved = inventory._proved((p, entry, inventory._start(cycle)))
    assert shown.verdict == inventory.PROVED
    assert proved["parameters"]["F"] == "2"


def test_one_file_that_fails_is_not_all(tmp_path, monkeypatch, capsys):
    """The others are written."""
    monkeypatch.setattr("csv.writer", lambda _: (_ for _ in ()).throw(OSError(28, "No space")))
    files = [tmp_path / name for name in ("a.csv", "b.npz")]
    assert tiny("orbit", *(word for file in files for word in ("--out", str(file)))) == 2
    assert 'a.csv": No space' in capsys.readouterr().err
    assert [each.name for each in tmp_path.iterdir()] == ["b.npz"]


def test_long_tables_are_written_in_pieces(tmp_path, monkeypatch):
    """The rows are the same."""
    files = [tmp_path / f"{k}.csv" for k in range(2)]
    assert tiny("basin", "--out", str(files[0])) == 0
    monkeypatch.setattr(export, "ROWS", 7)
    assert tiny("basin", "--out", str(files[1])) == 0
    assert files[0].read_bytes() == files[1].read_bytes()


def test_pieces_fit_into_memory():
    """Where the state after each of a million periods is kept, few orbits are followed at once."""
    parts = []
    in_pieces(Runner(), 10, parts.append, "test", 250_000)
    assert [(part.start, part.stop) for part in parts] == [(k, k + 2) for k in range(0, 10, 2)]


def test_what_is_not_proved_is_told(monkeypatch, capsys):
    """Then the status is 1."""

    def fails(*_):
        raise NotProved("a step", "for this test")

    monkeypatch.setattr(theorems, "accepted", fails)
    assert run("inventory", "--F", "17/20", "--prove") == 1
    assert "not proved: a step: for this test" in capsys.readouterr().out


def test_an_unknown_suffix_is_no_surprise_after_hours(monkeypatch):
    """It is refused before anything is computed."""
    monkeypatch.setattr(
        "cap.floats.diagnostics.alignment.sali", lambda *_, **__: pytest.fail("computed")
    )
    assert run("sali", "--out", "sali.jpeg") == 2
