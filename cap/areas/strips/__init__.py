"""The prover's side of `conservative`: columns of launches, fitted to `cap.checker.strips`."""
