"""What the functions of the checker return while certificates are checked, as digests.

    python tests/checker/computed.py [CERTIFICATE...]

records them anew in computed.json, with those of further certificates.

A slip of the hand that leaves every verdict as it was (a bound rounded the other way, a unit that
is forgotten, an end for the other) changes some number on the way, and with it the digest of a
module.  A change that is meant is recorded anew; the difference of the file names the modules in
which numbers changed, and no other should.

A function is asked at its first calls, then ever more rarely; one that returns nothing, for what
its arguments hold then.  Some certificates are rejected in the end: small ones, of long proofs.
Cosines and lengths in doubles, which libraries round differently and the checker takes for guesses,
are rounded correctly meanwhile.
"""

import json
import math
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
from types import FunctionType

import pytest
from flint import arb

from cap import checker
from cap.checker import verdict
from cap.checker.kernel.rejection import Rejected
from cap.sets.interval import workprec

ROOT = Path(__file__).parents[2]
KEPT = Path(__file__).with_suffix(".json")
HOME = Path(checker.__file__).parent
FIRST = 32  # calls of a function that are all noted; after these, each power of two
HASHED = "__hash__", "__eq__", "_hash"  # not the same in two processes
DEEP = 2  # an object in an object, so many times
BITS = 120


def kept():
    """Return the digests that are recorded, by the path of the certificate and the module."""
    return json.loads(KEPT.read_text("ascii"))


def digests(path):
    """Return a digest for each module of the checker that the check of a certificate runs."""
    found = defaultdict(sha256)
    with suppress(Rejected), pytest.MonkeyPatch.context() as patch:
        round_correctly(patch)
        note_what_is_returned(patch, found)
        verdict.check((ROOT / path).read_bytes(), lambda _: None)
    return {name: found[name].hexdigest()[:12] for name in sorted(found)}


def note_what_is_returned(patch, found):
    """Let the functions and methods of the checker note what they return."""
    names = [each.name for each in walk_packages(checker.__path__, "cap.checker.")]
    modules, known = [import_module(name) for name in names], {}

    def noting(f):
        if isinstance(f, staticmethod | classmethod):
            return type(f)(noting(f.__func__))
        if isinstance(f, property):
            return property(noting(f.fget))
        if isinstance(f, cached_property):
            f, name = cached_property(noting(f.func)), f.attrname
            f.__set_name__(None, name)
            return f
        if f not in known:
            getattr(f, "cache_clear", int)()
            known[f] = _noting(f, found)
        return known[f]

    holders = {id(each): each for module in modules for each in (module, *_classes(module))}
    for holder in holders.values():
        for name, value in list(vars(holder).items()):
            if name not in HASHED and _is_function(value):
                patch.setattr(holder, name, noting(value))


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


def _noting(f, found):
    """Return a function that notes what f returns."""
    calls, module = count(1), f.__module__.removeprefix("cap.checker.")

    @wraps(f)
    def g(*arguments, **options):
        value = f(*arguments, **options)
        n = next(calls)
        if n <= FIRST or not n & (n - 1):
            text = told(arguments if value is None else value, DEEP)
            found[module].update(f"{f.__qualname__} {text}".encode())
        return value

    return g


def told(value, deep):
    """Return numbers, and what objects hold, as text: the same for equal values."""
    kind = type(value)
    if value is None or kind in (bool, int, float, str, bytes, Fraction):
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
    """Let cosines, sines, angles and lengths of doubles be those on every machine."""

    def rounded(function):
        def nearest(*x):
            with workprec(BITS):
                return float(function(*map(arb, x)).mid())

        return nearest

    for name in ("cos", "sin", "atan2"):
        patch.setattr(math, name, rounded(getattr(arb, name)))
    patch.setattr(math, "hypot", rounded(lambda *x: sum(a * a for a in x).sqrt()))


if __name__ == "__main__":
    found = {path: digests(path) for path in sorted({*kept(), *sys.argv[1:]})}
    KEPT.write_text(json.dumps(found, indent=1) + "\n", "ascii")
