"""How the commands on turning, sticking, capture and losses fail: one line, and no file."""

from fractions import Fraction

import pytest
from support import proving

from cap.command.progress import Progress
from cap.errors import NotProved
from cap.maps.fixed_point import Start
from cap.parameters import PAPER
from cap.proofs import persistence
from cap.proofs.fixed_point import Setting

ORBIT = ("--orbit", "0.1003", "0.5419")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("persistence", "--epsilon", "1/100", "--e", "99/100"), "--epsilon"),
        (("persistence", "--epsilon", "1"), "restitution"),
        (("persistence", "--epsilon", "2"), "restitution"),
        (("persistence", "--epsilon", "-1/10"), "restitution"),
        (("persistence", "--epsilon", "x"), "not a number"),
        (("persistence", "--period", "2"), "--period"),
        (("periodic", "--period", "0"), "--period"),
        (("periodic", "--period", "17"), "--period"),
        (("periodic", "--period", "x"), "--period"),
        (("periodic", "--period", "-1"), "--period"),
        (("periodic", "--period", "1.5"), "--period"),
        (("periodic", "--period", ""), "--period"),
        (("elliptic", "--period", "2"), "--period"),
        (("capture", "--period", "2"), "--period"),
        (("periodic", "--order", "5"), "--order"),
        (("capture", "--order", "5"), "--order"),
        (("saddle", "--order", "5"), "--order"),
        (("periodic", "--e", "0"), "restitution"),
        (("periodic", "--e", "2"), "restitution"),
        (("periodic", "--e", "-1/2"), "restitution"),
        (("periodic", "--mu", "-1"), "viscosity"),
        (("capture", "--mu", "-1/3"), "viscosity"),
        (("periodic", "--f", "1"), "below the forcing"),
        (("capture", "--f", "2"), "below the forcing"),
        (("periodic", "--orbit", "1", "0.5"), "wall"),
        (("periodic", "--orbit", "-3", "0.5"), "wall"),
        (("capture", "--orbit", "1", "0"), "wall"),
        (("capture", "--orbit", "7", "0"), "wall"),
        (("periodic", "--orbit", "0", "0"), ""),
        (("periodic", "--orbit", "0", "1e20"), ""),
        (("periodic", "--orbit", "0"), ""),
        (("elliptic", "--e", "9/10", *ORBIT), "elastic walls"),
        (("saddle", "--mu", "1/10"), "elastic walls"),
        (("elliptic", "--epsilon", "1/10"), "elastic walls"),
        (("capture", "--orbit", "0.1003", "0.5419"), "not captured"),
        (("persistence", "--e", "1/3", "--mu", "1/2"), "cannot be continued from epsilon"),
        (("persistence", "--epsilon", "1/3", "--mu", "1/2"), "beyond epsilon = 0.2"),
        (("persistence", "--epsilon", "0", "--mu", "0"), "`elliptic`"),
        (("persistence",), "`elliptic`"),
        (("persistence", "--epsilon", "1/9", "--orbit", "0.3435", "0.7753"), "no elliptic orbit"),
        (("periodic", "--all", "--orbit", "0.4", "-0.6"), "--all"),
        (("periodic", "--digits", "5"), "--digits"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_bad_input(capsys, tmp_path, monkeypatch, words, complaint):
    """One line that says what is wrong, status 2, and nothing written."""
    monkeypatch.chdir(tmp_path)
    status, _, err = proving(capsys, *words)
    assert status == 2
    assert complaint in err
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_not_proved_is_said(capsys, tmp_path):
    """An orbit at rest in the middle of nothing is captured nowhere near; no file is written."""
    words = ("capture", "--f", "0", "--out", str(tmp_path))  # the ratio of the speeds is e = 1
    status, _, err = proving(capsys, *words)
    assert status == 1
    assert "NOT PROVED" in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("losses", "reason"),
    [
        (("1/20", "1/20"), "the family is proved for epsilon <= "),
        (("1/12", "1/12"), "followed back to epsilon = mu = 0"),
    ],
)
def test_how_far_the_family_reaches_is_said(capsys, tmp_path, monkeypatch, losses, reason):
    """Where no single cell will do: as far as they go, or that the orbit is another one."""
    monkeypatch.setattr("cap.proofs.persistence._most_cells", lambda *_: 6)
    epsilon, mu = losses
    words = ("persistence", "--epsilon", epsilon, "--mu", mu, "--digits", "8")
    status, _, err = proving(capsys, *words, "--out", str(tmp_path))
    assert status == 1
    assert "Lemma 5" in err
    assert reason in err
    assert list(tmp_path.iterdir()) == []


def test_how_far_the_family_reaches_is_not_rounded(monkeypatch):
    """0.0106250009 is said, not 0.01063, up to which nothing was proved."""

    def refuse(*_):
        raise NotProved("Lemma 5", "no single cell will do")

    monkeypatch.setattr(persistence._Builder, "_begin", refuse)
    monkeypatch.setattr(persistence._Builder, "_begin_small", lambda *_: None)
    monkeypatch.setattr(persistence._Builder, "grow", lambda *_: None)
    monkeypatch.setattr(persistence, "_most_cells", lambda *_: 150)
    reached = Fraction("0.0106250009"), Fraction("0.00093750001")
    grid = persistence.Grid(tuple([Fraction(0), node] for node in reached))
    setting = Setting(PAPER, Start(0.1, 0.5, ()), 8)
    with pytest.raises(NotProved, match=r"epsilon <= 0.0106250009, mu <= 0.00093750001 only"):
        persistence._Builder(setting, grid, setting.start, Fraction(1)).reach(
            (Fraction(1, 20),) * 2
        )


def test_the_progress_line_is_cleared(capsys, tmp_path, monkeypatch):
    """Nothing is printed onto what a search or a proof has told of its progress."""
    told = []
    monkeypatch.setattr(Progress, "tell", lambda _, words, *__: told.append(words))
    monkeypatch.setattr(Progress, "clear", lambda _: told.append(""))
    words = ("periodic", "--F", "3/2", "--digits", "8", "--out", str(tmp_path))
    assert proving(capsys, *words)[0] == 0
    assert told[0].startswith("searching: ")
    assert "" in told[:-1]
    assert told[-1] == ""
