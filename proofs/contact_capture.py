"""Theorem (contact_capture).  Let a system be given as data (`cap.system.model`), with a guard h
whose events, the hits, make h' to -e h', 0 < e <= 1, and which names a mode of rest.  If the lemmas
succeed, then for every motion that is at an explicit time in an explicit mode and box of states

 (i)   infinitely many hits happen, and until they accumulate nothing else;
 (ii)  they accumulate at a time in an explicit interval, |h'| before each is at most an explicit
       number k < 1 times that before the hit before it, but for a few first ones;
 (iii) from then on it is in the mode of rest, with h = h' = 0: for ever, or until an explicit time
       at least, and not so long as another explicit time.

Proof.  The box is cut in pieces.  (i), (ii): the first hits of a piece are followed, if need be
(`cap.orbits.first_hits`), then the lemma of `cap.orbits.capture` applies.  (iii): h' and L h'
vanish in the mode of rest where h = h' = 0, and its guards, restricted to this set, are positive
over pieces of time; where they depend on the clock alone, one period is enough for all times.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import reduce
from itertools import islice, pairwise, product
from typing import Any, NamedTuple

from cap.certificate import writer
from cap.errors import NotProved
from cap.orbits.capture import Boxes, Found, Start, Window, captured
from cap.orbits.first_hits import Place, hits
from cap.orbits.held import Held, Times
from cap.orbits.wall import Wall
from cap.proofs.certified import certified
from cap.proofs.contacts import as_parameters
from cap.runner import Runner
from cap.sets import bisection, interval
from cap.sets.interval import Ball
from cap.system.exponential import number
from cap.system.polynomial import COS, SIN

BITS, CHECKED = 128, 128
PLACES = 10  # decimals of the times of rest and release
PARTS = [Fraction(k, 4) for k in (2, 1, 3)]  # of a side of the box, where a state is looked for
GRID = 720  # times of a period at which a release is looked for
HITS, MOST_CUTS, FINEST = 8, 600, 2**20  # hits followed; letters of a tree; 1/size of a piece

Tell = Callable[[str, float | None], None]


class Rest(NamedTuple):
    """How long it rests: until ``until``, None for ever, and not until ``released``; and pieces."""

    until: Fraction | None
    released: Fraction | None
    cuts: Times


class Piece(NamedTuple):
    """What is proved of a piece of the box: the windows of the hits that are followed, and then."""

    hits: list[Window]
    found: Found


class Cut(NamedTuple):
    """A box in pieces: the letters of the checker's tree, and the pieces in their order."""

    tree: str
    pieces: list[Piece]


def prove(
    place: Wall, time: Fraction, mode: str, box: Boxes, tell: Tell = lambda *_: None
) -> dict[str, Any]:
    """Return a certificate, which the independent checker accepts, of all states of a box.

    Raises `NotProved` with the step that failed.
    """
    start = Start(place, time, box)
    with interval.workprec(BITS):
        if any(q.variables - {COS, SIN} for q in place.rested().values()):
            found, rest = lemma_2_rest_among_others(start)
            return _checked(start, mode, Cut(".", [Piece([], found)]), rest)
        cut = lemma_1_capture(start, mode, tell)
        return _checked(start, mode, cut, lemma_2_rest(place, whole(cut.pieces)))


def whole(pieces: Sequence[Piece]) -> Window:
    """Return the window in which the hits of all pieces accumulate."""
    times = [piece.found.time for piece in pieces]
    return min(a for a, _ in times), max(b for _, b in times)


def lemma_1_capture(start: Start, mode: str, tell: Tell) -> Cut:
    """*Statement.* (i), (ii).

    *Computed.* The box is cut in halves until of each piece no state is meant, or the lemma of
    `cap.orbits.capture` holds, after some hits that are followed.
    """
    place = Place.of(start.wall)
    sizes = {z: b - a for z, (a, b) in start.box.items()}
    waiting, tree, pieces = [start.box], "", list[Piece]()
    while waiting:
        box = waiting.pop()
        part = Start(start.wall, start.time, box)
        if _is_empty(part, mode):
            tree += "-"
            continue
        try:
            pieces.append(_piece(place, part, mode))
            tree += "."
        except NotProved:
            hopeless = start.wall.e == 1 or start.wall.rising != start.wall.falling
            if hopeless or len(tree) >= MOST_CUTS:
                raise
            z = max(box, key=lambda z: (box[z][1] - box[z][0]) / (sizes[z] or 1))
            (a, b), k = box[z], start.wall.system.state.index(z)
            if (b - a) * FINEST <= sizes[z]:
                raise
            tree += str(k)
            waiting += [{**box, z: ends} for ends in (((a + b) / 2, b), (a, (a + b) / 2))]
            tell(f"{len(pieces)} pieces of the box come to rest", None)
    if not pieces:
        raise NotProved("start", f"no state of the box has positive guards of {mode}")
    return Cut(tree, pieces)


def _is_empty(part: Start, mode: str) -> bool:
    """Return whether a guard is positive nowhere, in a piece of the box."""
    guards = part.wall.system.modes[mode].guards.values()
    return any(part.at(guard.value) < 0 for guard in guards)


