"""The command line of the prover: what it prints, where it writes, how it fails."""

import json
import os
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest
from checker.altered import schema, schema_of
from support import proving, smallest_first

from cap.certificate.writer import dumps
from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check
from cap.command.own_refusals import LISTED
from cap.floats import candidates
from cap.floats.search.periodic import Guess
from cap.proofs import symbolic, theorems

ROOT = Path(__file__).parents[2]


def test_elliptic_proves_writes_and_says_so(capsys, tmp_path):
    """The paper's theorem: exit 0, its numbers on the page, a certificate that verifies."""
    status, out, _ = proving(capsys, "elliptic", "--out", str(tmp_path))
    path = tmp_path / "elliptic.json"
    assert status == 0
    for text in (
        "Theorem (elliptic)",
        "0.1002798898441967281",
        "0.113477977036708",
        "Moser",
        str(path),
    ):
        assert text in out
    check(path.read_bytes(), lambda _step: None)


COMMANDS = dict(
    line.split(maxsplit=1)
    for line in (ROOT / "certificates/COMMANDS").read_text("utf-8").splitlines()
)
# to prove them takes the better part of a minute, or minutes; their provers have tests of their own
LONG = {"conservative", "mixed", "cascade-1", "entropies-1", "window-2", "persistence"}
LONG |= {
    "ball_curve",
    "ball_curve-2",
    "horseshoe-1",
    "horseshoe-3",
    "converse",
    "converse-2",
    "island",
    "island-2",
    "islands",
    "map_curve",
    "contact_basin-1",
    "contact_horseshoe-1",
    "contact_horseshoe-2",
    "map_horseshoe-1",
    "map_horseshoe-2",
    "map_horseshoe-3",
}  # and what they find depends on rounding in floats

LARGE = 20_000  # bytes: to try all theorems on a long file takes seconds

# seconds each, and with tests of their own, too, or one more of a theorem
SLOW = {
    "attractor",
    "capture-2",
    "contact_attractor-1",
    "contact_capture-2",
    "contact_capture-4",
    "branch",
    "branch-2",
    "contact_elliptic-2",
    "contacts-2",
    "contacts-3",
    "contacts_branch-2",
    "effective_stability",
    "elliptic-2",
    "horseshoe-2",
    "map_horseshoe-3",
}
SLOW |= {
    "inventory",
    "particles-2",
    "particles_limits",
    "particles_sink",
    "saddle-2",
    "symmetric-2",
}
SLOW |= {"window-1", *(f"periodic-{n}" for n in range(1, 14) if n != 11)}
REPRODUCED = [
    pytest.param(name, marks=[pytest.mark.slow] * (name.removesuffix(".json") in SLOW))
    for name in sorted(set(COMMANDS) - {f"{name}.json" for name in LONG})
]


def test_a_command_is_known_for_every_stored_certificate():
    """``certificates/COMMANDS`` names the files that are there."""
    assert sorted(COMMANDS) == sorted(p.name for p in (ROOT / "certificates").glob("*.json"))


@pytest.mark.parametrize("name", REPRODUCED)
def test_every_stored_certificate_is_reproduced(name, capsys, tmp_path, monkeypatch):
    """Its command gives it again, byte for byte but for its provenance.

    The checker is not asked about the same bytes again: `.ci/run` verifies all stored certificates.
    """
    stored = json.loads((ROOT / "certificates" / name).read_text("utf-8"))
    known = dumps({**stored, "provenance": {}})
    monkeypatch.setattr(theorems, "check", lambda *a: None if a[0] == known.encode() else check(*a))
    assert proving(capsys, *COMMANDS[name].split(), "--out", str(tmp_path / name))[0] == 0
    new = json.loads((tmp_path / name).read_text("utf-8"))
    assert dumps({**new, "provenance": {}}) == known


def test_a_second_run_leaves_the_file_alone(capsys, tmp_path):
    """It would be the same, so nothing is written."""
    proving(capsys, "saddle", "--out", str(tmp_path))
    before = (tmp_path / "saddle.json").read_bytes()
    _, out, _ = proving(capsys, "saddle", "--out", str(tmp_path))
    assert "unchanged" in out
    assert (tmp_path / "saddle.json").read_bytes() == before


@pytest.mark.parametrize(
    "words", ["elliptic", pytest.param("periodic --F 3", marks=pytest.mark.slow)]
)
def test_two_proofs_give_the_same_bytes(words, tmp_path):
    """Nothing of the run is in a certificate: not the time, nor an order that differs by chance."""
    for seed in "12":
        out = ["--out", str(tmp_path / f"{seed}.json")]
        subprocess.run(
            [sys.executable, "-m", "cap.prove", *words.split(), *out],
            check=True,
            capture_output=True,
            cwd=ROOT,
            env={**os.environ, "PYTHONHASHSEED": seed},
        )
    assert (tmp_path / "1.json").read_bytes() == (tmp_path / "2.json").read_bytes()


