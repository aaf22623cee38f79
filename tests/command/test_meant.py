"""Words that are nearly right: what was meant is guessed."""

import pytest

from cap import prove, verify
from cap.explore import __main__ as explore


@pytest.mark.parametrize(
    ("main", "words", "guess"),
    [
        (prove.main, ["ellptic"], 'there is no theorem "ellptic": did you mean elliptic'),
        (explore.main, ["portait"], "did you mean portrait"),
        (explore.main, ["--paper", "fig:covr"], "did you mean fig:cover"),
        (verify.main, ["--reading", "ellptic"], "did you mean elliptic"),
    ],
    ids=lambda words: " ".join(words) if isinstance(words, list) else "",
)
def test_meant(main, words, guess, capsys):
    """Status 2, one line with the guess."""
    try:
        status = main(words)
    except SystemExit as stop:
        status = stop.code
    out, err = capsys.readouterr()
    assert (status, out) == (2, "")
    assert guess in err
    assert err.count("\n") == 1


def test_nothing_like_it(capsys):
    """All names are given."""
    assert prove.main(["zzz"]) == 2
    assert "one of attractor, branch," in capsys.readouterr().err
