"""The checker stands alone: it loads nothing else of cap and no numeric package."""

from __future__ import annotations

import pkgutil
import subprocess
import sys

import pytest

import cap.checker

MODULES = [m.name for m in pkgutil.walk_packages(cap.checker.__path__, "cap.checker.")]
FOREIGN = {"flint", "mpmath", "numpy", "sympy", "gmpy2", "scipy"}


def loaded(code):
    """Return the modules loaded in a new interpreter by the code."""
    out = subprocess.run(
        [sys.executable, "-c", f"{code}; import sys; print(*sys.modules)"],
        capture_output=True,
        text=True,
        check=True,
    )
    return set(out.stdout.split())


def test_the_checker_loads_only_itself():
    """All modules of the checker together load nothing else of cap and nothing foreign."""
    modules = loaded("import " + ", ".join(MODULES))
    assert {m for m in modules if m.split(".")[0] == "cap"} == {"cap", "cap.checker", *MODULES}
    assert not {m.split(".")[0] for m in modules} & FOREIGN


def test_the_command_line_adds_only_itself():
    """``cap.verify`` adds only itself, ``cap.command.verifier``, ``cap.command.entry`` and
    ``cap.command.console``."""
    modules = loaded("import cap.verify, cap.command.verifier")
    ours = {m for m in modules if m.split(".")[0] == "cap"}
    own = {"cap.verify", "cap.command.verifier", "cap.command.entry", "cap.command.console"}
    assert ours <= {"cap", "cap.command", "cap.checker", *own, *MODULES}
    assert not {m.split(".")[0] for m in modules} & FOREIGN


@pytest.mark.parametrize("module", MODULES)
def test_every_module_can_be_imported_alone(module):
    """No module depends on another being imported first."""
    assert module in loaded(f"import {module}")


def test_the_checker_contains_no_assert():
    """No line is an assert, which ``python -O`` would not execute; the sources are ASCII."""
    for module in [*MODULES, "cap.verify", "cap.command.verifier"]:
        path = __import__(module, fromlist=["x"]).__file__
        with open(path, encoding="ascii") as file:  # noqa: PTH123
            assert not [line for line in file if line.lstrip().startswith("assert")]
