"""The parameters of the paper's system, as exact numbers: ``parameters.json``, if it has some."""

from fractions import Fraction

from cap.audit import subject
from cap.audit.subject import cached


@cached
def of_the_paper() -> dict[str, Fraction]:
    """Return the parameters at which the numbers of the paper are, by their names."""
    return {name: Fraction(text) for name, text in subject.data("parameters.json").items()}
