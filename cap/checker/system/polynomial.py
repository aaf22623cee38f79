"""Polynomials with rational coefficients in variables that have names; all operations are exact."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from fractions import Fraction

Monomial = tuple[str, ...]  # its variables, sorted, each as often as its power
DIVISIONS = 100


class Polynomial:
    """The sum of coefficient * monomial; two are equal if they have the same terms."""

    __slots__ = ("_hash", "terms")

    def __init__(self, terms: Mapping[Monomial, Fraction]) -> None:
        self.terms = {monomial: c for monomial, c in terms.items() if c}
        self._hash: int | None = None

    @classmethod
    def of(cls, value: Polynomial | Fraction | int) -> Polynomial:
        """Return a number as a polynomial; a polynomial as it is."""
        return value if isinstance(value, Polynomial) else cls({(): Fraction(value)})

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Polynomial) and self.terms == other.terms

    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = hash(frozenset(self.terms.items()))
        return self._hash

    def __add__(self, other: Polynomial | Fraction | int) -> Polynomial:
        total = dict(self.terms)
        for monomial, c in Polynomial.of(other).terms.items():
            total[monomial] = total.get(monomial, Fraction(0)) + c
        return Polynomial(total)

    def __neg__(self) -> Polynomial:
        return self * -1

    def __sub__(self, other: Polynomial | Fraction | int) -> Polynomial:
        return self + -Polynomial.of(other)

    def __mul__(self, other: Polynomial | Fraction | int) -> Polynomial:
        total: dict[Monomial, Fraction] = {}
        for p, c in self.terms.items():
            for q, d in Polynomial.of(other).terms.items():
                monomial = tuple(sorted(p + q))
                total[monomial] = total.get(monomial, Fraction(0)) + c * d
        return Polynomial(total)

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other: Fraction | int) -> Polynomial:
        return other + -self

    @property
    def variables(self) -> set[str]:
        """The names that occur."""
        return {name for monomial in self.terms for name in monomial}

    @property
    def number(self) -> Fraction:
        """The term without variables."""
        return self.terms.get((), Fraction(0))

    def derivative(self, name: str) -> Polynomial:
        """Return the derivative in a variable."""
        total = ZERO
        for monomial, c in self.terms.items():
            power = Counter(monomial)
            if power[name]:
                others = (power - Counter([name])).elements()
                total += Polynomial({tuple(sorted(others)): c * power[name]})
        return total

    def substituted(self, values: Mapping[str, Polynomial]) -> Polynomial:
        """Return the polynomial with others in the place of some variables."""
        total = ZERO
        for monomial, c in self.terms.items():
            term = Polynomial({(): c})
            for name in monomial:
                term = term * values.get(name, variable(name))
            total += term
        return total

    def coefficients(self, name: str) -> list[Polynomial]:
        """Return the coefficients of the powers of a variable, from the power 0 on."""
        found: list[Polynomial] = [ZERO] * (1 + max((m.count(name) for m in self.terms), default=0))
        for monomial, c in self.terms.items():
            others = tuple(z for z in monomial if z != name)
            found[monomial.count(name)] += Polynomial({others: c})
        return found

    def divided(self, other: Polynomial) -> Polynomial | None:
        """Return q with self = q other; None if it is not found by so many divisions of terms.

        The greatest monomial, by powers of the variables in order, of a product is the product of
        the greatest ones.
        """
        names, rest, found = sorted(self.variables | other.variables), self, ZERO

        def powers(monomial: Monomial) -> list[int]:
            return [monomial.count(name) for name in names]

        if not other.terms:
            return None
        lead = max(other.terms, key=powers)
        for _ in range(DIVISIONS):
            if not rest.terms:
                return found
            most = max(rest.terms, key=powers)
            left = Counter(most)
            left.subtract(lead)
            if min(left.values(), default=0) < 0:
                return None
            term = {tuple(sorted(left.elements())): rest.terms[most] / other.terms[lead]}
            found, rest = found + Polynomial(term), rest - Polynomial(term) * other
        return None

    def without(self, names: Iterable[str]) -> Polynomial:
        """Return the terms in which none of these variables occurs."""
        left = set(names)
        return Polynomial({m: c for m, c in self.terms.items() if left.isdisjoint(m)})


ZERO, ONE = Polynomial({}), Polynomial({(): Fraction(1)})


def variable(name: str) -> Polynomial:
    """Return a variable."""
    return Polynomial({(name,): Fraction(1)})
