"""The checker stands alone: it loads nothing else of cap and no numeric package."""

from __future__ import annotations

import ast
import json
import pkgutil
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest
from support import only

import cap.checker
from cap.checker.theorems import NAMES
from checker.altered import changed

MODULES = [m.name for m in pkgutil.walk_packages(cap.checker.__path__, "cap.checker.")]
STORED = Path(__file__).parents[2] / "certificates"
OWN = Path(__file__).parents[1] / "certificates/own"  # of systems that the commands do not take yet
BARE = {"kernel", "system", "theorems", "verdict"}
FLOW = BARE | {"flow", "maps"}
ROOMS = dict.fromkeys(("symmetric", "pitchfork", "branch"), BARE | {"one_one"})
ROOMS |= dict.fromkeys(("attractor", "window"), FLOW | {"release"})
ROOMS |= dict.fromkeys(("cascade", "entropies"), BARE | {"flow", "release"})
ROOMS |= {"impulse": BARE, "mixed": BARE | {"attracting", "folded"}}
ROOMS |= dict.fromkeys(("segment", "sliding"), BARE | {"flow"})
ROOMS |= {"contact_attractor": BARE, "contact_basin": BARE | {"resting"}}
ROOMS |= {"conservative": BARE | {"strips"}, "contacts": BARE, "contacts_branch": BARE}
ROOMS |= {"contacts_family": BARE}
ROOMS |= {"contact_elliptic": BARE | {"maps"}, "contact_capture": BARE}
ROOMS |= {"inventory": BARE | {"flow", "one_one"}, "horseshoe": BARE | {"coverings"}}
ROOMS |= dict.fromkeys(("contact_horseshoe", "map_horseshoe"), BARE | {"coverings"})
TWO_MASSES = ("particles", "particles_limits", "particles_saddle", "particles_sink")
ROOMS |= dict.fromkeys(TWO_MASSES, BARE | {"particles"})
ROOMS |= dict.fromkeys(("island", "islands", "converse"), BARE | {"tori"})
ROOMS |= {"ball_curve": BARE | {"tori"}}
ROOMS |= {"map_curve": BARE | {"coverings", "tori"}}
ROOMS |= {"particles_stability": FLOW | {"particles"}}
MORE = {
    "contact_elliptic": {"contacts"},
    "contacts_branch": {"contacts"},
    "contacts_family": {"contacts"},
    "homoclinic": {"saddle"},
    "islands": {"island"},
    "window": {"attractor"},
    "persistence": {"periodic"},
}
LOADERS = {"theorems", "attracting"}  # rooms whose files are loaded by their names
BY_NAME = {"theorems", "kernel.later"}  # where this is done
FOREIGN = {"flint", "mpmath", "numpy", "sympy", "gmpy2", "scipy", "numba", "matplotlib"}


def printed(code, *words):
    """Return the lines that the code prints in a new interpreter."""
    command = [sys.executable, "-c", code, *words]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()


def loaded(code):
    """Return the modules loaded in a new interpreter by the code."""
    return set(printed(f"{code}; import sys; print(*sys.modules)")[-1].split())


def test_the_checker_loads_only_itself():
    """All modules of the checker together load nothing else of cap and nothing foreign."""
    modules = loaded("import " + ", ".join(MODULES))
    assert {m for m in modules if m.split(".")[0] == "cap"} == {"cap", "cap.checker", *MODULES}
    assert not {m.split(".")[0] for m in modules} & FOREIGN


def test_the_command_line_adds_only_itself():
    """``cap.verify`` adds only itself, how a command begins, ends and speaks, and no library."""
    modules = loaded("import cap.verify, cap.command.verifier")
    ours = {m for m in modules if m.split(".")[0] == "cap"}
    own = {f"cap.command.{name}" for name in ("verifier", "outcome", "layout", "entry", "console")}
    own |= {"cap.verify", "cap.process", "cap.tree", "cap.words"}
    assert ours <= {"cap", "cap.command", "cap.checker", *own, *MODULES}
    assert not {m.split(".")[0] for m in modules} & FOREIGN


@pytest.mark.parametrize("theorem", only(NAMES, "contacts", "elliptic", "impulse", "particles"))
def test_a_verdict_loads_one_theorem_and_what_it_needs(theorem, tmp_path):
    """Of the theorems itself, and that of which it is a special case; the list for referees has
    just what was loaded.  A lie that is rejected at once loads as much as a long proof: no import
    is late.
    """
    known = sorted((*STORED.glob("*.json"), *OWN.glob("*.json")))
    path = next(p for p in known if p.stem.split("-")[0] == theorem)
    lie = changed(json.loads(path.read_text("utf-8")), "parameters", "nothing")
    path = tmp_path / path.name
    path.write_text(json.dumps(lie))
    modules = loaded(f"from cap import verify; verify.main([{str(path)!r}])")
    used = {m.removeprefix("cap.checker.") for m in modules if m.startswith("cap.checker.")}
    assert {m.partition(".")[0] for m in used} == ROOMS.get(theorem, FLOW)
    theorems = {m.partition(".")[2] for m in used if m.startswith("theorems.")}
    assert theorems == {theorem} | MORE.get(theorem, set())
    packages = ROOMS.get(theorem, FLOW) - LOADERS
    assert sorted(listed(theorem)[""]) == sorted(used - packages | {"verdict"})


