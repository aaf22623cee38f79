"""The papers that are audited, each in a folder of its own; see `cap.audit.subject`."""

FIRST = "mixed_dynamics"  # the one that is meant if none is named
