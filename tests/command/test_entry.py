"""How commands end when stopped, unread or unwritable: one line and a status, no traceback."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from cap.command import entry
from cap.command.verifier import parser

ROOT = Path(__file__).parents[2]
SADDLE = str(ROOT / "certificates/saddle.json")
SIGNALS = [
    (signal.SIGINT, "interrupted"),
    (signal.SIGTERM, "terminated"),
    (signal.SIGHUP, "hung up"),
]
SLOW = """
import sys, time
{early}
def main(words):
    {late}
"""


@pytest.fixture
def module(tmp_path, monkeypatch):
    """Return a function that writes a module of a command, and its environment."""

    def written(late="return 0", early=""):
        (tmp_path / "slow_command.py").write_text(SLOW.format(early=early, late=late))
        return {**os.environ, "PYTHONPATH": f"{ROOT}:{tmp_path}"}

    return written


def started(env, **pipes):
    """Start a process that runs the module through `entry`."""
    code = "from cap.command import entry; entry.leave(entry.run('slow_command:main', ['a']))"
    given = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | pipes
    return subprocess.Popen([sys.executable, "-c", code], env=env, **given)


def stopped(process, number):
    """Signal a process when it has said that it is ready; return its status and complaint."""
    assert process.stdout.readline() == b"ready\n"
    process.send_signal(number)
    _, complaint = process.communicate(timeout=30)
    return process.returncode, complaint.decode()


@pytest.mark.parametrize(("number", "word"), SIGNALS)
@pytest.mark.parametrize("when", ["early", "late"])
def test_a_signal_is_a_line_and_a_status(module, number, word, when):
    """While modules load, and while the command runs."""
    wait = "print('ready', flush=True); time.sleep(60)"
    env = module(**{when: wait})
    assert stopped(started(env), number) == (128 + number, f"{word}; nothing half-written\n")


def test_a_second_signal_ends_what_the_first_does_not(module):
    """Ctrl-C again, while the command tidies up for a minute."""
    wait = "try: print('ready', flush=True); time.sleep(60)\n    finally: time.sleep(60)"
    process = started(module(late=wait))
    assert process.stdout.readline() == b"ready\n"
    for _ in range(2):
        process.send_signal(signal.SIGINT)
        time.sleep(0.5)
    _, complaint = process.communicate(timeout=30)
    assert (process.returncode, complaint) == (130, b"interrupted; nothing half-written\n")


def test_an_interrupt_that_is_lost_comes_again(module):
    """In a finalizer nothing can be raised: Python would only say that it ignores it."""
    early = (
        "class Last:\n    def __del__(self):\n        print('ready', flush=True); time.sleep(60)"
    )
    late = "last = Last(); del last\n    for _ in range(600): time.sleep(0.1)"
    env = module(late=late, early=early)
    process = started(env)
    assert stopped(process, signal.SIGINT) == (130, "interrupted; nothing half-written\n")


def test_what_a_command_keeps_has_the_status_of_the_signal(module):
    """A command that hears an interrupt and goes on returns 130; after SIGTERM that is 143."""
    keep = (
        "try: print('ready', flush=True); time.sleep(60)\n    except KeyboardInterrupt: return 130"
    )
    for number, _ in SIGNALS:
        assert stopped(started(module(late=keep)), number) == (128 + number, "")


def test_signals_that_are_ignored_stay_ignored(module):
    """As ``nohup`` asks for."""
    env = module(late="print('ready', flush=True); time.sleep(1); print('done'); return 0")
    code = "import signal; signal.signal(signal.SIGHUP, signal.SIG_IGN); "
    code += "from cap.command import entry; entry.leave(entry.run('slow_command:main', []))"
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    process = subprocess.Popen([sys.executable, "-c", code], env=env, **pipes)
    assert process.stdout.readline() == b"ready\n"
    process.send_signal(signal.SIGHUP)
    out, _ = process.communicate(timeout=30)
    assert (process.returncode, out) == (0, b"done\n")


def test_handlers_are_given_back():
    """After the command, and after one that fails."""
    before = [signal.getsignal(number) for number, _ in SIGNALS]
    with pytest.raises(SystemExit):
        entry.run("cap.command.verifier:main", [])
    with pytest.raises(ModuleNotFoundError):
        entry.run("cap.no_such_module:main", [])
    assert [signal.getsignal(number) for number, _ in SIGNALS] == before


@pytest.mark.parametrize(
    ("late", "status", "line"),
    [
        ("raise MemoryError", 2, "error: not enough memory: ask for less\n"),
        ("raise PermissionError(13, 'no')", 2, "error: the system refused: no\n"),
        ("raise BrokenPipeError", 141, ""),
        (
            "import no_such_library.part",
            2,
            "error: the library no_such_library is missing: install cap, say by pip install -e .\n",
        ),
        ("sys.exit(2)", 2, ""),
        ("raise KeyboardInterrupt", 130, "interrupted; nothing half-written\n"),
    ],
)
def test_what_goes_wrong_around_a_command(module, late, status, line):
    """Memory, the system, a reader that has gone."""
    done = started(module(late=late))
    _, complaint = done.communicate(timeout=30)
    assert (done.returncode, complaint.decode()) == (status, line)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("prove", ["--list"]),
        ("prove", ["--help"]),
        ("prove", ["saddle"]),
        ("verify", [SADDLE]),
        ("verify", ["--help"]),
        ("explore", ["--help"]),
    ],
)
def test_a_reader_that_has_gone(name, words, tmp_path):
    """``| head -0``: status 141, and not a word."""
    assert unread(name, words, tmp_path) == (141, b"")


def test_a_reader_that_leaves_before_the_theorem(tmp_path):
    """``| head -1``: what was proved is written all the same."""
    command = [sys.executable, "-m", "cap.prove", "saddle", "--digits", "8"]
    env = {**os.environ, "PYTHONPATH": str(ROOT)}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, cwd=tmp_path, env=env, **pipes) as process:
        assert process.stdout.readline().startswith(b"Found ")
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 141
    assert [path.name for path in (tmp_path / "certificates").iterdir()] == ["saddle.json"]


def unread(name, words, folder):
    """Run a command whose output is closed; return its status and its complaint."""
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-m", f"cap.{name}", *words]
    env = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        command, stdout=writing, stderr=subprocess.PIPE, check=False, cwd=folder, env=env
    )
    os.close(writing)
    return done.returncode, done.stderr


@pytest.mark.parametrize("closed", ["stdout", "stderr", "both"])
def test_closed_streams(closed, tmp_path):
    """``>&-``, ``2>&-``: the verdict's status stands, and nothing else is printed."""
    redirect = {"stdout": ">&-", "stderr": "2>&-", "both": ">&- 2>&-"}[closed]
    (tmp_path / "empty").touch()
    for file, status in ((SADDLE, 0), (tmp_path / "empty", 1), (tmp_path / "none", 2)):
        line = f"{sys.executable} -m cap.verify {file} {redirect}"
        done = subprocess.run(line, shell=True, check=False, capture_output=True, cwd=ROOT)  # noqa: S602
        assert done.returncode == status
        assert done.stderr == b""


