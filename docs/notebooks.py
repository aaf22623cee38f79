"""Run the notebooks of this folder: ``python docs/notebooks.py [NAME ...]``.

Each cell must run, and complain about nothing; all but the one about a system of one's own show a
picture or a theorem.  Nothing is written.  Exit status 1 if one does not.
"""

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

FOLDER = Path(__file__).parent / "notebooks"
NOTHING_RICH = ("own_system",)


def wrong(path: Path) -> str:
    """Run a notebook; return what is wrong with it, or nothing."""
    book = nbformat.read(path, as_version=4)
    try:
        NotebookClient(book, timeout=600, kernel_name="python3").execute()
    except CellExecutionError as error:
        return str(error)
    shown = [out for cell in book.cells for out in cell.get("outputs", ())]
    told = [out["text"] for out in shown if out.get("name") == "stderr"]
    complaints = [text for text in told if not text.startswith("compiling")]  # the first time
    kinds = {kind for out in shown for kind in out.get("data", ())}
    if path.stem not in NOTHING_RICH and not kinds & {"image/png", "text/html"}:
        complaints.append("no picture and no theorem is shown")
    return "\n".join(complaints)


def main(names: list[str]) -> int:
    """Run them; return the exit status."""
    paths = [FOLDER / f"{name}.ipynb" for name in names] or sorted(FOLDER.glob("*.ipynb"))
    failed = 0
    for path in paths:
        said = wrong(path)
        failed += bool(said)
        print(f"{path.name}: {said or 'runs'}", flush=True)
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
