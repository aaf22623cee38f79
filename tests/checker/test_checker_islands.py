"""The theorem ``islands``: each island is one of ``island``; the list of them is looked at."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from cap.checker.kernel.certificate import read
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems.islands import Islands
from cap.checker.verdict import words
from cap.command.outcome import seconds
from checker.altered import SMALL_LOSSES, changed, encode, fits_the_schema, rejected, verify
from checker.tampered import accepted, malformed

ROOT = Path(__file__).parents[2]
GOOD = json.loads((ROOT / "tests/certificates/accept/islands_small.json").read_text("utf-8"))
FIRST, SECOND = GOOD["claims"]["islands"]


def listed(*claims):
    """Return the certificate with other claims."""
    return changed(GOOD, "claims", "islands", list(claims))


def test_it_is_verified():
    """A step for each f; the schema describes it."""
    assert len(verify(GOOD)) == 3
    fits_the_schema(GOOD)


def test_the_sentence():
    """It says what is claimed at each f, and of which nothing is."""
    said = words(read(encode(GOOD)))
    assert f"f = 2/5: Phi, alpha = [0;3,2,16,14,(1)], area in [{FIRST['area'][0]}, " in said
    assert f"{FIRST['area'][1]}] twice, p/q as 33/115; f = 11/20: sigma" in said
    assert said.endswith(", p/q as 41/113; nothing is claimed of f = 7/10 (no elliptic orbit)")
    fewer = {**GOOD["hints"], "open": []}
    assert "nothing is claimed" not in words(read(encode(GOOD | {"hints": fewer})))


def test_values_of_f():
    """They increase, and are those of the curves."""
    rejected(listed(FIRST | {"f": "12/20"}, SECOND), "do not increase")
    rejected(listed(FIRST | {"f": "11/20"}, SECOND), "do not increase")
    rejected(listed(FIRST, SECOND | {"f": "2"}), "f < F")
    near = str(Fraction(11, 20) + Fraction(1, 10**12))
    assert not accepted(listed(FIRST, SECOND | {"f": near}))
    assert not accepted(listed(FIRST | {"f": near}, SECOND))
    swapped = {"islands": GOOD["hints"]["islands"][::-1], "open": []}
    assert not accepted(listed(SECOND | {"f": "2/5"}, FIRST | {"f": "11/20"}))
    assert not accepted(GOOD | {"hints": swapped})


@pytest.mark.parametrize("n", [0, 1])
@pytest.mark.parametrize("name", ["x", "v", "area"])
def test_enclosures_are_moved(n, name):
    """Each is noticed."""
    low, high = map(Fraction, GOOD["claims"]["islands"][n][name])
    ends = [str(2 * high - low), str(3 * high - 2 * low)]
    rejected(changed(GOOD, "claims", "islands", n, name, ends), "contain")


def test_lies():
    """Two disks where there is one; another centre; another rotation number; losses."""
    rejected(listed(FIRST, SECOND | {"disks": "2"}), "own image")
    other = {"centre": ["0.2", "0.3"]}
    rejected(listed(FIRST | {"orbits": other}, SECOND), "may be equal")
    golden = {"head": ["3"], "period": ["1"]}
    assert not accepted(listed(FIRST | {"rotation_number": golden}, SECOND))
    for loss in SMALL_LOSSES:
        rejected({**GOOD, "parameters": GOOD["parameters"] | loss}, "unknown fields")


def test_what_is_cited():
    """Franks, if periodic orbits are claimed at some f."""
    rejected(GOOD | {"cites": GOOD["cites"][:-1]}, "own list")
    without = [{k: v for k, v in c.items() if k != "orbits"} for c in (FIRST, SECOND)]
    hints = [{k: v for k, v in h.items() if k != "ray"} for h in GOOD["hints"]["islands"]]
    less = listed(*without) | {"hints": GOOD["hints"] | {"islands": hints}}
    rejected(less, "own list")
    assert len(verify(less | {"cites": GOOD["cites"][:-1]})) == 3
    rejected(listed(without[0], SECOND), "orbits without a ray")
    half = listed(without[0], SECOND)
    assert (
        len(
            verify(
                half
                | {"hints": less["hints"] | {"islands": [hints[0], GOOD["hints"]["islands"][1]]}}
            )
        )
        == 3
    )


def test_sizes():
    """As many hints as claims; the time is bounded, and said before."""
    assert seconds(encode(GOOD)) == 1
    larger = changed(GOOD, "hints", "islands", 0, "places", "99")
    assert seconds(encode(changed(larger, "hints", "islands", 0, "degree", "3000"))) > 30
    fewer = GOOD["hints"] | {"islands": GOOD["hints"]["islands"][:1]}
    rejected(GOOD | {"hints": fewer}, "hints for each f")
    rejected(changed(larger, "hints", "islands", 1, "places", "300"), "between")
    most = changed(larger, "hints", "islands", 0, "degree", "4096")
    both = changed(most, "hints", "islands", 1, "degree", "4096")
    rejected(changed(both, "hints", "islands", 1, "places", "60"), "in all")
    rejected(changed(most, "hints", "islands", 0, "places", "101"), "degree times places")


def test_open_values():
    """Anything may be left open, in a word for the reason."""
    rejected(changed(GOOD, "hints", "open", 0, "reason", "laziness"), "none of")
    assert len(verify(changed(GOOD, "hints", "open", 0, "f", "3/5"))) == 3


def test_what_is_malformed():
    """Fields missing, added, of another type; what has the form of numbers is tested elsewhere."""
    survived = [where for where, bad in malformed(GOOD) if readable(bad)]
    fewer = [("hints", "islands", 0, "hits", n) for n in (0, 1)]
    unclaimed = [("hints", "open", []), ("hints", "open", 0)]
    others = [w for w in survived if w[-1] != ["2", "1"] and "rotation_number" not in w]
    assert sorted(map(str, others)) == sorted(map(str, fewer + unclaimed))


def readable(certificate):
    """Return whether a certificate can be read, and its polynomials."""
    try:
        for each in Islands(read(encode(certificate)), lambda _: None).each():
            each.polynomials()
    except Rejected:
        return False
    return True
