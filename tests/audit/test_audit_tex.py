"""Formulas of TeX files: what they mean, and that the erratum's are compared with derived ones."""

from dataclasses import replace

import pytest

from cap.audit import errata, ledger, steps, tex
from cap.audit.decide import decided
from cap.audit.means.lazy import sympy as sp
from cap.audit.verdict import Outcome
from cap.errors import NotProved

pytest_plugins = ["audit_fixtures"]
NAMES = {name: sp.Symbol(name, positive=True) for name in ("f", "F", "omega", "t", "v", "beta0")}
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
    ],
)
def test_what_a_formula_means(text, expected):
    """Products without signs, functions without brackets, indices."""
    assert sp.simplify(tex.expression(text, NAMES) - sp.sympify(expected, locals=NAMES)) == 0


@pytest.mark.parametrize("text", ["", "F +", "(F", "F)", "x", r"\frac{F}", "|F"])
def test_what_means_nothing(text):
    """It is refused."""
    with pytest.raises(NotProved):
        tex.expression(text, NAMES)


def test_another_formula_in_the_erratum(monkeypatch):
    """A sign is enough: the claim that asks for the change is not decided."""
    claim = ledger.claims()[WALL]
    assert decided(claim, fresh=True).outcome is Outcome.CORRECTED
    (change,) = errata.of(WALL)
    formula = {**change.formula, "tex": "-" + change.formula["tex"]}
    for other in (
        replace(change, formula=formula),
        replace(change, formula=formula, new="= -" + formula["tex"]),
    ):
        monkeypatch.setattr(errata, "changes", lambda other=other: (other,))
        assert decided(claim, fresh=True).outcome is Outcome.UNDECIDED


def test_most_formulas_are_compared():
    """Those of the erratum with what the steps of its claims derive."""
    assert sum(bool(each.formula) for each in errata.changes()) >= 19
    with pytest.raises(NotProved, match="another formula"):
        steps.Steps().agrees({"positive": "F", "tex": "2F", "is": "3*F"}, "x = 2F")
