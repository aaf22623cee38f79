"""``cap.verify --formal``: what is said of what Coq answers, with a script in the place of Coq."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from cap import verify
from cap.command import formal
from cap.formal import coq

ROOT = Path(__file__).parents[2]
ELLIPTIC = str(ROOT / "certificates/elliptic.json")
SADDLE = str(ROOT / "certificates/saddle.json")
PERIODIC = str(ROOT / "certificates/periodic-1.json")
AXIOMS = """Axioms:
ClassicalDedekindReals.sig_not_dec : forall P : Prop, {~ ~ P} + {~ P}
ClassicalDedekindReals.sig_forall_dec
  : forall P : nat -> Prop,
    (forall n : nat, {P n} + {~ P n}) ->
    {n : nat | ~ P n} + {forall n : nat, P n}
FunctionalExtensionality.functional_extensionality_dep
  : forall (A : Type) (B : A -> Type) (f g : forall x : A, B x),
    (forall x : A, f x = g x) -> f = g
Classical_Prop.classic : forall P : Prop, P \\/ ~ P
"""
PROBE = 'grep -q "Theorem\\|Eval" Certified.v || exit 0'  # whether Coq finds its libraries
ACCEPTS = f"{PROBE}\ncat <<'END'\n{AXIOMS}END"
FAILS = f"""{PROBE}
grep -q Theorem Certified.v && echo 'File "./Certified.v", line 7: Error: no.' && exit 1
echo '     = trace_claim :: twist_claim :: nil'; echo '     : list test'
"""


FORMALLY = """import runpy, sys
from cap import proofs
proofs.__file__ = sys.argv.pop(1)
sys.argv.insert(1, "--formal")
runpy.run_module("cap.verify", run_name="__main__")
"""  # cap.verify --formal, with another library
COMPILES = """for source in *.v; do  # which are not compiled yet, and then tells which
    [ "$1" = -n ] || [ -e "${source}o" ] || { cp "$source" "${source}o"; echo "$source" >> told; }
done"""


@pytest.fixture
def home(tmp_path, monkeypatch):
    """Return the directory of a library that is small, so that no test changes ours."""
    place = tmp_path / "proofs/formal"
    place.mkdir(parents=True)
    for name in ("Statement.v", "Checked.v"):
        (place / name).write_text(f"{name}, the first\n")
    monkeypatch.setattr(coq.proofs, "__file__", str(place.with_name("__init__.py")))
    return place


@pytest.fixture
def installed(home, tmp_path, monkeypatch):
    """Return a function that puts scripts in the place of coqc and make."""

    def put(coqc, make="exit 0"):
        for name, script in {"coqc": coqc, "coqdep": "exit 0", "make": make}.items():
            (tmp_path / name).write_text(f"#!/bin/sh\n{script}\n")
            (tmp_path / name).chmod(0o755)
        monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")

    return put


def formally(capsys, *names):
    """Return (status, standard output, standard error) of the command."""
    status = verify.main(["--formal", *names])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_a_theorem_is_printed_with_the_axioms_that_coq_prints(installed, capsys):
    """PROVED BY COQ, the theorem, the file, and the axioms word by word; exit status 0."""
    installed(ACCEPTS)
    status, out, _ = formally(capsys, SADDLE, ELLIPTIC)
    assert status == 0
    assert out.startswith("PROVED BY COQ: x'' = F cos(omega t)")
    assert f'("{SADDLE}")\n' in out
    assert f'("{ELLIPTIC}")\n' in out
    assert out.endswith(AXIOMS.removeprefix("Axioms:\n"))


@pytest.mark.parametrize(
    "answer",
    [
        f"{ACCEPTS}\necho 'Statement.wishful : 0 = 1'",
        f"{PROBE}\necho Closed under the global context",
        f"{PROBE}\n",
    ],
)
def test_other_axioms_or_none_prove_nothing(installed, capsys, answer):
    """An axiom that is not of the classical reals, or no list of axioms, is no proof."""
    installed(answer)
    status, out, _ = formally(capsys, ELLIPTIC)
    assert status == 1
    assert out.startswith(f'NOT PROVED BY COQ: "{ELLIPTIC}"')
    assert "axioms" in out


def test_what_fails_is_named(installed, capsys):
    """If Coq refuses, the tests of Check.v that fail are asked for and printed."""
    installed(FAILS)
    status, out, _ = formally(capsys, ELLIPTIC)
    assert status == 1
    assert out.startswith("NOT PROVED BY COQ")
    assert "trace_claim :: twist_claim" in out


def test_the_end_of_coqs_words_is_printed_if_no_test_fails(installed, capsys):
    """If it is not the tests that fail, Coq's own complaint is printed, in the same line."""
    installed(f"{PROBE}\ngrep -q Theorem Certified.v || exit 0\necho Error: Illegal.; exit 1")
    status, out, _ = formally(capsys, ELLIPTIC)
    assert (status, out.count("\n")) == (1, 1)
    assert "Error: Illegal." in out


