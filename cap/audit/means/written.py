"""Written proofs, ``proofs/audit/*.md``: each section is a proof with numbered steps."""

import re
from functools import cache

from cap.tree import inside

FOLDER = inside("proofs") / "audit"


def exists(reference: str) -> bool:
    """Return whether ``FILE.md#section`` names a section of a written proof."""
    name, _, section = reference.partition("#")
    return section in sections(name)


@cache
def sections(name: str) -> list[str]:
    """Return the sections of a file, if it is there, by the names that a link uses."""
    text = path.read_text(encoding="utf-8") if (path := FOLDER / name).is_file() else ""
    return [anchor(title) for title in re.findall(r"^## (.+)$", text, flags=re.MULTILINE)]


def anchor(title: str) -> str:
    """Return the name of a section in links, as the usual renderers of Markdown make it."""
    return re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")
