"""The papers that are audited, each in a folder of its own; see `cap.audit.subject`."""
