"""The packages to install: those found in `cap`, and two folders of the tree that belong inside it.

In the tree `cap/proofs` and `cap/certificates` are links to these folders; here they are named, for
systems without links and for archives.  Everything else is in `pyproject.toml`.
"""

from setuptools import find_packages, setup

INSIDE = {"cap.proofs": "proofs", "cap.certificates": "certificates"}

setup(
    packages=sorted({*find_packages(include=["cap", "cap.*"]), *INSIDE}),
    package_dir=INSIDE,
)
