"""Parameters are exact, and what makes no sense is refused in one line."""

from fractions import Fraction

import pytest

from cap.errors import BadInput
from cap.parameters import PAPER, Parameters, exact


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.4", Fraction(2, 5)),
        ("2/5", Fraction(2, 5)),
        ("-7/3", Fraction(-7, 3)),
        ("+1/3", Fraction(1, 3)),
        ("1e-3", Fraction(1, 1000)),
        ("-2.5E+2", Fraction(-250)),
        (".5", Fraction(1, 2)),
        ("5.", Fraction(5)),
        ("007", Fraction(7)),
        (" 1 \n", Fraction(1)),
        ("0", Fraction(0)),
        ("-0.0", Fraction(0)),
        ("0e999", Fraction(0)),
        ("1e30", Fraction(10) ** 30),
        ("1e-30", Fraction(1, 10**30)),
        ("0.1000000000000000055511151231257827021181583404541015625", Fraction(0.1)),
    ],
)
def test_numbers_are_read_exactly(text, value):
    """A decimal is the decimal, not the double next to it."""
    assert exact(text) == value


def test_a_decimal_is_not_its_double():
    """0.4 and 0.1 are no dyadic numbers."""
    assert exact("0.4") != Fraction(0.4)
    assert exact("0.1") != Fraction(0.1)


@pytest.mark.parametrize(
    "text",
    [
        *("", " ", ".", "-", "/", "e5", "1e", "1/", "/2", "--1", "1/-2", "1 / 2", "1 2", "0x10"),
        *("nan", "NaN", "inf", "-inf", "infinity", "1e400", "1e-400", "1e31", "1e-31", "1e9999"),
        *("1/0", "0/0", "1.5/2", "1/2.5", "1_000", "1,5", "2*3", "10**400", str(10**400), "1+1j"),
        *("１", "４/５", "٣", "0.４", "½", "²", "−1", "0" * 201, "1e1/2", "1\x00", "1\n2"),
    ],
)
def test_everything_else_is_bad_input(text):
    """Also full-width and other digits, underscores, huge sizes, infinities."""
    with pytest.raises(BadInput) as caught:
        exact(text)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 150


def parameters(**changes):
    """Return the paper's parameters with some of them changed."""
    values = {"F": 1, "omega": 1, "f": Fraction(2, 5), "l": -1, "r": 1}
    return Parameters(**{name: Fraction(value) for name, value in (values | changes).items()})


@pytest.mark.parametrize(
    "changes",
    [
        *({"F": 0}, {"F": -1}, {"F": Fraction(2, 5)}, {"F": Fraction(1, 3)}, {"F": -1, "f": 0}),
        *({"omega": 0}, {"omega": -1}, {"f": Fraction(-1, 10**40)}, {"f": 1}, {"f": 2}),
        *({"l": 1}, {"l": 2}, {"r": -1}, {"l": -1, "r": Fraction(-1)}),
        *({"e": 0}, {"e": -1}, {"e": 1 + Fraction(1, 10**40)}, {"mu": -Fraction(1, 10**40)}),
    ],
)
def test_parameters_that_are_no_oscillator_are_refused(changes):
    """0 < F, 0 < ω, 0 <= f < F, l < r, 0 < e <= 1, 0 <= μ, with equality on the right side."""
    with pytest.raises(BadInput):
        parameters(**changes)


def test_the_limits_of_the_parameters_are_allowed():
    """f = 0 is, and f just below F, and nearly soft walls."""
    assert parameters(e=Fraction(1, 10**40), mu=Fraction(10**9)).mu == 10**9
    assert parameters(f=0).f == 0
    assert parameters(f=1 - Fraction(1, 10**40)).f < 1
    assert Fraction(4, 9) == parameters(l=-7, r=Fraction(-59, 9)).R


def test_strings_are_exact_and_in_order():
    """What is written into a certificate gives the same parameters back."""
    elastic = {"F": "1", "omega": "1", "f": "2/5", "l": "-1", "r": "1"}
    assert PAPER.strings() == {**elastic, "e": "1", "mu": "0"}
    assert PAPER.elastic_strings() == elastic
    soft = parameters(e=Fraction(9, 10), mu=Fraction(1, 3))
    for p in (PAPER, soft):
        assert Parameters(*(exact(text) for text in p.strings().values())) == p
    assert Parameters(*(exact(text) for text in elastic.values())) == PAPER


@pytest.mark.parametrize("changes", [{"e": Fraction(9, 10)}, {"mu": Fraction(1, 3)}])
def test_theorems_on_elastic_walls_refuse_the_others(changes):
    """e and μ are never dropped in silence."""
    assert PAPER.conserves
    p = parameters(**changes)
    assert not p.conserves
    with pytest.raises(BadInput, match="elastic"):
        p.elastic_strings()
