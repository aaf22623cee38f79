"""A system as source of one compiled function that follows its orbits in doubles.

Each mode is a block of straight-line code.  Numbers of the model are arguments, by place: another
value of a parameter is not compiled again.  A guard, or a derivative of it, that is zero after an
event by an identity of polynomials is zero there, whatever rounding says: so the next event is
never decided by a tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction

import numpy as np

from cap.floats.models.identities import (
    ORDERS,
    identities,
    orders,
    resting,
    restitution,
    split,
)
from cap.floats.models.spectrum import BITS, Exponential, Floats, exponential, number
from cap.sets import interval
from cap.sets.interval import Ball
from cap.system.lemmas import Clocked, Falls, Lemma, clock_part, lemmas
from cap.system.model import Guard, System
from cap.system.polynomial import COS, ONE, PI, SIN, ZERO, Polynomial, Quotient

SIMULTANEOUS, NO_MODE, MANY = 1, 2, 4
"""Bits of flags: two events within `CLOSE`; no mode after an event; too many events in a period."""
CLOSE, NEGATIVE, SOON = 1e-13, -1e-9, 1e-6
SOLVERS = "first", "decreasing", "clocked"
KINDS = {"T": "imaginary", "I": "imaginary", "R": "real", "C": "remainder"}  # R(z d) of rates
IMPORTS = """\
from numba import njit

