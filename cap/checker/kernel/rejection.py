"""The one way to fail: a condition that is not certainly true rejects the certificate."""


class Rejected(Exception):
    """The certificate does not prove its claim.  It does not follow that the claim is false."""


def need(ok: object, why: str) -> None:
    """Raise ``Rejected(why)`` unless ``ok`` is exactly ``True`` (``python -O`` changes nothing)."""
    if ok is not True:
        raise Rejected(why)


class TooCoarse(Rejected):
    """A step that finer hints might pass."""
