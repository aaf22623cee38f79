"""Prove this, of a model: an orbit that a search finds, or the one near the state clicked."""

from collections.abc import Callable
from typing import Any

from cap.errors import BadInput
from cap.explore.play.own_sea import own_state
from cap.explore.play.theorem import Ask, Panel
from cap.floats.models.subject import Subject

NAME = "contacts"
SUMMARY = "a periodic orbit, its contacts and multipliers; a basin if it attracts"
OPTIONS = {"digits": "10", "period": "1"}  # and what they are if they are not given


def prove(_theorem: str, options: dict[str, Any], tell: Callable[[str], None]) -> Any:
    """Return the theorem on an orbit of a model, verified; raise `NotProved` or `BadInput`."""
    from cap.own import prove_orbit  # noqa: PLC0415 (slow to load: in this process alone)
    from cap.system.files import load  # noqa: PLC0415

    system = load(options["model"], options["values"]).system
    digits, periods = (options.get(name, usual) for name, usual in OPTIONS.items())
    return prove_orbit(
        system, state=options.get("orbit"), periods=periods, digits=digits, progress=tell
    )


class OwnTheorem(Panel):
    """The panel of proofs about a model."""

    prove_with = staticmethod(prove)

    def __init__(self, ask: Ask) -> None:
        super().__init__(ask, [(NAME, f"{NAME}: {SUMMARY}")], "digits=20 period=2")

    def _about(self, p: Subject) -> dict[str, Any]:
        """Return the model's file and the values of its parameters."""
        return {"model": p.loaded.path, "values": dict(p.loaded.values)}

    def _options(self) -> dict[str, Any]:
        """Return the options of the proof; raise `BadInput` for what is none."""
        found = super()._options()
        for name in found.keys() - {"model", "values", "orbit"}:
            if name not in OPTIONS:
                raise BadInput(f"no option {name}: there are {', '.join(OPTIONS)}")
        if "orbit" in found:
            found["orbit"] = list(own_state(self._ask()[0], found["orbit"]))
        return found
