"""The documentation site: every module is reached, and links to folders lead somewhere.

That it is built without a warning is a step of CI: ``python docs/pages.py FOLDER``.
"""

import importlib.util
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def pages():
    """Return the script that builds the site."""
    sys.path.insert(0, str(ROOT / "docs"))
    try:
        spec = importlib.util.spec_from_file_location("pages", ROOT / "docs/pages.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module
    finally:
        sys.path.remove(str(ROOT / "docs"))


@pytest.mark.slow
def test_every_module_is_reached(pages):
    """By room, once each, with its first line."""
    lines = [line for line in pages.modules() if line.startswith("- ")]
    found = [re.match(r"- \[`([\w.]+)`\]\(([\w/]+)\.html\): \S", line).groups() for line in lines]
    assert all(name == place.replace("/", ".") for name, place in found)
    files = [*ROOT.glob("cap/**/*.py"), *ROOT.glob("proofs/**/*.py")]
    names = {path.relative_to(ROOT).with_suffix("").as_posix() for path in files}
    names = {name.removesuffix("/__init__") for name in names if "__main__" not in name}
    names = {name if name.startswith("cap") else f"cap/{name}" for name in names}
    assert {place for _, place in found} == names - {"cap"}
    assert len(found) == len(names) - 1


def test_links_to_folders(pages, tmp_path):
    """Lead to a list of their files; others stay as they are."""
    (tmp_path / "books").mkdir()
    (tmp_path / "books/a.ipynb").write_text("{}")
    page = tmp_path / "page.md"
    led = pages.LINK.sub(lambda found: pages._led(page, found), "[b](books) [c](c.md#d) [e](#f)")
    assert led == "[b](books/index.md) [c](c.md#d) [e](#f)"
    assert "[a.ipynb](a.ipynb)" in (tmp_path / "books/index.md").read_text("utf-8")


def test_the_navigation_names_pages_that_there_are():
    """Those that it does not name come under "More"."""
    text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
    named = set(re.findall(r"(docs/[\w-]+\.md)", text))
    assert len(named) > 10
    assert named <= {path.relative_to(ROOT).as_posix() for path in ROOT.glob("docs/*.md")}
