"""The theorem ``window``: the cycle, its symbols, its entropy, and certificates that lie."""

from __future__ import annotations

import json
from fractions import Fraction
from itertools import islice
from pathlib import Path

import pytest
from mpmath import mp

from cap.checker.kernel.certificate import read
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.window import Window
from cap.checker.verdict import words
from checker.altered import changed, encode, fits_the_schema, rejected

pytestmark = pytest.mark.usefixtures("releases_computed_once")

STORED, ZERO = (
    json.loads((Path(__file__).parents[2] / "certificates" / name).read_text("utf-8"))
    for name in ("window-1.json", "window-2.json")
)


@pytest.fixture(scope="module")
def cells():
    """Return the cells of the stored certificate, proved."""
    return list(Window(read(encode(STORED)), lambda _: None).covered())


@pytest.fixture
def at(cells):
    """Return the checker of a certificate, with its cells, and its critical point."""

    def prepared(certificate=STORED):
        proof = Window(read(encode(certificate)), lambda _: None)
        proof.cells = cells
        hints = certificate["hints"]
        c = Interval.enclosing(*map(Fraction, hints["critical"]), int(hints["bits"]))
        return proof, c

    return prepared


def lie(*path_and_value):
    """Return the stored certificate with another claim."""
    return changed(STORED, "claims", *path_and_value)


def refused(at, why, certificate):
    """Check that the lie is noticed, for this reason, where the orbit of c is followed."""
    proof, c = at(certificate)
    with pytest.raises(Rejected, match=why):
        proof.kneading(c, proof.into_itself(c))


def moved(pair, by):
    """Return an enclosure moved by a multiple of its width."""
    low, high = map(Fraction, pair)
    return [str(low + by * (high - low)), str(high + by * (high - low))]


def test_it_is_verified():
    """The schema describes it; the line says what was proved and what was not."""
    steps = []
    certificate = read(encode(STORED))
    Window(certificate, steps.append).prove()
    assert len(steps) == 6
    fits_the_schema(STORED)
    line = words(certificate)
    for part in (
        ", and then LRL again and again",
        "least period 3",
        "not claimed that it attracts",
    ):
        assert part in line
    assert "no periodic orbit attracts" not in line


def test_the_symbols(at):
    """No symbol can be another one, before J or in the cycle of J; nor can the block be shifted."""
    proof, c = at()
    proof.kneading(c, proof.into_itself(c))
    first, repeated = STORED["claims"]["kneading"], STORED["claims"]["repeated"]
    assert "".join(islice(proof.symbols(), 11)) == (first + 4 * repeated)[:11]
    for n in range(len(first)):
        other = first[:n] + ("L" if first[n] == "R" else "R") + first[n + 1 :]
        refused(at, f"symbol {n + 1} of the kneading", lie("kneading", other))
    for n in range(len(repeated)):
        other = repeated[:n] + ("L" if repeated[n] == "R" else "R") + repeated[n + 1 :]
        refused(at, f"symbol {n + 1} of those repeated", lie("repeated", other))
    refused(at, "may not lie in J", lie("kneading", first + repeated[:1]))


def test_the_cycle(at):
    """Another period, another point, another multiplier; J too small or not contracted."""
    points, J = STORED["claims"]["cycle"], list(map(Fraction, STORED["claims"]["around"]))
    for n in range(3):
        refused(at, "does not contain", lie("cycle", n, moved(points[n], 5)))
    refused(at, "does not contain", lie("multiplier", moved(STORED["claims"]["multiplier"], -5)))
    refused(at, "wider", lie("multiplier", ["-0.08", "-0.07"]))
    refused(
        at,
        "may not take J|may not contract",
        lie("around", [str(J[0] - Fraction(1, 1000)), str(J[1])]),
    )
    refused(at, "no interior", lie("around", [str(J[0]), str(J[0])]))
    middle = sum(J) / 2
    refused(at, "may not", lie("around", [str(J[0]), str(middle)]))
    low, high = map(Fraction, STORED["hints"]["point"])
    for wrong in ([low - 1, low], [low, high + 1], [low, low]):
        hint = changed(STORED, "hints", "point", list(map(str, wrong)))
        refused(at, "not in J", hint)
    hint = changed(STORED, "hints", "point", [str(high), str(2 * high - low)])
    refused(at, "may not begin", hint)
    twice = lie("repeated", 2 * STORED["claims"]["repeated"])
    twice["claims"]["cycle"] = 2 * points
    refused(at, "period of the cycle may be smaller", twice)
    rejected(lie("cycle", points[1:]), "cycle is not a list")


def test_an_iterate_that_does_not_contract(at, monkeypatch):
    """It takes J into its interior, but its derivative may be 1: then it may have more cycles."""
    proof, c = at()
    bits = int(STORED["hints"]["bits"])
    found = proof.round(Interval.enclosing(*map(Fraction, STORED["claims"]["around"]), bits))
    for slope in (1, -1):
        steep = found._replace(slope=Interval.enclosing(slope, slope, bits))
        monkeypatch.setattr(proof, "round", lambda _, steep=steep: steep)
        with pytest.raises(Rejected, match="may not contract J"):
            proof.attracts(c)


def test_the_entropies(at):
    """That of period three is the logarithm of the golden ratio; that of period four is zero."""
    at()[0].entropy()
    low, high = map(Fraction, STORED["claims"]["entropy"])
    with mp.workdps(50):
        golden = Fraction(mp.nstr(mp.log(mp.phi), 45))
    assert low < golden < high
    for by, why in ((3, "below its lower"), (-3, "above its upper")):
        with pytest.raises(Rejected, match=why):
            at(lie("entropy", moved(STORED["claims"]["entropy"], by)))[0].entropy()
    assert ZERO["claims"]["entropy"] == ["0", "0"]
    Window(read(encode(ZERO)), lambda _: None).entropy()
    with pytest.raises(Rejected, match="may be positive"):
        at(lie("entropy", ["0", "0"]))[0].entropy()
    chaotic = changed(ZERO, "claims", "entropy", ["0.1", "0.1"])
    with pytest.raises(Rejected, match="below its lower"):
        Window(read(encode(chaotic)), lambda _: None).entropy()
    assert "no horseshoe" in words(read(encode(ZERO)))


def test_zero_entropy_is_nowhere_called_positive():
    """What is cited for a positive entropy says that it is not used without one."""
    cited = {c["theorem"]: c["hypotheses"] for c in ZERO["cites"]}
    for name in ("Misiurewicz", "Li-Yorke"):
        assert cited[name][0]["statement"].startswith("only where the lower end of entropy is pos")
    assert "if upper = 0" in cited["Milnor-Thurston"][1]["statement"]
