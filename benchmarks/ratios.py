"""Our times over those of the python-flint peer (`peer.py`), in one run, in turns.

    python benchmarks/ratios.py [ROUNDS]

A time is the least of many short rounds, ours and the peer's by turns, so that a busy machine
disturbs both alike.  *second pass* (existence and what follows from K) is compared with the peer's
and, as *in all*, with the peer's existence alone.  On one core, in microseconds, before and after
the work on speed of November, the peer the same:

    bits                       53                              200
                   before   after    peer  ratio   before   after    peer  ratio
    existence         159     114      87   1.32      210     155     112   1.38
    second pass       235     167     128   1.31      313     236     167   1.42
    in all            232     166      87   1.91      312     225     114   1.97
    jet               405     256     262   0.98      480     291     319   0.91

Ours serves any itinerary, walls, parameters and scalars, encloses the least speed too, and its jets
are two to six times narrower beyond order 0: that they became by the work on speed, while the other
enclosures stayed the same, up to 3% of the rounding errors.
"""

import sys
import time
from collections.abc import Callable

import peer
from bench_elliptic import Hints

from cap.flow.event import BALLS
from cap.flow.jet_transport import strobe_jet
from cap.flow.strobe import strobe
from cap.sets import interval

CALLS = 10


def ratio(ours: Callable[[], object], theirs: Callable[[], object], rounds: int) -> str:
    """Return the least times of a call of both, in microseconds, and their ratio."""
    best = [float("inf"), float("inf")]
    for _ in range(rounds):
        for k, function in enumerate((ours, theirs)):
            began = time.perf_counter()
            for _ in range(CALLS):
                function()
            best[k] = min(best[k], (time.perf_counter() - began) / CALLS * 1e6)
    return f"{best[0]:7.1f} us   peer {best[1]:7.1f} us   {best[0] / best[1]:5.2f}"


def compare(bits: int, rounds: int) -> None:
    """Print the table for one precision."""
    with interval.workprec(bits):
        ours, theirs = Hints(), peer.Hints()
        orbit = strobe(ours.osc, ours.box, ours.expected, BALLS)
        times = peer.existence(theirs)[-1]
        table: list[tuple[str, Callable[[], object], Callable[[], object]]] = [
            ("existence", ours.existence, lambda: peer.existence(theirs)),
            ("second pass", ours.second_pass, lambda: peer.second_pass(theirs)),
            ("in all", ours.second_pass, lambda: peer.existence(theirs)),
            (
                "jet",
                lambda: strobe_jet(ours.osc, ours.box, orbit, 3),
                lambda: peer.jet(theirs, times),
            ),
        ]
        for name, mine, other in table:
            print(f"{bits:4} bits   {name:12} {ratio(mine, other, rounds)}", flush=True)


if __name__ == "__main__":
    for precision in (53, 200):
        compare(precision, int(sys.argv[1]) if len(sys.argv) > 1 else 300)
