"""Test tools of the checker's tests."""
