"""The theorem ``impulse``: what is true is verified, every lie is noticed."""

from __future__ import annotations

from fractions import Fraction

import pytest
from mpmath import mp, workdps

from cap.certificate.latex import macros
from cap.checker.kernel.certificate import read
from cap.checker.kernel.theorem import Theorem
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected, verify
from checker.forge import _decimal
from checker.tampered import accepted, malformed, survivors

PAPER = {"F": "1", "omega": "1", "f": "7/10", "l": "-1", "r": "1", "e": "1", "mu": "0"}
SYSTEMS = {
    "paper": PAPER,
    "losses": PAPER | {"e": "1/2", "mu": "3/7"},
    "other units": PAPER | {"F": "3", "omega": "2/7", "f": "2", "l": "1/4", "r": "7/4"},
    "large": PAPER | {"F": str(10**30), "f": "7" + 29 * "0", "omega": str(10**30)},
    "small": PAPER | {"F": "1/" + str(10**30), "f": "7/1" + 31 * "0", "omega": "1/" + str(10**30)},
    "near the bound": PAPER | {"f": "0.6367"},
}


def forge(system=PAPER, digits=30):
    """Return a valid certificate; h by quadrature, nothing is rigorous."""
    with workdps(digits + 90):
        F, omega, f = (
            mp.mpf(Fraction(system[k]).numerator) / Fraction(system[k]).denominator
            for k in ("F", "omega", "f")
        )
        bound = 2 / mp.pi
        h = mp.pi * mp.quad(lambda t: mp.cos(t) - bound, [0, mp.acos(bound)])
        margin = f - bound * F
        values = {
            "margin": (margin, F),
            "delay": (h * bound * F / (omega * margin), 1 / omega),
            "delay_per_speed": (1 / margin, 1 / F),
            "gap": (h * F / omega**2, F / omega**2),
        }
        claims = {name: pair(value, unit, digits) for name, (value, unit) in values.items()}
    return {
        "format": "cap-certificate/1",
        "theorem": "impulse",
        "parameters": system,
        "digits": str(digits),
        "claims": claims,
        "hints": {"bits": str(digits * 4 + 400)},
        "cites": [],
        "provenance": {},
    }


def pair(value, unit, digits):
    """Return decimals around a value, as near as the width rule asks for."""
    size = max(abs(value), unit) / mp.mpf(10) ** (digits + 1)
    places = max(1, 2 - int(mp.floor(mp.log10(size))))
    return [_decimal(value - 3 * size, places), _decimal(value + 3 * size, places)]


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
@pytest.mark.parametrize("digits", [6, 40])
def test_it_is_verified(system, digits):
    """With losses, in all units, at few digits and many; the schema describes it."""
    certificate = forge(system, digits)
    assert len(verify(certificate)) == 4
    fits_the_schema(certificate)


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_every_number(system):
    """No enclosure can be moved or widened."""
    assert survivors(forge(system, 10)) == []


def test_what_is_malformed():
    """Fields missing, added, of another type are noticed when read, or later."""
    bad = [altered for _, altered in malformed(forge())]
    assert len(bad) > 100
    assert not any(accepted(altered) for altered in bad)


@pytest.mark.parametrize("name", ["F", "omega", "f"])
def test_other_parameters(name):
    """The claims hold for no other forcing and friction."""
    certificate = forge()
    value = Fraction(certificate["parameters"][name]) + Fraction(1, 10**12)
    assert not accepted(changed(certificate, "parameters", name, str(value)))


@pytest.mark.parametrize("name", ["l", "r", "e", "mu"])
def test_the_walls_and_losses_do_not_matter(name):
    """The same claims are true with others, if they make sense."""
    assert accepted(changed(forge(), "parameters", name, "1/2" if name != "l" else "-7"))
    rejected(changed(forge(), "parameters", name, "-2" if name != "l" else "2"), "does not hold")


@pytest.mark.parametrize("f", ["0", "3/5", "0.6366197723675813430755350534900574481378"])
def test_at_most_the_bound(f):
    """Below 2F/pi nothing is certified, whatever is claimed; nor where it is not certain."""
    rejected(changed(forge(), "parameters", "f", f), "not certainly above 2F/pi")
    barely = PAPER | {"f": "0.6366197723675813430755350534900574481378386"}
    rejected(forge(barely, 6) | {"hints": {"bits": "64"}}, "not certainly above 2F/pi")


def test_friction_is_below_the_forcing():
    """As in all theorems."""
    rejected(changed(forge(), "parameters", "f", "1"), "f < F")


def test_a_margin_that_touches_zero(monkeypatch):
    """The claim itself must say that f > 2F/pi."""
    monkeypatch.setattr(Theorem, "compare", lambda *_: None)
    rejected(changed(forge(), "claims", "margin", ["0", "1"]), "margin claimed is not positive")
    assert accepted(changed(forge(), "claims", "margin", ["1/100", "1"]))


def test_words_and_macros():
    """The line states what was proved; each number has its macro."""
    certificate = read(encode(forge()))
    line = words(certificate)
    for name, claim in certificate.claims.items():
        assert str(claim) in line, name
    for part in ("f = 7/10", "e = 1", "mu = 0", "comes to rest", "2F/pi is sharp"):
        assert part in line
    shown = list(macros(certificate, "a", 5))
    assert "\\newcommand{\\capAGap}{[0.66134, 0.66135]}" in shown
    assert sum(line[0] != "%" for line in shown) == len(certificate.claims)
