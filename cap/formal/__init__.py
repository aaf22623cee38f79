"""Theorems for Coq: the numbers of a certificate as Coq reads them, and a run of Coq.

Nothing here is trusted.  `theorem` writes numbers, `hints` says where to look for the orbit; the
library in ``proofs/formal`` computes in Coq's kernel whether the theorem holds with these numbers.
"""
