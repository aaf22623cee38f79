"""The places of the paper that claims are taken from: its labels, read from the TeX file.

Every label of a section, a statement, an equation, an item, a table or a figure is a place, and so
is every statement without a label, called by its kind and number (``remark 5.2``), and the
abstract.  Numbers are those that LaTeX prints.  The list is stored in ``labels.json``.
"""

import hashlib
import json
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from cap.audit import subject
from cap.audit.manuscript import Manuscript
from cap.audit.subject import cached

_STATEMENTS = "theorem", "lemma", "proposition", "corollary", "definition", "remark", "conjecture"
# What has a number: its kind, its counter, and its number by those of the section and of itself.
_NUMBERED = {
    **{name: (name, "statement", "{0}.{1}") for name in _STATEMENTS},
    **dict.fromkeys(("equation", "align"), ("equation", "equation", "({0}.{1})")),
    **{name: (name, name, "{1}") for name in ("figure", "table")},
    "enumerate": ("item", "item", "{1}"),
    "section": ("section", "section", "{0}"),
    "subsection": ("subsection", "subsection", "{0}.{1}"),
    "paragraph": ("paragraph", "subsection", "{0}.{1}"),
}
_FROM_ZERO = {"section": ("subsection", "statement", "equation"), "enumerate": ("item",)}
_COUNTED_INSIDE = "align", "enumerate"  # by labels, and items
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
    """A place: its label, its kind, number and section as printed, its title."""

    label: str
    kind: str
    number: str
    section: str
    title: str

    @property
    def name(self) -> str:
        """Its kind and number."""
        return f"{self.kind.capitalize()} {self.number}"


@dataclass(frozen=True)
class Paper:
    """The places of the paper in its order, and a digest of the file they were read from.

    ``lines``: where quotations begin, by the claims.  Counted in the file are the works that
    are cited, the entries or files of a bibliography, and the pictures without a file.  ``bound``
    is a digest of the quotations and the erratum that were found to fit the file.
    """

    sha256: str = ""
    title: str = ""
    author: str = ""
    cited: int = 0
    references: int = 0
    pictures: int = 0
    bound: str = ""
    places: tuple[Place, ...] = ()
    lines: dict[str, int] = field(default_factory=dict)

    def place(self, label: str) -> Place:
        """Return the place with this label; `KeyError` if there is none."""
        return {each.label: each for each in self.places}[label]


def read(path: Path) -> Paper:
    """Return the places of a TeX file."""
    manuscript = Manuscript.read(path)
    text = manuscript.printed.text
    return Paper(
        sha256=hashlib.sha256(manuscript.text.encode()).hexdigest(),
        title=manuscript.argument("title"),
        author=manuscript.argument("author"),
        cited=len({key for keys in _CITED.findall(text) for key in keys.split(",")}),
        references=len(_REFERENCES.findall(text)),
        pictures=len(_PICTURES.findall(text)),
        bound="",
        places=tuple(_Reader().places(text)),
    )


class _Reader:
    """Where the reading has come to: counters, and what is open."""

    def __init__(self) -> None:
        self.count = Counter[str]()
        self.appendix = False
        self.open: list[tuple[str, str, bool]] = []  # environment, title, whether it has a label
        self.heading = "", ""  # to which a label belongs that follows it, and its title

    def places(self, text: str) -> Iterator[Place]:
        return filter(None, map(self.read, _TOKEN.finditer(text)))

    def read(self, token: re.Match[str]) -> Place | None:
        """Read what comes next; return the place that it makes, if it does."""
        if token["section"]:
            self.begin(token["section"])
            self.heading = token["section"], token["name"]
        elif token["appendix"]:
            self.appendix, self.count["section"] = True, 0
        elif token["begin"] == "abstract":
            return Place("abstract", "abstract", "", "0", "Abstract")
        elif token["begin"] and token["begin"] != "document":
            self.begin(token["begin"])
            self.open.append((token["begin"], token["title"] or "", False))
        elif token["item"]:
            self.count["item"] += 1
        elif token["label"]:
            return replace(self.labelled(), label=token["label"])
        elif token["end"] not in ("abstract", "document") and self.open:
            name, title, labelled = self.open.pop()
            if name in _STATEMENTS and not labelled:
                place = self.place(name, title)
                return replace(place, label=f"{name} {place.number}")
        return None

    def begin(self, name: str) -> None:
        """Count what begins; inside of it, others are counted from 0."""
        self.heading = "", ""
        for each in _FROM_ZERO.get(name, ()):
            self.count[each] = 0
        if name in _NUMBERED and name not in _COUNTED_INSIDE:
            self.count[_NUMBERED[name][1]] += 1

    def labelled(self) -> Place:
        """Return the place that a label names: the innermost that has a number, or a heading."""
        for k, (name, title, _) in reversed(list(enumerate(self.open))):
            if name in _NUMBERED:
                self.open[k] = name, title, True
                self.count["equation"] += name == "align"
                return self.place(name, title if name in _STATEMENTS else "")
        (name, title), self.heading = self.heading, ("", "")
        return self.place(name or "paragraph", title)

    def place(self, name: str, title: str) -> Place:
        """Return a place without a label, with the number that is printed now."""
        kind, counter, printed = _NUMBERED[name]
        number = self.count["section"]
        section = chr(ord("A") + number - 1) if self.appendix else str(number)
        printed = printed.format(section, self.count[counter])
        return Place("", kind, printed, section, _plain(title))


def _plain(title: str) -> str:
    """Return a title without the commands of TeX, but for those for which the paper has words."""
    for command, words in subject.paper().get("titles", {}).items():
        title = title.replace(command, words)
    return " ".join(re.sub(r"\\\w+|[{}$]", "", title).split())


def dumps(paper: Paper) -> str:
    """Return the text of the stored list: JSON with a line for each place."""
    text = json.dumps(asdict(paper), ensure_ascii=False, indent=1)
    text = re.sub(r"(?<=[\[{])\n {3,}|\n  (?=[\]}])", "", text)
    return re.sub(r"\n {3,}", " ", text) + "\n"


@cached
def stored() -> Paper:
    """Return the places as they are stored; none before the first time."""
    found = subject.data("labels.json") or asdict(Paper())
    return Paper(**{**found, "places": tuple(Place(**each) for each in found["places"])})
