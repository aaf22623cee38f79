"""The options that some theorems take: these say so, the help and complaints repeat it."""

from dataclasses import fields

import pytest

from cap.command.prover_options import Asked
from cap.command.prover_parser import OF_SOME, parser, takers
from cap.errors import BadInput
from cap.proofs.fixed_point import Setting
from cap.proofs.theorems import THEOREMS

ELSEWHERE = {"period", "jobs", "journal"}  # of the request, and of the runner
SENSIBLE = {"order": "5", "journal": "journal"}


def test_theorems_take_options_that_there_are():
    """What a theorem names is declared; what is declared some theorem takes, and a setting has."""
    taken = {option for theorem in THEOREMS.values() for option in theorem.options}
    assert taken == set(OF_SOME)
    assert taken - ELSEWHERE <= {field.name for field in fields(Setting)}


def test_takers():
    """Where a range of f is asked for, it is the theorem on the range that takes the option."""
    assert {"attractor on a range of f", "branch"} <= set(takers("journal"))
    assert takers("undecided") == ["mixed"]


def test_the_help_names_them():
    """Also if it is asked for twice."""
    shown = parser()
    for _ in range(2):
        words = " ".join(shown.format_help().split())
        assert "--order N elliptic: odd order" in words
        assert "--from Q attractor, branch, cascade, entropies: for f from" in words
        assert "--masses M1,M2 particles, particles_limits," in words


@pytest.mark.parametrize("name", sorted(OF_SOME))
def test_each_is_refused_elsewhere(name, tmp_path, monkeypatch):
    """A theorem that does not take it refuses it, and one that does gets its value."""
    monkeypatch.chdir(tmp_path)
    given = [f"--{name}", SENSIBLE.get(name, "3")]
    with pytest.raises(BadInput, match=f"^--{name} is an option of: .*{takers(name)[-1]}$"):
        Asked.of(parser().parse_args(["saddle", *given]), print)
    taker = next(theorem for theorem in takers(name) if " " not in theorem)
    asked = Asked.of(parser().parse_args([taker, *given]), print)
    found = asked.more.get(name) or getattr(asked, name, asked.request.periods)
    assert str(found) == given[1]
