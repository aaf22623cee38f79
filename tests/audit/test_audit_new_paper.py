"""A paper whose audit begins: two files, then its places, then its verdicts."""

import pytest

from cap.audit import command, labels, subject
from cap.audit.papers import FIRST

pytest_plugins = ["audit_fixtures"]

TEX = r"""\documentclass{article}
\begin{document}
\title{A hit}
\author{N. N.}
\section{Energy}\label{sec:energy}
\begin{equation}\label{eq:energy}
E = m v^2/2
\end{equation}
\begin{theorem}\label{thm:loss}
At a hit the energy $(1-e) E$ is lost.
\end{theorem}
\end{document}
"""
PAPER = 'groups = ["energy"]\n\n[none]\n"sec:energy" = "a heading"\n'
CLAIMS = r"""
[[claim]]
id = "energy.of-a-mass"
where = "eq:energy"
kind = "formula"
says = "The energy of a mass m of the speed v."
stated = "m v²/2"
quote = "E = m v^2/2"
positive = "m v"
verdict = "formula"
found = "m v²/2"
evidence = "the integral of m v"
steps = '''
derived = integrate(m*v, v)
printed = m*v**2/2
'''

[[claim]]
id = "energy.lost"
where = "thm:loss"
kind = "statement"
says = "What is lost at a hit."
stated = "(1-e) E"
quote = "the energy $(1-e) E$ is lost"
positive = "m v e"
verdict = "formula"
found = "(1 - e²) E"
evidence = "the energies before and after"
steps = '''
derived = m*v**2/2 - m*(e*v)**2/2
printed = (1 - e)*m*v**2/2
'''
"""


@pytest.fixture
def tex(tmp_path, monkeypatch):
    """Begin the audit of a paper; return its TeX file."""
    folder = tmp_path / "papers" / "mine"
    (folder / "claims").mkdir(parents=True)
    (folder / "paper.toml").write_text(PAPER, "utf-8")
    (folder / "claims" / "energy.toml").write_text(CLAIMS, "utf-8")
    (tmp_path / "mine.tex").write_text(TEX, "utf-8")
    with monkeypatch.context() as patch:
        patch.setattr(subject, "FOLDER", tmp_path / "papers")
        yield tmp_path / "mine.tex"
    subject.choose(FIRST)


def audit(*words):
    """Run the command; return its status."""
    return command.main(["--of", "mine", *map(str, words)])


def test_from_two_files_to_a_report(tex, capsys):
    """Places are read, claims decided, verdicts recorded; all other files may come later."""
    assert audit("--paper", tex, "--record") == 0
    assert [place.label for place in labels.stored().places] == [
        "sec:energy", "eq:energy", "thm:loss"
    ]  # fmt: skip
    assert audit("--coverage") == 0
    assert audit() == 1  # nothing is recorded yet
    assert audit("--record") == 0
    capsys.readouterr()
    assert audit() == 0
    told = capsys.readouterr().out
    assert "energy.of-a-mass: confirmed (proved)" in told
    assert "energy.lost: corrected (proved)" in told
    for words in (["--summary"], ["--erratum"], ["--bibtex"], ["--paper", tex]):
        assert audit(*words) == 0
    assert "A hit" in capsys.readouterr().out


def test_places_come_first(tex, capsys):
    """Without them nothing can be said of claims: a line says how they are stored."""
    for words in ([], ["--coverage"], ["--summary"], ["--patch", tex]):
        assert audit(*words) == 2
        assert "--paper FILE.tex --record" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('quote = "E = m v^2/2"\n', "", "claim energy.of-a-mass has no quote"),
        ('kind = "formula"', 'kind = "formulae"', "the kind is none of statement, step of a proof"),
        ('kind = "formula"', "kind = formula", "energy.toml: "),
        ('"eq:energy"', '"eq:energi"', "is taken from 'eq:energi', which is no place"),
    ],
)
def test_mistakes_in_claims(tex, capsys, old, new, said):
    """Each is a line with the file or the claim."""
    assert audit("--paper", tex, "--record") == 0
    path = subject.file("claims/energy.toml")
    path.write_text(CLAIMS.replace(old, new, 1), "utf-8")
    subject.forget()
    capsys.readouterr()
    assert audit() == 2
    error = capsys.readouterr().err
    assert error.startswith("error: ")
    assert said in error
    assert error.count("\n") == 1


def test_a_symbol_that_is_not_declared(tex, capsys):
    """A slip of the pen decides nothing: it was a symbol of its own, and the formula wrong."""
    assert audit("--paper", tex, "--record") == 0
    path = subject.file("claims/energy.toml")
    path.write_text(CLAIMS.replace("integrate(m*v, v)", "integrate(m*w, w)"), "utf-8")
    subject.forget()
    capsys.readouterr()
    assert audit() == 1
    told = capsys.readouterr()
    assert "energy.of-a-mass could not be decided" in told.out + told.err
    assert "name 'w' is not defined" in told.out + told.err


def test_a_group_without_claims(tex, capsys):
    """Its file is named."""
    (tex.parent / "papers" / "mine" / "claims" / "energy.toml").unlink()
    assert audit("--paper", tex, "--record") == 2
    assert "the group 'energy' of paper.toml has no file" in capsys.readouterr().err
