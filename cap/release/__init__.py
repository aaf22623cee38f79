"""After a stick the state is one number: the map from one release to the next."""
