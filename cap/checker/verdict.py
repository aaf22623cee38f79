"""A certificate is checked: the theorem that it names is proved from its numbers, or not."""

from __future__ import annotations

from collections.abc import Callable

from cap.checker.kernel.certificate import Certificate, read
from cap.checker.theorems import load


def check(
    data: bytes,
    step: Callable[[str], None],
    jobs: int = 1,
    tell: Callable[[str, float], None] = lambda _words, _part: None,
) -> Certificate:
    """Return the certificate if its theorem is proved; otherwise raise an exception.

    Each step is reported in one line when it is done.  With ``jobs`` > 1 a long proof may use as
    many processes.  ``tell`` hears again and again what a long proof does, and which part of all of
    it is done.
    """
    certificate = read(data)
    step(f"the certificate has the form of the theorem '{certificate.theorem}'")
    theorem = load(certificate.theorem)(certificate, step)
    theorem.jobs, theorem.tell = jobs, tell
    theorem.prove()
    return certificate


def words(certificate: Certificate) -> str:
    """Return the theorem of a certificate in one line."""
    return load(certificate.theorem)(certificate, lambda _: None).words()
