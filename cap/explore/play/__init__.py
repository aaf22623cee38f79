"""The page to play with: a portrait, the orbit of a click, and the prover, in a browser."""
