"""The prover's side of the horseshoes: which parallelograms cover which, in boxes."""
