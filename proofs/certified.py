"""Certificates of maps and of systems of one's own: made, and given to the checker."""

from typing import Any

from cap.certificate import writer
from cap.checker.kernel.rejection import Rejected
from cap.checker.theorems import load
from cap.checker.verdict import check
from cap.errors import NotProved
from cap.runner import Runner

Content = tuple[dict[str, Any], dict[str, Any]]
"""Claims and hints."""


def assembled(
    theorem: str,
    parameters: dict[str, Any],
    digits: int,
    content: Content,
    bits: int | None = None,
) -> dict[str, Any]:
    """Return a certificate from its claims and hints; what it cites is the checker's list.

    ``bits`` is the precision in which it was found, if that is known by now.
    """
    claims, hints = content
    return {
        "format": writer.FORMAT,
        "theorem": theorem,
        "parameters": parameters,
        "digits": str(digits),
        "claims": claims,
        "hints": hints,
        "cites": load(theorem).cited(claims),
        **({} if bits is None else {"provenance": writer.provenance(bits)}),
    }


def certified(
    theorem: str,
    parameters: dict[str, Any],
    content: Content,
    runner: Runner,
    *,
    digits: int = 6,
    bits: int = 64,
) -> dict[str, Any]:
    """Return a certificate, of claims and hints, that the checker accepts.

    ``bits`` is the precision in which it was found.  Raises `NotProved` with the checker's reason.
    """
    certificate = assembled(theorem, parameters, digits, content, bits)
    runner.tell("the checker checks it", None)
    try:
        check(writer.dumps(certificate).encode(), lambda _step: None, runner.jobs, runner.tell)
    except Rejected as reason:
        why = f"the independent checker rejects the certificate: {reason}"
        raise NotProved("checker", why) from None
    return certificate
