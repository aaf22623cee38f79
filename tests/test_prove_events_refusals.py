"""How the commands on turning, sticking, capture and losses fail: one line, and no file."""

import pytest

from cap import prove


def run(capsys, *words):
    """Return (status, standard output, standard error) of one command."""
    try:
        status = prove.main(words)
    except SystemExit as stop:
        status = stop.code
    captured = capsys.readouterr()
    return status, captured.out, captured.err


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
        (("persistence", "--e", "1/3", "--mu", "1/2"), "orbit"),
        (("persistence", "--orbit", "0.3435", "0.7753"), "no elliptic orbit"),
        (("periodic", "--all", "--orbit", "0.4", "-0.6"), "--all"),
        (("periodic", "--digits", "5"), "--digits"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_bad_input(capsys, tmp_path, monkeypatch, words, complaint):
    """One line that says what is wrong, status 2, and nothing written."""
    monkeypatch.chdir(tmp_path)
    status, _, err = run(capsys, *words)
    assert status == 2
    assert complaint in err
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_not_proved_is_said(capsys, tmp_path):
    """An orbit at rest in the middle of nothing is captured nowhere near; no file is written."""
    words = ("capture", "--f", "0", "--out", str(tmp_path))  # the ratio of the speeds is e = 1
    status, _, err = run(capsys, *words)
    assert status == 1
    assert "NOT PROVED" in err
    assert list(tmp_path.iterdir()) == []
