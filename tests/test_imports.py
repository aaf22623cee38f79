"""Which module imports which: no circles, and floats come to proofs through one door."""

import ast
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
RIGOROUS = (
    *("cap.sets", "cap.system", "cap.flow", "cap.maps", "cap.orbits", "cap.one_one", "cap.areas"),
    *(
        "cap.particles",
        "cap.release",
        "cap.tori",
        "cap.certificate",
        "cap.checker",
        "cap.formal",
    ),
)
STAIRS = ("cap.sets", "cap.flow", "cap.maps", "cap.release", "cap.proofs")
COMMANDS = ("cap.command", "cap.prove", "cap.verify", "cap.explore", "cap.paper", "cap.audit")
ABOVE = (*COMMANDS, "cap.interface", "cap.figures", "cap.own")
FLOATING = ("cap.floats", "cap.explore", "cap.paper", "cap.pictures")
DOOR = "cap.floats.candidates"
DOOR_OF_MODELS = "cap.floats.models.periodic"


def name_of(path):
    """Return the name of the module in a file."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    if parts[0] == "proofs":  # installed inside cap
        parts = ("cap", *parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def for_types(tree):
    """Return the nodes that only a type checker sees."""
    branches = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.If)
        and isinstance(node.test, ast.Name)
        and node.test.id == "TYPE_CHECKING"
    ]
    return {inner for branch in branches for inner in ast.walk(branch)}


def named(node):
    """Return the names that an import may load."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom) and node.module and not node.level:
        inner = [f"{node.module}.{alias.name}" for alias in node.names]
        return [node.module, *inner]
    return []


@cache
def graph():
    """Return for each module those that it imports itself, at the top or inside a function."""
    files = {
        name_of(path): path for top in ("cap", "proofs") for path in ROOT.glob(f"{top}/**/*.py")
    }
    packages = {name for name, path in files.items() if path.name == "__init__.py"}
    edges = {}
    for name, path in files.items():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        hidden = for_types(tree)
        found = {other for node in ast.walk(tree) if node not in hidden for other in named(node)}
        edges[name] = (found & files.keys()) - packages - {name}
    return edges


def imported(rooms):
    """Return (module, what it imports) for all modules in some packages."""
    return {
        (name, other)
        for name, others in graph().items()
        for other in others
        if name.startswith(tuple(f"{room}." for room in rooms))
    }


def within(name, rooms):
    """Return whether a module is one of some packages, or in one."""
    return any(name == room or name.startswith(f"{room}.") for room in rooms)


def climbing(edges):
    """Return (module, what it imports) for modules below the command lines that import one."""
    return {
        (name, other)
        for name, others in edges.items()
        for other in others
        if name != "cap" and not name.endswith(".__main__") and not within(name, ABOVE)
        if within(other, ABOVE)
    }


@pytest.mark.slow
def test_no_circle_of_imports():
    """Not even of those inside functions."""
    assert len(graph()) > 200
    try:
        list(TopologicalSorter(graph()).static_order())
    except CycleError as circle:
        pytest.fail(" -> ".join(circle.args[1]))


@pytest.mark.slow
def test_a_circle_is_seen():
    """The test above can fail."""
    with pytest.raises(CycleError):
        list(TopologicalSorter({**graph(), DOOR: {"cap.proofs.theorems"}}).static_order())


def test_nothing_low_imports_a_command_line():
    """What computes knows neither the commands nor what they print."""
    assert climbing(graph()) == set()


@pytest.mark.parametrize("low", ["cap.runner", "cap.sets.kept", "cap.floats.engine.compiled"])
def test_a_climb_is_seen(low):
    """The test above can fail."""
    edges = {**graph(), low: graph()[low] | {"cap.command.entry"}}
    assert climbing(edges) == {(low, "cap.command.entry")}


@pytest.mark.parametrize("number", range(len(STAIRS)))
def test_no_step_up(number):
    """Sets know no flow, the flow no fixed points, and none of them a theorem."""
    room, higher = STAIRS[number], STAIRS[number + 1 :]
    assert len(imported([room])) > 10
    assert [pair for pair in imported([room]) if within(pair[1], higher)] == []


def test_what_is_rigorous_imports_no_floats():
    """Nor what draws and explores."""
    found = imported(RIGOROUS)
    assert len(found) > 100
    assert [pair for pair in found if pair[1].startswith(FLOATING)] == []


def test_proofs_take_hints_through_one_door():
    """The theorems and their commands import nothing else of the float mode, but of own systems."""
    doors = {
        pair for pair in imported(["cap.proofs", "cap.command"]) if pair[1].startswith(FLOATING)
    }
    assert {("cap.proofs.theorems", DOOR), ("cap.proofs.elliptic", DOOR)} <= doors
    assert {other for _, other in doors} == {DOOR, DOOR_OF_MODELS}


def test_floats_know_nothing_of_proofs():
    """They are searched by the prover, and do not call it."""
    others = {other for _, other in imported(["cap.floats"])}
    rooms = (
        "cap.proofs",
        "cap.certificate",
        "cap.checker",
        "cap.explore",
        "cap.pictures",
        "cap.paper",
    )
    assert [other for other in others if other.startswith(rooms)] == []
