"""Parameters of masses between walls: each condition at its limit, and just beyond it."""

from __future__ import annotations

from fractions import Fraction

import pytest

from cap.checker.kernel.rejection import Rejected
from cap.checker.system.all_f import ForAllF
from cap.checker.system.lossy import WithLosses
from cap.checker.system.masses import TwoMasses
from cap.checker.system.walls import BetweenWalls
from cap.checker.theorems import NAMES, load

GOOD = {"F": "1", "omega": "1", "f": "2/5", "l": "-1", "r": "1", "e": "1", "mu": "0"}
MASSES = {k: q for k, q in GOOD.items() if k not in ("e", "mu")} | {"masses": ["1", "9/10"]}
TINY, HUGE = Fraction(1, 10**30), Fraction(10**30)
SMALL = Fraction(1, 10**9)

BAD = {
    "omega": (0, -1, HUGE + 1, TINY / 2),
    "f": (-SMALL, 1, 1 + SMALL),
    "F": (Fraction(2, 5), 0, HUGE + 1),
    "l": (1, 1 - TINY / 2, -HUGE - 1),
    "r": (-1, HUGE + 1),
    "e": (0, -1, 1 + SMALL),
    "mu": (-SMALL, HUGE + 1),
    "masses": ([0, 1], [1, 0], [1, -1], [HUGE + 1, 1], [1, TINY / 2]),
}
FINE = {
    "omega": (TINY, HUGE),
    "f": (0, 1 - SMALL),
    "F": (HUGE,),
    "l": (-HUGE, 1 - TINY),
    "r": (HUGE,),
    "e": (SMALL, 1),
    "mu": (HUGE,),
    "masses": ([TINY, HUGE],),
}


def exact(value):
    """Return numbers, or lists of them."""
    return [Fraction(q) for q in value] if isinstance(value, list) else Fraction(value)


def cases(table):
    """Yield each theorem, with one parameter changed."""
    for theorem, given in ((WithLosses, GOOD), (TwoMasses, MASSES)):
        for name in given:
            for value in table[name]:
                yield theorem, {k: exact(q) for k, q in (given | {name: value}).items()}


@pytest.mark.parametrize(("theorem", "given"), list(cases(BAD)))
def test_they_are_refused(theorem, given):
    """With one line that says which condition does not hold."""
    with pytest.raises(Rejected, match=r"does not hold|not positive|in size"):
        theorem.parameters(given)


@pytest.mark.parametrize(("theorem", "given"), list(cases(FINE)))
def test_they_are_read(theorem, given):
    """All of them, as they are."""
    p = theorem.parameters(given)
    for name, value in given.items():
        read = getattr(p, name)
        assert (list(read) if name == "masses" else read) == value


def test_a_theorem_about_all_f():
    """Its f is set to 0, and without losses e = 1, mu = 0."""
    given = {name: exact(GOOD[name]) for name in ("F", "omega", "l", "r")}
    assert ForAllF.PARAMETERS.keys() == given.keys()
    assert ForAllF.parameters(given)[2:] == (0, -1, 1, 1, 0)


@pytest.mark.parametrize("masses", [["0", "1"], ["1", "-1"]])
def test_a_mass_that_is_not_positive(masses):
    """It is said to be one."""
    given = {name: exact(q) for name, q in (MASSES | {"masses": masses}).items()}
    with pytest.raises(Rejected, match="a mass is not positive"):
        TwoMasses.parameters(given)


@pytest.mark.parametrize("name", NAMES)
def test_no_theorem_has_other_losses(name):
    """Where e and mu are parameters they are bounded; between walls they are 1 and 0 elsewhere."""
    theorem = load(name)
    if not issubclass(theorem, BetweenWalls):
        assert not {"e", "mu"} & set(theorem.PARAMETERS)
        return
    given = {key: exact((GOOD | MASSES)[key]) for key in theorem.PARAMETERS}
    p = theorem.parameters(given)
    if not {"e", "mu"} & given.keys():
        assert (getattr(p, "e", 1), getattr(p, "mu", 0)) == (1, 0)
        return
    for key in ("e", "mu"):
        for value in BAD[key]:
            with pytest.raises(Rejected, match=r"does not hold|in size"):
                theorem.parameters(given | {key: exact(value)})
