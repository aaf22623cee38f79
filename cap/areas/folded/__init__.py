"""The prover's side of `mixed`, in compiled doubles: a mirror of `cap.checker.folded`."""
