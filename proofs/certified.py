"""Certificates of maps and of systems of one's own: made, and given to the checker."""

from typing import Any

from cap.certificate import writer
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems import load
from cap.checker.verdict import check
from cap.errors import NotProved
from cap.runner import Runner


def certified(
    theorem: str,
    parameters: dict[str, Any],
    content: tuple[dict[str, Any], dict[str, Any]],
    runner: Runner,
    *,
    digits: int = 6,
    bits: int = 64,
) -> dict[str, Any]:
    """Return a certificate, of claims and hints, that the checker accepts.

    ``bits`` is the precision in which it was found.  Raises `NotProved` with the checker's reason.
    """
    claims, hints = content
    certificate = {
        "format": writer.FORMAT,
        "theorem": theorem,
        "parameters": parameters,
        "digits": str(digits),
        "claims": claims,
        "hints": hints,
        "cites": load(theorem).cited(claims),
        "provenance": writer.provenance(bits),
    }
    runner.tell("the checker checks it", None)
    try:
        check(writer.dumps(certificate).encode(), lambda _step: None, runner.jobs, runner.tell)
    except Rejected as reason:
        why = f"the independent checker rejects the certificate: {reason}"
        raise NotProved("checker", why) from None
    return certificate
