"""The one way in which a step of a decision fails; that steps were made is noted."""

from cap.errors import NotProved

_steps = 0


def need(ok: object, why: str, **sets: object) -> None:
    """Raise `NotProved` unless ``ok`` is exactly True; ``why`` says what was not established."""
    made()
    if ok is not True:
        raise NotProved("audit", why, sets)


def made() -> None:
    """Note that a step was made."""
    global _steps  # noqa: PLW0603 (one decision is made at a time)
    _steps += 1


def steps() -> int:
    """Return how many steps were made since the last call; forget them."""
    global _steps
    found, _steps = _steps, 0
    return found
