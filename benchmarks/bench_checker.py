"""The checker's time on the stored certificates.

    python -m pytest -n0 benchmarks/bench_checker.py --benchmark-columns=min

`benchmarks/worst.py` measures the worst certificates that the format admits.
"""

import json
from pathlib import Path

import pytest

from cap.checker.verdict import check

STORED = Path(__file__).parents[1] / "certificates"


def checked(benchmark, certificate):
    """Measure the check of a certificate, which must succeed, once."""
    data = json.dumps(certificate).encode()
    benchmark.extra_info["bits"] = certificate["hints"].get("bits")
    benchmark.pedantic(check, (data, lambda _: None), rounds=1)


@pytest.mark.parametrize("path", sorted(STORED.glob("*.json")), ids=lambda path: path.stem)
def test_stored(benchmark, path):
    """Every stored certificate."""
    checked(benchmark, json.loads(path.read_text("utf-8")))
