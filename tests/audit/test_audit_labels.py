"""Places are read from TeX with the numbers that LaTeX prints."""

import pytest

from cap.audit import labels
from cap.audit.revision import compared
from cap.errors import BadInput

pytest_plugins = ["audit_fixtures"]
TEX = r"""
\begin{document}
\begin{abstract} words \end{abstract}
\section{One}\label{sec:one}
\begin{equation}\label{eq:a} 1 \end{equation}
\begin{equation*} 1 \end{equation*}
% \begin{theorem}\label{thm:commented} \end{theorem}
\begin{theorem}[Volume of $\Om_{\rm NS}$]\label{thm:b}
\begin{enumerate} \item first \item\label{it} second \end{enumerate}
\end{theorem}
\begin{remark} without a label \end{remark}
\subsection{Part}\label{ssec:part}
\textit{A paragraph.}\label{ssec:paragraph}
\begin{align}
x &= 1 \label{eq:c}\\
y &= 2 \label{eq:d}
\end{align}
\section{Two}
\begin{lemma}\label{lem:e} \begin{equation}\label{eq:f} 1 \end{equation} \end{lemma}
\begin{figure}\caption{A}\label{fig:g}\end{figure}
\begin{table}\caption{B}\label{tab:h}\end{table}
\appendix
\section{Three}\label{app:i}
\begin{proposition}\label{prop:j}\end{proposition}
\end{document}
"""


@pytest.fixture
def paper(tmp_path):
    """Return the file of a small paper."""
    path = tmp_path / "paper.tex"
    path.write_text(TEX)
    return path


def test_places(paper):
    """Kinds, numbers and sections; comments are skipped, unlabelled statements are not."""
    found = [(p.label, p.kind, p.number, p.section) for p in labels.read(paper).places]
    assert found == [
        ("abstract", "abstract", "", "0"),
        ("sec:one", "section", "1", "1"),
        ("eq:a", "equation", "(1.1)", "1"),
        ("thm:b", "theorem", "1.1", "1"),
        ("it", "item", "2", "1"),
        ("remark 1.2", "remark", "1.2", "1"),
        ("ssec:part", "subsection", "1.1", "1"),
        ("ssec:paragraph", "paragraph", "1.1", "1"),
        ("eq:c", "equation", "(1.2)", "1"),
        ("eq:d", "equation", "(1.3)", "1"),
        ("lem:e", "lemma", "2.1", "2"),
        ("eq:f", "equation", "(2.1)", "2"),
        ("fig:g", "figure", "1", "2"),
        ("tab:h", "table", "1", "2"),
        ("app:i", "section", "A", "A"),
        ("prop:j", "proposition", "A.1", "A"),
    ]
    assert labels.read(paper).place("thm:b").title == "Volume of Ω_NS"


def test_what_is_stored_can_be_read(paper, elsewhere):
    """Writing and reading gives the same places."""
    stored = elsewhere("labels.json")
    read = labels.read(paper)
    stored.write_text(labels.dumps(read))
    assert labels.stored() == read
    assert compared(paper) == []
    paper.write_text(TEX.replace("lem:e", "lem:other").replace(r"\section{Two}", ""))
    lines = compared(paper)
    assert "gone: lem:e" in lines
    assert "new: lem:other" in lines
    assert "moved or changed: eq:f" in lines
    assert any("digest" in line for line in lines)


def test_a_file_that_is_not_there(tmp_path):
    """One line."""
    with pytest.raises(BadInput, match="cannot read"):
        compared(tmp_path / "none.tex")


def test_the_stored_places():
    """Those of the paper: 17 figures, one table, an appendix."""
    places = labels.stored().places
    kinds = [place.kind for place in places]
    assert (kinds.count("figure"), kinds.count("table")) == (17, 1)
    assert labels.stored().place("prop:hist-sigma").number == "A.1"
    assert len({place.label for place in places}) == len(places)
