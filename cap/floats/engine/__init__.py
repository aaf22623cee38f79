"""Float mode, the flow: flights and events of one mass in doubles, one orbit or many at once."""
