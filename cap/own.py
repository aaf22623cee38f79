"""A periodic orbit of a system of one's own, proved from Python; see docs/own-system.md."""

from collections.abc import Callable, Sequence

from cap.errors import BadInput, NotProved
from cap.interface import Verified, verified
from cap.option import integer
from cap.system.model import System

DIGITS, PERIODS = (1, 100), (1, 64)  # limits


def prove_orbit(
    system: System,
    *,
    state: Sequence[float] | None = None,
    mode: str | None = None,
    periods: int = 1,
    digits: int = 10,
    progress: Callable[[str], None] = lambda _: None,
) -> Verified:
    """Prove a periodic orbit by its contacts, theorem `contacts`; the checker verifies it.

        prove_orbit(read("examples/ball.py", {"A": "6/5"}))
        prove_orbit(ball, state=(2.0, -2.6), mode="fly", digits=20)

    It is the orbit to which Newton's method leads from a ``state`` at t = 0, in a ``mode`` (by
    default the first one where the state may begin); without one the first that a search in floats
    finds, those that attract first.  ``periods`` are those of the clock in a round.

    Raises `BadInput` if no orbit is found or the request makes no sense, and `NotProved` if a step
    of the proof does not succeed: the orbit may still be there.
    """
    from cap.certificate import writer  # noqa: PLC0415 (slow to load: only who proves)
    from cap.floats.models.periodic import near, search  # noqa: PLC0415
    from cap.proofs import contacts  # noqa: PLC0415

    count = integer(str(periods), "periods", PERIODS)
    shown = integer(str(digits), "digits", DIGITS)
    contacts.as_parameters(system)
    progress("an orbit is looked for")
    if state is not None:
        try:
            orbit = near(system, [float(z) for z in state], mode, count)
        except NotProved as failure:
            raise BadInput(f"no orbit that closes is near that of the state: {failure}") from None
    else:
        found = search(system, count, lambda words, _part: progress(words)).orbits
        if not found:
            raise BadInput(
                f"no isolated orbit with a contact was found that closes after {count} T"
            )
        orbit = found[0]
    progress(f"proving: {orbit.shown()}")
    return verified(writer.dumps(contacts.prove(orbit.itinerary, orbit.guess, shown)).encode())
