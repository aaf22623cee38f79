"""Tests of the flow of cells."""
