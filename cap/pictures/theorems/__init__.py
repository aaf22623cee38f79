"""Pictures of theorems that are proved: what a reader sees of a certificate.

Each theorem has a function that draws it, in a module of this room.  It is given the proof of the
checker, which has succeeded, and an empty figure.  Where a picture needs what a proof finds on its
way, the module has that proof, too: the checker's own, which keeps it.  What a picture calls proved
is what the certificate claims; curves in floats lead the eye, and say that they are floats.
"""

from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

from matplotlib.figure import Figure

from cap.checker import theorems
from cap.checker.kernel.theorem import Theorem
from cap.errors import BadInput
from cap.pictures.style import blank, style


class Drawing(NamedTuple):
    """A function ``module:function`` of this room, and the size of its figure in inches.

    ``proof``: a class of that module, which proves in place of the checker's.
    """

    draw: str
    size: tuple[float, float] = (7.6, 5.6)
    proof: str = ""


DRAWINGS = {
    "attractor": Drawing("releases:attractor", (9.0, 4.8)),
    "ball_curve": Drawing("cylinder:ball_curve", (6.8, 5.8)),
    "branch": Drawing("pairs:branch"),
    "capture": Drawing("captures:capture", (8.2, 4.2)),
    "cascade": Drawing("releases:cascade", (9.0, 4.6)),
    "conservative": Drawing("islands:conservative", (7.2, 5.2)),
    "contact_attractor": Drawing("phases:contact_attractor", (6.4, 6.4)),
    "contact_basin": Drawing("shares:basin", (7.2, 6.0)),
    "contact_capture": Drawing("chatter:capture", (8.6, 4.6)),
    "contact_elliptic": Drawing("contacts:elliptic", (8.6, 5.0)),
    "contact_horseshoe": Drawing("horseshoes:contact_horseshoe", (7.2, 5.8)),
    "contacts": Drawing("contacts:contacts", (8.6, 5.0)),
    "contacts_branch": Drawing("curves:branch", (7.6, 6.2)),
    "contacts_family": Drawing("contacts:family", (8.6, 5.0)),
    "converse": Drawing("islands:converse", (6.6, 5.6)),
    "effective_stability": Drawing("fixed_points:effective_stability", (7.0, 6.6)),
    "elliptic": Drawing("fixed_points:elliptic"),
    "entropies": Drawing("releases:entropies", (7.2, 4.6)),
    "homoclinic": Drawing("homoclinic:draw", (6.4, 5.8), "Proof"),
    "horseshoe": Drawing("horseshoes:horseshoe", (7.2, 6.2)),
    "impulse": Drawing("resting:impulse", (6.4, 4.6)),
    "inventory": Drawing("islands:inventory", (8.6, 4.6)),
    "island": Drawing("islands:island", (6.6, 5.6)),
    "islands": Drawing("island_family:islands", (7.2, 6.4)),
    "map_curve": Drawing("cylinder:map_curve", (6.8, 5.8)),
    "map_horseshoe": Drawing("horseshoes:map_horseshoe", (7.2, 5.8)),
    "mixed": Drawing("mixed:draw", (7.4, 9), "Proof"),
    "particles": Drawing("two_masses:elliptic", (9.0, 4.4)),
    "particles_limits": Drawing("two_masses:limits", (7.6, 7.0)),
    "particles_saddle": Drawing("two_masses:saddle", (9.0, 4.4)),
    "particles_sink": Drawing("two_masses:sink", (8.2, 4.2)),
    "particles_stability": Drawing("two_masses:stability", (8.2, 6.2)),
    "periodic": Drawing("fixed_points:periodic"),
    "persistence": Drawing("fixed_points:persistence", (9.6, 5.8)),
    "pitchfork": Drawing("pairs:pitchfork"),
    "saddle": Drawing("fixed_points:saddle"),
    "segment": Drawing("resting:segment", (8.2, 4.4)),
    "sliding": Drawing("resting:sliding", (8.2, 4.4)),
    "symmetric": Drawing("pairs:symmetric"),
    "window": Drawing("releases:window", (9.0, 4.8)),
}


def proof(name: str) -> type[Theorem]:
    """Return what proves a theorem so that it can be drawn."""
    if name not in DRAWINGS:
        raise BadInput(f"there is no picture of the theorem {name}")
    drawing = DRAWINGS[name]
    if not drawing.proof:
        return theorems.load(name)
    found: type[Theorem] = getattr(_module(drawing), drawing.proof)
    return found


def function(name: str) -> Callable[[Any, Figure], None]:
    """Return what draws a theorem of this name that is proved."""
    drawing = DRAWINGS[name]
    found: Callable[[Any, Figure], None] = getattr(_module(drawing), drawing.draw.split(":")[1])
    return found


def drawn(theorem: Theorem) -> Figure:
    """Return the picture of a theorem that is proved."""
    name = theorem.certificate.theorem
    with style():
        figure = blank(DRAWINGS[name].size)
        function(name)(theorem, figure)
    return figure


def _module(drawing: Drawing) -> Any:
    return import_module(f"{__name__}.{drawing.draw.split(':')[0]}")
