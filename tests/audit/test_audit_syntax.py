"""The syntax of TeX files: what is right passes, each fault is named; the erratum makes none."""

import re

import pytest

from cap.audit import errata, labels
from cap.audit.manuscript import faults
from cap.errors import BadInput

RIGHT = r"""\begin{proof}
Let $a = \{b \mid c\}$ cost \$5 \% % }
\[ x \\[2pt] \text{if $y$} \] by~\eqref{eq:one}, \verb|}$|.
\begin{equation}\label{eq:one} $$ \end{equation}
\end{proof}
""".replace("$$ ", "")
WRONG = [
    ("\\{b", "{b", "line 2: a $ inside of mathematics"),
    ("c\\}$", "c\\}", "line 3: a $ inside"),
    ("\\end{equation}", "\\end{align}", "line 4: \\end{align} closes nothing that is open"),
    ("\\end{proof}", "", "line 1: proof is not closed"),
    ("\\] by", "by", "closes nothing"),
    ("\\text{if $y$}", "\\text{if $y}", "closes nothing"),
    ("\\label{eq:one}", "\\label{eq:two}", "there is no label eq:one"),
    ("Let", "Let \\label{eq:one}", "eq:one is a label 2 times"),
    ("\\eqref{eq:one}", "\\ref{eq:one,eq:three}", "there is no label eq:three"),
    ("\\[ x", "$ \\[ x", "line 3: a $ inside of mathematics"),
]


def test_a_file_without_faults():
    """Comments, escaped signs, line breaks with an argument, words inside of formulas."""
    assert faults(RIGHT) == []
    assert faults("") == []


@pytest.mark.parametrize(("old", "new", "words"), WRONG)
def test_faults_are_named(old, new, words):
    """One is enough."""
    wrong = RIGHT.replace(old, new)
    assert wrong != RIGHT
    assert any(words in each for each in faults(wrong)), faults(wrong)


def test_a_patch_makes_no_fault(tmp_path, monkeypatch):
    """A brace too many is told; a fault that was there is not the erratum's."""
    path = tmp_path / "paper.tex"
    path.write_text("one $x$\n\n{two\n")
    for new, fault in (("$y$", False), ("$y", True), ("$y$ \\ref{eq:none}", True)):
        change = errata.Change(("saltation.wall-entry",), "$x$", new)
        monkeypatch.setattr(errata, "changes", lambda change=change: (change,))
        if fault:
            with pytest.raises(BadInput, match="would be no TeX"):
                errata.patch(path)
        else:
            assert "+one $y$" in errata.patch(path)[0]


def kept(piece):
    """Return what a change has to keep: how much is opened, less what is closed, in a piece."""
    plain = re.sub(r"\\\\[\\{}$%]", "", piece)
    pairs = ("{", "}"), ("\\begin{", "\\end{"), ("\\[", "\\]"), ("\\bigl", "\\bigr")
    return [plain.count(a) - plain.count(b) for a, b in pairs], plain.count("$") % 2


def test_each_change_keeps_what_is_open():
    """And its references have a label in the paper, and no label is dropped."""
    known = {place.label for place in labels.stored().places}
    for each in errata.changes():
        assert kept(each.old) == kept(each.new), each.old
        assert set(re.findall(r"ref\{([^{}]*)\}", each.new)) <= known
        assert re.findall(r"\\label\{[^{}]*\}", each.old) == re.findall(
            r"\\label\{[^{}]*\}", each.new
        )
