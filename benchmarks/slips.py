"""Slips: mutants of other kinds than those of `mutants.py`, as a tired author makes them.

Two arguments, two items of a pair or two names that were bound together are exchanged; a bound is
doubled or halved; an end of an interval is replaced by its midpoint, a magnitude by that of the
midpoint, a radius by 0; errors are not added; a divisor, an exponent, an optional argument, the end
of a slice, an assignment that renews a value is forgotten; a difference is turned round; a default,
a branch or an order is the other one; a `need` or a call that only checks is left out.
"""

from __future__ import annotations

import ast
from ast import unparse
from collections import defaultdict
from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise

Change = tuple[ast.AST, str]
_PAIRS = ["e_all e", "cos sin", "first last", "low high", "A B", "T V", "left right", "a b"]
_PAIRS += ["lower upper", "near all", "forward backward", "begin end", "p s"]
OPPOSITE = {a: b for pair in map(str.split, _PAIRS) for a, b in (pair, pair[::-1])}
MODULES = ("q", "line", "math")
WIDENING = ("widened", "moved", "rounded", "hull", "_hull")
ORDERED = ("need", "isinstance", "range", "zip", "min", "max", "Field", "Citation", "Fraction")
NUMBER = int | float


def slips(tree: ast.Module) -> Callable[[ast.AST], Iterator[Change]]:
    """Return what gives pieces of a node, or the node, and what may stand in their place."""
    called = {id(n.func) for n in ast.walk(tree) if isinstance(n, ast.Call)}
    bound = defaultdict[int, list[str]](list)
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            for part, text in _exchanged(node):
                bound[id(part)].append(text)
    return partial(_changes, called=called, bound=bound)


def _exchanged(function: ast.FunctionDef) -> Iterator[Change]:
    """Give names for others that were bound with them, and assignments that may be left out."""
    arguments, siblings = function.args.args, dict[str, str]()
    for one, two in pairwise(arguments):
        if one.annotation and two.annotation and unparse(one.annotation) == unparse(two.annotation):
            siblings[one.arg] = two.arg
    known = {argument.arg for argument in arguments}
    for node in ast.walk(function):
        if isinstance(node, ast.Tuple) and isinstance(node.ctx, ast.Store):
            names = [e.id for e in node.elts if isinstance(e, ast.Name)]
            siblings |= zip(names, names[::-1], strict=True) if len(names) == 2 else ()
    for node in ast.walk(function):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and node.id in siblings:
            yield node, siblings[node.id]
    for statement in function.body:
        if isinstance(statement, ast.Assign):
            parts = (n for target in statement.targets for n in ast.walk(target))
            names = {n.id for n in parts if isinstance(n, ast.Name)}
            if names and names <= known:
                yield statement, "pass"
            known |= names


def _changes(node: ast.AST, called: set[int], bound: dict[int, list[str]]) -> Iterator[Change]:
    yield from ((node, text) for text in bound.get(id(node), ()))
    match node:
        case ast.FunctionDef():
            options = node.args.defaults + [d for d in node.args.kw_defaults if d is not None]
            for default in options:
                yield from ((default, text) for text in _default(default))
        case ast.Expr(value=ast.Call(func=f)) if unparse(f) != "self.step":
            yield node, "pass"
        case ast.AugAssign(op=ast.Add() | ast.Sub() as op):
            sign = "-" if isinstance(op, ast.Add) else "+"
            yield node, f"{unparse(node.target)} {sign}= {unparse(node.value)}"
        case ast.For() | ast.comprehension():
            yield node.iter, f"list({unparse(node.iter)})[::-1]"
            yield from ((test, f"not ({unparse(test)})") for test in getattr(node, "ifs", ()))
        case ast.Attribute(ctx=ast.Load()) if id(node) not in called:
            yield from ((node, text) for text in _attribute(unparse(node.value), node.attr))
        case ast.Constant(value=int() | float() as n) if not isinstance(n, bool):
            yield from ((node, f"({text})") for text in _bounds(n))
        case ast.expr():
            yield from ((node, f"({text})") for text in _expressions(node))


def _default(node: ast.expr) -> Iterator[str]:
    value = getattr(node, "value", None)
    if isinstance(value, bool):
        yield str(not value)
    elif isinstance(value, int | float):
        yield from (str(value + 1), f"({value - 1})")


def _bounds(n: NUMBER) -> Iterator[str]:
    """Give the double and the half; an integer next to it is no news."""
    if isinstance(n, float):
        yield from (repr(2 * n), repr(n / 2))
    else:
        yield from (str(m) for m in (2 * n, n // 2) if abs(m - n) > 1)


def _attribute(owner: str, name: str) -> Iterator[str]:
    if name in ("lower", "upper"):
        yield f"(({owner}).lower / 2 + ({owner}).upper / 2)"
    elif name == "magnitude":
        yield from (f"abs(({owner}).mid)", f"({owner}).upper")
    elif name == "rad":
        yield "0.0"
    elif name == "mid":
        yield from (f"({owner}).lower", f"({owner}).upper")
    elif name in OPPOSITE and owner != "math":
        yield f"{owner}.{OPPOSITE[name]}"


def _expressions(node: ast.expr) -> Iterator[str]:
    """Give expressions that may stand in the place of one made of others."""
    match node:
        case ast.Call():
            yield from _calls(node)
        case ast.BinOp(left=a, op=ast.Add() | ast.Sub(), right=b):
            texts = isinstance(a, ast.JoinedStr) or isinstance(getattr(a, "value", 0), str)
            if not texts:
                yield f"-({unparse(a)}) + ({unparse(b)})"
        case ast.BinOp(left=a, op=ast.Div() | ast.Pow() | ast.FloorDiv()):
            yield unparse(a)
        case ast.IfExp(test=t, body=a, orelse=b):
            yield f"({unparse(b)}) if ({unparse(t)}) else ({unparse(a)})"
        case ast.Tuple(elts=[a, b], ctx=ast.Load()) if not isinstance(a, ast.Starred):
            yield f"{unparse(b)}, {unparse(a)}"
        case ast.Subscript(value=x, slice=ast.Slice(), ctx=ast.Load()):
            yield unparse(x)
        case ast.Subscript(value=x, slice=ast.Constant(value=0), ctx=ast.Load()):
            yield f"{unparse(x)}[-1]"


def _calls(node: ast.Call) -> Iterator[str]:
    """Give what may stand in the place of a call."""
    f, given = node.func, [unparse(a) for a in node.args]
    name = f.attr if isinstance(f, ast.Attribute) else getattr(f, "id", "")
    named = [unparse(k) for k in node.keywords]
    if name not in ORDERED:
        for n in range(len(given) - 1):
            order = [*given[:n], given[n + 1], given[n], *given[n + 2 :]]
            if type(node.args[n]) is type(node.args[n + 1]) is not ast.Starred:
                yield f"{unparse(f)}({', '.join(order + named)})"
        for n in range(len(named)):
            yield f"{unparse(f)}({', '.join(given + named[:n] + named[n + 1 :])})"
    if name in WIDENING:
        owned = isinstance(f, ast.Attribute) and unparse(f.value) not in MODULES
        yield unparse(f.value) if owned else given[0]
    if name in ("all", "any"):
        yield str(name == "all")
    if name == "is_positive" and isinstance(f, ast.Attribute):
        yield f"({unparse(f.value)}).lower + ({unparse(f.value)}).upper > 0"
    if name == "reversed":
        yield given[0]