@pytest.mark.parametrize("path", smallest_first((ROOT / "certificates").glob("*.json")))
def test_certificates_satisfy_the_schema(path):
    """The JSON Schema describes every stored certificate; of small ones what it refuses is seen."""
    good = json.loads(path.read_text("utf-8"))
    schema_of(good["theorem"]).validate(good)
    if path.stat().st_size > LARGE:
        return
    schema().validate(good)
    for bad in ({**good, "extra": "1"}, {**good, "digits": 30}, {**good, "claims": {}}):
        assert not schema().is_valid(bad)


@pytest.mark.parametrize(
    "words",
    [
        ("--f", "9/20"),
        ("--f", "1/2"),
        ("--f", "0.6"),
        ("--F", "2", "--omega", "3", "--f", "0.8", "--l", "-2/9", "--r", "2/9"),
        ("--l", "-7/3", "--r", "-1/3"),
        ("--digits", "12"),
        ("--digits", "80"),
        ("--order", "7"),
        ("--orbit", "0.56", "1.07"),
        ("--F", "1000000", "--f", "400000", "--l", "-1e6", "--r", "1e6"),
        ("--F", "1/1000000", "--f", "4e-7", "--l", "-1e-6", "--r", "1e-6"),
    ],
    ids=" ".join,
)
def test_other_parameters(capsys, tmp_path, words):
    """The theorem at other parameters, digits, orders and orbits."""
    status, out, err = proving(capsys, "elliptic", *words, "--out", str(tmp_path))
    assert (status, err) == (0, "")
    assert "accepts" in out


def test_large_multipliers(capsys, tmp_path):
    """The checker's determinant is too wide for the first guard digits, and not for the next."""
    words = "--F", "1.3", "--f", "3/10", "--r", "3/2", "--digits", "10", "--out", str(tmp_path)
    status, out, err = proving(capsys, "saddle", *words)
    assert (status, err) == (0, "")
    assert "accepts" in out


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("elliptic", "--f", "-1/10"), "friction must not be negative"),
        (("elliptic", "--f", "1"), "below the forcing"),
        (("elliptic", "--f", "nan"), "not a number"),
        (("elliptic", "--f", "1/0"), "denominator is zero"),
        (("elliptic", "--F", "1e400"), "out of range"),
        (("elliptic", "--F", "1" + 400 * "0"), "not a number"),
        (("elliptic", "--F", "0"), "forcing must be positive"),
        (("elliptic", "--omega", "0"), "frequency must be positive"),
        (("elliptic", "--omega", "-1"), "frequency must be positive"),
        (("elliptic", "--l", "1"), "left wall"),
        (("elliptic", "--l", "2"), "left wall"),
        (("elliptic", "--orbit", "2", "1"), "wall"),
        (("elliptic", "--orbit", "0", "0"), "v"),
        (("elliptic", "--orbit", "inf", "1"), "not a number"),
        (("elliptic", "--orbit", "0.3435", "0.7753"), "no elliptic orbit"),
        (("saddle", "--orbit", "0.1", "0.54"), "no saddle orbit"),
        (("elliptic", "--f", "7/10"), "no elliptic non-sticking"),
        (("elliptic", "--digits", "3"), "--digits"),
        (("elliptic", "--digits", "-5"), "--digits"),
        (("elliptic", "--digits", "10000000"), "--digits"),
        (("elliptic", "--order", "4"), "must be one of"),
        (("theorem",), 'there is no theorem "theorem"'),
        ((), "say what to prove"),
        (("elliptic", "--unknown"), "unrecognized"),
    ],
    ids=lambda value: " ".join(value)[:40] if isinstance(value, tuple) else "",
)
def test_bad_input(capsys, tmp_path, monkeypatch, words, complaint):
    """Nonsense ends in exit 2, with a line that says what is wrong, and nothing written."""
    monkeypatch.chdir(tmp_path)
    status, _, err = proving(capsys, *words)
    assert status == 2
    assert complaint in err
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("out", ["/dev/null/x", "/proc/none", "/dev/full/x.json"])
def test_unwritable_output(capsys, out):
    """A place that cannot be written is bad input."""
    status, _, err = proving(capsys, "saddle", "--out", out)
    assert status == 2
    assert "cannot write" in err


def test_not_proved_is_exit_one_and_names_the_step(capsys, tmp_path, monkeypatch):
    """A guess with wrong hit times: the step that fails and its sets are printed."""
    wrong = Guess(0.1003, 0.5419, ((0.5, 1.0), (3.5, -1.0)), ((-0.46, -1.0), (1.0, 0.0)), 0.09)
    monkeypatch.setattr(candidates.periodic, "orbits", lambda *_: [wrong])
    status, _, err = proving(capsys, "elliptic", "--out", str(tmp_path))
    assert status == 1
    assert "NOT PROVED" in err
    assert list(tmp_path.iterdir()) == []


