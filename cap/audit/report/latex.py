"""Words in LaTeX: pdflatex, standard packages only."""

import re
import unicodedata

_TEXTS = "backslash asciitilde asciicircum bar quotedbl asciigrave quotedblleft quotedblright"
_SPECIAL = {
    **{sign: f"\\{sign}" for sign in "&%$#_{}"},
    **{sign: rf"\text{name}{{}}" for sign, name in zip('\\~^|"`“”', _TEXTS.split(), strict=True)},
    "<": "$<$",
    ">": "$>$",
    "−": "$-$",
    "…": r"\dots{}",
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
_MARKS = {
    "\u0303": r"\ensuremath{\tilde{%s}}",
    "\u0304": r"\ensuremath{\bar{%s}}",
    "\u0302": r"\ensuremath{\hat{%s}}",
    "\u0308": r"\"{%s}",
}
_PLACES = {"<super>": "textsuperscript", "<sub>": "textsubscript"}


def escaped(text: str) -> str:
    """Return text for LaTeX; `ValueError` names a sign for which there is no way to write it."""
    signs: list[str] = []
    for sign in unicodedata.normalize("NFD", text):
        signs.append(_MARKS[sign] % signs.pop() if sign in _MARKS else _sign(sign))
    return "".join(signs).replace("--", "-{}-")  # no dash


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
    signs = re.sub(r"([-/.])", r"\1\\allowbreak{}", escaped(text))
    return rf"\texttt{{{signs}}}"


def breakable(text: str) -> str:
    """Return text that may be broken after each sixth sign of a long word."""
    parts = (re.findall(".{1,6}", word) for word in text.split())
    return " ".join(r"\allowbreak{}".join(map(escaped, each)) for each in parts)
