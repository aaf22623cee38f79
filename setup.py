"""The packages to install: those found in `cap`, and two folders of the tree that belong inside it.

In the tree `cap/proofs` and `cap/certificates` are links to these folders; here they are named, for
systems without links and for archives.  An editable installation puts the tree itself on the path
(where there are no links, `cap` finds both folders beside it), so that type checkers see it too.
Everything else is in `pyproject.toml`.
"""

import re
import sys
import tomllib
from pathlib import Path

from setuptools import find_packages, setup

INSIDE = {"cap.proofs": "proofs", "cap.certificates": "certificates"}
FOUND = {
    name for name in find_packages(include=["cap", "cap.*"]) if not name.startswith(tuple(INSIDE))
}

HERE = Path(__file__).parent
SOURCE = tomllib.loads((HERE / "pyproject.toml").read_text("utf-8"))["project"]["urls"]["Source"]


def readme() -> str:
    """Return the README for a registry, where links to files of the tree must be whole."""
    text = (HERE / "README.md").read_text("utf-8")
    return re.sub(r"\]\((?!https?:|#)", f"]({SOURCE}/blob/main/", text)


ABOUT = {"long_description": readme(), "long_description_content_type": "text/markdown"}

if "editable_wheel" in sys.argv:
    setup(packages=sorted(FOUND), package_dir={"": "."}, **ABOUT)
else:
    setup(packages=sorted({*FOUND, *INSIDE}), package_dir=INSIDE, **ABOUT)
