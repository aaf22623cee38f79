"""Intervals, elementary functions, jets and strict reading: what every referee reads."""
