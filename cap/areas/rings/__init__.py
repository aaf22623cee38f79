"""The prover's side of `converse`: rings around an island, from which motions stop or go out."""
