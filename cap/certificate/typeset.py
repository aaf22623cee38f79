r"""A theorem as a page or a paper shows it: HTML with TeX between \( and \), and LaTeX.

What is shown are the checker's own words and the numbers of the certificate, to all digits: those
that both ends of an enclosure have in common, and the others of both, 0.1027[1..2].
"""

import html
import re
from collections.abc import Iterator, Mapping
from typing import Any

from cap.certificate.table import rows
from cap.checker.kernel.theorem import Certificate
from cap.checker.theorems import load
from cap.checker.verdict import words
from cap.words import digits

MODEL = r"\ddot x = F\cos\omega t - f\,\mathrm{sgn}\,\dot x - \mu\dot x,\quad l < x < r"
NAMES = {"omega": r"\omega", "mu": r"\mu", "e": "e", "F": "F", "f": "f", "l": "l", "r": "r"}
ENCLOSURE = re.compile(r"\[(-?\d+\.\d+), (-?\d+\.\d+)\]")
SPECIAL = {c: f"\\{c}" for c in "&%$#_{}"} | {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
}
Row = tuple[str, str, str]


def page(c: Certificate, stored: Mapping[str, Any]) -> str:
    """Return a verified certificate as HTML; ``stored`` is what is in its file."""
    system, clauses = _parts(c)
    said = "".join(f"<li>{html.escape(_short(clause))}</li>" for clause in clauses)
    numbers = "".join(
        f"<tr><td>{html.escape(label)}</td><td>{_inline(symbol)}</td>"
        f"<td><code>{html.escape(number)}</code></td></tr>"
        for label, symbol, number in _numbers(c, stored["claims"])
    )
    cited = "".join(
        f"<li>{html.escape(each['theorem'])} ({html.escape(each['reference'])})</li>"
        for each in stored["cites"]
    )
    return (
        f"<div><p><b>Theorem ({html.escape(c.theorem)}).</b> VERIFIED by the checker.</p>"
        f"{_system(stored['parameters'])}<p>{html.escape(_short(system))}:</p><ul>{said}</ul>"
        f"<table>{numbers}</table>"
        + (f"<p>Cited, each hypothesis discharged by a claim:</p><ul>{cited}</ul>" if cited else "")
        + "</div>"
    )


def paper(c: Certificate, stored: Mapping[str, Any]) -> str:
    """Return the numbers of a verified certificate as a LaTeX array, and its sentence."""
    lines = [
        rf"\text{{{_text(label)}}} & {symbol} & {number} \\"
        for label, symbol, number in _numbers(c, stored["claims"])
    ]
    table = "\n".join([r"\begin{array}{lll}", *lines, r"\end{array}"])
    sentence = _text(_short(words(c)))
    return f"\\textbf{{Theorem ({_text(c.theorem)}).}} {sentence}.\n\n$$\n{table}\n$$"


def _parts(c: Certificate) -> tuple[str, list[str]]:
    """Return the system that a theorem is about, and its clauses."""
    first, *others = words(c).split("; ")
    system, _, begin = first.partition(": ")
    return system, [part for part in (begin, *others) if part]


def _numbers(c: Certificate, claims: dict[str, Any]) -> Iterator[Row]:
    """Give a label, a symbol where the claim is one number, and the enclosure, of each claim."""
    for field in load(c.theorem).CLAIMS:
        found = rows((field,), claims)
        for label, (lower, upper) in found:
            yield label, field.symbol if len(found) == 1 else "", digits(lower, upper)


def _system(parameters: Mapping[str, Any]) -> str:
    """Return the model with its parameters as a formula, if it is that of one mass."""
    if not {"F", "omega", "l", "r"} <= parameters.keys() <= NAMES.keys():
        return ""
    values = r",\ ".join(f"{NAMES[name]} = {value}" for name, value in parameters.items())
    model = MODEL if "mu" in parameters else MODEL.replace(r" - \mu\dot x", "")
    return f"<p>{_inline(model)}</p><p>{_inline(values)}</p>"


def _short(sentence: str) -> str:
    """Return a sentence with its enclosures in short."""
    return ENCLOSURE.sub(lambda found: digits(*found.groups()), sentence)


def _inline(formula: str) -> str:
    safe = html.escape(formula.replace("<", r"\lt ").replace(">", r"\gt "))
    return rf"\({safe}\)" if formula else ""


def _text(words: str) -> str:
    """Return words as LaTeX sets them."""
    return "".join(SPECIAL.get(c, c) for c in words)
