"""The report in LaTeX, for an editor to print: pdflatex, standard packages only."""

import re
import unicodedata

from cap.audit.report.view import INTRODUCTION, Entry, Report, identity, title

_SPECIAL = {
    **{sign: f"\\{sign}" for sign in "&%$#_{}"},
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"$<$",
    ">": r"$>$",
    "|": r"\textbar{}",
    '"': r"\textquotedbl{}",
    "`": r"\textasciigrave{}",
    "−": "$-$",
    "…": r"\dots{}",
    "“": r"\textquotedblleft{}",
    "”": r"\textquotedblright{}",
}
_LETTERS = (
    ("αβγδεζηθκλμ", "alpha beta gamma delta varepsilon zeta eta theta kappa lambda mu"),
    ("νξπρστφχψω", "nu xi pi rho sigma tau varphi chi psi omega"),
    ("ΓΔΘΛΠΣΦΨΩℓ", "Gamma Delta Theta Lambda Pi Sigma Phi Psi Omega ell"),
    ("∂∫∮∞∧∪±∓·×≡≈♯‖", "partial int oint infty wedge cup pm mp cdot times equiv approx sharp Vert"),
    ("∘√", "circ surd"),
)
_COMMANDS = {
    sign: name for signs, names in _LETTERS for sign, name in zip(signs, names.split(), strict=True)
}
_MARKS = {"\u0303": r"\tilde", "\u0304": r"\bar", "\u0302": r"\hat", "\u0308": r"\""}
_PLACES = {"<super>": "textsuperscript", "<sub>": "textsubscript"}
_BREAK = r"\1\\allowbreak{}"
_CLUSTER = re.compile("(.)([\u0300-\u036f]*)", re.DOTALL)


def latex(report: Report) -> str:
    """Return a document."""
    lines = [
        r"\documentclass[10pt]{article}",
        r"\usepackage[T1]{fontenc}\usepackage[utf8]{inputenc}\usepackage{textcomp}",
        r"\usepackage[a4paper,margin=18mm]{geometry}\usepackage{amssymb,graphicx,longtable,multicol}",
        r"\usepackage[hidelinks]{hyperref}\sloppy\setlength{\parindent}{0pt}",
        r"\setlength{\parskip}{4pt plus 2pt}",
        rf"\title{{{written(title())}}}\date{{}}\begin{{document}}\maketitle",
    ]
    for line in identity():
        lines += [_broken(line), ""]
    if report.whole:
        for paragraph in INTRODUCTION:
            lines += [written(paragraph), ""]
        lines += [*_counts(report), *_findings(report), *_statements(report)]
    lines.append(r"\begin{multicols}{2}\raggedright\footnotesize")
    for section in report.sections():
        lines.append(rf"\section*{{{written(section.heading)}}}")
        for entry in section.entries:
            lines += _entry(entry)
    return "\n".join([*lines, r"\end{multicols}", r"\end{document}", ""])


def written(text: str) -> str:
    """Return text for LaTeX; `ValueError` names a sign for which there is no way to write it."""
    clusters = _CLUSTER.finditer(unicodedata.normalize("NFD", text))
    signs = "".join(_marked(_sign(each[1]), each[2]) for each in clusters)
    return signs.replace("--", "-{}-")  # no dash


def _marked(letter: str, marks: str) -> str:
    """Return a letter with the marks that are above it."""
    for mark in marks:
        accent = _MARKS[mark]
        letter = (
            f"{accent}{{{letter}}}" if mark == "\u0308" else rf"\ensuremath{{{accent}{{{letter}}}}}"
        )
    return letter


def _sign(sign: str) -> str:
    if sign in _SPECIAL:
        return _SPECIAL[sign]
    if " " <= sign <= "~":
        return sign
    if sign in _COMMANDS:
        return rf"\ensuremath{{\{_COMMANDS[sign]}}}"
    place, _, code = unicodedata.decomposition(sign).partition(" ")
    if place not in _PLACES:
        raise ValueError(f"no way to write {sign!r} in LaTeX ({unicodedata.name(sign, '?')})")
    return rf"\{_PLACES[place]}{{{_sign(chr(int(code, 16)))}}}"


def _counts(report: Report) -> list[str]:
    outcomes = [str(each) for each in report.outcomes()]
    heads = " & ".join(rf"\rotatebox{{90}}{{{each}}}" for each in outcomes)
    lines = [
        r"\section*{Summary}",
        rf"\begin{{longtable}}{{p{{0.5\textwidth}}{'r' * len(outcomes)}}}",
    ]
    lines.append(rf"& {heads} \\ \hline")
    for name, row in report.counts():
        lines.append(rf"{written(name)} & {' & '.join(map(str, row))} \\")
    return [*lines, r"\end{longtable}", ""]


def _findings(report: Report) -> list[str]:
    lines = [r"\section*{The findings}", "The ten first matter most.", r"\begin{enumerate}"]
    for found in report.findings():
        head, change = (written(each) for each in (found.finding.title, found.finding.change))
        lines.append(rf"\item \textbf{{{head}}} ({found.finding.severity}). {written(found.words)}")
        lines.append(rf"\emph{{To change:}} {change} {written(found.where)}.")
    return [*lines, r"\end{enumerate}", ""]


def _statements(report: Report) -> list[str]:
    lines = [r"\section*{The statements, and what may be cited instead}"]
    lines.append(r"\begin{longtable}{p{0.28\textwidth}p{0.17\textwidth}p{0.47\textwidth}}")
    lines.append(r"statement & status & what may be cited instead \\ \hline\endhead")
    for statement, status in report.statements():
        cells = map(written, (statement.name, status, statement.instead))
        lines.append(rf"{' & '.join(cells)} \\[3pt]")
    return [*lines, r"\end{longtable}", ""]


def _entry(entry: Entry) -> list[str]:
    claim, verdict = entry.claim, entry.verdict
    head = rf"{_typed(claim.id)}: \emph{{{verdict.outcome}}} ({verdict.strength})"
    typed = {"text": lambda words: _broken(words, r"\texttt"), "proof": _typed}
    parts = {k: typed.get(k, written)(words) for k, words in entry.parts().items()}
    parts.pop("certificate", None)  # a command names it
    parts["run"] = "; ".join(map(_typed, entry.commands))
    lines = [rf"\bigskip\textbf{{{head}}}", f"{written(f'{entry.where}. {claim.says}')}"]
    lines += [rf"\textit{{{name.capitalize()}.}} {words}" for name, words in parts.items()]
    return [each for line in lines for each in (line, "")]


def _typed(text: str) -> str:
    """Return what is to be typed, which may be broken after its signs."""
    return rf"\texttt{{{re.sub(r'([-/.])', _BREAK, written(text))}}}"


def _broken(text: str, command: str = "") -> str:
    """Return text that may be broken after each sixth sign of a long word."""
    parts = (re.findall(".{1,6}", word) for word in text.split())
    words = " ".join(r"\allowbreak{}".join(map(written, each)) for each in parts)
    return f"{command}{{{words}}}" if command else words
