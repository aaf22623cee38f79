"""The one way in which a step of a decision fails; what a decision rests on is noted."""

from cap.errors import NotProved

_NOTED: list[str] = []  # one decision is made at a time


def need(ok: object, why: str, **sets: object) -> None:
    """Raise `NotProved` unless ``ok`` is exactly True; ``why`` says what was not established."""
    made()
    if ok is not True:
        raise NotProved("audit", why, sets)


def made(certificate: str = "") -> None:
    """Note that a step was made, or that a certificate was asked for."""
    _NOTED.append(certificate)


def noted() -> list[str]:
    """Return what was noted since the last call; forget it."""
    found = list(_NOTED)
    _NOTED.clear()
    return found
