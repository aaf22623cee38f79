"""Write the Coq file of a certificate: ``python -m cap.formal CERTIFICATE``, to standard output.

The Makefile in ``proofs/formal`` calls it; to prove the theorem at once, use
``python -m cap.verify --formal CERTIFICATE``.
"""

from cap.command import entry

if __name__ == "__main__":
    entry.leave(entry.run("cap.command.formal:write", None))
