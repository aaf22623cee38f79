"""What the theorem branch refuses, the steps that refuse it, and bad input."""

from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise

import pytest
from closed_forms import check_cells, proved, setting
from conftest import STARTS
from support import over, proving

from cap.errors import BadInput, NotProved
from cap.maps.fixed_point import Start
from cap.one_one.closed_form import asymmetric
from cap.parameters import Parameters
from cap.proofs import branch, branch_curve, pitchfork
from cap.proofs.branch_curve import Part
from cap.proofs.fixed_point import Setting
from cap.proofs.one_one import Scale
from cap.sets import interval
from cap.subdivision import Cell


@pytest.fixture(scope="module", autouse=True)
def _cells_once():
    """Examine no cell twice: a verdict depends on ρ and the cell alone."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("examine_monotone", "examine_twist"):
            patch.setattr(branch, name, cache(getattr(branch, name)))
        yield


@pytest.mark.parametrize("theorem", [pitchfork, branch])
@pytest.mark.parametrize(
    ("rho", "why"),
    [("1/2", "> 0.70407"), ("0.704", "> 0.70407"), ("3", "< 2.9348"), ("1e6", "< 2.9348")],
)
def test_where_there_is_no_pitchfork(theorem, rho, why):
    """A hypothesis on the parameters fails: it is bad input, said in one line."""
    with pytest.raises(BadInput, match=rf"no pitchfork: R omega\^2/F {why} is needed"):
        theorem.prove(setting(rho))


@pytest.mark.parametrize(
    ("rho", "low", "high", "why"),
    [
        (2, "0.47", None, "exists for"),
        ("3/4", None, "0.3", r"no pair .* between 0\.6146668\d* and 0\.6154807\d*:"),
        ("3/4", "0.6155", "0.7", "no pair"),
    ],
)
def test_ranges_without_a_pair(rho, low, high, why):
    """They are bad input, said in one line."""
    f_range = tuple(end and Fraction(end) for end in (low, high))
    with pytest.raises(BadInput, match=why) as caught:
        branch.prove(setting(rho, options=over(*f_range)))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("rho", ["1", "3/2", "2", "9/4"])
def test_where_the_pair_exists_is_rounded_up(rho):
    """What is said of the f below which there is a pair is not below it; at each size of F."""
    for F in (Fraction(1), Fraction(1, 10**9), Fraction(10**9)):
        p = Parameters(F, Fraction(1), F / 2, Fraction(0), Fraction(rho) * F)
        ask = Setting(p, Start(0.0, 0.0, ()), 12, options=over(F * 63 / 100))
        with pytest.raises(BadInput) as caught:
            branch.prove(ask)
        with interval.workprec(200):
            birth = pitchfork.lemma_2_parabolic(Scale(ask)).alpha * interval.ball(F)
        said = Fraction(str(caught.value).split()[6])
        assert birth < interval.ball(said) < birth * 100001 / 100000


class Altered:
    """An orbit of which one thing is not as it is."""

    def __init__(self, orbit, **others):
        self.orbit, self.others = orbit, others

    def __getattr__(self, name):
        """Return it, or what stands for it."""
        return self.others.get(name, getattr(self.orbit, name))


ALTERED = {
    "none": lambda _: {},
    "the minima exchanged": lambda o: {"slowest": lambda: o.slowest()[::-1]},
    "equal minima": lambda o: {"slowest": lambda: (o.slowest()[0],) * 2},
    "the least speed grows": lambda o: {"slowest": lambda: (o.delta / 9, o.slowest()[1])},
    "a minimum before the flight": lambda o: {"delays": lambda: (-o.delays()[0], o.delays()[1])},
    "a minimum after the flight": lambda o: {"durations": (o.delays()[0], o.durations[1])},
    "a hit that is slower": lambda o: {"speeds": (o.speeds[0], o.slowest()[0] - 0.01)},
    "a hit of no speed": lambda o: {"speeds": (o.speeds[0], o.speeds[1] * 0)},
    "the trace grows": lambda o: {"trace": lambda: -o.trace()},
    "the trace stays": lambda o: {"trace": lambda: o.trace() * 0},
}


@pytest.mark.parametrize("ends", [("0", "1/1000"), ("1/4", "27/100")])
@pytest.mark.parametrize("name", ALTERED)
def test_each_condition_of_lemma_3_counts(monkeypatch, name, ends):
    """A cell is refused if one of them does not hold."""
    monkeypatch.setattr(branch, "asymmetric", lambda *at: _altered(name, *at))
    examine = getattr(branch.examine_monotone, "__wrapped__", branch.examine_monotone)
    assert examine(Fraction(2), Cell(*map(Fraction, ends))) == ("-" if name == "none" else "?")


def _altered(name, delta, rho):
    orbit = asymmetric(delta, rho)
    return Altered(orbit, **ALTERED[name](orbit))


def test_decreasing_is_refused_where_it_does_not_hold():
    """On cells with δ = 0 inside, beyond δ_max, too wide; on the mirror image it increases."""

    def verdict(low, high, rho=2):
        return branch.examine_monotone(Fraction(rho), Cell(Fraction(low), Fraction(high)))

    assert verdict(0, "1/1000") == "-"
    assert verdict("1/4", "27/100") == "-"
    for low, high in (
        ("-1/1000", "1/1000"),
        ("-1/4", "-24/100"),
        ("1/10", "3/4"),
        ("3/4", "8/10"),
        ("1", "101/100"),
        ("-1/1000", "0"),
    ):
        assert verdict(low, high) == "?"
    assert verdict(0, "1/1000", 3) == "?"
    assert verdict(0, "1/1000", "1/2") == "-"  # that it is positive is not asked here


def test_the_sign_of_the_twist_on_cells():
    """On both sides of its zero, and across."""
    rho = Fraction(2)
    signs = {("0.36", "0.361"): "-", ("0.363", "0.364"): "+", ("0.362", "0.3625"): "?"}
    for ends, sign in signs.items():
        verdict = branch.examine_twist(rho, Cell(*map(Fraction, ends)))
        bracket = branch._enclosure(verdict)
        assert Part(Cell(Fraction(0), Fraction(1)), bracket).sign == sign.replace("?", "none")
    assert branch.examine_twist(rho, Cell(Fraction(0), Fraction(1, 1000))) == "?"
    assert branch.examine_twist(rho, Cell(Fraction(6, 5), Fraction(7, 5))) == "?"


@pytest.mark.parametrize(
    "verdict",
    ["", "1", "1 2 3", "2 1", "-1 1", "0 1", "1/0 2", "nan nan", "1e999999999 1e9999999999", "+"],
)
def test_verdicts_of_a_damaged_journal(verdict):
    """No pair of numbers, none of one sign; exponents that no memory holds."""
    with pytest.raises(BadInput, match="damaged"):
        branch._enclosure(verdict)


def test_changes_of_sign():
    """Of the twist: cells without sign between different signs only; neighbours are merged."""
    ends = [Fraction(k) for k in range(8)]
    signs = [None, "-", None, None, "+", None, "+"]
    values = {"-": (Fraction(-2), Fraction(-1)), "+": (Fraction(1), Fraction(2)), None: None}
    parts = [Part(Cell(a, b), values[s]) for (a, b), s in zip(pairwise(ends), signs, strict=True)]
    merged = branch._merged(parts)
    assert [part.sign for part in merged] == ["none", "-", "none", "+", "none", "+"]
    assert [tuple(part.cell) for part in merged][2] == (2, 4)
    assert list(branch_curve._zeros(merged)) == [Cell(Fraction(2), Fraction(4))]


def test_the_cells_of_the_first_attempt():
    """They grow from the birth on, in order, up to the longest, and end where they should."""
    for last in (
        "0.476422882354231814995594374963613985045796572",
        "1e-9",
        "0.0011",
        "1.5",
        "0.02",
    ):
        ends = branch._ends(Fraction(last))
        assert ends[0] == 0
        assert ends[-1] == Fraction(last)
        assert all(a < b for a, b in pairwise(ends))
        assert all(b - a <= branch.LONGEST * 2 for a, b in pairwise(ends))
        for end in ends:
            interval.exact_decimal(end)


BAD = [
    "branch --f 1/2",
    "pitchfork --f 1/2",
    "branch --orbit 1/10 1/2",
    "pitchfork --orbit 1/10 1/2",
    "symmetric --orbit 1/10 1/2",
    "symmetric --all",
    "branch --e 1/2",
    "pitchfork --e 1/2",
    "symmetric --e 9/10",
    "symmetric --mu 1/10",
    "branch --epsilon 1/10",
    "symmetric --f 0",
    "symmetric --f 1",
    "symmetric --f -1/2",
    "branch --F 0",
    "branch --F -1",
    "branch --F nan",
    "symmetric --f nan",
    "pitchfork --omega inf",
    "branch --omega 0",
    "branch --l 1 --r 1",
    "branch --from nan",
    "branch --to nan",
    "branch --from 1/0",
    "branch --from 2/5 --to 2/5",
    "branch --from 1/2 --to 2/5",
    "branch --from 0",
    "branch --from -1/10",
    "branch --from 47/100",
    "branch --r -1/4 --to -1",
    "symmetric --from 1/10",
    "pitchfork --to 1/10",
    "symmetric --jobs 2",
    "pitchfork --journal x",
    "branch --jobs 0",
    "branch --jobs x",
    "branch --period 2",
    "branch --order 5",
    "branch --digits 5",
    "branch --digits nan",
    "branch --journal .",
    "branch --journal no/such/directory",
]


@pytest.mark.parametrize("line", BAD)
def test_bad_input(capsys, tmp_path, monkeypatch, line):
    """One line on standard error, status 2, no traceback, no file."""
    monkeypatch.chdir(tmp_path)
    status, _, err = proving(capsys, *line.split())
    assert status == 2
    assert err.count("\n") == 1
    assert err.startswith("error: ")
    assert not list(tmp_path.iterdir())


DEFECTS = {  # what is not yet refused: the words, and why
    "branch --from=": "an empty word is compared with 0",
    "branch --to=": "an empty word is taken for none",
    "branch --F=": "an empty word is taken for none",
    "branch --to 0": "0 is taken for none",
}


@pytest.mark.parametrize("line", DEFECTS)
def test_empty_words(capsys, tmp_path, monkeypatch, line):
    """They are bad input too."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(branch, "lemma_1_closed_form", lambda: 1 / 0)
    status, _, err = proving(capsys, *line.split())
    assert (status, err.count("\n")) == (2, 1)


