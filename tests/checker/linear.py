"""Linear planar maps, of which all is known."""

from cap.checker.coverings.planar import Image, Planar
from cap.checker.kernel.doubles import Double


class Linear(Planar):
    """(x, y) -> (3x, y/4), which covers squares; or another linear map."""

    def __init__(self, *entries):
        self.entries = tuple(map(Double, entries or (3.0, 0.0, 0.0, 0.25)))

    def image(self, x, y):
        """Enclose it."""
        a, b, c, d = self.entries
        return Image(a * x + b * y, c * x + d * y, ((a, b), (c, d)))
