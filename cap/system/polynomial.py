"""Polynomials with exact coefficients, and quotients of two.

A monomial is the sorted pairs (name, power).  The number pi is one of the names, the only one that
may have a negative power: as pi is transcendental, two such sums are equal as functions of the
other names only if they have the same terms.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import Any

from cap.errors import BadInput

Monomial = tuple[tuple[str, int], ...]
DIVISIONS = 100  # of terms, at most
PI, COS, SIN = "pi", "cos", "sin"  # the names that have a meaning


class Polynomial:
    """A sum of coefficient * monomial; never changed once it is made."""

    __slots__ = ("terms",)

    terms: Mapping[Monomial, Fraction]

    def __init__(self, terms: Mapping[Monomial, Fraction]) -> None:
        self.terms = {monomial: c for monomial, c in terms.items() if c}

    @staticmethod
    def of(value: object) -> Polynomial:
        """Return an exact number, a polynomial or an expression of sympy as a polynomial."""
        if isinstance(value, Polynomial):
            return value
        if isinstance(value, int | Fraction):
            return Polynomial({(): Fraction(value)})
        if _is_symbolic(value):
            from cap.system.symbols import terms  # noqa: PLC0415 (sympy is slow to load)

            return Polynomial(terms(value))
        why = "" if callable(value) else " (write rationals as Fraction)"
        shown = "a function" if callable(value) else repr(value)
        raise BadInput(f"not an exact polynomial: {shown}{why}")

    def __eq__(self, other: object) -> bool:
        if isinstance(other, int | Fraction):
            other = Polynomial.of(other)
        return isinstance(other, Polynomial) and self.terms == other.terms

    def __hash__(self) -> int:
        return hash(frozenset(self.terms.items()))

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __add__(self, other: object) -> Polynomial:
        if isinstance(other, Quotient):
            return NotImplemented
        total = dict(self.terms)
        for monomial, c in Polynomial.of(other).terms.items():
            total[monomial] = total.get(monomial, Fraction(0)) + c
        return Polynomial(total)

    def __neg__(self) -> Polynomial:
        return Polynomial({monomial: -c for monomial, c in self.terms.items()})

    def __sub__(self, other: object) -> Polynomial:
        if isinstance(other, Quotient):
            return NotImplemented
        return self + -Polynomial.of(other)

    def __rsub__(self, other: object) -> Polynomial:
        return Polynomial.of(other) - self

    def __mul__(self, other: object) -> Polynomial:
        if isinstance(other, Quotient):
            return NotImplemented
        total: dict[Monomial, Fraction] = {}
        for left, c in self.terms.items():
            for right, d in Polynomial.of(other).terms.items():
                both = _product(left, right)
                total[both] = total.get(both, Fraction(0)) + c * d
        return Polynomial(total)

    __radd__, __rmul__ = __add__, __mul__

    def __pow__(self, power: int) -> Polynomial:
        if not isinstance(power, int):
            raise BadInput(f"only a whole power of a polynomial is one: {power!r}")
        base = self if power >= 0 else self.reciprocal()
        return reduce(mul, [base] * abs(power), ONE)

    def __truediv__(self, other: object) -> Any:
        """Return a polynomial if the other is a rational times a power of pi, else a `Quotient`."""
        if isinstance(other, Quotient):
            return NotImplemented
        below = Polynomial.of(other)
        simple = below.is_number and len(below.terms) == 1
        return self * below.reciprocal() if simple else over(self, below)

    def __rtruediv__(self, other: object) -> Any:
        return Polynomial.of(other) / self

    def __repr__(self) -> str:
        told = "".join(
            f" {'-' if c < 0 else '+'} {_shown(monomial, abs(c))}"
            for monomial, c in self.terms.items()
        )
        return ("-" if told.startswith(" -") else "") + told[3:] or "0"

    def reciprocal(self) -> Polynomial:
        """Return 1/q of a rational times a power of pi, not zero; refuse anything else."""
        if len(self.terms) == 1 and self.is_number:
            [(monomial, c)] = self.terms.items()
            return Polynomial({tuple((name, -k) for name, k in monomial): 1 / c})
        raise BadInput(f"cannot divide by {self!r}: not a rational times a power of pi")

    @property
    def variables(self) -> set[str]:
        """The names that occur, without pi."""
        return {name for monomial in self.terms for name, _ in monomial} - {PI}

    @property
    def is_number(self) -> bool:
        """Whether no name but pi occurs."""
        return not self.variables

    @property
    def degree(self) -> int:
        """The largest sum of powers in a monomial, without those of pi."""
        powers = (sum(k for name, k in m if name != PI) for m in self.terms)
        return max(powers, default=0)

    def derivative(self, name: str) -> Polynomial:
        """Return the derivative in a variable."""
        total: dict[Monomial, Fraction] = {}
        for monomial, c in self.terms.items():
            power = dict(monomial).get(name, 0)
            if power:
                total[_product(monomial, ((name, -1),))] = c * power
        return Polynomial(total)

    def multiple_of(self, other: Polynomial) -> Fraction | None:
        """Return a rational c with self = c other, 0 if self is 0; None if there is none."""
        if not self:
            return Fraction(0)
        if self.terms.keys() != other.terms.keys():
            return None
        first, *others = (self.terms[monomial] / c for monomial, c in other.terms.items())
        return first if all(factor == first for factor in others) else None

    def divided(self, other: Polynomial) -> Polynomial | None:
        """Return q with self = q other, q without negative powers; None if it is not found soon.

        By division with the order of monomials by their powers of the variables, one by one.
        """
        names = sorted({name for q in (self, other) for m in q.terms for name, _ in m})
        rest, quotient = self, ZERO

        def leading(q: Polynomial) -> Monomial:
            return max(q.terms, key=lambda m: [dict(m).get(name, 0) for name in names])

        for _ in range(DIVISIONS):
            if not rest:
                return quotient
            top, bottom = leading(rest), leading(other)
            monomial = _product(top, tuple((name, -k) for name, k in bottom))
            if any(k < 0 for _, k in monomial):
                return None
            term = Polynomial({monomial: rest.terms[top] / other.terms[bottom]})
            quotient, rest = quotient + term, rest - term * other
        return None

    def without(self, *names: str) -> Polynomial:
        """Return the terms in which none of these variables occurs."""
        kept = {m: c for m, c in self.terms.items() if not any(name in names for name, _ in m)}
        return Polynomial(kept)

    def substituted(self, values: Mapping[str, Polynomial]) -> Polynomial:
        """Return the polynomial with polynomials in place of some variables."""
        names = {name: values.get(name, variable(name)) for name in self.variables}
        return Polynomial.of(self.evaluated(names, Polynomial.of, variable(PI)))

    def evaluated(
        self, values: Mapping[str, Any], constant: Callable[[Fraction], Any], pi: Any = None
    ) -> Any:
        """Return the value in another arithmetic.

        ``constant`` makes its numbers, ``values`` holds those of the variables, ``pi`` its pi.
        """
        values = {**values, PI: pi}
        terms = [_term(m, c, values, constant) for m, c in self.terms.items()]
        return reduce(add, terms) if terms else constant(Fraction(0))


@dataclass(frozen=True)
class Quotient:
    """A rational function: numerator/denominator, the same one may be written in several ways."""

    numerator: Polynomial
    denominator: Polynomial

    @staticmethod
    def of(value: object) -> Quotient:
        """Return a quotient, what `Polynomial.of` takes, or a rational function of sympy."""
        if isinstance(value, Quotient):
            return value
        if _is_symbolic(value):
            from cap.system.symbols import parts  # noqa: PLC0415 (sympy is slow to load)

            return Quotient(*map(Polynomial.of, parts(value)))
        return Quotient(Polynomial.of(value), ONE)

    def __add__(self, other: object) -> Quotient:
        a, b = self, Quotient.of(other)
        if a.denominator == b.denominator:
            return over(a.numerator + b.numerator, a.denominator)
        top = a.numerator * b.denominator + b.numerator * a.denominator
        return over(top, a.denominator * b.denominator)

    def __neg__(self) -> Quotient:
        return Quotient(-self.numerator, self.denominator)

    def __sub__(self, other: object) -> Quotient:
        return self + -Quotient.of(other)

    def __rsub__(self, other: object) -> Quotient:
        return Quotient.of(other) - self

    def __mul__(self, other: object) -> Quotient:
        b = Quotient.of(other)
        return over(self.numerator * b.numerator, self.denominator * b.denominator)

    __radd__, __rmul__ = __add__, __mul__

    def __truediv__(self, other: object) -> Quotient:
        b = Quotient.of(other)
        return self * Quotient(b.denominator, b.numerator)

    def __rtruediv__(self, other: object) -> Quotient:
        return Quotient.of(other) / self

    @property
    def variables(self) -> set[str]:
        """The names that occur, without pi."""
        return self.numerator.variables | self.denominator.variables


def over(numerator: Polynomial, denominator: Polynomial) -> Quotient:
    """Return a quotient without a monomial that divides all terms of both."""
    if not denominator:
        raise BadInput("a denominator is zero")
    monomials = [dict(m) for q in (numerator, denominator) for m in q.terms]
    common = monomials[-1].keys() if numerator else ()
    shared = tuple((name, -min(m.get(name, 0) for m in monomials)) for name in sorted(common))
    factor = Polynomial({_product((), shared): Fraction(1)})
    top, bottom = numerator * factor, denominator * factor
    if bottom.is_number and len(bottom.terms) == 1:
        return Quotient(top / bottom, ONE)
    return Quotient(top, bottom) if top else Quotient(ZERO, ONE)


def variable(name: str) -> Polynomial:
    """Return a variable, or the number pi."""
    return Polynomial({((name, 1),): Fraction(1)})


def variables(names: str) -> tuple[Polynomial, ...]:
    """Return the variables whose names stand in a string, with spaces between them."""
    return tuple(map(variable, names.split()))


ZERO, ONE = Polynomial({}), Polynomial({(): Fraction(1)})


def _is_symbolic(value: object) -> bool:
    """Return whether sympy made a value; it is not loaded here."""
    return type(value).__module__.partition(".")[0] == "sympy"


def _product(left: Monomial, right: Monomial) -> Monomial:
    """Return the product of two monomials."""
    powers = dict(left)
    for name, k in right:
        powers[name] = powers.get(name, 0) + k
    return tuple(sorted((name, k) for name, k in powers.items() if k))


def _term(
    monomial: Monomial, c: Fraction, values: Mapping[str, Any], constant: Callable[[Fraction], Any]
) -> Any:
    """Return the value of a term; a factor of 1 is left out."""
    top = [values[name] for name, k in monomial for _ in range(k)]
    bottom = [values[name] for name, k in monomial for _ in range(-k)]
    factors = [constant(c), *top] if c != 1 or not top else top
    product = reduce(mul, factors)
    return product / reduce(mul, bottom) if bottom else product


def _shown(monomial: Monomial, c: Fraction) -> str:
    """Return a term for people."""
    powers = [name if k == 1 else f"{name}^{k}" for name, k in monomial]
    return " ".join(powers if c == 1 and powers else [str(c), *powers])
