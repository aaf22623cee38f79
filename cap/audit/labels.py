"""The places of the paper that claims are taken from: its labels, read from the TeX file.

Every label of a section, a statement, an equation, an item, a table or a figure is a place, and so
is every statement without a label, called by its kind and number (``remark 5.2``), and the
abstract.  Numbers are those that LaTeX prints.  The list is stored in ``labels.json``.
"""

import hashlib
import json
import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path

from cap.audit import subject
from cap.audit.manuscript import Manuscript
from cap.audit.subject import cached

_STATEMENTS = (
    *("theorem", "lemma", "proposition", "corollary", "definition", "remark", "conjecture"),
)
_EQUATIONS = ("equation", "align")
_FLOATS = ("figure", "table")
_TOKEN = re.compile(
    r"\\(?P<section>section|subsection)\{(?P<name>(?:[^{}]|\{[^{}]*\})*)\}"
    r"|\\begin\{(?P<begin>\w+\*?)\}(?:\[(?P<title>(?:[^][]|\[[^]]*\])*)\])?"
    r"|\\end\{(?P<end>\w+\*?)\}|\\label\{(?P<label>[^}]*)\}|(?P<appendix>\\appendix\b)"
    r"|(?P<item>\\item\b)"
)
_CITED = re.compile(r"\\cite\w*\*?(?:\[[^]]*\])*\{([^}]*)\}")
_REFERENCES = re.compile(r"\\bibitem|\\bibliography\{|\\addbibresource")
_PICTURES = re.compile(r"\\includegraphics(?:\[[^]]*\])?\{\s*\}")


@dataclass(frozen=True)
class Place:
    """A place: its label, its kind, number and section as printed, its title, its line."""

    label: str
    kind: str
    number: str
    section: str
    title: str
    line: int


@dataclass(frozen=True)
class Paper:
    """The places of the paper in its order, and a digest of the file they were read from.

    ``lines``: those of `cap.audit.quotes`, by the claims.  Counted in the file are the works that
    are cited, the entries or files of a bibliography, and the pictures without a file.  ``bound``
    is a digest of the quotations and the erratum that were found to fit the file.
    """

    sha256: str
    places: tuple[Place, ...]
    title: str = ""
    author: str = ""
    cited: int = 0
    references: int = 0
    pictures: int = 0
    bound: str = ""
    lines: dict[str, int] = field(default_factory=dict)

    def place(self, label: str) -> Place:
        """Return the place with this label; `KeyError` if there is none."""
        return self._by_label[label]

    @property
    def _by_label(self) -> dict[str, Place]:
        return {place.label: place for place in self.places}


@dataclass
class _Reader:
    """Where the reading has come to: counters, and the environments that are open."""

    section: int = 0
    subsection: int = 0
    appendix: bool = False
    statement: int = 0
    equation: int = 0
    floats: dict[str, int] = field(default_factory=lambda: dict.fromkeys(_FLOATS, 0))
    items: int = 0
    open: list[tuple[str, str, int, bool]] = field(default_factory=list)
    at_heading: str = ""
    last_title: str = ""

    @property
    def number(self) -> str:
        return chr(ord("A") + self.section - 1) if self.appendix else str(self.section)


def read(path: Path) -> Paper:
    """Return the places of a TeX file."""
    manuscript = Manuscript.read(path)
    text = re.sub(r"(?<!\\)%.*", "", manuscript.text)
    return Paper(
        hashlib.sha256(manuscript.text.encode()).hexdigest(),
        tuple(_places(text)),
        manuscript.title,
        manuscript.author,
        len({key for keys in _CITED.findall(text) for key in keys.split(",")}),
        len(_REFERENCES.findall(text)),
        len(_PICTURES.findall(text)),
    )


