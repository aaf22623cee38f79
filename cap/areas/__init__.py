"""The prover's side of `mixed` and `conservative`: what the checker then proves is found here."""
