"""Float mode: search and diagnostics.  No rigorous module imports it; proofs take hints from it."""
