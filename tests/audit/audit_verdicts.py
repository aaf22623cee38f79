"""Verdicts for the tests of the audit."""

import os

from cap.audit.verdict import Outcome, Verdict


def said(outcome, found="", evidence="", **more):
    """Return a verdict."""
    return Verdict(outcome=Outcome(outcome), found=found, evidence=evidence, **more)


def killed(*_):
    """End the process that decides."""
    os._exit(1)