def _places(text: str) -> Iterator[Place]:
    r = _Reader()
    for token in _TOKEN.finditer(text):
        line = text.count("\n", 0, token.start()) + 1
        if token["section"]:
            _heading(r, token["section"], token["name"])
        elif token["appendix"]:
            r.appendix, r.section = True, 0
        elif token["begin"]:
            _begin(r, token["begin"], token["title"] or "")
            if token["begin"] == "abstract":
                yield Place("abstract", "abstract", "", "0", "Abstract", line)
        elif token["item"]:
            r.items += 1
        elif token["end"]:
            yield from _end(r, line)
        else:
            yield _labelled(r, token["label"], line)


def _heading(r: _Reader, level: str, name: str) -> None:
    r.at_heading, r.last_title = level, _plain(name)
    if level == "section":
        r.section, r.subsection = r.section + 1, 0
        r.statement = r.equation = 0
    else:
        r.subsection += 1


def _begin(r: _Reader, name: str, title: str) -> None:
    if name == "document":
        return
    r.at_heading = ""
    if name in _STATEMENTS:
        r.statement += 1
    elif name == "equation":
        r.equation += 1
    elif name in _FLOATS:
        r.floats[name] += 1
    elif name == "enumerate":
        r.items = 0
    r.open.append((name, title, r.statement, False))


def _end(r: _Reader, line: int) -> Iterator[Place]:
    """Close an environment; a statement without a label is a place of its own name."""
    if not r.open:
        return
    opened, title, number, labelled = r.open.pop()
    if opened in _STATEMENTS and not labelled:
        printed = f"{r.number}.{number}"
        yield Place(f"{opened} {printed}", opened, printed, r.number, _plain(title), line)


def _labelled(r: _Reader, label: str, line: int) -> Place:
    kinds = [name for name, *_ in r.open]
    inner = next(
        (k for k in reversed(kinds) if k in (*_STATEMENTS, *_EQUATIONS, *_FLOATS, "enumerate")), ""
    )
    if inner in _STATEMENTS:
        index = len(kinds) - 1 - kinds[::-1].index(inner)
        name, title, count, _ = r.open[index]
        r.open[index] = name, title, count, True
        return Place(label, inner, f"{r.number}.{count}", r.number, _plain(title), line)
    if inner in _EQUATIONS:
        r.equation += inner == "align"
        return Place(label, "equation", f"({r.number}.{r.equation})", r.number, "", line)
    if inner in _FLOATS:
        return Place(label, inner, str(r.floats[inner]), r.number, "", line)
    if inner == "enumerate":
        return Place(label, "item", str(r.items), r.number, "", line)
    if r.at_heading:
        number = r.number if r.at_heading == "section" else f"{r.number}.{r.subsection}"
        kind, r.at_heading = r.at_heading, ""
        return Place(label, kind, number, r.number, r.last_title, line)
    return Place(label, "paragraph", f"{r.number}.{r.subsection}", r.number, "", line)


def _plain(title: str) -> str:
    """Return a title without the commands of TeX."""
    without = re.sub(r"\\(?:Om|Omega)_\{\\rm (\w+)\}", r"Ω_\1", title)
    for command, letter in (("Phi", "Φ"), ("PP", "Φ'"), ("Sigma", "Σ")):
        without = re.sub(rf"\\{command}\b", letter, without)
    without = without.replace('\\"o', "ö")
    return re.sub(r"\s+", " ", re.sub(r"\\\w+|[{}$]", "", without)).strip()


def dumps(paper: Paper) -> str:
    """Return the text of the stored list."""
    rows = [json.dumps(asdict(place), ensure_ascii=False) for place in paper.places]
    places = ",\n  ".join(rows)
    lines = ",\n  ".join(f'"{name}": {line}' for name, line in paper.lines.items())
    head = ",\n ".join(
        f'"{name}": {json.dumps(getattr(paper, name), ensure_ascii=False)}'
        for name in ("sha256", "title", "author", "cited", "references", "pictures", "bound")
    )
    return f'{{\n {head},\n "places": [\n  {places}\n ],\n "lines": {{\n  {lines}\n }}\n}}\n'


@cached
def stored() -> Paper:
    """Return the places as they are stored."""
    found = subject.data("labels.json")
    places = tuple(Place(**each) for each in found.pop("places"))
    return Paper(places=places, **found)