def test_help_names_what_is_proved_once():
    """The theorems of which the README says that they, or parts, are proved by one code alone."""
    told = parser().format_help()
    for name in ("conservative", "contact_attractor", "mixed", "horseshoes", "particles_stability"):
        assert name in told


@pytest.mark.parametrize("words", [[SADDLE], ["--help"]])
@pytest.mark.parametrize("buffered", ["", "1"])
def test_a_full_disk(monkeypatch, words, buffered):
    """An output that cannot be written is a line and the status 2, at the first line or later."""
    monkeypatch.setenv("PYTHONUNBUFFERED", buffered)
    with Path("/dev/full").open("w") as full:
        command = [sys.executable, "-m", "cap.verify", *words]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, check=False, cwd=ROOT)
    assert done.returncode == 2
    assert done.stderr == b"error: output cannot be written: No space left on device\n"


def test_without_a_home(monkeypatch):
    """Libraries are told a home where nothing can be kept, as `~` would be a directory's name."""
    monkeypatch.setenv("HOME", "~")
    assert entry.run("cap.command.verifier:main", ["nothing.json"]) == 2
    assert os.environ["HOME"] == os.devnull
    monkeypatch.setenv("HOME", "/somewhere")
    entry.run("cap.command.verifier:main", ["nothing.json"])
    assert os.environ["HOME"] == "/somewhere"
