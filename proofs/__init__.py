"""One module for each theorem, reading like its proof on paper."""
