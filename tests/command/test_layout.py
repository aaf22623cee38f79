"""Verdicts laid out for a terminal: the same words, the ends of enclosures written shortly."""

import re

import pytest

from cap.command.layout import KEPT, laid_out


@pytest.mark.parametrize(
    ("enclosure", "short"),
    [
        ("[0.10271, 0.10272]", "0.1027[1..2]"),
        ("[-0.10272, -0.10271]", "-0.1027[2..1]"),
        ("[1.2340099, 1.2340101]", "1.2340[099..101]"),
        ("[1.2345, 1.2345]", "[1.2345, 1.2345]"),
        ("[-0.00001, 0.00001]", "[-0.00001, 0.00001]"),
        ("[0.347829, 0.465903]", "[0.347829, 0.465903]"),
        ("[9.99999, 10.00001]", "[9.99999, 10.00001]"),
        ("[100, 101]", "[100, 101]"),
    ],
)
def test_enclosures_whose_ends_have_digits_in_common(enclosure, short):
    """The digits before the bracket with those in it are the ends; other enclosures stay."""
    told = laid_out(f'VERIFIED: s: x in {enclosure} ("f")', 80)
    assert told.splitlines() == ["VERIFIED: s", f"  - x in {short}", '  ("f")']
    if short != enclosure:
        common, lower, upper = re.fullmatch(r"(.*)\[(\d+)\.\.(\d+)\]", short).groups()
        assert f"[{common}{lower}, {common}{upper}]" == enclosure


def test_each_claim_has_its_line():
    """The system before the first colon, then what semicolons separate, within the width."""
    told = laid_out('VERIFIED: the system: one claim that is long; two: a; hence b ("a.json")', 24)
    assert told.splitlines() == [
        "VERIFIED: the system",
        "  - one claim that is",
        "    long",
        "  - two: a",
        "  - hence b",
        '  ("a.json")',
    ]


def test_a_system_that_ends_with_a_semicolon():
    """Where no colon comes first, all before the semicolon is the system."""
    assert laid_out('VERIFIED: x; a: b ("f")', 40).splitlines()[:2] == ["VERIFIED: x", "  - a: b"]


def test_a_long_word_is_cut_and_its_length_told():
    """A sequence of symbols that is longer than a line."""
    told = laid_out(f'VERIFIED: s: {"RL" * 50} ("f")', 100)
    assert told.splitlines()[1] == f"  - {'RL' * (KEPT // 2)}... (100 letters)"


@pytest.mark.parametrize("word", ["REJECTED", "CANNOT READ"])
def test_other_verdicts_are_only_wrapped(word):
    """Nothing in a reason, or in the name of a file, makes another line of them."""
    verdict = f'{word}: "a; VERIFIED: b.json": no [0.12345, 0.12346]'
    assert " ".join(laid_out(verdict, 30).split()) == verdict


def test_the_name_of_a_file_begins_no_claim():
    """Semicolons in it are its own."""
    told = laid_out(r'VERIFIED: s: a ("x; y: \" z.json")', 80)
    assert told.splitlines() == ["VERIFIED: s", "  - a", r'  ("x; y: \" z.json")']
