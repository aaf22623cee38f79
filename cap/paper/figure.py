"""A figure of the paper: its table, what finds the numbers there, its picture."""

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, partial
from importlib import import_module
from multiprocessing import parent_process
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from cap.audit import tables
from cap.audit.comparison import Comparison
from cap.audit.verdict import Outcome
from cap.errors import BadInput
from cap.floats.engine import swarm
from cap.floats.findings import Findings, Floats, State
from cap.floats.search.fixed_point import elliptic_point
from cap.parameters import PAPER, at
from cap.runner import Runner
from cap.words import meant

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Canvas

T = TypeVar("T")
Found = Mapping[str, Any]  # what is found, by the names that the rows of a table ask for


@dataclass(frozen=True, eq=False)
class Run:
    """How figures are computed: what is computed in one run is kept for it.

    ``quick``: in the smallest size that makes sense, for tests; ``drawn``: with all that a picture
    shows.
    """

    runner: Runner = field(default_factory=partial(Runner, whole=True))
    quick: bool = False
    drawn: bool = True

    def size(self, full: int, quick: int) -> int:
        """Return how many of something there are to be."""
        return quick if self.quick else full


class Refined(NamedTuple, Generic[T]):
    """What the paper computed, and the same with more states and periods."""

    paper: T
    better: T


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


def markdown(rows: Iterable[Comparison]) -> list[str]:
    """Return a table."""
    lines = ["| what | paper | ours | agrees? | why not, or a remark |", "|---|---|---|---|---|"]
    words = {Outcome.CONFIRMED: "yes", Outcome.UNCHECKABLE: "not said"}
    for row in rows:
        cells = (row.what, row.paper, row.ours, words.get(row.outcome, "**no**"), row.reason)
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return lines


@dataclass(frozen=True)
class Figure:
    """A figure: the functions of its ``module`` find what the rows ask for, one of them the data.

    ``draw``: a function ``module:function`` of `cap.pictures.paper`, which draws the data; ``size``
    in inches.
    """

    label: str
    title: str
    module: str
    draw: str
    size: tuple[float, float]
    data: str = ""

    def compared(self, run: Run) -> Compared:
        """Compute it."""

        def find(row: Mapping[str, Any]) -> Found:
            module = row.get("module", self.module)
            return dict(found(module, row["by"], run, row.get("with", {})))

        rows = tables.comparisons(self.label, find)
        data = found(self.module, self.data, run, {}) if self.data else None
        return Compared(parameters=PAPER, label=self.label, title=self.title, rows=rows, data=data)

    def picture(self, compared: Compared, dpi: float = 200) -> "Canvas":
        """Draw it."""
        from cap.pictures.style import drawn  # noqa: PLC0415 (matplotlib, only where it draws)

        return drawn(f"paper.{self.draw}", compared.data, self.size, dpi)


def labels() -> tuple[str, ...]:
    """Return the labels of the figures, in the order of the paper."""
    return tuple(tables.tables())


def figure(label: str) -> Figure:
    """Return a figure, by its label with or without "fig:"; `BadInput` if there is none."""
    full = label if label in labels() else f"fig:{label}"
    if full not in labels():
        guess = meant(full, labels()) or f": all, or one of {', '.join(labels())}"
        raise BadInput(f"the paper has no figure {label!r}{guess}")
    own = {name: entry for name, entry in tables.tables()[full].items() if name != "row"}
    return Figure(**own | {"size": tuple(own["size"])})


def labelled(label: str) -> list[str]:
    """Return the labels that are meant: all of them, or one."""
    return list(labels()) if label == "all" else [figure(label).label]


def found(module: str, function: str, run: Run, options: Mapping[str, str]) -> Any:
    """Return what a function of a module finds in a run."""
    return getattr(import_module(module), function)(run, **options)


def finds(module: str, function: str, options: Mapping[str, str]) -> Found:
    """Find what one row asks for, for the audit."""
    return dict(found(module, function, _of_the_audit(), options))


@cache
def _of_the_audit() -> Run:
    """Return a run on all cores unless this is one process of several."""
    jobs = 1 if parent_process() else os.cpu_count() or 1
    return Run(Runner(jobs=jobs, whole=True), drawn=False)


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


def percent(part: float, whole: float) -> str:
    """Return a share in words."""
    return f"{100 * part / whole:.3g}%" if whole else "none"