def test_a_rejected_certificate_is_not_written(capsys, tmp_path, monkeypatch):
    """If the checker does not accept what the prover made, nothing is claimed."""

    def reject(_data, _step, _jobs, _tell):
        raise Rejected("for the test")

    monkeypatch.setattr(theorems, "check", reject)
    status, out, err = proving(capsys, "saddle", "--out", str(tmp_path))
    assert status == 1
    assert "for the test" in err
    assert "Theorem" not in out
    assert list(tmp_path.iterdir()) == []


def test_interrupt_leaves_nothing(capsys, tmp_path, monkeypatch):
    """Ctrl-C while proving: exit 130, no file."""

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(theorems, "accepted", interrupted)
    status, _, err = proving(capsys, "saddle", "--out", str(tmp_path))
    assert status == 130
    assert "interrupted" in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "spoil",
    [
        lambda text: text.replace('"digits": "30"', '"digits": "999", "digits": "30"'),
        lambda text: re.sub(r'"provenance": \{.*?\}', '"provenance": null', text, flags=re.DOTALL),
        lambda _: "[" * 300000 + "]" * 300000,
        lambda _: "",
        lambda text: text[:-100],
    ],
    ids=["duplicate key", "no provenance", "nested", "empty", "truncated"],
)
def test_a_file_that_the_checker_rejects_is_not_kept(capsys, tmp_path, spoil):
    """Only a certificate that verifies is left alone as unchanged."""
    path = tmp_path / "c.json"
    proving(capsys, "saddle", "--out", str(path))
    path.write_text(spoil(path.read_text("utf-8")))
    status, out, _ = proving(capsys, "saddle", "--out", str(path))
    assert status == 0
    assert "unchanged" not in out
    check(path.read_bytes(), lambda _step: None)


@pytest.mark.parametrize(("length", "omega"), [("1e12", "1"), ("1e-12", "1e12"), ("1e10", "1e-5")])
def test_other_units(capsys, tmp_path, length, omega):
    """The paper's system in other units of length and time: the same twist, in those units."""
    scale, w = Fraction(length), Fraction(omega)
    force = scale * w * w
    words = ["--F", str(force), "--f", str(force * Fraction(2, 5)), "--omega", str(w)]
    path = tmp_path / "one.json"
    words += ["--l", str(-scale), "--r", str(scale), "--out", str(path), "--order", "3"]
    assert proving(capsys, "elliptic", *words)[0] == 0
    lower, upper = json.loads(path.read_text("utf-8"))["claims"]["twist"]
    unit = scale**2 * w
    assert Fraction(lower) * unit < Fraction("0.113477977036708622736396099064")
    assert Fraction(upper) * unit > Fraction("0.113477977036708622736396099063")


@pytest.mark.parametrize(
    "walls",
    [
        ("1000", "1002"),
        pytest.param(("1000000", "1000002"), marks=pytest.mark.slow),
        pytest.param(("-7/3", "-1/3"), marks=pytest.mark.slow),
    ],
)
def test_walls_far_away(capsys, tmp_path, walls):
    """Shifted walls change nothing but x."""
    words = ("--l", walls[0], "--r", walls[1], "--all", "--out", str(tmp_path))
    assert proving(capsys, "elliptic", *words)[0] == 0
    assert len(list(tmp_path.iterdir())) == 2


def test_output_that_cannot_be_encoded(tmp_path):
    """Paths beyond the terminal's encoding are escaped."""
    command = [sys.executable, "-m", "cap.prove", "saddle", "--out", str(tmp_path / "é")]
    env = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(command, capture_output=True, env=env, check=False, cwd=ROOT)
    assert done.returncode == 0
    assert b"\\xe9" in done.stdout


def test_a_second_argument_for_all(capsys, tmp_path):
    """`--all` with one orbit or one file makes no sense."""
    for words in (("--orbit", "0.1", "0.5"), ("--out", str(tmp_path / "one.json"))):
        status, _, err = proving(capsys, "elliptic", "--all", *words)
        assert (status, err.count("\n")) == (2, 1)


def test_list_names_every_theorem(capsys):
    """`--list` says what can be proved, each theorem once, in groups, in columns that fit."""
    status, out, _ = proving(capsys, "--list")
    assert status == 0
    lines, yours = (part.splitlines() for part in out.split("a system or a map of your own"))
    assert [line.rpartition("  ")[0].strip() for line in yours[1:]] == list(LISTED)
    assert max(map(len, yours)) <= 110
    own = [line for line in lines if line.startswith("  ")]
    assert sorted(line.split()[0] for line in own) == sorted([*theorems.THEOREMS, *symbolic.NAMES])
    assert [line for line in lines if line not in own] == [
        f"{g}:" for g in theorems.GROUPS.values()
    ]
    (column,) = {re.match(r"  \w+ +", line).end() for line in own}
    assert all(line[column - 1] == " " != line[column] for line in own)
    assert max(map(len, lines)) <= 110
