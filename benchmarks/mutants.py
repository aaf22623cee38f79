"""Mutants: copies of a module with one small error each, as `mutation.py` needs them.

A mutant replaces one piece of the source by another: a comparison weakened or turned round, `and`
by `or`, a statement dropped, lower and upper ends exchanged, a bound off by one unit, an interval
collapsed to its midpoint, the first or last round of a loop left out.  What is only said
(docstrings, messages, steps, annotations) is left as it is.
"""

from __future__ import annotations

import ast
from ast import unparse
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import accumulate
from pathlib import Path
from typing import NamedTuple

COMPARISONS = {
    ast.Lt: ("<", "<=", ">="),
    ast.LtE: ("<=", "<", ">"),
    ast.Gt: (">", ">=", "<="),
    ast.GtE: (">=", ">", "<"),
    ast.Eq: ("==", "!="),
    ast.NotEq: ("!=", "=="),
    ast.Is: ("is", "is not"),
    ast.IsNot: ("is not", "is"),
    ast.In: ("in", "not in"),
    ast.NotIn: ("not in", "in"),
}
OPERATORS = {ast.Add: "-", ast.Sub: "+", ast.Mult: "/", ast.Div: "*", ast.Pow: "*"}
FLOORS = {ast.FloorDiv: "//", ast.RShift: ">>"}
_PAIRS = ["min max", "all any", "floor ceil", "_low _high", "lower upper", "lo hi", "centre box"]
_PAIRS += ["cos sin", "l r", "lies_in lies_inside"]
OPPOSITE = {a: b for pair in map(str.split, _PAIRS) for a, b in (pair, pair[::-1])}
TESTS = ("is_positive", "is_before", "contains_zero", "is_between_walls", "startswith", "contains")
TESTS += ("lies_in", "lies_inside", "_lies_in", "is_met")
DROPPED = ("magnitude", "square", "sqrt", "midpoint", "range", "bound", "abs", "sorted", "inverse")
CHOICES = ("min", "max", "_hull", "hull", "intersection", "tightened")
RETURNS = {"bool": ("True", "False"), "Interval": ("({}).midpoint()",)}
WORDS = ("step", "Rejected")  # calls of which the arguments are only said
Change = tuple[ast.AST, str]
Changes = Callable[[ast.AST], Iterator[Change]]


class Mutant(NamedTuple):
    """A module in which the characters from start to end become this text.

    ``line`` is the first one of the statement, ``where`` names class and function.
    """

    module: str
    line: int
    where: str
    name: str
    start: int
    end: int
    text: str

    def source(self, original: str) -> str:
        """Return the source of the mutant."""
        return original[: self.start] + self.text + original[self.end :]


def errors(_tree: ast.Module) -> Changes:
    """Return what gives the changes of a node that are described above."""
    return _changes


def mutants(path: Path, module: str, kinds: Callable[[ast.Module], Changes]) -> list[Mutant]:
    """Return all mutants of a module, each with a name of its own, in the order of the source."""
    source, result, seen = path.read_text(encoding="ascii"), list[Mutant](), Counter[str]()
    offsets = [0, *accumulate(map(len, source.splitlines(keepends=True)))]
    tree = ast.parse(source)
    for where, first, piece, text in _pieces(tree, (), 0, kinds(tree)):
        before = " ".join(unparse(piece).split())
        if text.strip("()") == before.strip("()"):
            continue
        place = ".".join((module.rsplit(".", maxsplit=1)[-1], *where))
        name = f"{place}: {before} -> {text}"
        seen[name] += 1
        ends = [
            offsets[line - 1] + column
            for line, column in (
                (piece.lineno, piece.col_offset),
                (piece.end_lineno, piece.end_col_offset),
            )
        ]
        name += f" ({seen[name]})" if seen[name] > 1 else ""
        result.append(Mutant(module, first, place, name, *ends, text))
    return result


def marked(path: Path) -> ast.Module:
    """Return a module that notes, before each statement in a function, (path, line) in SEEN."""
    tree = ast.parse(path.read_text(encoding="ascii"))
    for node in [n for n in ast.walk(tree) if not isinstance(n, ast.Module | ast.ClassDef)]:
        for field in ("body", "orelse", "finalbody"):
            statements = getattr(node, field, None)
            if isinstance(statements, list):
                marks = [f"SEEN.add(({str(path)!r}, {s.lineno}))" for s in statements]
                pairs = zip((ast.parse(mark).body[0] for mark in marks), statements, strict=True)
                setattr(node, field, [part for pair in pairs for part in pair])
    return tree


