"""Quotations, the erratum, and other versions of the paper; the TeX file itself is not here.

What is tested is made of the pieces that are quoted.  That they are in the paper, each once, and
that every change fits, was found when its places were read: `labels.stored().bound` says of what.
"""

import subprocess
from dataclasses import replace

import pytest

from cap.audit import errata, ledger, revision
from cap.audit.manuscript import Manuscript
from cap.audit.revision import State
from cap.errors import BadInput

TWIST = "birkhoff.value-of-the-twist"
CHANGES = pytest.mark.parametrize("change", errata.changes(), ids=lambda each: each.claims[0])


def state(name, text):
    """Return what became of a claim's sentence in a text."""
    new = Manuscript(text)
    return revision.sentence(name, new, errata.undone(new))[0]


def test_pieces_are_found_however_lines_are_broken():
    """With the line in which they begin."""
    text = Manuscript("one\ntwo three\n  four three\nfour")
    assert text.lines("three four") == [2, 3]
    assert text.count("two three") == 1
    assert text.replaced("three four", r"\3").text == "one\ntwo \\3 \\3"


def test_pieces_are_no_parts_of_words_or_numbers():
    """A digit more, or a sign of a word before, makes another one."""
    text = Manuscript("at -0.42, 0.425, 10.4 and 1.5.2, words; swords 10.4")
    found = [text.count(each) for each in ("-0.42", "0.42", "0.425", "10.4", "1.5", "0.4", "words")]
    assert found == [1, 0, 1, 2, 0, 0, 1]
    assert text.replaced("words", "x").text.endswith("x; swords 10.4")


def test_what_is_not_printed():
    """Comments, what is switched off, and what follows the end; lines stay those of the file."""
    text = Manuscript(
        "a 5\\% b % c\nd \\\\% e\n\\iffalse f\n\\fi g\n"
        "\\begin{comment}\nh\\end{comment}i\n\\end{document}\nj"
    ).printed
    assert text.text.split() == ["a", r"5\%", "b", "d", r"\\", "g", "i", r"\end{document}"]
    assert [text.lines(each) for each in "dgi"] == [[2], [4], [6]]


def test_title_and_author():
    """As they stand in the file."""
    text = Manuscript("\\title{On\n mixed dynamics}\n\\author{A. Author}")
    assert (text.argument("title"), text.argument("author")) == ("On mixed dynamics", "A. Author")
    assert Manuscript("").argument("title") == ""


def test_each_sentence_stands_in_its_own_quotation():
    """Nothing is seen to change where nothing does."""
    for name, piece in ledger.quotes().items():
        assert state(name, piece) is State.STANDS


@CHANGES
def test_a_change_replaces_what_it_is_about(change):
    """Nothing of the old is in the new; made twice it is made once."""
    text = Manuscript("\n\n".join([change.old] * change.times))
    new = text.replaced(change.old, change.new)
    assert new.count(change.old) == 0
    assert new.count(change.new) == change.times


def test_a_patch_is_one_for_git(tmp_path, monkeypatch):
    """It applies to the file, and makes of it what is announced; made twice it is empty."""
    change = errata.of("saltation.wall-entry")[0]
    monkeypatch.setattr(errata, "changes", lambda: (change,))
    path = tmp_path / "paper.tex"
    path.write_text("before\n\\[\n" + change.old + "\n\\]\nafter\n")
    text, done, others = errata.patch(path)
    assert (done, others) == ([], [])
    (tmp_path / "erratum.patch").write_text(text)
    for words in (["apply", "--check", "erratum.patch"], ["apply", "erratum.patch"]):
        subprocess.run(["git", *words], cwd=tmp_path, check=True)  # noqa: S607 (whose git is there)
    assert path.read_text("utf-8") == "before\n\\[\n" + change.new + "\n\\]\nafter\n"
    assert errata.patch(path) == ("", ["saltation.wall-entry"], [])


def test_a_patch_is_one_of_what_is_left(tmp_path, monkeypatch):
    """What is corrected already is told, in whole or in part; so is what fits nowhere."""
    made, part, rewritten = (
        errata.Change((f"a.{old}",), old, old.upper(), times=2) for old in ("one", "two", "three")
    )
    monkeypatch.setattr(errata, "changes", lambda: (made, part, rewritten))
    path = tmp_path / "paper.tex"
    path.write_text("ONE\nTWO\ntwo\nthree\nONE\n")
    text, done, (other,) = errata.patch(path)
    assert done == ["a.one"]
    assert [line for line in text.splitlines()[2:] if line[0] in "+-"] == ["-two", "+TWO"]
    assert "change for a.three does not fit" in other


@pytest.mark.parametrize(
    ("new", "expected"),
    [
        ("-0.42", State.STANDS),
        ("+0.113", State.CORRECTED),  # what is found, rounded
        ("0.1135", State.CORRECTED),
        ("+0.114", State.CHANGED),
        ("-0.113", State.CHANGED),
        ("-0.41", State.CHANGED),
        ("small", State.GONE),
    ],
)
def test_a_number_that_changes(new, expected):
    """It is corrected if it is the one found, in any number of digits; words are gone."""
    text = ledger.quotes()[TWIST].replace("-0.42", new)
    assert state(TWIST, text) is expected


