"""What is written for Coq, without Coq: the certificate's numbers, exactly, and hints that hold."""

import re
from fractions import Fraction
from pathlib import Path

import pytest
from mpmath import mp, workdps

from cap.checker.kernel.certificate import read
from cap.errors import NotProved
from cap.formal import syntax
from cap.formal.hints import hints
from cap.formal.theorem import theorem, words
from cap.sets import interval

STORED = Path(__file__).parents[2] / "certificates"
NUMBER = r"(Whole|Fraction|Decimal) (-?\d+|\(-\d+\))(?: (\d+))?"


def certificate(name):
    """Return a stored certificate."""
    return read((STORED / f"{name}.json").read_bytes())


@pytest.fixture(params=["elliptic", "elliptic-2"])
def elliptic(request):
    """Return a certificate of an elliptic orbit: the orbit, and its mirror image."""
    return certificate(request.param)


@pytest.fixture(params=["elliptic", "elliptic-2", "saddle", "saddle-2"])
def orbit(request):
    """Return a certificate of which Coq may prove the theorem."""
    return certificate(request.param)


def claimed(c):
    """Return the claims in the order of Statement.v."""
    claims = [c["box"]["x"], c["box"]["v"], c["least_speed"], *c["hit_times"], *c["hit_speeds"]]
    claims += [*c["hit_forcing"], c["trace"]]
    if "multipliers" in c:
        return [*claims, c["x"], c["v"], *c["jacobian"][0], *c["jacobian"][1], *c["multipliers"]]
    powers = ("2,0", "1,1", "0,2", "3,0", "2,1", "1,2", "0,3")
    for z, row in zip("xv", c["jacobian"], strict=True):
        claims += [c[z], *row, *(c["taylor"][z][power] for power in powers)]
    return [*claims, c["rotation_angle"], c["rotation_number"], c["twist"]]


def value(kind, top, bottom):
    """Return the value of a term of the type ``number``, as Data.v defines it."""
    below = {"Whole": 1, "Fraction": int(bottom or 0), "Decimal": 10 ** int(bottom or 0)}[kind]
    return Fraction(int(top.strip("()"))) / below


def test_the_file_is_the_same_at_every_precision(orbit):
    """The text depends on the certificate alone."""
    first = theorem(orbit)
    with interval.workprec(1000):
        assert theorem(orbit) == first


def test_the_theorem_has_the_numbers_of_the_certificate_in_the_order_of_the_statement(orbit):
    """Every interval in the theorem is that of the data, and of the certificate."""
    text = theorem(orbit)
    proved = text[text.index("Definition theorem") : text.index("From Cap Require Data")]
    data = text[text.index("Definition numbers") : text.index("Definition where_to_look")]
    computed = [value(*found) for found in re.findall(NUMBER, data)][5:]
    ends = [end for pair in re.findall(r"lo := (\S+); hi := (\S+) ", proved) for end in pair]
    assert [Fraction(end.strip("()")) for end in ends] == computed
    assert computed == [e for claim in claimed(orbit.claims) for e in (claim.lower, claim.upper)]


def test_the_theorem_is_stated_in_the_words_of_the_statement_alone(orbit):
    """Before it nothing but Statement.v is loaded: no other file can define its words anew."""
    text = theorem(orbit)
    stated, proved = text.split("(** The proof *)")
    assert re.findall(r"^.*\b(?:Require|Import)\b.*$", stated, re.MULTILINE) == [
        "From Coq Require Import Reals.",
        "From Cap Require Import Statement.",
    ]
    assert re.findall(r"^(?:Definition|Theorem) (\w+)", stated, re.MULTILINE) == ["theorem"]
    assert "From Cap Require Data Check Checked.\n\nModule Computed.\nImport Data" in proved
    assert proved.split("End Computed.")[1] == (
        "\n\nTheorem proved : theorem.\nProof. exact Computed.proof. Qed.\n\n"
        "Set Printing Width 200.\nPrint Assumptions proved.\n"
    )


def test_the_fields_are_those_of_the_library(orbit):
    """The theorem has the fields that Statement.v declares, and the data the same, in its order."""
    source = (STORED.parent / "proofs/formal/Statement.v").read_text("utf-8")
    shared, own = (
        re.findall(
            r"(\w+) :>? \w+",
            re.search(rf"Record {kind}_claims := \{{(.*?)\}}", source, re.DOTALL)[1],
        )
        for kind in ("orbit", orbit.theorem)
    )
    declared = [own[0], *shared, *own[1:]]
    proved, data = theorem(orbit).split("Definition numbers")
    numbers = data[: data.index("Definition where_to_look")]
    assert re.findall(r"^ +(\w+) :=", proved, re.MULTILINE) == declared
    fields = [f"{name}_" for name in [own[0], "F", "w", "f", "l", "r", *shared, *own[1:]]]
    assert re.findall(r"^ +(\w+) :=", numbers, re.MULTILINE) == fields


