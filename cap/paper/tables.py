"""The tables of the paper's figures, for the audit: their labels, their modules, their rows."""

import os
from multiprocessing import parent_process

from cap.audit.comparison import Comparison
from cap.paper.registry import LABELS, figure, module
from cap.runner import Runner

__all__ = ["LABELS", "module", "rows"]


def rows(label: str) -> tuple[Comparison, ...]:
    """Compute the table of a figure, on all cores unless this is one process of several."""
    from cap.paper.figure import Run  # noqa: PLC0415 (numpy, where a table is computed)

    jobs = 1 if parent_process() else os.cpu_count() or 1
    return figure(label).compute(Run(runner=Runner(jobs=jobs, whole=True), drawn=False)).rows
