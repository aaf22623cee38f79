"""What the mechanics asks of a number: float, array, ball, jet and Taylor model all qualify."""

from abc import abstractmethod
from typing import Any, Protocol, Self, TypeVar


class Scalar(Protocol):
    """A commutative ring with division, which mixes with Python integers."""

    def __add__(self, other: Self | int, /) -> Self: ...
    def __radd__(self, other: int, /) -> Self: ...
    def __sub__(self, other: Self | int, /) -> Self: ...
    def __rsub__(self, other: int, /) -> Self: ...
    def __mul__(self, other: Self | int, /) -> Self: ...
    def __rmul__(self, other: int, /) -> Self: ...
    def __truediv__(self, other: Self | int, /) -> Self: ...
    def __neg__(self) -> Self: ...


S = TypeVar("S", bound=Scalar)


class Ring:
    """Derives the other operations from sum, negative, product and reciprocal.

    Operands are of the same kind (space, domain), or scalars: numbers that stand for constants.
    No `ABC`: its metaclass would double the time of ``isinstance``, which every operation asks.
    """

    __slots__ = ()

    @abstractmethod
    def __add__(self, other: Any) -> Self: ...
    @abstractmethod
    def __neg__(self) -> Self: ...
    @abstractmethod
    def __mul__(self, other: Any) -> Self: ...

    @abstractmethod
    def reciprocal(self) -> Self:
        """Return 1/self."""

    def __radd__(self, other: Any) -> Self:
        return self.__add__(other)

    def __sub__(self, other: Any) -> Self:
        return self.__add__(-other)

    def __rsub__(self, other: Any) -> Self:
        return (-self).__add__(other)

    def __rmul__(self, other: Any) -> Self:
        return self.__mul__(other)

    def __rtruediv__(self, other: Any) -> Self:
        return self.reciprocal().__mul__(other)
