"""A system as data: modes, guards, resets; and what follows from them by exact algebra."""
