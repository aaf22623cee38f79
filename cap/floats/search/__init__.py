"""Float mode, search: periodic orbits, families and curves of them, with any itinerary."""
