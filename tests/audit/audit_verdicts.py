"""Verdicts for the tests of the audit."""

from cap.audit.verdict import Outcome, Verdict


def said(outcome, found="", evidence="", **more):
    """Return a verdict."""
    return Verdict(outcome=Outcome(outcome), found=found, evidence=evidence, **more)
