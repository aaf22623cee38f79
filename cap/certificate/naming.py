"""Names of certificates: they tell the theorem, the parameters and the orbit, and nothing else.

    elliptic.json                   the paper's parameters, the orbit that the search finds first
    elliptic-f=9_20.json            other parameters: those that are not the paper's
    periodic-F=3-period=2.json      and what else the theorem is about
    elliptic-x=0.559163-v=1.06697.json    an orbit that was asked for: its state at t = 0

So a name does not depend on what lies in the folder.  Certificates that differ in their digits, or
the order of their twists, have the same name.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from pathlib import Path

from cap.certificate.writer import stored
from cap.checker.kernel.certificate import Certificate
from cap.checker.theorems import load
from cap.errors import BadInput
from cap.parameters import PAPER, Parameters

LONGEST = 120  # characters of a name
NEAR = Fraction(1, 10**6)  # in the units R and R omega: orbits that are the same in floats
LOSSLESS = {"e": Fraction(1), "mu": Fraction(0)}  # of a theorem whose parameters have no losses

State = tuple[float, float]


def name(theorem: str, parameters: Parameters, about: Mapping[str, str]) -> str:
    """Return the name of a file; ``about`` is what the theorem is about besides its parameters."""
    paper = PAPER.strings()
    changed = {key: q for key, q in _told(theorem, parameters).items() if q != paper[key]}
    return short([theorem, *(f"{key}={value}" for key, value in {**changed, **about}.items())])


def short(words: Sequence[str]) -> str:
    """Return the name of a file that tells these words; a long one tells the first, the theorem."""
    told = "-".join(words).replace("/", "_")
    if len(told) > LONGEST:
        from hashlib import sha256  # noqa: PLC0415 (slow to load, and few names are so long)

        told = f"{words[0]}-{sha256(told.encode()).hexdigest()[:16]}"
    return f"{told}.json"


def of_state(state: State) -> dict[str, str]:
    """Return what tells an orbit: its state at t = 0, to six digits."""
    return {key: f"{z:.6g}" for key, z in zip("xv", state, strict=True)}


def free(
    path: Path,
    theorem: str,
    parameters: Parameters,
    state: State,
    masses: tuple[Fraction, ...] = (),
) -> None:
    """Raise `BadInput` unless nothing is at ``path``, or a certificate about the same.

    So no other file is replaced.
    """
    if not path.exists():
        return
    old = stored(path)
    same = old and getattr(old.parameters, "masses", ()) == masses
    if not (old and same and _is_about(old, theorem, parameters, state)):
        advice = "move it away, or name the file with --out FILE.json"
        raise BadInput(f"there is another file at {path}: {advice}")


def _told(theorem: str, parameters: Parameters) -> dict[str, str]:
    """Return the parameters that a certificate has."""
    strings, about = parameters.strings(), load(theorem).PARAMETERS
    return {key: strings[key] for key in strings if key != "f" or "f" in about}


def _is_about(old: Certificate, theorem: str, p: Parameters, state: State) -> bool:
    """Return whether a certificate has this theorem and these parameters, and holds the state.

    What has no box of states is about no one state.
    """
    given = {**LOSSLESS, **old.parameters._asdict()}
    same = all(given[key] == getattr(p, key) for key in _told(theorem, p))
    if old.theorem != theorem or not same or not isinstance(old.claims.get("box"), dict):
        return old.theorem == theorem and same
    where = old.claims if "x" in old.claims else old.claims["box"]
    units = {"x": p.R, "v": p.R * p.omega}
    return all(
        where[key].lower - NEAR * units[key] <= z <= where[key].upper + NEAR * units[key]
        for key, z in zip("xv", state, strict=True)
        if key in where
    )
