"""Float mode: search.  Nothing rigorous trusts it; no rigorous module imports it."""
