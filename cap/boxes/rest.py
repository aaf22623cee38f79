"""A mass at rest: how it comes to rest at a wall, how long it rests, how it begins to move."""

from cap.boxes.capture import capture
from cap.boxes.flight import Constants, Moment, launch, slow
from cap.boxes.motion import (
    CAPTURE_L,
    CAPTURE_R,
    FLY,
    NEAR,
    RELEASE_L,
    RELEASE_R,
    WALL,
    Motion,
    exact,
    lose,
    place_anywhere,
    set_matrix,
    tell,
)
from cap.sets.compiled import kernel
from cap.sets.doubles import (
    Interval,
    between,
    clipped,
    is_finite,
    lower,
    magnitude,
    upper,
)


@kernel
def _release_at(y: Constants, j: int) -> tuple[float, Moment]:
    """Return the side and the moment of the j-th time at which a mass at rest may be released.

    They are (j + 1) π - arccos α: in turn to the left and to the right.
    """
    side = -1.0 if j % 2 == 0 else 1.0
    return side, slow(y, side, j // 2)


@kernel
def release(y: Constants, n: Motion, end: Moment, choice: int) -> int:
    """End a rest, in the way of this number; return how many ways there may be.

    Between the walls |F cos ωt| <= f when the rest begins, and it ends at the next slow time of
    either side; at a wall, at the next one of the other side: where F cos ωt reaches ∓f.  If the
    rest may have begun before or after such a time, it may end there or at the next.  A rest does
    not begin after the end.
    """
    since = n.flight.t
    count, first, found = 0, -1, -1
    for j in range(8):
        side, at = _release_at(y, j)
        barred = n.kind == WALL and side == n.flight.sign
        if barred or upper(at.t) < lower(since):
            continue
        first = j if count == 0 else first
        found = j if count == choice else found
        count += 1
        if lower(at.t) > upper(since) or lower(at.t) > upper(end.t):
            break
    found = first if count == 1 else found
    side, at = _release_at(y, found)
    if found < 0 or not is_finite(since):
        lose(n)
    elif upper(at.t) < lower(end.t):
        _begin_to_move(y, n, side, at)
    elif lower(at.t) > upper(end.t):
        n.ended = 1
    else:
        lose(n)
    if count != 1:
        n.certain = 0
    return count


@kernel
def _begin_to_move(y: Constants, n: Motion, side: float, at: Moment) -> None:
    """Begin to fly to a side.  At a wall the place is exact."""
    zero = exact(0.0)
    gap, own, a, b = n.flight.gap, n.centre.gap, n.a, n.b
    if side != n.flight.sign:
        gap, own, a, b = clipped(y.width - gap, 0.0, upper(y.width)), y.width - own, -a, -b
    if n.kind == WALL:
        gap, own, a, b = y.width, y.width, zero, zero
    set_matrix(n, a, b, zero, zero)
    launch(n.flight, side, at, zero, gap)
    launch(n.centre, side, at, zero, own)
    n.kind, n.rising, n.bounced = FLY, 1, 0
    tell(n, RELEASE_R if side > 0 else RELEASE_L)


@kernel
def capture_after_hit(y: Constants, n: Motion, end: Moment) -> bool:
    """Prove that the wall captures the motions that have just left it; then they rest there.

    If that may last beyond the end, they are near the wall.
    """
    side, since = -n.flight.sign, n.flight.t
    if not n.flight.cos.mid < -y.alpha.mid:
        return False
    fast = magnitude(n.flight.speed)
    found = capture(y, side, since, 0.0, fast, True)
    if not found.proved or not upper(since) < lower(end.t):
        return False
    if found.until < lower(end.t):
        lean(n, side, between(lower(since), found.until))
    else:
        stay_near(n, side, since, 0.0, fast)
    return True


@kernel
def stay_near(n: Motion, side: float, since: Interval, far: float, fast: float) -> None:
    """Forget all but that the motions are near a wall."""
    zero = exact(0.0)
    n.kind, n.certain, n.rising, n.bounced = NEAR, 0, 0, 0
    launch(n.flight, side, Moment(since, zero, zero), between(-fast, fast), between(0.0, far))
    place_anywhere(n)
    n.centre.speed, n.base.w, n.d = zero, n.flight.speed.rad, exact(1.0)


@kernel
def lean(n: Motion, side: float, since: Interval) -> None:
    """Let the motions rest at a wall; their capture ends within this time."""
    zero = exact(0.0)
    n.kind, n.rising, n.bounced = WALL, 0, 0
    at = Moment(since, zero, zero)  # the sine and cosine are not asked for in a rest
    launch(n.flight, side, at, zero, zero)
    launch(n.centre, side, at, zero, zero)
    set_matrix(n, zero, zero, zero, zero)
    tell(n, CAPTURE_R if side > 0 else CAPTURE_L)
