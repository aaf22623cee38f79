"""A test tool: valid certificates of ``capture``, made in mpmath, with claims that are tight.

Nothing here is rigorous: margins are guessed, and the tests show that the checker accepts them.
"""

from __future__ import annotations

from itertools import product

from mpmath import mp, mpf

from checker.forge import _decimal, _mp
from checker.forge_hybrid import PAPER, around, claim, envelope, windows
from checker.hybrid import Flow


def forge_capture(  # noqa: PLR0913
    *,
    parameters=PAPER | {"e": "1", "mu": "0"},
    box=(("0.998", "1"), ("-0.02", "0.02")),
    wall="r",
    held=("0.5",),
    speed=None,
    digits=20,
    margin="1e-9",
):
    """Return a valid certificate of a capture, at once or (with a speed) by the hit below it.

    What is claimed exceeds what follows by the margin, and by a part of the spread of the times.
    """
    with mp.workdps(40):
        flow, margin, side = Flow(parameters), mpf(margin), 1 if wall == "r" else -1
        times, words, claimed, start, fastest = [], [], [], mpf(0), None
        corners, slack = [tuple(map(mpf, q)) for q in box], margin
        if speed is not None:
            times, words = windows([flow], corners, captures=(mpf(speed), held), margin="0.0005")
            cut = words.index(f"capture {wall}")
            runs = [flow.run(*z, 1, mpf(speed))[0] for z in product(*corners)]
            times, words, claimed = times[:cut], words[:cut], tightly(runs, times[:cut], margin)
            fastest, start = (max(getattr(r[cut - 1], q) for r in runs) for q in ("speed", "t"))
            slack += (start - min(run[cut - 1].t for run in runs)) / 20
        words += [f"capture {wall}", f"release {'left' if side > 0 else 'right'}"]
        times.append([times[-1][0] if times else "0", held[-1]])
        b = forcing(flow, side, times[-1])
        if fastest is None:
            height = max(side * ((flow.r if side > 0 else flow.l) - x) for x in corners[0])
            until, k = lemma(flow, b, max(map(abs, corners[1])), height=height)
        else:
            until, k = lemma(flow, b, fastest, start=start)
        claimed.append([claimed[-1][0] if claimed else "0", _decimal(until + slack, 20)])
        out, _ = flow.released(mpf(held[-1]), -side)
        times.append(around(out, mpf("1e-9")))
        claims = {
            "box": {name: list(q) for name, q in zip("xv", box, strict=True)},
            "wall": wall,
            "itinerary": words,
            "event_times": [*claimed, times[-1]],
            "forcing": [_decimal(b[0] - margin, 20), _decimal(b[1] + margin, 20)],
            "ratio": _decimal(k + margin, 20),
            "accumulation_time": claimed[-1],
            "release_time": claim(out, digits, 1 / flow.omega),
        }
    hints = {"bits": str(int(digits * 3.33) + 60), "events": times}
    return envelope("capture", parameters, digits, claims, hints)


def lemma(flow, force, speed, *, height=None, start=0):
    """Return when the hits have accumulated by the lemma of capture, and the ratio of their speeds.

    The force towards the wall lies in an interval; the mass is at most so fast and so high at the
    time 0, or without a height hits the wall so fast at the start.
    """
    low, high = force
    rise, fall, wait, q = low + flow.f, high - flow.f, mpf(0), speed
    k = flow.e * mp.sqrt(fall / rise)
    if height is not None:
        q = mp.sqrt(speed**2 * max(1, fall / rise) + 2 * fall * height)
        H = height + speed**2 / (2 * rise)
        wait = speed / rise + mp.sqrt(2 * H / (low - flow.f - flow.mu * q))
    g = low - flow.f - flow.mu * q
    return start + wait + (1 / rise + 1 / mp.sqrt(rise * g)) * flow.e * q / (1 - k), k


def forcing(flow, side, window):
    """Return the least and the greatest force towards the wall in a window."""
    a, b = map(_mp, window)
    values = [side * flow.force(a + (b - a) * n / 100) for n in range(101)]
    return min(values), max(values)


def tightly(runs, times, margin):
    """Return enclosures of the times of events, little wider than they spread, or of a capture."""
    result = []
    for n, window in enumerate(times):
        if runs[0][n].word.startswith("capture"):
            result.append(window)
            continue
        found = [run[n].t for run in runs]
        reach = (max(found) - min(found)) / 50 + margin
        result.append([_decimal(min(found) - reach, 20), _decimal(max(found) + reach, 20)])
    return result
