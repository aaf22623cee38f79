"""What the functions of the checker compute while certificates are checked, as digests.

    python tests/checker/computed.py [CERTIFICATE...]

records them anew in computed.json, with those of further certificates.

A slip of the hand that leaves every verdict as it was (a bound rounded the other way, a unit that
is forgotten, an end for the other) changes some number on the way, and with it the digest of a
module.  A change that is meant is recorded anew; the difference of the file names the modules in
which numbers changed, and no other should.

A function is asked at its first calls, then ever more rarely: what it returns or yields, and what
its variables hold then.  Some certificates are rejected in the end: small ones, of long proofs.
Cosines, angles, logarithms and lengths in doubles, which libraries round differently and the
checker takes for guesses, are rounded correctly meanwhile.
"""

import inspect
import json
import math
import re
import sys
from collections import defaultdict
from contextlib import suppress
from fractions import Fraction
from functools import cached_property, wraps
from hashlib import sha256
from importlib import import_module
from itertools import count
from pathlib import Path
from pkgutil import walk_packages
from types import FunctionType, GeneratorType

import pytest
from flint import arb

from cap import checker
from cap.checker import verdict
from cap.checker.kernel.rejection import Rejected
from cap.checker.system import own
from cap.sets.interval import workprec

ROOT = Path(__file__).parents[2]
KEPT = Path(__file__).with_suffix(".json")
HOME = Path(checker.__file__).parent
FIRST = 32  # calls of a function that are all noted; after these, each power of two
HASHED = "__hash__", "__eq__", "_hash"  # not the same in two processes
STATE = "_known", "_done"  # of modules: not constant
DEEP = 2  # an object in an object, so many times
BITS = 120
PLAIN = bool, int, float, str, bytes, Fraction, re.Pattern


def kept():
    """Return the digests that are recorded: of constants, and those by path of a certificate."""
    return json.loads(KEPT.read_text("ascii"))


def digests(path):
    """Return a digest for each module of the checker that the check of a certificate runs."""
    found = defaultdict(sha256)
    with suppress(Rejected), pytest.MonkeyPatch.context() as patch:
        round_correctly(patch)
        patch.setattr(own, "_known", {})
        note_what_is_computed(patch, found)
        verdict.check((ROOT / path).read_bytes(), lambda _: None)
    return {name: found[name].hexdigest()[:12] for name in sorted(found)}


def constants():
    """Return a digest for each module of its constants, with those of classes, and of defaults.

    Margins for rounding and bounds of work are among them, on which few verdicts depend.
    """
    return {
        name: sha256("".join(sorted(_constants(module))).encode()).hexdigest()[:12]
        for name, module in modules()
    }


def _constants(module):
    """Give each constant of a module as a line."""
    for holder in (module, *_classes(module)):
        for name, value in vars(holder).items():
            f = inspect.unwrap(getattr(value, "__func__", value))
            if isinstance(f, FunctionType) and f.__module__ == module.__name__:
                yield f"{name} {told((f.__defaults__, f.__kwdefaults__), DEEP)}\n"
            elif not name.startswith("__") and name not in STATE and _is_data(value):
                yield f"{name} {told(value, DEEP)}\n"


def _is_data(value):
    """Return whether a value consists of numbers and words."""
    kind = type(value)
    return kind.__module__.startswith("cap.") or kind in (*PLAIN, tuple, list, dict, set, frozenset)


def modules():
    """Give the modules of the checker after their names in it."""
    for each in walk_packages(checker.__path__, "cap.checker."):
        yield each.name.removeprefix("cap.checker."), import_module(each.name)


