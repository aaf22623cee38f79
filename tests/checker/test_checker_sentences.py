"""The theorem of each certificate that is kept is told in the words of ``sentences.txt``."""

import pytest

from checker import sentences


@pytest.fixture(scope="module")
def kept():
    """Return the sentences that are recorded."""
    return sentences.kept()


@pytest.mark.parametrize("path", sentences.paths())
def test_the_sentence(path, kept):
    """Words that are meant to change are recorded anew."""
    assert sentences.sentence(path) == kept[path]


def test_no_other_is_recorded(kept):
    """And none is missing."""
    assert list(kept) == sentences.paths()
