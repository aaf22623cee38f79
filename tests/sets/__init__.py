"""Tests of the arithmetic of sets."""