@pytest.mark.parametrize(
    ("name", "old", "new", "expected"),
    [
        (
            "introduction.an-elliptic-orbit-exists",
            "0.4",
            "0.5",
            State.CHANGED,
        ),  # no number that was found
        ("gallery.orbit-at-three", "-0.968", "+0.578", State.CHANGED),  # that of another
        ("gallery.orbit-at-three", "-0.968", "-0.9678", State.CORRECTED),
        ("gallery.orbit-at-three", "-0.968", "-0.9679", State.CHANGED),
        ("roots.value-of-f-sc", "0.34790", "0.348", State.CHANGED),  # fewer digits
        ("wellposed.turns-are-apart", "2", "1", State.CHANGED),  # of a formula
    ],
)
def test_a_number_that_becomes_another(name, old, new, expected):
    """One that was right has to stay it; a number that is found is not any number."""
    piece = ledger.quotes()[name]
    assert old in piece
    assert state(name, piece.replace(old, new)) is expected


def test_the_erratum_is_recognised():
    """All changes of a claim have to be made; what is around a change is changed by it."""
    name = "linearization.impulse-bound-in-f"
    olds, news = ([getattr(each, what) for each in errata.of(name)] for what in ("old", "new"))
    assert state(name, " ".join(news)) is State.CORRECTED
    assert state(name, " ".join([news[0], *olds[1:]])) is State.CHANGED
    around = "fig-hist-cont.f-imp-pi-f-2"
    assert state(around, ledger.quotes()[around].replace(olds[-1], news[-1])) is State.CORRECTED
    assert state(around, news[-1]) is State.GONE
    beside = "linearization.value-of-the-bound"  # its quotation begins inside of a change
    rest = ledger.quotes()[beside].removeprefix(r"$F_{\rm imp} = \pi f / (2\omega)")
    assert state(beside, news[-1] + rest) is State.CORRECTED
    assert state(beside, news[-1] + rest.replace("our", "other")) is State.GONE
    assert state(beside, f"{news[-1]}{rest} {olds[-1]}") is State.GONE
    more = "stops.tangency-times"  # and this has words that no change is about
    (change,) = errata.of(more)
    corrected = ledger.quotes()[more].replace(change.old, change.new)
    assert state(more, corrected) is State.CORRECTED
    assert state(more, corrected.replace("only when", "never when")) is State.CHANGED
    inside = "fig-hist-cont.orbits-at-each-f-but-2"  # and here a change is a part of it
    (change,) = errata.of("gallery.range-of-the-counts")
    corrected = ledger.quotes()[inside].replace(change.old, change.new)
    assert state(inside, corrected) is State.CORRECTED
    assert state(inside, corrected.replace("$3$", "$4$")) is State.CHANGED


def test_what_is_told_of_a_version():
    """What changed, and how many wrong sentences are left, formulas and numbers apart."""
    pieces = dict.fromkeys(ledger.quotes().values())
    text = "\n\n".join(pieces).replace(
        "yields $\\tau_1 \\approx -0.42", "yields $\\tau_1 \\approx 0.1135"
    )
    hidden = ledger.quotes()["roots.value-of-f-sc"]
    text = text.replace(hidden, "\n% ".join(["", *hidden.splitlines()]) + "\n")
    lines = revision.told(Manuscript(text))
    assert any(line.startswith("gone: roots.value-of-f-sc: ") for line in lines)
    assert any(line.startswith(f"corrected: {TWIST}: now 0.1135; found:") for line in lines)
    assert "of them formulas and numbers" in lines[-1]


def test_another_text():
    """It is refused, rather than compared."""
    for text in ("", "\\section{Another paper}"):
        with pytest.raises(BadInput, match="another text"):
            revision.told(Manuscript(text))


def test_a_text_that_other_claims_need(tmp_path, monkeypatch):
    """Its places are not stored if a claim has no place there, or what is new is there already."""
    path = tmp_path / "paper.tex"
    path.write_text("\\section{One}\\label{sec:one} by (c) and by (d)")
    monkeypatch.setattr(ledger, "quotes", dict)
    monkeypatch.setattr(errata, "changes", tuple)
    with pytest.raises(BadInput, match=r"no label in .*: where .*roots\.value-of-f-sc"):
        revision.fitted(path)
    own = replace(ledger.claims()[TWIST], where="sec:one")
    monkeypatch.setattr(ledger, "claims", lambda: {TWIST: own})
    revision.fitted(path)
    change = errata.Change((TWIST,), "by (c)", "by (d)")
    monkeypatch.setattr(errata, "changes", lambda: (change,))
    with pytest.raises(BadInput, match="has elsewhere what is new"):
        revision.fitted(path)
