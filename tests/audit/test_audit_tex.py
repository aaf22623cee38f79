"""Formulas of TeX files: what they mean, and that the erratum's are compared with derived ones."""

import re
import tomllib
from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import pytest

from cap.audit import errata, ledger, steps, subject, tables, tex
from cap.audit.decide import decided
from cap.audit.means.lazy import sympy as sp
from cap.audit.verdict import Outcome
from cap.errors import NotProved

pytest_plugins = ["audit_fixtures"]
NAMES = {
    name: sp.Symbol(name, positive=True) for name in ("f", "F", "omega", "t", "v", "beta0")
} | {
    "f_sc": sp.Symbol("f_sc"),
    "xdot": sp.Symbol("xdot", real=True),
}
WALL = "saltation.wall-entry"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (r"\frac{2 F\cos\omega t_*}{v_-}", "2*F*cos(omega*t)/v"),
        (r"2F\,|\cos\omega t|/v", "2*F*Abs(cos(omega*t))/v"),
        (r"\bigl(F - f\bigr)/(4\omega^{1/2} t)", "(F - f)/(4*sqrt(omega)*t)"),
        (r"-\pi f^2 + \beta_0", "beta0 - pi*f**2"),
        (r"\sqrt{\tfrac{1}{2}F} \arcsin(f/F)", "sqrt(F/2)*asin(f/F)"),
        (r"\sin f \cos F", "sin(f)*cos(F)"),
        (r"\mathrm{sech}(F t)", "sech(F*t)"),
        (r"e^{-f_{\rm sc} t}", "exp(-f_sc*t)"),
        (r"-f\,\sgn(\dot x)", "-f*sign(xdot)"),
        (r"\frac14 + \frac{2}{3}", "Rational(11, 12)"),
        (r"\sqrt{2}{F}\frac{f}{\frac{t^{2}}{v}}{t}", "sqrt(2)*F*f*v/t"),
        (r"\cos\frac{F}{2}", "cos(F/2)"),
        (r"F\cos t\,e^{-f t}", "F*cos(t)*exp(-f*t)"),
    ],
)
def test_what_a_formula_means(text, expected):
    """Products without signs, functions without brackets, indices."""
    assert sp.simplify(tex.meaning(text, NAMES) - sp.sympify(expected, locals=NAMES)) == 0


def test_lists():
    """Between commas, and of both signs."""
    assert tex.meaning(r"F, 2t", NAMES) == [NAMES["F"], 2 * NAMES["t"]]
    assert tex.meaning(r"\pm F,\ \pi \pm t", NAMES) == [
        *(NAMES["F"], -NAMES["F"]),
        *(sp.pi + NAMES["t"], sp.pi - NAMES["t"]),
    ]


@pytest.mark.parametrize("text", ["", "F +", "(F", "F)", "x", r"\frac{F}", "|F", "F'", "F < 2"])
def test_what_means_nothing(text):
    """It is refused."""
    with pytest.raises(NotProved):
        tex.meaning(text, NAMES)


@pytest.mark.parametrize(
    "text",
    [
        *(r"\sqrt 2 F", "F^10", r"1\,000", "10 000 F", r"2\cdot -F", r"\pm F \pm t", "F//t"),
        *(
            r"\cos\omega(t - v)",
            r"\cos 2(t + v)",
            r"\cos\omega^{(F + f)}t",
            r"\cos t^{\frac{1}{2}}v",
        ),
        *(r"F/2t", r"1/2\omega t", r"F/\omega\cos t", r"\sqrt{F, t}"),
    ],
)
def test_what_means_two_things(text):
    """It is refused, too: TeX, or a reader, takes another part for the power, or the argument."""
    with pytest.raises(NotProved):
        tex.meaning(text, NAMES)


