"""The notebooks are stored without outputs, and there are those that the pages name.

That they run is a step of ``.ci/beside``: ``python docs/notebooks.py``.
"""

import json
import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"


def test_the_notebooks():
    """Each begins with a heading, and has no outputs."""
    (told,) = re.findall(
        r"`docs/notebooks/`, and CI runs them: (.*?);",
        (DOCS / "python.md").read_text(encoding="utf-8"),
        re.DOTALL,
    )
    paths = sorted(DOCS.glob("notebooks/*.ipynb"))
    assert sorted(re.findall(r"`(\w+)`", told)) == [path.stem for path in paths]
    for path in paths:
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        assert cells[0]["source"][0].startswith("# ")
        code = [cell for cell in cells if cell["cell_type"] == "code"]
        assert [(cell["outputs"], cell["execution_count"]) for cell in code] == [
            ([], None) for _ in code
        ]