def _pieces(
    node: ast.AST, where: tuple[str, ...], first: int, changes: Changes
) -> Iterator[tuple[tuple[str, ...], int, ast.AST, str]]:
    """Give (names of class and function, first line, piece, its other text) of all changes."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        where = (*where, node.name)
    first = node.lineno if isinstance(node, ast.stmt) else first
    for piece, text in dict.fromkeys(changes(node)):
        yield where, first, piece, text
    for child in _inner(node):
        yield from _pieces(child, where, first, changes)


def _inner(node: ast.AST) -> Iterator[ast.AST]:
    """Give the parts of a node in which an error matters."""
    called, skipped = _called(node), {"annotation", "returns", "decorator_list", "args"}
    if called in WORDS or isinstance(node, ast.JoinedStr | ast.Import | ast.ImportFrom):
        return
    if isinstance(node, ast.Call):
        skipped = {"keywords"} if called in ("zip", "PeriodMap") else set()
    for field, value in ast.iter_fields(node):
        if field not in skipped:
            parts = value if isinstance(value, list) else [value]
            parts = parts[:1] if called == "need" and field == "args" else parts
            yield from (part for part in parts if isinstance(part, ast.AST))


def _called(node: ast.AST) -> str:
    """Return the name of what is called, or nothing."""
    f = node.func if isinstance(node, ast.Call) else None
    return f.attr if isinstance(f, ast.Attribute) else f.id if isinstance(f, ast.Name) else ""


def _changes(node: ast.AST) -> Iterator[Change]:
    """Give a piece of a node, or the node, and what may stand in its place."""
    match node:
        case ast.FunctionDef(returns=ast.AST() as kind) if unparse(kind) in RETURNS:
            for part in ast.walk(node):
                if isinstance(part, ast.Return):
                    value = unparse(part.value)
                    yield from ((part.value, t.format(value)) for t in RETURNS[unparse(kind)])
        case ast.If() | ast.While():
            yield from ((node.test, text) for text in ("True", "False"))
        case ast.For() | ast.comprehension():
            yield from (
                (node.iter, f"list({unparse(node.iter)}){cut}") for cut in ("[1:]", "[:-1]")
            )
            yield from ((condition, "True") for condition in getattr(node, "ifs", ()))
        case ast.Expr() if isinstance(node.value, ast.Call) and _called(node.value) != "step":
            yield node, "pass"
        case ast.AugAssign() | ast.Raise() | ast.Continue() | ast.Break():
            yield node, "pass"
        case ast.Attribute() | ast.Name() | ast.Constant():
            yield from ((node, text) for text in _atoms(node))
        case ast.expr():
            yield from ((node, f"({text})") for text in _expressions(node))


def _atoms(node: ast.Attribute | ast.Name | ast.Constant) -> Iterator[str]:
    """Give names and numbers that may stand in the place of one."""
    match node:
        case ast.Attribute(attr=name) if name in OPPOSITE:
            yield f"{unparse(node.value)}.{OPPOSITE[name]}"
        case ast.Name(id=name) if name in OPPOSITE and len(name) > 2:
            yield OPPOSITE[name]
        case ast.Constant(value=bool()):
            yield str(not node.value)
        case ast.Constant(value=int()):
            yield from (f"({node.value + side})" for side in (1, -1))


def _expressions(node: ast.expr) -> Iterator[str]:
    """Give expressions that may stand in the place of one made of others."""
    match node:
        case ast.IfExp():
            yield from (unparse(node.body), unparse(node.orelse))
        case ast.Compare():
            yield from _comparisons(node)
        case ast.BoolOp():
            this, other = ("and", "or") if isinstance(node.op, ast.And) else ("or", "and")
            parts = [f"({unparse(value)})" for value in node.values]
            yield f" {other} ".join(parts)
            yield from (f" {this} ".join(parts[:n] + parts[n + 1 :]) for n in range(len(parts)))
        case ast.BinOp() if not _is_text(node.left):
            yield from _sums(node.op, f"({unparse(node.left)})", f"({unparse(node.right)})")
        case ast.UnaryOp(operand=inner):
            yield unparse(inner)
            if isinstance(inner, ast.BinOp) and type(inner.op) in FLOORS:  # rounded down
                yield f"-({unparse(inner.left)}) {FLOORS[type(inner.op)]} ({unparse(inner.right)})"
        case ast.Call():
            yield from _calls(node)


def _sums(op: ast.operator, a: str, b: str) -> Iterator[str]:
    """Give what may stand in the place of a sum, a product, a quotient."""
    if type(op) in OPERATORS and not {a, b} & {"(s)", "(-s)", "(side)", "(sign)"}:  # they are +-1
        yield f"{a} {OPERATORS[type(op)]} {b}"
    if isinstance(op, ast.Add | ast.Sub | ast.Mult):
        yield from (a, b)
    if type(op) in FLOORS:
        yield f"-(-{a} {FLOORS[type(op)]} {b})"  # rounded up


def _is_text(node: ast.expr) -> bool:
    """Return whether an expression is a string."""
    return isinstance(node, ast.JoinedStr) or isinstance(getattr(node, "value", None), str)


def _comparisons(node: ast.Compare) -> Iterator[str]:
    """Give comparisons that are weaker, stronger, opposite or only a part."""
    sides = [f"({unparse(side)})" for side in (node.left, *node.comparators)]
    words = [COMPARISONS[type(op)][0] for op in node.ops]

    def joined(words: list[str], sides: list[str]) -> str:
        return " ".join([sides[0], *(f"{w} {s}" for w, s in zip(words, sides[1:], strict=True))])

    for n, op in enumerate(node.ops):
        for other in COMPARISONS[type(op)][1:]:
            yield joined([*words[:n], other, *words[n + 1 :]], sides)
    if len(words) > 1:
        yield from (joined(words[1:], sides[1:]), joined(words[:-1], sides[:-1]))


def _calls(node: ast.Call) -> Iterator[str]:
    """Give what may stand in the place of a call."""
    name, given = _called(node), [unparse(a) for a in node.args]
    owner = [unparse(node.func.value)] if isinstance(node.func, ast.Attribute) else []
    if name in TESTS:
        yield from ("True", "False")
    if name in DROPPED and len(owner + given) == 1:
        yield (owner + given)[0]
    if name in CHOICES and len(owner + given) > 1:
        yield from owner + given
    if name == "isqrt":
        yield f"{unparse(node)} + 1"
    if name == "range" and given and not isinstance(node.args[-1], ast.Constant):
        yield from (f"range({', '.join(given)} {side} 1)" for side in "+-")
