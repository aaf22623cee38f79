"""What can be proved, and how: each theorem with its search and its proof, up to the checker.

The proof of a theorem is in ``proofs/NAME.py``, which is imported when it is asked for: it takes
longer to load all of them than to prove one.  No table names the theorems: they are the checker's.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from importlib import import_module
from types import ModuleType
from typing import Any

from cap.certificate import writer as certificate
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems import NAMES
from cap.checker.verdict import check
from cap.errors import NotProved, TooFewDigits
from cap.floats.candidates import Search
from cap.option import Option
from cap.parameters import Parameters
from cap.proofs.fixed_point import Proof, Setting
from cap.proofs.options import RANGE_OF_F
from cap.runner import Runner, within

PARTS = [Fraction(n, 100) for n in (90, 70, 50, 30, 10, 3, 1)]  # of the largest box found
GUARDS = (15, 30, 60)  # digits computed beyond those claimed
LOOSER = "does not contain the enclosure computed"  # by the checker: with more digits it may

Check = Callable[[Mapping[str, Any], Parameters], object]

GROUPS = {
    "orbit": "one periodic orbit, or one box of states",
    "family": "all orbits of a kind",
    "states": "what becomes of all states",
    "releases": "orbits that stick: the map from the place of one release to that of the next",
    "masses": "two masses",
    "identities": "identities, for all parameters, without a certificate",
}
"""What one may want to prove, in the order of ``--list``."""


@dataclass(frozen=True)
class Theorem:
    """A theorem of the checker and, in ``proofs/NAME.py``, its proof."""

    name: str

    @property
    def _module(self) -> ModuleType:
        return import_module(f"cap.proofs.{self.name}")

    @property
    def summary(self) -> str:
        """What it says, in a line."""
        return str(self._module.SUMMARY)

    @property
    def group(self) -> str:
        """To which of the `GROUPS` it belongs."""
        return str(self._module.GROUP)

    @property
    def options(self) -> tuple[Option, ...]:
        """The options that it takes, beside those that all take."""
        options: tuple[Option, ...] = getattr(self._module, "OPTIONS", ())
        return options

    @property
    def over_f(self) -> "Theorem":
        """The theorem, perhaps another, that is proved where a range of f is asked for."""
        return THEOREMS[getattr(self._module, "OVER_F", self.name)]

    def meant(self, given: Collection[str]) -> "Theorem":
        """Return the theorem, perhaps another, that is proved where these options are given."""
        return self.over_f if any(option.name in given for option in RANGE_OF_F) else self

    def fits(self, options: Mapping[str, Any], parameters: Parameters) -> None:
        """Raise `BadInput` if options do not go together, or not with the parameters."""
        check: Check = getattr(self._module, "CHECK", lambda _options, _parameters: None)
        check(options, parameters)

    @property
    def checking(self) -> float:
        """The part of the time of a proof that the checker may take at its end."""
        part: float = getattr(self._module, "CHECKING", 0.0)
        return part

    @property
    def search(self) -> Search:
        """The search for the orbits that it may be about."""
        found: Search = self._module.SEARCH
        return found

    def prove(self, setting: Setting) -> Proof:
        """Prove the theorem up to the size of its box; return the rest of the proof."""
        proof: Proof = self._module.prove(setting)
        return proof


OWN = (
    "ball_curve",
    "contacts",
    "contacts_branch",
    "contacts_family",
    "contact_attractor",
    "contact_basin",
    "contact_capture",
    "contact_elliptic",
    "contact_horseshoe",
    "map_curve",
    "map_horseshoe",
)
"""Theorems about a system of one's own: `cap.command.own`, reached by ``--model``; about a map, by
``--map``: `cap.command.own_curve`, `cap.command.own_horseshoe`; about a ball, by ``--ball``:
`cap.command.own_ball`."""

THEOREMS = {name: Theorem(name) for name in NAMES if name not in OWN}


def takers(option: str) -> list[str]:
    """Return the theorems that take an option of this name, in words; this loads all of them."""
    taken = {name: [o.name for o in theorem.options] for name, theorem in THEOREMS.items()}
    return [
        name if option in taken[name] else f"{name} on a range of f"
        for name, theorem in THEOREMS.items()
        if option in taken[name] + taken[theorem.over_f.name]
    ]


def accepted(theorem: Theorem, setting: Setting) -> dict[str, Any]:
    """Return a certificate that the independent checker accepts, or raise `NotProved`.

    More guard digits are computed until all digits claimed are certain, to the checker, too.
    """
    ours = 1 - theorem.checking
    tell = setting.runner.tell
    runner = replace(setting.runner, tell=within(tell, 0, ours))
    checks = replace(setting.runner, tell=within(tell, ours, 1, "check: "))
    for guard in GUARDS:
        sharper = replace(setting, guard=guard, runner=runner)
        try:
            proved = _followed(theorem.prove(sharper), checks)
            break
        except TooFewDigits:
            if guard == GUARDS[-1]:
                raise
    return {**proved, "provenance": certificate.provenance(sharper.bits)}


def _followed(proof: Proof, runner: Runner) -> dict[str, Any]:
    """Return the certificate for the largest of the `PARTS` to which the checker can follow."""
    rejection, before = "", None
    for part in PARTS:
        proved = {**proof(part), "provenance": {}}
        if proved == before:
            break  # nothing in it depends on the part
        before = proved
        try:
            data = certificate.dumps(proved).encode()
            check(data, lambda _step: None, runner.jobs, runner.tell)
        except Rejected as reason:
            rejection = str(reason)
        else:
            return proved
    looser = rejection.endswith(LOOSER)
    why = f"the independent checker rejects the certificate: {rejection}"
    raise (TooFewDigits if looser else NotProved)("checker", why)
