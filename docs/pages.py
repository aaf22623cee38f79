"""Build the documentation site: ``python docs/pages.py FOLDER``; a warning is an error.

The pages are those of the repository, laid out as they are there, so that the links between them
hold; a link to a folder leads to a list of its files.  To them come the pages of all modules, made
by pdoc (`docs/api.py`), and a list of the modules by room.
"""

import argparse
import ast
import logging
import re
import shutil
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import api
from mkdocs.commands.build import build
from mkdocs.config import load_config
from mkdocs.exceptions import Abort

ROOT = Path(__file__).resolve().parents[1]
SHOWN = (
    *("*.md", "CITATION.cff", "LICENSE", "certificates/*", "docs/**/*", "examples/**/*"),
    *("cap/**/*.py", "proofs/*.py", "proofs/audit/*.md", "proofs/formal/*"),
)
LINK = re.compile(r"(\]\()([^)#:\s]+)((?:#[^)\s]*)?\))")
ROOMS = {  # of the house, in the order in which data runs
    "": "the Python interface",
    "system": "a system as data: modes, guards, resets",
    "sets": "what encloses: balls, jets, Taylor models, outward-rounded doubles",
    "flow": "certified events, and orbits over many periods",
    "maps": "fixed points, normal forms, twist, stability, coverings",
    "orbits": "periodic orbits of any system, by their contacts",
    "proofs": "one module per theorem, reading like its proof on paper",
    "certificate": "what a certificate is, and its words",
    "checker": "the trusted base: the standard library alone",
    "floats": "the float mode, from which nothing is proved",
}


def lay_out(stage: Path) -> None:
    """Copy what is shown, and let links to folders lead to lists of files."""
    for pattern in SHOWN:
        for path in ROOT.glob(pattern):
            if path.is_file() and "__pycache__" not in path.parts:
                copy = stage / path.relative_to(ROOT)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, copy)
    for page in sorted(stage.rglob("*.md")):
        text = page.read_text(encoding="utf-8")
        page.write_text(LINK.sub(partial(_led, page), text), encoding="utf-8")


def _led(page: Path, found: re.Match[str]) -> str:
    """Return a link; to a folder it is one to the page that lists it."""
    before, target, after = found.groups()
    folder = (page.parent / target).resolve()
    if not folder.is_dir():
        return found[0]
    name = "README.md" if (folder / "README.md").exists() else "index.md"
    if not (folder / name).exists():
        rows = [f"- [{p.name}]({p.name})" for p in sorted(folder.iterdir()) if p.is_file()]
        (folder / name).write_text("\n".join([f"# {folder.name}", "", *rows, ""]), encoding="utf-8")
    return f"{before}{target.rstrip('/')}/{name}{after}"


def modules() -> Iterator[str]:
    """Give the lines of the page that lists all modules by room, with their first lines."""
    yield "# Modules by room\n"
    yield "Every module, with the first line of what it says of itself.\n"
    found: dict[str, list[tuple[str, Path]]] = {}
    for path in sorted([*ROOT.glob("cap/**/*.py"), *ROOT.glob("proofs/**/*.py")]):
        parts = path.relative_to(ROOT).with_suffix("").parts
        parts = parts if parts[0] == "cap" else ("cap", *parts)
        parts = parts[:-1] if parts[-1] == "__init__" else parts
        room = parts[1] if len(parts) > 2 or (path.name == "__init__.py" and parts[1:]) else ""
        if len(parts) > 1 and "__main__" not in parts and not path.is_symlink():
            found.setdefault(room, []).append((".".join(parts), path))
    for room in sorted(found, key=lambda r: [*ROOMS, r].index(r)):
        yield f"## cap{'.' if room else ''}{room}\n"
        yield f"{ROOMS.get(room, '').capitalize()}\n"
        for name, path in dict(found[room]).items():
            doc = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
            first = " ".join(doc.split("\n\n")[0].split()).replace("|", r"\|").replace("<", "&lt;")
            yield f"- [`{name}`]({'/'.join(name.split('.'))}.html): {first}"
        yield ""


def main(out: Path) -> int:
    """Build the site into a folder; return the exit status."""
    logging.basicConfig(level=logging.WARNING, format="%(message)s")
    with TemporaryDirectory() as folder:
        stage = Path(folder).resolve()
        lay_out(stage)
        api.main(stage / "api")
        (stage / "api/index.html").unlink()
        (stage / "api/index.md").write_text("\n".join(modules()), encoding="utf-8")
        config = load_config(str(ROOT / "mkdocs.yml"), docs_dir=str(stage), site_dir=str(out))
        theorems = sorted(p.name for p in (stage / "docs/theorems").glob("*.md"))
        for entry in config.nav:
            if "Theorems" in entry:
                entry["Theorems"] += [f"docs/theorems/{name}" for name in theorems]
        named = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
        rest = [f"docs/{p.name}" for p in sorted((stage / "docs").glob("*.md"))]
        config.nav.append({"More": [page for page in rest if page not in named]})
        try:
            build(config)
        except Abort as error:
            print(error, file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("folder", type=Path)
    sys.exit(main(parser.parse_args().folder.resolve()))
