"""The one way in which a step of a decision fails."""

from cap.errors import NotProved


def need(ok: object, why: str, **sets: object) -> None:
    """Raise `NotProved` unless ``ok`` is exactly True; ``why`` says what was not established."""
    if ok is not True:
        raise NotProved("audit", why, sets)
