"""The options that some theorems take: these declare them, the help and complaints repeat it."""

import subprocess
import sys

import pytest

from cap.command.prover_options import Asked
from cap.command.prover_parser import options_of, parser, read
from cap.errors import BadInput
from cap.option import Option, count
from cap.proofs import conservative, saddle
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS, takers

EVERY = options_of(THEOREMS)
SENSIBLE = {
    "degree": "6",
    "order": "5",
    "from": "1/3",
    "to": "2/5",
    "undecided": "1/2",
    "masses": "1,9/10",
    "proportional": None,
    "largest": None,
    "rotation": "[0;3,(1)]",
    "sets": "any",
}


def test_one_name_is_one_option():
    """Theorems that take an option of the same name take the same, so the command line is one."""
    declared = {option for theorem in THEOREMS.values() for option in theorem.options}
    assert sorted(option.name for option in declared) == sorted(EVERY)
    assert sorted({option.keyword for option in declared}) == sorted(
        option.keyword for option in EVERY.values()
    )


def test_takers():
    """Where a range of f is asked for, it is the theorem on the range that takes the option."""
    assert {"attractor on a range of f", "branch"} <= set(takers("journal"))
    assert takers("undecided") == ["mixed"]
    assert takers("from") == ["attractor", "branch", "cascade", "entropies", "islands"]


def test_the_help_names_them():
    """Also if it is asked for twice."""
    shown = parser()
    for _ in range(2):
        words = " ".join(shown.format_help().split())
        assert "--order N elliptic: odd order" in words
        assert "--from Q attractor, branch, cascade, entropies, islands: for f from" in words
        assert "--masses M1,M2 particles, particles_limits," in words


@pytest.mark.parametrize("name", THEOREMS)
def test_the_help_of_a_theorem(name, capsys):
    """It has the options that the theorem takes, and no others."""
    with pytest.raises(SystemExit):
        read([name, "--help"])
    shown = capsys.readouterr().out
    assert " ".join(THEOREMS[name].summary.split()) in " ".join(shown.split())
    own = {option for option in EVERY if f" --{option} " in shown.replace("\n", " ")}
    assert own == set(options_of([name]))


def test_a_new_option_is_declared_once(monkeypatch):
    """A theorem that declares one is asked for it, helped with it, and given its value."""
    patience = Option("patience", count(1, 9), "so long (default 3)", "N", default=3, about=True)
    monkeypatch.setattr(saddle, "OPTIONS", (patience,), raising=False)
    shown = " ".join(parser("saddle").format_help().split())
    assert "--patience N so long (default 3)" in shown
    assert "--patience N saddle: so long" in " ".join(parser().format_help().split())
    for words, value, name in (
        ([], 3, "saddle.json"),
        (["--patience", "7"], 7, "saddle-patience=7.json"),
    ):
        asked = Asked.of(read(["saddle", *words, "--out", "no-such-directory"]), print)
        assert Setting(None, None, 9, options=asked.request.options).of(patience) == value
        (found,) = THEOREMS["saddle"].search(asked.request).candidates[:1]
        assert asked.path(found).name == name
    with pytest.raises(BadInput, match=r"^--patience must be an integer from 1 to 9: '10'$"):
        Asked.of(read(["saddle", "--patience", "10"]), print)
    with pytest.raises(BadInput, match=r"^--patience is an option of: saddle$"):
        Asked.of(read(["elliptic", "--patience", "1"]), print)


@pytest.mark.parametrize("name", sorted(EVERY))
def test_each_is_refused_elsewhere(name, tmp_path, monkeypatch):
    """A theorem that does not take it refuses it, and one that does reads its value."""
    monkeypatch.chdir(tmp_path)
    word = SENSIBLE.get(name, "3")
    given = [f"--{name}"] if word is None else [f"--{name}", word]
    with pytest.raises(BadInput, match=f"^--{name} is an option of: .*{takers(name)[-1]}$"):
        Asked.of(read(["saddle", *given]), print)
    taker = next(theorem for theorem in takers(name) if " " not in theorem)
    options = read([taker, *given])
    assert options.own == {name: [] if word is None else word}
    if word is not None:
        value = EVERY[name].read(word)
        assert str(value) in (word, "(Fraction(1, 1), Fraction(9, 10))")


@pytest.mark.parametrize(
    "words",
    [
        ("--flights", "3", "conservative"),
        ("conservative", "--flights", "3"),
        ("--out", "saddle", "conservative", "--flights", "3"),
        ("--F", "1", "--flights=3", "conservative"),
    ],
)
def test_in_any_order(words):
    """The theorem may come first or last, and a file may have the name of another."""
    asked = Asked.of(read(words), print)
    assert asked.request.kind == "conservative"
    assert asked.request.options == {"flights": 3}
    assert Setting(None, None, 9, options=asked.request.options).of(conservative.FLIGHTS) == 3


def test_only_the_theorem_named_is_loaded():
    """The others take time."""
    code = """
import sys
from cap.command.prover_parser import read
read(["elliptic", "--order", "5", "--digits", "8"])
print(*[name for name in sys.modules if name.startswith("cap.proofs.")])
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = {name.removeprefix("cap.proofs.") for name in run.stdout.split()}
    assert loaded & set(THEOREMS) == {"elliptic"}