def note_what_is_computed(patch, found):
    """Let the functions and methods of the checker note what they compute."""
    known = {}

    def noted(f):
        if isinstance(f, staticmethod | classmethod):
            return type(f)(noted(f.__func__))
        if isinstance(f, property):
            return property(noted(f.fget))
        if isinstance(f, cached_property):
            f, name = cached_property(noted(f.func)), f.attrname
            f.__set_name__(None, name)
            return f
        if f not in known:
            getattr(f, "cache_clear", int)()
            known[f] = noting(f, found)
        return known[f]

    holders = {id(each): each for _, module in modules() for each in (module, *_classes(module))}
    for holder in holders.values():
        for name, value in list(vars(holder).items()):
            if name not in HASHED and _is_function(value):
                patch.setattr(holder, name, noted(value))


def _classes(module):
    """Give the classes of a module."""
    for each in vars(module).values():
        if isinstance(each, type) and each.__module__ == module.__name__:
            yield each


def _is_function(value):
    """Return whether a value is a function of the checker, or made of one."""
    for inner in ("__func__", "fget", "func", "__wrapped__"):
        value = getattr(value, inner, value) if not isinstance(value, FunctionType) else value
    return isinstance(value, FunctionType) and Path(value.__code__.co_filename).is_relative_to(HOME)


def noting(f, found):
    """Return a function that notes what f returns or yields, and its variables when it returns."""
    calls, code = count(1), inspect.unwrap(f).__code__
    module = f.__module__.removeprefix("cap.checker.")

    def note(value, /, **variables):
        held = [f"{name}={told(variables[name], DEEP - 1)}" for name in sorted(variables)]
        found[module].update(f"{f.__qualname__} {told(value, DEEP)} {' '.join(held)}".encode())

    def traced(frame, event, value):
        if event == "return" and frame.f_code is code:
            note(value, **frame.f_locals)

    def yielded(values):
        for each in values:
            note(each)
            yield each

    @wraps(f)
    def g(*arguments, **options):
        n, before = next(calls), sys.getprofile()
        asked = n <= FIRST or not n & (n - 1)
        if not asked and before is None:
            return f(*arguments, **options)
        sys.setprofile(traced if asked else None)
        try:
            value = f(*arguments, **options)
        finally:
            sys.setprofile(before)
        return yielded(value) if asked and isinstance(value, GeneratorType) else value

    return g


def told(value, deep):
    """Return numbers, and what objects hold, as text: the same for equal values."""
    kind = type(value)
    if value is None or kind in PLAIN:
        return repr(value)
    if isinstance(value, tuple | list):
        return f"{kind.__name__}({','.join([told(each, deep) for each in value])})"
    if isinstance(value, dict):
        pairs = [f"{told(key, deep)}:{told(each, deep)}" for key, each in value.items()]
        return f"{{{','.join(pairs)}}}"
    if isinstance(value, set | frozenset):
        return f"{{{','.join(sorted(told(each, deep) for each in value))}}}"
    if deep == 0 or callable(value) or not kind.__module__.startswith("cap."):
        return kind.__name__
    slots = [name for each in kind.__mro__ for name in getattr(each, "__slots__", ())]
    fields = {name: getattr(value, name) for name in slots if hasattr(value, name)}
    fields |= getattr(value, "__dict__", {})
    return kind.__name__ + "".join(
        f" {k}={told(fields[k], deep - 1)}" for k in sorted(fields.keys() - HASHED)
    )


def round_correctly(patch):
    """Let functions of doubles that libraries round differently have one value on every machine."""

    def rounded(function):
        def nearest(*x):
            with workprec(BITS):
                return float(function(*map(arb, x)).mid())

        return nearest

    for name in ("cos", "sin", "acos", "asin", "atan2"):
        patch.setattr(math, name, rounded(getattr(arb, name)))
    patch.setattr(math, "log2", rounded(lambda x: x.log_base(2)))
    patch.setattr(math, "hypot", rounded(lambda *x: sum(a * a for a in x).sqrt()))


if __name__ == "__main__":
    paths = sorted({*kept()["certificates"], *sys.argv[1:]})
    found = {"constants": constants(), "certificates": {path: digests(path) for path in paths}}
    KEPT.write_text(json.dumps(found, indent=1) + "\n", "ascii")
