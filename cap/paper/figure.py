"""What a figure of the paper is here: its computation, its numbers, its picture."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from cap.audit.comparison import Comparison, markdown
from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.findings import Findings, Floats, State
from cap.floats.search.fixed_point import elliptic_point
from cap.parameters import PAPER, at
from cap.runner import Runner

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas


@dataclass(frozen=True)
class Run:
    """How a figure is computed, whole or not at all.

    ``quick``: in the smallest size that makes sense, for tests; ``drawn``: with all that its
    picture shows.
    """

    runner: Runner = field(default_factory=partial(Runner, whole=True))
    quick: bool = False
    drawn: bool = True

    def size(self, full: int, quick: int) -> int:
        """Return how many of something there are to be."""
        return quick if self.quick else full


@dataclass(frozen=True, kw_only=True)
class Compared(Findings):
    """The numbers of one figure, and the data of its picture."""

    label: str
    title: str
    rows: tuple[Comparison, ...]
    data: Any = None

    def columns(self) -> dict[str, ArrayLike]:
        """Return one row for each number."""
        names = ("what", "paper", "ours", "agrees", "reason")
        return {name: np.array([getattr(row, name) for row in self.rows]) for name in names}

    def lines(self) -> list[str]:
        """Return the table."""
        agree = sum(row.agrees for row in self.rows)
        head = f"## {self.label}: {self.title}"
        number = f"{agree} of {len(self.rows)} agree"
        return [head, "", number, "", *markdown(self.rows)]


@dataclass(frozen=True)
class Result:
    """What a computation gives."""

    rows: tuple[Comparison, ...]
    data: Any


@dataclass(frozen=True)
class Figure:
    """A figure: ``compute`` gives its rows and data; its picture, and the size in inches.

    ``draw``: a function ``module:function`` of `cap.pictures.paper`, which draws the data.
    """

    title: str
    compute: Callable[[Run], Result]
    draw: str
    size: tuple[float, float] = (7.4, 4.2)

    def compared(self, label: str, run: Run) -> Compared:
        """Compute it."""
        result = self.compute(run)
        return Compared(
            parameters=PAPER,
            label=label,
            title=self.title,
            rows=result.rows,
            data=result.data,
        )

    def picture(self, compared: Compared, dpi: float = 200) -> "Canvas":
        """Draw it."""
        from cap.pictures.style import drawn  # noqa: PLC0415 (matplotlib, only where it draws)

        return drawn(f"paper.{self.draw}", compared.data, self.size, dpi)


STEP = 1e-6  # of the paper's differences


def differences(states: Floats) -> Floats:
    """Return Φ' (N, 2, 2) at states (N, 2) by the paper's central differences."""
    columns = []
    for axis in np.eye(2):
        ends = [swarm.follow(PAPER, states + side * STEP * axis, 1).states for side in (1, -1)]
        columns.append((ends[0] - ends[1]) / (2 * STEP))
    return np.stack(columns, axis=-1)


def elliptic(F: str = "1") -> State:
    """Return the elliptic fixed point at F with the smallest x."""
    found = elliptic_point(at(F=F))
    if found is None:
        raise BadInput(f"no elliptic orbit was found at F = {F}")
    return found
