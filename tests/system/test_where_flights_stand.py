"""Flights with dry friction are written out in few places, and each of them follows from the data.

A flight is recognised by its terms: a sum of a sine or a cosine and of friction times a duration.
Names tell what these are; a formula with other names is not seen, but those here have these.
"""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CIRCULAR = re.compile(r"(^|_)(sin|cos|sine|cosine)s?(_|\d|$)|^(sin|cos)[A-Z_]", re.IGNORECASE)
FRICTION = re.compile(r"^(alpha|f|phi|drag|a|friction|half|fallen|lost|fall)$")
SUMS = ast.Add, ast.Sub
OF_MODELS, PRODUCTS = ("total", "moved"), ("scaled", "product", "times", "divided", "square")

TESTS = {
    "own": "tests/checker/test_checker_own_formulas.py",
    "closed": "tests/checker/test_checker_written_flights.py",
    "here": "tests/system/test_written_flights.py",
}
PLACES = {  # of flights, with the test that derives them from the model, and its functions
    "cap/checker/system/flight.py": ("own", "test_flights"),
    "cap/checker/flow/free.py": ("own", "test_the_free_velocity"),  # with viscosity
    "cap/checker/strips/ceiling.py": ("own", "test_flights_by_their_times"),  # narrower
    "cap/checker/folded/motion.py": ("closed", "test_folded_flights"),  # models, no operators
    "cap/checker/one_one/closed_form.py": ("closed", "test_closed_form"),  # read without flights
    "cap/checker/one_one/pairs.py": ("closed", "test_least_speeds_of_pairs"),  # the same
    "cap/flow/flight.py": ("here", "test_flights"),
    "cap/areas/folded/laws.py": ("here", "test_folded_flights"),  # models, no operators
    "cap/floats/engine/flight.py": ("here", "test_engine"),  # nothing cancels in it
}
OTHER = {  # what looks like one
    "cap/areas/rings/half_periods.py": "the greatest of sin s - α s",
    "cap/areas/rings/search.py": "the same",
    "cap/checker/tori/segments.py": "the same",
    "cap/maps/inventory.py": "the integral of the positive part of |cos t| - α",
    "cap/checker/particles/mechanics.py": "the force",
    "cap/checker/particles/orbit.py": "the force",
    "cap/floats/engine/events.py": "the jump of a derivative at a hit",
    "cap/floats/search/spanning.py": "a ball on a table: no friction",
    "cap/floats/coverings/planar.py": "a response at a slow time, given to the flight",
    "cap/sets/circular.py": "the series of the cosine",
    "cap/checker/one_one/paper_equation.py": "the paper's equation, and what it has for a velocity",
    "proofs/symmetric.py": "the paper's equation, and what it has for a velocity",
    "proofs/one_one.py": "sympy: derivatives and integrals are taken there",
    "proofs/symplectic_signs.py": "sympy: the integral of the force",
}


def called(node):
    """Return the name of the function that is called, or nothing."""
    if not isinstance(node, ast.Call):
        return ""
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def names(node):
    """Return all names in an expression."""
    inner = ast.walk(node)
    return {getattr(n, "id", getattr(n, "attr", "")) for n in inner}


def terms(node):
    """Return the terms of a sum: of operators, or of the functions of models."""
    if isinstance(node, ast.BinOp) and isinstance(node.op, SUMS):
        return [*terms(node.left), *terms(node.right)]
    if isinstance(node, ast.UnaryOp):
        return terms(node.operand)
    if called(node) in OF_MODELS:
        return [term for inner in node.args for term in terms(inner)]
    return [node]


def circular(term):
    """Return whether there is a sine or a cosine."""
    return any(map(CIRCULAR.search, names(term)))


def slowing(term):
    """Return whether it is friction times something, and no sine."""
    product = any(
        (isinstance(n, ast.BinOp) and isinstance(n.op, ast.Mult)) or called(n) in PRODUCTS
        for n in ast.walk(term)
    )
    return product and not circular(term) and any(map(FRICTION.search, names(term)))


def flights(source):
    """Return the lines on which a flight seems to be written out."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        if (isinstance(node, ast.BinOp) and isinstance(node.op, SUMS)) or called(node) in OF_MODELS:
            parts = terms(node)
            if any(map(circular, parts)) and any(map(slowing, parts)):
                found.add(node.lineno)
    return found


def test_flights_stand_in_nine_files():
    """All that looks like a flight is in one of these, or named as something else."""
    files = [p for top in ("cap", "proofs") for p in (ROOT / top).rglob("*.py")]
    inside = [p.relative_to(ROOT).as_posix() for p in files if "audit" not in p.parts]
    found = {name for name in inside if flights((ROOT / name).read_text("utf-8"))}
    found = {name for name in found if not name.startswith("cap/proofs/")}  # a link
    assert sorted(found - PLACES.keys() - OTHER.keys()) == []
    assert sorted(OTHER.keys() - found) == []
    assert len(PLACES) == 9


@pytest.mark.parametrize("place", PLACES)
def test_each_is_derived(place):
    """The test that is named is there, and imports the module."""
    path, function = PLACES[place]
    source = (ROOT / TESTS[path]).read_text("utf-8")
    module = place.removesuffix(".py").replace("/", ".")
    imported = {
        f"{node.module}.{alias.name}" if source.count(f"{node.module} import") else node.module
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    assert any(name == module or name.startswith(f"{module}.") for name in imported), imported
    assert f"def {function}(" in source


@pytest.mark.parametrize(
    "formula",
    [
        "x + v * t + 1 - cos - self.alpha * t * t / 2",
        "(u - sin_t) * d + cos_t - cos_T - f * d.square() / 2",
        "v.mid + math.sin(t) - phi * t",
        "start + s * (np.sin(later) - np.sin(t)) - ratios.alpha * after",
        "total(total(sin, scaled(d, y.a, e)), A)",
    ],
)
def test_a_flight_is_seen(formula):
    """Also one that nobody has written yet."""
    assert flights(f"found = {formula}")