def test_other_certificates_and_bad_files_are_not_proved(installed, capsys, tmp_path):
    """A periodic orbit with losses, no certificate, no file: one line each, the larger status."""
    installed(ACCEPTS)
    (tmp_path / "bad.json").write_text("{}")
    status, out, _ = formally(capsys, PERIODIC, str(tmp_path / "bad.json"))
    assert status == 1
    assert [line.split(":")[0] for line in out.splitlines()] == ["NOT PROVED BY COQ"] * 2
    status, out, _ = formally(capsys, str(tmp_path / "none"), PERIODIC)
    assert status == 2
    read, proved = out.splitlines()
    assert read.startswith("CANNOT READ: ")
    assert proved.startswith("NOT PROVED BY COQ: ")


@pytest.mark.parametrize("other", ["--explain", "--latex"])
def test_what_the_checker_prints_is_not_asked_of_coq(capsys, other):
    """Options of the checker's words are refused in one line, exit status 2."""
    with pytest.raises(SystemExit, match="2"):
        verify.main(["--formal", other, ELLIPTIC])
    assert capsys.readouterr().err.startswith("error: --formal goes with neither")


@pytest.mark.parametrize(("coqc", "what"), [(None, "coqc and coqdep"), ("exit 1", "libraries")])
def test_without_coq_one_line_says_how_to_get_it(
    installed, capsys, tmp_path, monkeypatch, coqc, what
):
    """No Coq, or Coq without its libraries: one line with the packages, exit status 2."""
    if coqc is None:
        (tmp_path / "make").symlink_to("/bin/true")
        monkeypatch.setenv("PATH", str(tmp_path))
    else:
        installed(coqc)
    status, out, err = formally(capsys, ELLIPTIC)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert what in err
    assert coq.FROM_DEBIAN in err


def test_a_library_that_does_not_compile_is_an_error(installed, capsys):
    """Then nothing can be said of a certificate: exit status 2, and what Coq said."""
    installed(ACCEPTS, make="echo coqc Motion.v; echo Error: in Motion.v; exit 2")
    status, out, err = formally(capsys, ELLIPTIC)
    assert (status, out) == (2, "")
    assert "Error: in Motion.v" in err


def test_a_library_that_cannot_be_written_is_copied(home, installed, monkeypatch):
    """Where files cannot be written, the library is compiled elsewhere, and gone afterwards."""
    installed(ACCEPTS)
    monkeypatch.setattr(os, "access", lambda *_: False)
    with coq.library(lambda *_: None) as place:
        assert place != home
        assert (place / "Statement.v").exists()
    assert not place.exists()


def test_what_was_compiled_of_other_sources_is_compiled_again(home, installed):
    """Make goes by the times of files; a source may be older than what another one became."""
    installed(ACCEPTS, make=COMPILES)

    def compiled():
        (home / "told").write_text("")
        with coq.library(lambda *_: None):
            return (home / "told").read_text("utf-8").split()

    assert compiled() == ["Checked.v", "Statement.v"]
    assert compiled() == []
    (home / "Statement.v").write_text("Statement.v, the second\n")
    os.utime(home / "Statement.v", (0, 0))
    assert compiled() == ["Statement.v"]
    (home / "Checked.vo").write_text("of unknown origin")
    assert compiled() == ["Checked.v"]
    (home / ".compiled").unlink()
    assert compiled() == ["Checked.v", "Statement.v"]


@pytest.mark.slow
def test_memory_and_time_are_limited(tmp_path, monkeypatch):
    """A program that asks for more memory, or more time, than it may have ends."""
    monkeypatch.setattr(coq, "MEMORY", 1 << 28)
    monkeypatch.setattr(coq, "SECONDS", 1)
    greedy = coq.run([sys.executable, "-c", "b'x' * (1 << 29)"], tmp_path)
    assert greedy.status
    assert "MemoryError" in greedy.text
    endless = coq.run([sys.executable, "-c", "while True: pass"], tmp_path)
    assert endless.status == -signal.SIGXCPU
    assert coq.last_words(endless) == "over 1 s"


def test_ctrl_c_ends_coq_too(installed, home, tmp_path):
    """At an interrupt the status is 130, there is one line, and Coq is no longer running."""
    installed(f"{PROBE}\necho $$ > {tmp_path}/pid\nexec sleep 60")
    command = [sys.executable, "-c", FORMALLY, str(home.with_name("__init__.py")), ELLIPTIC]
    with subprocess.Popen(command, cwd=ROOT, stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 30
        while not (tmp_path / "pid").exists() or not (tmp_path / "pid").read_text("utf-8").strip():
            assert time.monotonic() < deadline
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        assert process.wait(30) == 130
        assert process.stderr.read() == "interrupted; nothing half-written\n"
    pid = int((tmp_path / "pid").read_text("utf-8"))
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


def test_the_coq_file_is_written_to_standard_output(capsys):
    """``python -m cap.formal`` prints the file; of another theorem one line says why not."""
    assert formal.write([ELLIPTIC]) == 0
    assert "theorem : Prop := elliptic_orbit 1 1 (2 / 5) (-1) 1" in capsys.readouterr().out
    assert formal.write([PERIODIC]) == 2
    assert capsys.readouterr().err.count("\n") == 1
