"""The figures of the paper, by their labels, in its order; their tables, for the audit."""

import os
from importlib import import_module
from multiprocessing import parent_process
from typing import TYPE_CHECKING

from cap.errors import BadInput
from cap.runner import Runner
from cap.words import meant

if TYPE_CHECKING:
    from cap.audit.comparison import Comparison
    from cap.paper.figure import Figure

_MODULES = {
    "fig:model-schematic": "sketches:MODEL",
    "fig:cover": "sketches:COVER",
    "fig:impulse-bound": "impulse_bound:FIGURE",
    "fig:kam-gallery": "gallery_near:FIGURE",
    "fig:decomp-schematic": "sketches:DECOMPOSITION",
    "fig:multi-particle": "sketches:PARTICLES",
    "fig:orbit": "orbit:FIGURE",
    "fig:KAM": "island:FIGURE",
    "fig:bifurcation": "bifurcation:FIGURE",
    "fig:sali": "sali:FIGURE",
    "fig:basin": "basin:FIGURE",
    "fig:continuation": "continuation:FIGURE",
    "fig:coexist-main": "coexistence:FIGURE",
    "fig:hist-gallery-low": "regimes:LOW",
    "fig:hist-gallery-high": "regimes:HIGH",
    "fig:hist-cont": "forcing:FIGURE",
    "fig:hist-chatter": "sticking:FIGURE",
}
LABELS = tuple(_MODULES)


def figure(label: str) -> "Figure":
    """Return a figure, by its label with or without "fig:"; `BadInput` if there is none."""
    full = label if label in _MODULES else f"fig:{label}"
    if full not in _MODULES:
        guess = meant(full, LABELS) or f": all, or one of {', '.join(LABELS)}"
        raise BadInput(f"the paper has no figure {label!r}{guess}")
    found: Figure = getattr(import_module(module(full)), _MODULES[full].partition(":")[2])
    return found


def module(label: str) -> str:
    """Return the module that computes a figure."""
    return f"cap.paper.{_MODULES[label].partition(':')[0]}"


def labelled(label: str) -> list[str]:
    """Return the labels that are meant: all of them, or one."""
    if label == "all":
        return list(LABELS)
    figure(label)
    return [label if label in _MODULES else f"fig:{label}"]


def rows(label: str) -> "tuple[Comparison, ...]":
    """Compute the table of a figure, on all cores unless this is one process of several."""
    from cap.paper.figure import Run  # noqa: PLC0415 (numpy, where a table is computed)

    jobs = 1 if parent_process() else os.cpu_count() or 1
    return figure(label).compute(Run(runner=Runner(jobs=jobs, whole=True), drawn=False)).rows
