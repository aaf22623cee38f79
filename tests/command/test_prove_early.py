"""What makes no sense, or cannot be written, is refused by the prover before it searches."""

import pytest
from support import proving

from cap.proofs import theorems


@pytest.fixture(autouse=True)
def _no_search(monkeypatch):
    """Fail if anything is searched for."""

    def searched(_request):
        pytest.fail("searched before the options were tried")

    monkeypatch.setattr(theorems.Theorem, "search", staticmethod(searched))


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("saddle", "--jobs", "2"), "an option of: attractor on a range of f"),
        (("branch", "--jobs", "0"), "--jobs must be"),
        (("branch", "--jobs", "x"), "--jobs must be"),
        (("branch", "--from", "1/2", "--to", "1/3"), "0 < from < to"),
        (("cascade", "--from", "1/2"), "say for which f: --from Q --to Q, below F"),
        (("attractor", "--to", "1/2"), "say for which f: --from Q --to Q, below F"),
        (("entropies", "--from", "1/2", "--to", "1"), "say for which f: --from Q --to Q, below F"),
        (("mixed", "--undecided", "1"), "--undecided must be less than 1: 1"),
        (("mixed", "--speed", "-1"), "--speed must be positive: -1"),
        (("--jobs", "2", "saddle"), "an option of: attractor on a range of f"),
        (("saddle", "--nothing", "2"), "unrecognized arguments: --nothing 2"),
        (("periodic", "--set", "e=1/2"), "--set goes with --model FILE"),
        (("saddle", "elliptic"), "unrecognized arguments: elliptic"),
        (("saddle", "--from", "1/2"), "an option of: attractor, branch, cascade, entropies"),
        (("saddle", "--journal", "j"), "an option of: attractor on a range of f"),
        (("saddle", "--period", "2"), "an option of: periodic"),
        (("saddle", "--order", "5"), "an option of: elliptic"),
        (("saddle", "--digits", "5"), "--digits must be"),
        (("saddle", "--all", "--out", "a.json"), "one file as --out: name a directory"),
        (("saddle", "--l", "1", "--r", "1." + "0" * 30 + "1"), "at least 1e-30 apart"),
        (("saddle", "--out", "/dev/null"), 'cannot write "/dev/null": Not a directory'),
        (("saddle", "--out", "/dev/null/a/b"), 'cannot write "/dev/null/a/b": Not a directory'),
        (("saddle", "--out", "/dev/null/a.json"), 'cannot write "/dev/null/a.json": Not a dir'),
        (("saddle", "--out", "x" * 300 + ".json"), "File name too long"),
        (
            ("saddle", "--out", "no/a.json"),
            'cannot write "no/a.json": No such file or directory: "no"',
        ),
        (("saddle", "--out", "no/a"), 'cannot write "no/a": No such file or directory: "no"'),
        (("saddle", "--out", "a.txt"), 'cannot write into "a.txt": there is no such directory'),
        (("saddle", "--out", "a.JSON"), "directory; the name of a file ends in .json"),
        (("branch", "--journal", "/dev/null/j"), 'cannot write "/dev/null/j": Not a directory'),
        (("branch", "--journal", "no/j"), 'cannot write "no/j": No such file or directory'),
        (("branch", "--journal", "."), 'cannot write ".": Is a directory'),
    ],
    ids=lambda words: " ".join(words)[:40] if isinstance(words, tuple) else "",
)
def test_refused_at_once(capsys, tmp_path, monkeypatch, words, complaint):
    """One line, status 2, and nothing is written."""
    monkeypatch.chdir(tmp_path)
    status, out, err = proving(capsys, *words)
    assert (status, out) == (2, "")
    assert err.startswith("error: ")
    assert complaint in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_directory_named_like_a_file(capsys, tmp_path):
    """It cannot be replaced."""
    (tmp_path / "a.json").mkdir()
    status, _, err = proving(capsys, "saddle", "--out", str(tmp_path / "a.json"))
    assert status == 2
    assert "Is a directory" in err
