"""Why a theorem does not apply to a system of one's own, in one line each."""

from collections.abc import Mapping

from cap.proofs import symbolic
from cap.proofs.theorems import THEOREMS

PROVED = (
    "of a system of one's own `periodic`, `elliptic`, `branch`, `family`, `capture`, `basin`, "
    "`attractor` and `horseshoe` are proved"
)

LISTED = {
    "periodic --model FILE": "periodic orbits by their contacts; their type, the basin of a sink",
    "elliptic --model FILE": "an elliptic orbit where nothing is lost: its twist, tori around it",
    "branch --model FILE": "a curve of periodic orbits over a parameter: its folds and flips",
    "family --model FILE": "a family of periodic orbits at one value of the parameters, exactly",
    "capture --model FILE": "infinitely many contacts in finite time, then rest, from a box",
    "basin --model FILE": "the share of a rectangle of states that comes to rest in time",
    "attractor --model FILE": "releases: one motion that the others tend to, or entropy",
    "horseshoe --model FILE": "entropy of motions from contact to contact",
    "horseshoe --map FILE": "the same of a map of the plane",
    "island --map FILE": "an invariant curve around the cylinder, which no orbit of a map crosses",
    "island --ball A=Q": "the same of an elastic ball on a vibrating table",
}
"""What is proved of a system or a map of one's own, for ``--list``."""

REASONS: Mapping[str, str] = {
    "family": "name it first: `family --model FILE`",
    "capture": "name it first: `capture --model FILE`",
    "attractor": "name it first: `attractor --model FILE`",
    "entropies": "its map is that of one mass under dry friction; see `attractor --model`",
    "window": "its map is that of one mass under dry friction; see `attractor --model`",
    "cascade": "its map is that of one mass under dry friction; see `attractor --model`",
    "effective_stability": "its motions are those whose velocity never vanishes, of one mass",
    "island": "its invariant curve is one of the map over half a period, of one mass",
    "homoclinic": "its curves are those of a saddle of the map over one period, of one mass",
    "saddle": "`periodic --model` says of any orbit how many multipliers are outside the circle",
    "persistence": "its family goes from elastic walls to others; see `branch --model`",
    "pitchfork": "its orbits hit each of two walls once, in closed form; see `branch --model`",
    "symmetric": "its orbits hit each of two walls once, in closed form; see `branch --model`",
    "inventory": "its list is complete by a bound of the velocities between two walls",
    "segment": "its orbits touch no wall and are in closed form",
    "conservative": "its areas are those of velocities that never vanish, between two walls",
    "mixed": "its areas are those of one mass between two walls",
    "horseshoe": "name it first: `horseshoe --model FILE`",
    "impulse": "its bound is that of the momentum of one mass under dry friction",
    "symplectic": "its identities are those of collisions of masses",
}
MASSES = "it is about masses between two walls; `periodic --model` takes any number of them"
OTHER = "it is about one mass between two walls"


def why(theorem: str) -> str:
    """Return the line for a theorem, or for what is none."""
    if theorem not in (*THEOREMS, *symbolic.NAMES):
        return f"there is no theorem {theorem!r}; {PROVED}"
    other = MASSES if theorem.startswith(("particles", "sliding")) else OTHER
    return f"{theorem} does not apply to a model: {REASONS.get(theorem, other)}; {PROVED}"
