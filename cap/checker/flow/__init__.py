"""Mechanics, events and itineraries, transcribed for the checker."""