@pytest.mark.slow
@pytest.mark.parametrize("F", ["1", "1e20"])
def test_few_digits(monkeypatch, F):
    """The exceptions contain the claims on resonances of order <= 4, also of few digits."""
    monkeypatch.setattr(branch, "SMALLEST", Fraction(1, 1000))
    p = Parameters(Fraction(F), Fraction(1), Fraction(F) / 2, Fraction(0), 2 * Fraction(F))
    ask = Setting(p, Start(0.0, 0.0, ()), 6 if p.F == 1 else 12)
    low = Fraction(41, 100) if p.F == 1 else None
    check_cells(branch.prove(replace(ask, options=over(low)))(Fraction(1)))


@pytest.mark.slow
def test_a_range_in_large_units():
    """F = 10^20 and --from: fewer decimal places than none."""
    p = Parameters(Fraction(10**20), Fraction(10**10), Fraction(1), Fraction(0), Fraction(2))
    f_range = Fraction(44 * 10**18), None
    check_cells(
        branch.prove(Setting(p, STARTS["elliptic"], 12, options=over(*f_range)))(Fraction(1))
    )


def test_a_range_that_needs_more_digits():
    """The pair lives for an f of 1e-12 only: at 12 digits none is in between, at 30 there are."""
    check_cells(proved(branch, "0.7040606066", digits=30))
    with pytest.raises(NotProved):
        branch.prove(setting("0.7040606066"))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("rho", "low"),
    [("2.93", "1/1000"), pytest.param("2.9348", "1/10000", marks=pytest.mark.slow)],
)
def test_down_to_little_friction(rho, low):
    """Near δ_max, where f = 0, cells must be shorter than twice what may be halved."""
    check_cells(proved(branch, rho, low=low))
