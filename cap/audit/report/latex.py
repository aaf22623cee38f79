"""Words in LaTeX: pdflatex, standard packages only."""

import re
import unicodedata

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


def escaped(text: str) -> str:
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


def typed(text: str) -> str:
    """Return what is to be typed, which may be broken after its signs."""
    return rf"\texttt{{{re.sub(r'([-/.])', _BREAK, escaped(text))}}}"


def breakable(text: str) -> str:
    """Return text that may be broken after each sixth sign of a long word."""
    parts = (re.findall(".{1,6}", word) for word in text.split())
    return " ".join(r"\allowbreak{}".join(map(escaped, each)) for each in parts)