from cap.floats.models.roots import captures, clocked_of, decreasing_of, first_of
from cap.floats.models.roots import imaginary, real, remainder, turned
"""
HEAD = f'''"""Made from a model by `cap.floats.models.source`."""

import math

{IMPORTS}
TURN, CLOSE, NEGATIVE, SOON = 2 * math.pi, {CLOSE}, {NEGATIVE}, {SOON}
SIMULTANEOUS, NO_MODE, MANY = {SIMULTANEOUS}, {NO_MODE}, {MANY}
'''
FOLLOW = '''

def follow(K, starts, modes, phase, periods, most, ends, last, counts, flags, log, path):
    """Follow orbits; the arrays from ``ends`` on are written, and how many lines of ``log``."""
'''


class Source:
    """``text``; the ``numbers`` K; the names of ``modes``, and ``words``, which count events."""

    def __init__(self, system: System) -> None:
        self.system = system
        self.modes = tuple(system.modes)
        self.words = tuple(dict.fromkeys(n for m in system.modes.values() for n in m.guards))
        self._numbers: list[float] = []
        self._y = (*(f"y{i}" for i in range(len(system.state))), "c", "s", "1.0")
        self._after = (*(f"f{i}" for i in range(len(system.state))), "c", "s", "1.0")
        self._along: dict[str, str] = {}
        self.exponentials: list[Exponential] = []  # of the modes
        blocks = [line for k in range(len(self.modes)) for line in self._mode(k)]
        self.text = self._driver(blocks)

    @property
    def numbers(self) -> Floats:
        """K: what is constant in the text is not among them."""
        return np.array(self._numbers or [0.0])

    def _number(self, value: float) -> str:
        self._numbers.append(value)
        return f"k{len(self._numbers) - 1}"

    def _dot(self, row: Sequence[float], names: Sequence[str]) -> str:
        """Return the source of a scalar product; factors 0, 1 and -1 are not written."""
        terms = []
        for value, name in zip(row, names, strict=True):
            if value in (1.0, -1.0):
                terms.append(f"{'-' if value < 0 else '+'} {name}")
            elif value:
                terms.append(f"+ {self._number(value)}" + (f" * {name}" if name != "1.0" else ""))
        return " ".join(terms).removeprefix("+ ") or "0.0"

    def _value(self, q: Polynomial | Quotient, names: Sequence[str]) -> str:
        """Return the source of a polynomial, or of a quotient, of y."""
        if isinstance(q, Quotient):
            top = self._value(q.numerator, names)
            below = q.denominator
            return top if below == ONE else f"({top}) / ({self._value(below, names)})"
        known = dict(zip((*self.system.state, COS, SIN), names, strict=False))
        parts: dict[tuple[str, ...], Polynomial] = {}
        for monomial, c in q.terms.items():
            factors = tuple(known[n] for n, k in monomial if n != PI for _ in range(k))
            powers = tuple((n, k) for n, k in monomial if n == PI)
            parts[factors] = parts.get(factors, ZERO) + Polynomial({powers: c})
        written = []
        for factors, part in parts.items():
            value = float(number(part))
            sign, size = ("-", 1.0) if value == -1 else ("+", value)
            whole = [*([self._number(size)] if size != 1 or not factors else []), *factors]
            written.append(f"{sign} {' * '.join(whole)}")
        return " ".join(written).removeprefix("+ ") or "0.0"

    def _mode(self, k: int) -> Iterator[str]:
        """Yield the block of a mode: its next event, the flight up to it, the reset."""
        name = self.modes[k]
        guards = self.system.modes[name].guards
        E = exponential(self.system, name)
        self.exponentials.append(E)
        omega = float(number(self.system.omega))
        letters = kinds(E, omega)
        self._along[letters] = along(letters)
        rates = [self._number(part) for z in E.rates for part in (z.real, z.imag)]
        yield f"{'if' if k == 0 else 'elif'} m == {k}:  # {name}"
        yield f"    rates = ({', '.join(rates)},)"
        for word, lemma in lemmas(
            self.system, name
        ).items():  # a guard after those that it falls with
            yield from self._next(E, letters, name, word, lemma)
        yield "    d = D"
        for j, letter in enumerate(letters):
            x, y = rates[2 * j : 2 * j + 2]
            moved = (
                f"turned({y} * d, turn)" if letter == "T" else f"{KINDS[letter]}({x} * d, {y} * d)"
            )
            yield f"    u{j}, v{j} = {moved}"
        n = len(self.system.state)
        for i in range(n):
            yield f"    f{i} = y{i}" + self._moved(E, i)
        yield "    " + "; ".join(f"y{i} = f{i}" for i in range(n))
        yield "    if best < 0:"
        yield "        break"
        yield "    t += D"
        turning = letters.find("T")
        yield "    angle = w * D"  # the clock: from its angle at the begin of each period
        cosine = "imaginary(0.0, angle)" if turning < 0 else f"u{turning}, v{turning}"
        yield f"    p, q = {cosine}"
        yield "    p, q = p + 1 - angle * angle / 2, q + angle"
        yield "    c, s = c * p - s * q, s * p + c * q"
        for g, (word, guard) in enumerate(guards.items()):
            yield f"    {'if' if g == 0 else 'elif'} best == {g}:  # {word}"
            yield from (f"        {line}" for line in self._event(name, word, guard))

    def _next(
        self, E: Exponential, letters: str, mode: str, word: str, lemma: Lemma
    ) -> Iterator[str]:
        """Yield the code that asks when a guard comes to zero, before D."""
        g = list(self.system.modes[mode].guards).index(word)
        row, curved = split(self.system, mode, word)
        rows, h = E.rows(row), self.system.guard(mode, word).value
        fall, least = fall_angle(h), least_angle(lemma)
        for order in ORDERS:
            value = self._value(h, self._y) if curved else self._dot(rows[order], self._y)
            yield f"    a{order} = {value}"
            h = self.system.lie(mode, h)
            yield f"    if zeros & {1 << (3 * g + order)}:"
            yield f"        a{order} = 0.0"
        if fall is not None:
            yield f"    ahead = {self._number(fall)} - begin - w * t"
            yield "    while ahead < -CLOSE:"
            yield "        ahead += TURN"
            yield "    now = a0 <= 0 and (a1 < 0 or (a1 == 0 and a2 < 0))"
            yield "    d = 0.0 if now else max(ahead, 0.0) / w"
        else:
            solver, more = "decreasing" if isinstance(lemma, Falls) else "first", ""
            if least is not None:
                solver, more = "clocked", ", (ahead / w, span, (p, q))"
                yield f"    ahead = {self._number(least)} - begin - w * t"
                yield f"    while ahead < (SOON if zeros & {2 << 3 * g} else 0.0):"
                yield "        ahead += TURN"
                there = least if math.isfinite(least) else 0.0  # it is not looked at
                cosine, sine = (self._number(f(there)) for f in (math.cos, math.sin))
                yield f"    p, q = {cosine} * c + {sine} * s, {sine} * c - {cosine} * s"
            parts = ", ".join(["a0, a1, a2", *(self._dot(row, self._y) for row in rows[3:])])
            yield f"    d = {solver}_{letters}(({parts}), rates, D, turn{more})"
        yield "    if d <= D + CLOSE and best >= 0 and abs(d - D) <= CLOSE:"
        yield "        flags[o] |= SIMULTANEOUS"
        yield "    if d < D:"
        yield f"        D, best, turn = d, {g}, (math.nan, math.nan)"

    def _moved(self, E: Exponential, i: int) -> str:
        """Return the source of what a flight adds to a variable."""
        linear, square = self._dot(E.first[i], self._y), self._dot(E.second[i], self._y)
        parts = [] if linear == "0.0" else [f"d * ({linear})"]
        parts += [] if square == "0.0" else [f"d * d * 0.5 * ({square})"]
        for j in range(len(E.rates)):
            for basis, P in ((f"u{j}", E.real[j]), (f"v{j}", E.imaginary[j])):
                factor = self._dot(P[i], self._y)
                parts += [] if factor == "0.0" else [f"({factor}) * {basis}"]
        return "".join(f" + {part}" for part in parts)

    def _event(self, mode: str, word: str, guard: Guard) -> Iterator[str]:
        """Yield the reset, and the choice of the next mode."""
        reset = self.system.reset(mode, word)
        for i, z in enumerate(self.system.state):
            yield f"f{i} = {self._value(reset[z], self._y)}"
        yield f"counts[o, {self.words.index(word)}] += 1"
        zeros = [identities(self.system, mode, word, to) for to in guard.to]
        for n, to in enumerate(guard.to):
            asked = ORDERS if len(guard.to) > 1 else ORDERS[:1]  # what falls from 0 happens, too
            tests = [self._sign(to, g, zeros[n], asked) for g in self.system.modes[to].guards]
            signs = ", ".join(filter(None, tests))
            yield f"fits{n} = min({signs}, math.inf)" if signs else f"fits{n} = math.inf"
        best = ", ".join(f"fits{n}" for n in range(len(guard.to)))
        yield f"most_fitting = max({best}, NEGATIVE)"
        yield "if most_fitting == NEGATIVE:"
        yield "    flags[o] |= NO_MODE"
        yield "    break"
        for n, to in enumerate(guard.to):
            yield f"{'if' if n == 0 else 'elif'} most_fitting == fits{n}:"
            yield from (f"    {line}" for line in self._enter(mode, word, to, zeros[n]))
        yield "; ".join(f"y{i} = f{i}" for i in range(len(self.system.state)))

    def _sign(self, mode: str, word: str, zeros: dict[str, int], asked: Sequence[int]) -> str:
        """Return h just after an event, or its first derivative that is no identical zero."""
        h = self.system.guard(mode, word).value
        for order in asked:
            if order not in orders(zeros[word]):
                return self._value(h, self._after)
            h = self.system.lie(mode, h)
        return ""

    def _enter(self, mode: str, word: str, to: str, zeros: dict[str, int]) -> Iterator[str]:
        """Yield how a mode begins; or the end of infinitely many events."""
        guard = self.system.guard(mode, word)
        bits = sum(
            1 << (3 * g + order)
            for g, name in enumerate(self.system.modes[to].guards)
            for order in orders(zeros[name])
        )
        yield f"m, zeros = {self.modes.index(to)}, {bits}"
        yield from self._logged(self.words.index(word))
        e = restitution(self.system, mode, word, to)
        if guard.rest is not None and e is not None:
            yield from self._capture(mode, guard, to, e)

    def _capture(self, mode: str, guard: Guard, to: str, e: Fraction) -> Iterator[str]:
        """Yield the test whether infinitely many events follow at once."""
        h, lie = guard.value, self.system.lie
        speed = self._value(lie(to, h), self._after)
        up, down = (self._value(-lie(k, lie(k, h)), self._after) for k in (to, mode))
        terms = Polynomial({monomial: abs(c) for monomial, c in h.terms.items()})
        size = self._value(terms, [f"abs({z})" for z in self._after])
        yield f"e, size = {self._number(float(e))}, {size}"
        yield f"if captures({speed}, {up}, {down}, e, size):"
        for i, value in enumerate(resting(self.system, mode, guard)):
            yield f"    y{i} = {self._value(value, self._after)}"
        yield "    " + "; ".join(f"f{i} = y{i}" for i in range(len(self.system.state)))
        yield f"    m, zeros = {self.modes.index(str(guard.rest))}, 0"
        yield f"    counts[o, {len(self.words)}] += 1"
        yield from (f"    {line}" for line in self._logged(len(self.words)))

    def _logged(self, word: int) -> Iterator[str]:
        """Yield the code that writes an event down: orbit, time, which; mode and state after it."""
        n = len(self.system.state)
        yield "if lines < len(log):"
        yield f"    log[lines, 0], log[lines, 1], log[lines, 2] = o, period * span + t, {word}"
        yield "    log[lines, 3] = m"
        yield from (f"    log[lines, {4 + i}] = f{i}" for i in range(n))
        yield "    lines += 1"

    def _driver(self, blocks: Sequence[str]) -> str:
        """Return the whole text."""
        n = len(self.system.state)
        w = self._number(float(number(self.system.omega)))
        state = " = ".join(f"y{i}" for i in range(n))
        lines = [
            f"w, span, lines = {w}, TURN / {w}, 0",
            "for o in range(len(starts)):",
            *(f"    y{i} = starts[o, {i}]" for i in range(n)),
            "    m, zeros = modes[o], 0",
            "    for period in range(periods):",
            "        t, begin = 0.0, (phase + period * TURN) % TURN",
            "        c, s = p0, q0 = math.cos(begin), math.sin(begin)",
            "        for event in range(most):",
            "            D, best, turn = span - t, -1, (p0 * c + q0 * s, q0 * c - p0 * s)",
            *(f"            {line}" for line in blocks),
            "        else:",
            "            flags[o] |= MANY",
            "        zeros = 0",
            "        if len(path):",
            *(f"            path[o, period, {i}] = y{i}" for i in range(n)),
            "        if flags[o] & (MANY | NO_MODE):",
            f"            {state} = math.nan",
            "            break",
            *(f"    ends[o, {i}] = y{i}" for i in range(n)),
            "    last[o] = m",
            "return lines",
        ]
        numbers = [f"k{i} = K[{i}]" for i in range(len(self._numbers))]
        body = "\n".join(f"    {line}" for line in [*numbers, *lines])
        return f"{HEAD}{''.join(self._along.values())}{FOLLOW}{body}\n"


def least_angle(lemma: Lemma) -> float | None:
    """Return the angle of the clock in [0, 2 pi) at which a guard is least, by Lemma C.

    inf if it is nowhere least, None if the lemma does not tell: see `cap.orbits.minima`.
    """
    part = clock_part(lemma) if isinstance(lemma, Clocked) and lemma.order == 1 else None
    if part is None or not all(q.is_number for q in part):
        return None
    return _zero_angle(part, -1)


def fall_angle(h: Polynomial) -> float | None:
    """Return the angle of the clock at which a guard that is one of the clock alone falls to zero.

    inf if it never does, None if it is no sum of cos and sin and a number.
    """
    a, b, c = h.derivative(COS), h.derivative(SIN), h.without(COS, SIN)
    if h.variables - {COS, SIN} or not (a.is_number and b.is_number):
        return None
    return _zero_angle((a, b, c), +1)


def _zero_angle(parts: Sequence[Polynomial], side: int) -> float:
    """Return the angle in [0, 2 pi) where a cos + b sin + c is zero and falls, or rises (side -1).

    inf if it is nowhere zero, or touches it.
    """
    with interval.workprec(BITS):
        a, b, c = map(number, parts)
        size = (a * a + b * b).sqrt()
        if not size > abs(c):
            return math.inf
        angle, turn = Ball.atan2(b, a) + side * (-c / size).acos(), 2 * interval.pi()
        return float(angle - turn * math.floor(float(angle / turn)))


def kinds(E: Exponential, omega: float) -> str:
    """Return a letter for each rate: that of the clock, imaginary, real or complex."""
    return "".join(
        "T" if z == 1j * omega else "R" if not z.imag else "C" if z.real else "I" for z in E.rates
    )


def along(kinds: str) -> str:
    """Return the source of what `roots` needs of flights with rates of these kinds."""
    lines = ["h, h1, h2 = a[0] + d * (a[1] + d * a[2] / 2), a[1] + d * a[2], a[2]"]
    value = ["h = a[0] + d * (a[1] + d * a[2] / 2)"]
    for j, kind in enumerate(kinds):
        re, im = f"rates[{2 * j}]", f"rates[{2 * j + 1}]"
        lines += [
            f"p, q, re, im = a[{3 + 2 * j}], a[{4 + 2 * j}], {re}, {im}",
            "x, y = re * d, im * d",
            f"u, v = {KINDS[kind]}(x, y)",
            "h += p * u + q * v",
            "u, v = u + (x * x - y * y) / 2, v + x * y",
            "p, q = p * re + q * im, q * re - p * im",
            "h1 += p * u + q * v",
            "u, v = u + x, v + y",
            "p, q = p * re + q * im, q * re - p * im",
            "h2 += p * u + q * v",
        ]
        known = f"turned({im} * d, turn)" if kind == "T" else f"{KINDS[kind]}({re} * d, {im} * d)"
        value += [f"u, v = {known}", f"h += a[{3 + 2 * j}] * u + a[{4 + 2 * j}] * v"]
    both = _compiled(f"along_{kinds}(a, rates, d)", [*lines, "return h, h1, h2"])
    both += _compiled(f"value_{kinds}(a, rates, d, turn)", [*value, "return h"])
    solvers = [f"{name}_{kinds} = {name}_of(along_{kinds}, value_{kinds})" for name in SOLVERS]
    return "\n".join([both, "", *solvers, ""])


def _compiled(head: str, lines: Sequence[str]) -> str:
    body = "".join(f"    {line}\n" for line in lines)
    return f'\n\n@njit(error_model="numpy", nogil=True)\ndef {head}:\n{body}'
