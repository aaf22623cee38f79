"""Exact numbers as Coq reads them."""

from collections.abc import Callable, Sequence

JET = ("2,0", "1,1", "0,2", "3,0", "2,1", "1,2", "0,3")  # after 0,0 and 1,0 and 0,1: as in `jet`


def number(text: str) -> str:
    """Return a term of the type ``number`` of Data.v."""
    if "/" in text:
        return "Fraction {} {}".format(*map(signed, text.split("/")))
    whole, _, decimals = text.partition(".")
    if not decimals:
        return f"Whole {signed(whole)}"
    digits = (whole.removeprefix("-") + decimals).lstrip("0") or "0"
    return f"Decimal {signed('-' * whole.startswith('-') + digits)} {len(decimals)}"


def real(text: str) -> str:
    """Return the real number: 2/5 is a quotient, 0.25 a decimal."""
    return f"({text.replace('/', ' / ')})" if "/" in text else signed(text)


def signed(text: str) -> str:
    """Return a number that may be an argument."""
    return f"({text})" if text.startswith("-") else text


def pair_of_numbers(ends: Sequence[str]) -> str:
    """Return a term of the type ``range`` of Data.v."""
    return f"({number(ends[0])}, {number(ends[1])})"


def interval(ends: Sequence[str]) -> str:
    """Return a term of the type ``interval`` of Statement.v."""
    return f"{{| lo := {real(ends[0])}; hi := {real(ends[1])} |}}"


def record(fields: Sequence[tuple[str, str]], margin: str = "  ") -> str:
    """Return a record, a field in a line."""
    return "{|\n" + ";\n".join(f"{margin}{name} := {term}" for name, term in fields) + " |}"


def jet(entries: Sequence[Sequence[str]], term: Callable[[Sequence[str]], str]) -> str:
    """Return a polynomial with intervals as coefficients, one in a line."""
    return "Jet" + "".join(f"\n    {_argument(term(entry))}" for entry in entries)


def _argument(term: str) -> str:
    return term if term[0] in "({" else f"({term})"