def test_the_parameter_lies_between_neighbouring_decimals(elliptic):
    """δ, from the hit times in 60 digits, is between the two decimals, one unit apart."""
    c, p = elliptic.claims, elliptic.parameters
    low, high = (Fraction(end) for end in hints(elliptic).delta)
    assert high - low == Fraction(1, 10**50)
    with workdps(70):
        alpha, rho = mp.mpf(p.f.numerator) / p.f.denominator, mp.mpf(2)

        def excess(d):
            G = mp.pi**2 / 2 * mp.sinc(d) - 2 * mp.cos(d) - 2 * d * mp.sin(d)
            return 2 / mp.pi * mp.cos(d) * mp.sqrt(1 - (rho / G) ** 2) - alpha

        first, second = (mp.mpf(t.text[0]) for t in c["hit_times"])
        delta = mp.findroot(excess, (second - first - mp.pi) / 2)
        assert mp.mpf(low.numerator) / low.denominator < delta
        assert delta < mp.mpf(high.numerator) / high.denominator


def test_of_symmetric_orbits_the_sign_is_told(elliptic):
    """Hits half a period apart are of a symmetric orbit: S > 0 if t1 + t2 < 2π, else S < 0."""
    with workdps(40):
        for first, kind in (("1.2", "Symmetric_plus"), ("2.2", "Symmetric_minus")):
            second = Fraction(mp.nstr(mp.mpf(first) + mp.pi, 36))
            times = [
                t._replace(lower=end)
                for t, end in zip(
                    elliptic.claims["hit_times"], (Fraction(first), second), strict=True
                )
            ]
            found = hints(elliptic._replace(claims=elliptic.claims | {"hit_times": times}))
            assert found.kind == kind
    assert hints(elliptic).kind == "Asymmetric"


def test_numbers_are_read_exactly():
    """Integers, fractions and decimals, also below zero and with zeros in front."""
    for text, term in (
        ("-3", "Whole (-3)"),
        ("2/5", "Fraction 2 5"),
        ("-2/5", "Fraction (-2) 5"),
        ("0.0025", "Decimal 25 4"),
        ("-0.10", "Decimal (-10) 2"),
        ("0.00", "Decimal 0 2"),
    ):
        assert syntax.number(text) == term
        assert value(*re.fullmatch(NUMBER, term).groups()) == Fraction(text)
    assert [syntax.real(text) for text in ("-3", "-2/5", "0.25")] == ["(-3)", "(-2 / 5)", "0.25"]


def test_the_sentence_has_the_numbers_of_the_theorem(elliptic):
    """What is said of a proof names the parameters, the twist, the box and Moser's hypothesis."""
    said, c = words(elliptic), elliptic.claims
    for part in ("f = 2/5", str(c["twist"]), str(c["box"]["x"]), "if Moser's twist theorem holds"):
        assert part in said


def test_of_a_saddle_the_eigenvalues_are_said():
    """Both eigenvalues, the box, and that it is hyperbolic; nothing of stability."""
    saddle = certificate("saddle")
    said = words(saddle)
    for part in (*saddle.claims["multipliers"], saddle.claims["box"]["v"], "hyperbolic"):
        assert str(part) in said
    assert "stable" not in said


@pytest.mark.parametrize("name", ["periodic-1", "branch", "symmetric"])
def test_other_theorems_are_not_claimed(name):
    """The library states the theorems on elliptic orbits and saddles alone."""
    with pytest.raises(NotProved, match="elliptic orbits and saddles alone"):
        theorem(certificate(name))


def test_more_than_two_hits_are_not_claimed(elliptic):
    """The closed form is of orbits with one hit of each wall."""
    times = elliptic.claims["hit_times"] * 2
    with pytest.raises(NotProved, match="one hit of each wall"):
        theorem(elliptic._replace(claims=elliptic.claims | {"hit_times": times}))


def test_hits_of_no_asymmetric_orbit_are_refused(elliptic):
    """Where the hit times belong to no orbit at this friction there is nothing to be computed."""
    other = elliptic.parameters._replace(f=Fraction(41, 100))
    with pytest.raises(NotProved, match="no asymmetric orbit"):
        hints(elliptic._replace(parameters=other))