def _piece(place: Place, part: Start, mode: str) -> Piece:
    """Return what is proved of a piece, after as few hits as will do.

    Where e = 1 none are followed: no ratio is below 1, unless friction slows a rise.
    """
    try:
        return Piece([], captured(part.wall, part.entry(), part.time))
    except NotProved as failure:
        reason = failure
    if part.wall.e < 1 and mode == part.wall.falling and part.at(part.wall.h) > 0:
        windows: list[Window] = []
        try:
            for window, entry in islice(hits(place, part), HITS):
                windows.append(window)
                with suppress(NotProved):
                    return Piece(windows, captured(part.wall, entry, part.time))
        except NotProved as failure:
            reason = failure
    raise reason


def lemma_2_rest(place: Wall, accumulated: Window) -> Rest:
    """*Statement.* (iii), where the guards of the mode of rest depend on the clock alone.

    *Computed.* These guards on pieces of time.
    """
    since, last = accumulated
    held = Held(place, {})
    period = interval.ends(2 * interval.pi() / number(place.system.omega))[1]
    times = [since + period * k / GRID for k in range(GRID + 1)]
    falls = next((pair for pair in pairwise(times) if held.ended(pair[1])), None)
    if falls is None:
        return Rest(None, None, held.cuts(since, since + period))
    key = held.ended(falls[1])[0]
    until, released = bisection.crossing(lambda t: held.at(key, t), *falls, PLACES)
    if until < last:
        sets = {"accumulated": last, "released": until}
        raise NotProved("rest", "it may be released before the hits have accumulated", sets)
    return Rest(until, released, held.cuts(since, until))


def lemma_2_rest_among_others(start: Start) -> tuple[Found, Rest]:
    """*Statement.* (i) to (iii), without a time of release; *computed* on pieces of time, for the
    longest time found in which the other variables are not seen to go too far.
    """
    place, entry = start.wall, start.entry()
    first = captured(place, entry, start.time).time[1]

    def until(more: Fraction) -> tuple[Found, Rest]:
        last = captured(place, entry, first + more).time[1] + more
        again = captured(place, entry, last)
        held = Held(place, again.others)
        return again, Rest(last, None, held.cuts(again.time[0], last))

    longer = bisection.largest(until, first - start.time, 6)
    return until(Fraction(0) if longer is None else interval.short(longer))


def _checked(start: Start, mode: str, cut: Cut, rest: Rest) -> dict[str, Any]:
    """Return the certificate, if the checker accepts it."""
    place, pieces = start.wall, cut.pieces
    claims = {
        "start": writer.exact(start.time),
        "mode": mode,
        "box": {z: [*map(writer.exact, ends)] for z, ends in start.box.items()},
        "falling": place.falling,
        "guard": place.guard,
        "rising": place.rising,
        "restitution": writer.exact(place.e),
        **_ratios(pieces),
        "accumulation_time": [*map(writer.exact, whole(pieces))],
        **_of(rest),
    }
    hints = {
        "bits": str(CHECKED),
        "tree": cut.tree,
        "pieces": [_of_piece(piece) for piece in pieces],
        "state": {z: writer.exact(c) for z, c in _meant(start, mode).items()},
        "cuts": [*map(str, rest.cuts)],
    }
    parameters = as_parameters(place.system, rests=True)
    content = claims, hints
    return certified("contact_capture", parameters, content, Runner(), digits=PLACES, bits=BITS)


def _ratios(pieces: Sequence[Piece]) -> dict[str, str]:
    """Return a ratio below 1, and how many first hits are left out of it in some piece."""
    ratio, followed = reduce(Ball.max, [piece.found.ratio for piece in pieces]), 0
    for windows, found in pieces:
        count = len(windows) or 1
        followed = max(followed, count if count > 1 else 0)
        for k, hit in enumerate(found.hits[0 if windows else 1 :], count + 1):
            if hit.ratio < 1:
                ratio = ratio.max(hit.ratio)
            else:
                followed = max(followed, k)
    return {"followed": str(followed), "ratio": writer.bound(ratio)}


def _of_piece(piece: Piece) -> dict[str, Any]:
    """Return the hints about a piece."""
    found = piece.found
    return {
        "hits": [[*map(writer.exact, window)] for window in piece.hits],
        "until": [writer.exact(t) for t in (*(hit.until for hit in found.hits), found.time[1])],
        "height": writer.exact(found.height),
        "speed": writer.exact(found.speed),
        "others": {z: [*map(writer.exact, ends)] for z, ends in found.others.items()},
    }


def _meant(start: Start, mode: str) -> dict[str, Fraction]:
    """Return a state of the box at which all guards of a mode are positive."""
    guards = start.wall.system.modes[mode].guards.values()
    sides = [[a + (b - a) * part for part in PARTS] for a, b in start.box.values()]
    for state in product(*sides):
        at = dict(zip(start.box, state, strict=True))
        point = replace(start, box={z: (c, c) for z, c in at.items()})
        if all(point.at(guard.value) > 0 for guard in guards):
            return at
    raise NotProved(
        "start", f"no state of the box is seen in which all guards of {mode} are positive"
    )


def _of(rest: Rest) -> dict[str, str]:
    """Return the claims about the rest."""
    if rest.until is None:
        return {"for_ever": "yes"}
    released = {} if rest.released is None else {"released_by": writer.exact(rest.released)}
    return {"rests_until": writer.exact(rest.until), **released}
