"""The command lines: options, progress, how they begin and end."""
