"""Periodic orbits of own systems: to prove and to check, over the check of `elliptic`, by turns.

    python benchmarks/contacts_of_own.py [ROUNDS]

Times are the least of the rounds, of processor time, in milliseconds; what is made of a system
alone (functions, parameters of the certificate) is made once.  ``orbit`` is the proof alone, in
balls from a guess, with Newton's iteration; ``in a row`` is the mean of ten, between which nothing
else runs.  ``prove`` adds the text of the certificate and, where one is found, the ellipsoid that
is attracted; the checker reads the text.
"""

import sys
import time
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path[0] = str(ROOT / "tests")  # not the modules beside this one

from own_systems import CASES  # noqa: E402

from cap.certificate.writer import dumps  # noqa: E402
from cap.checker.verdict import check  # noqa: E402
from cap.orbits.equations import Equations  # noqa: E402
from cap.orbits.periodic import Prover  # noqa: E402
from cap.proofs import contacts, published  # noqa: E402
from cap.proofs.contacts import EXTRA, Prepared  # noqa: E402
from cap.sets import interval  # noqa: E402
from cap.system.files import read  # noqa: E402

DIGITS = 10
CALLS = 10
REFERENCE = (ROOT / "certificates/elliptic.json").read_bytes()


def verified(data: bytes) -> None:
    """Check a certificate."""
    check(data, lambda _: None)


def orbit(itinerary: Any, guess: list[float], shared: Prepared) -> None:
    """Prove an orbit as `contacts.prove` does, without a certificate."""
    with interval.workprec(96 + 8 * DIGITS):
        prover = Prover(Equations(itinerary, shared.kinds), pieces=True)
        prover.prove(guess, DIGITS + EXTRA, Fraction(1, 10 ** (DIGITS + 2)))


def in_a_row(itinerary: Any, guess: list[float], shared: Prepared) -> None:
    """Prove the orbit again and again."""
    for _ in range(CALLS):
        orbit(itinerary, guess, shared)


def cases() -> Iterator[tuple[str, Any, list[float]]]:
    """Give names, itineraries and guesses."""
    for name, case in CASES.items():
        yield name, *case()
    system = read(ROOT / "examples/billiard.py")
    table = ROOT / "examples/data/church-fortin/a1.8-e0.75-E1.5.csv"
    for row in published.rows(system, table)[:1]:
        itinerary = published.Itinerary(system, row.contacts, row.periods)
        yield "billiard, two impacts", itinerary, list(row.guess)


def least(functions: list[Callable[[], object]], rounds: int) -> list[float]:
    """Return the least times of some functions, which run by turns, in milliseconds."""
    best = [float("inf")] * len(functions)
    for _ in range(rounds):
        for k, function in enumerate(functions):
            began = time.process_time()
            function()
            best[k] = min(best[k], (time.process_time() - began) * 1e3)
    return best


def main(rounds: int) -> None:
    """Print a line for each orbit."""
    heads = "".join(f" {name:>8}" for name in ("orbit", "in a row", "prove", "check"))
    print(f"{'':22}{heads} {'both over the check of elliptic':>34}")
    for name, itinerary, guess in cases():
        shared = Prepared.of(itinerary.system)
        data = dumps(contacts.prove(itinerary, guess, shared=shared)).encode()
        alone, row, both, ours, theirs = least(
            [
                lambda: orbit(itinerary, guess, shared),  # noqa: B023
                lambda: in_a_row(itinerary, guess, shared),  # noqa: B023
                lambda: contacts.prove(itinerary, guess, shared=shared),  # noqa: B023
                lambda: verified(data),  # noqa: B023
                lambda: verified(REFERENCE),
            ],
            rounds,
        )
        prove = both - ours  # the proof ends with a check
        times = f"{alone:8.2f} {row / CALLS:8.2f} {prove:8.2f} {ours:8.2f}"
        print(f"{name:22} {times} {prove / theirs:16.3f} {ours / theirs:16.3f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)
