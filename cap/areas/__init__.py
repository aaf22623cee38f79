"""The prover's side of `mixed`, `conservative` and `converse`: it finds what is then proved."""
