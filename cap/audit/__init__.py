"""The audit of the paper: every checkable claim, decided, with evidence that can be run again.

``python -m cap.audit`` prints a referee's report.  Read `cap.audit.given` for what a claim is,
`cap.audit.verdict` for what can be said of it, `cap.audit.subject` for what a paper consists of,
`cap.audit.steps` for how claims are decided.
"""