@cache
def listed(theorem):
    """Return the modules that ``--reading`` lists for a theorem: always, and where so much is
    claimed."""
    lines = printed(f"from cap import verify; verify.main(['--reading', {theorem!r}])")
    found, name, counts = {}, "", []
    for line in lines:
        if line.endswith("claimed:"):
            name = line.split("`")[1]
        elif line.endswith(".py"):
            file = line.split()[-1].removesuffix(".py").removesuffix("/__init__")
            found.setdefault(name, []).append(file.replace("/", "."))
            counts.append(list(map(int, line.split()[:2])))
        elif line.endswith("in all"):
            assert list(map(int, line.split()[:2])) == [sum(n) for n in zip(*counts, strict=True)]
            counts = []
    return found


CLAIMED = {
    "attractor": [],
    "segment": [],
    "cycles": [[["-0.2323", "-0.2072"]]],
    "sinks": [{"x": "0", "v": "1", "matrix": [["9", "0"], ["0", "9"]], "halves": "2"}],
}


@pytest.mark.parametrize("name", CLAIMED)
def test_what_is_claimed_to_attract_is_loaded_only_then(name, tmp_path):
    """Each of them adds the files that are listed, and no others: of sinks nothing is read where
    none is claimed."""
    lie = json.loads((STORED / "mixed.json").read_text("utf-8"))
    claims = lie["claims"]
    if CLAIMED[name]:
        claims[name] = CLAIMED[name]
    for other in set(CLAIMED) - {name}:
        claims.pop(other, None)
    if name != "attractor":
        del lie["hints"]["attractor"]
    claims["box"] = {"x": ["-1", "2"], "v": ["-3", "3"]}
    path = tmp_path / "mixed.json"
    path.write_text(json.dumps(lie))
    modules = loaded(f"from cap import verify; verify.main([{str(path)!r}])")
    used = {m.removeprefix("cap.checker.") for m in modules if m.startswith("cap.checker.")}
    pages = listed("mixed")
    rooms = {m for m in used if (Path(cap.checker.__path__[0]) / m.replace(".", "/")).is_dir()}
    assert sorted(pages[""] + pages[name]) == sorted(used - rooms | LOADERS)
    if name != "attractor":
        assert not used & {"theorems.attractor", "kernel.jet", "release.kneading"}


@pytest.mark.parametrize("claimed", [True, False])
def test_the_equation_of_the_paper_is_loaded_where_its_roots_are_claimed(claimed, tmp_path):
    """Without them the theorem on symmetric orbits is proved, too, by the files that are listed."""
    certificate = json.loads((STORED / "symmetric.json").read_text("utf-8"))
    if not claimed:
        del certificate["claims"]["paper_roots"]
    path = tmp_path / "symmetric.json"
    path.write_text(json.dumps(certificate))
    code = f"from cap import verify; assert verify.main(['--explain', {str(path)!r}]) == 0"
    lines = printed(f"{code}; import sys; print(*sys.modules)")
    used = {m.removeprefix("cap.checker.") for m in lines[-1].split() if "cap.checker." in m}
    pages = listed("symmetric")
    more = pages["paper_roots"] if claimed else []
    assert sorted(pages[""] + more) == sorted(used - (ROOMS["symmetric"] - LOADERS) | {"verdict"})
    assert any("paper's equation" in line for line in lines) == claimed


@pytest.mark.slow
def test_every_module_can_be_imported_alone():
    """No module depends on another being imported first: each is, after all are forgotten."""
    code = """
import sys
for module in sys.argv[1:]:
    __import__(module)
    print(module, module in sys.modules)
    for name in [name for name in sys.modules if name.split(".")[0] == "cap"]:
        del sys.modules[name]
"""
    assert printed(code, *MODULES) == [f"{module} True" for module in MODULES]


def test_no_import_is_late():
    """What a module of the checker needs it imports at its beginning; only theorems, and parts of
    them that are not always claimed, are loaded by their names."""
    for module in MODULES:
        path = Path(__import__(module, fromlist=["x"]).__file__)
        text = path.read_text(encoding="ascii")
        tree = ast.parse(text)
        found = [n for n in ast.walk(tree) if isinstance(n, ast.Import | ast.ImportFrom)]
        assert all(node in tree.body for node in found), module
        by_name = "import_module" in text or "__import__" in text
        assert by_name == (module.removeprefix("cap.checker.") in BY_NAME), module


def test_the_checker_contains_no_assert():
    """No line is an assert, which ``python -O`` would not execute; the sources are ASCII."""
    for module in [*MODULES, "cap.verify", "cap.command.verifier"]:
        path = __import__(module, fromlist=["x"]).__file__
        with open(path, encoding="ascii") as file:  # noqa: PTH123
            assert not [line for line in file if line.lstrip().startswith("assert")]