def test_another_formula_in_the_erratum(monkeypatch):
    """A sign is enough: the claim that asks for the change is not decided."""
    claim = ledger.claims()[WALL]
    assert decided(claim, fresh=True).outcome is Outcome.CORRECTED
    (change,) = errata.of(WALL)
    (formula,) = change.formula
    other = {**formula, "tex": "-" + formula["tex"]}
    for wrong in (
        replace(change, formula=(other,)),
        replace(change, formula=(other,), new="= -" + formula["tex"]),
        replace(change, formula=({"tex": formula["tex"]},)),
    ):
        monkeypatch.setattr(errata, "changes", lambda wrong=wrong: (wrong,))
        assert decided(claim, fresh=True).outcome is Outcome.UNDECIDED


def test_another_number_in_the_erratum(monkeypatch):
    """Rows of tables ask for changes, too."""
    (change,) = errata.of("fig-orbit.v")
    steps.Steps().agrees(*change.formula, change.new)
    (formula,) = change.formula
    for digits in ("0.5419433067664596", "0.5419433067664584", "-0.5419433067664595"):
        with pytest.raises(NotProved, match="another formula"):
            steps.Steps().agrees({**formula, "tex": digits}, f"v = {digits}")
    for around in ("v = 1{}", "v = -{}", "v = - {}", "v = {}1", "v = {}.5", "v = {}^2"):
        with pytest.raises(NotProved, match="not in the text"):
            steps.Steps().agrees(formula, around.format(formula["tex"]))
    row = ledger.claims()["fig-orbit.v"]
    monkeypatch.setattr(tables, "_found", lambda *_: {})
    other = replace(change, new="v = 0.5419433067664584")
    monkeypatch.setattr(errata, "changes", lambda: (other,))
    assert "not in the text of the erratum" in decided(row, fresh=True).evidence


FORMULAS = [(each, formula) for each in errata.changes() for formula in each.formula]
_FACTORS = {r"\mu^{1/2}": r"\mu", "I^{5/2}": "I", "I^{3/2}": "I"}  # of orders: not a number


def others(text):
    """Return other formulas, one of which is wrong whatever the comparison: a bound has a side."""
    if re.fullmatch(r"-?\d+\.\d+", text):
        return [str(Decimal(text) + 2), str(Decimal(text) - 2)]
    return [f"{_FACTORS.get(text, 2)}{text}"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "formula"), FORMULAS, ids=[f"{each.claims[0]}-{f['tex']}" for each, f in FORMULAS]
)
def test_each_formula_of_the_erratum_is_compared(change, formula):
    """It agrees with the steps of its claim; another factor, or number, does not."""
    common, entry = data_of(change.claims[0])
    used = [subject.module(f"means.{each}") for each in entry.get("uses", "").split()]
    made = steps.Steps(common, entry, used=used)
    made.agrees(formula, change.new)
    refused = 0
    for other in others(formula["tex"]):
        try:
            made.agrees({**formula, "tex": other}, other)
        except NotProved:
            refused += 1
    assert refused


def data_of(name):
    """Return what is common to a group, and the steps of a claim, if they decide it."""
    group = name.partition(".")[0]
    path = Path(errata.__file__).parent / f"papers/mixed_dynamics/claims/{group}.toml"
    if not path.is_file():
        return {}, {}  # a row of a table
    data = tomllib.loads(path.read_text(encoding="utf-8"))
    (entry,) = (each for each in data["claim"] if each["id"] == name)
    return ({}, {}) if "decide" in entry else (data.get("common", {}), entry)


def test_most_formulas_are_compared():
    """Those of the erratum with what the steps of its claims derive."""
    assert sum(bool(each.formula) for each in errata.changes()) >= 68
    with pytest.raises(NotProved, match="another formula"):
        steps.Steps().agrees({"positive": "F", "tex": "2F", "is": "3*F"}, "x = 2F")
    with pytest.raises(NotProved, match="compared with nothing"):
        steps.Steps().agrees({"positive": "F", "tex": "2F"}, "x = 2F")
