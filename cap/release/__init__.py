"""From one release to the next: after a stick the state is one number, and Φ a map of an interval."""
