"""The theorem of each certificate that is kept is told in the words of ``sentences.txt``."""

import pytest

from checker import sentences

LONG = "certificates/mixed.json"


def marked():
    """Return the certificates, for `parametrize`; one that takes seconds to be read is slow."""
    marks = {LONG: [pytest.mark.slow]}
    return [pytest.param(path, marks=marks.get(path, [])) for path in sentences.paths()]


@pytest.fixture(scope="module")
def kept():
    """Return the sentences that are recorded."""
    return sentences.kept()


@pytest.mark.parametrize("path", marked())
def test_the_sentence(path, kept):
    """Words that are meant to change are recorded anew."""
    assert sentences.sentence(path) == kept[path]


def test_no_other_is_recorded(kept):
    """And none is missing."""
    assert list(kept) == sentences.paths()
