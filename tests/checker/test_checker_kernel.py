"""The kernel knows no system: none of its names, units or sentences."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import cap.checker.kernel

FILES = sorted(Path(cap.checker.kernel.__file__).parent.glob("*.py"))
FORM = {"theorems", "kernel"}  # a certificate is read by the tables of the theorem that it names


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_kernel_imports_no_system(file):
    """Only the kernel itself, and the theorems by their names."""
    tree = ast.parse(file.read_text(encoding="ascii"))
    modules = [n.module for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) and n.module]
    rooms = {m.split(".")[2] for m in modules if m.startswith("cap.checker.")}
    assert rooms <= FORM


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_kernel_names_no_constant_of_a_system(file):
    """Neither omega nor friction, walls or masses."""
    text = file.read_text(encoding="ascii")
    assert not [word for word in ("omega(", "mu x'", "mu:", "masses", "walls") if word in text]
    tree = ast.parse(text)
    read = {n.attr for n in ast.walk(tree) if isinstance(n, ast.Attribute)}
    assert not read & {"omega", "mu", "masses", "F", "R"}
