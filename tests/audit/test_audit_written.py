"""Written proofs: what refers to them, and what they refer to, is there."""

import re

from cap.audit import recorded
from cap.audit.means import written

FILES = sorted(path.name for path in written.FOLDER.glob("*.md"))


def test_every_reference_is_a_section():
    """Of all recorded verdicts by argument."""
    proofs = {each.proof for each in recorded.recorded().values() if each.proof}
    assert all(written.exists(each) for each in proofs)
    assert not written.exists("setup.md#no-such-section")
    assert not written.exists("none.md#the-contact-law")


def test_every_section_is_used():
    """By a verdict, or by another section, as a lemma."""
    proofs = {each.proof for each in recorded.recorded().values()}
    lemmas = {"decomposition.md#speeds-of-never-stopping-orbits"}
    sections = {f"{name}#{section}" for name in FILES for section in written.sections(name)}
    assert sections == (proofs - {""}) | lemmas


def test_every_proof_has_a_statement_and_steps():
    """A statement, and numbered steps (or a reason beside it)."""
    for name in FILES:
        text = (written.FOLDER / name).read_text(encoding="utf-8")
        for section in re.split(r"^## ", text, flags=re.MULTILINE)[1:]:
            assert re.search(r"\*(Statement|Lemma|Definition)\.\*", section), (name, section[:40])
            assert re.search(r"^1\. ", section, flags=re.MULTILINE), (name, section[:40])


def test_anchors():
    """As the usual renderers make them."""
    assert written.anchor("The saddle-center of *the* orbits, (2)") == (
        "the-saddle-center-of-the-orbits-2"
    )
