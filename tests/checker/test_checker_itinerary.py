"""The itinerary: windows that miss a hit reject, as do orbits that turn or start at a wall."""

from __future__ import annotations

from fractions import Fraction

import pytest

from cap.checker.flow.itinerary import PeriodMap
from cap.checker.kernel.interval import Interval
from cap.checker.kernel.rejection import Rejected
from cap.checker.system.walls import Parameters
from checker.altered import changed, rejected
from checker.forge import PARAMETERS


@pytest.mark.parametrize(
    ("windows", "why"),
    [
        ([["0", "1.2"], ["3.4", "3.6"]], "begins before"),
        ([["1.0", "1.2"], ["1.1", "3.6"]], "begins before"),
        ([["1.0", "1.2"], ["3.4", "6.3"]], "after T"),
        ([["1.11", "1.2"], ["3.4", "3.6"]], "reached before"),
        ([["1.0", "1.05"], ["3.4", "3.6"]], "not be reached"),
        ([["1.05", "1.15"], ["3.6", "3.7"]], "reached before"),
        ([["1.05", "1.15"], ["3.3", "3.4"]], "not be reached"),
        ([["1.05", "1.15"], ["3.4", "3.6"], ["5.9", "6.1"]], "not be reached"),
        ([["1.05", "1.15"]], "vanish between the last"),
        ([["1.05", "1.15"], ["3.4", "3.6"], ["6.1", "6.2"], ["6.25", "6.26"]], "not be reached"),
    ],
)
def test_windows(good, windows, why):
    """Overlapping, misplaced, missing and surplus windows, each with its reason."""
    certificate = changed(good, "hints", "hit_times", windows)
    for name in ("hit_times", "hit_speeds", "hit_forcing"):
        certificate["claims"][name] = (good["claims"][name] * 2)[: len(windows)]
    rejected(certificate, why)


def passage(x, v, windows, parameters=PARAMETERS, radius="0", order=2):
    """Follow a box of initial states through the windows, without a certificate."""
    p = Parameters(**{k: Fraction(q) for k, q in parameters.items()})
    rho, m = Fraction(radius), (Fraction(x), Fraction(v))
    box = [Interval.enclosing(q - rho, q + rho, 128) for q in m]
    centre = [Interval.enclosing(q, q, 128) for q in m]
    windows = [(Fraction(a), Fraction(b)) for a, b in windows]
    return PeriodMap(p, windows).over(box, centre, order)


@pytest.mark.parametrize("x", ["1", "-1", "1.5", "-2"])
def test_a_start_at_or_beyond_a_wall(x):
    """A start on a wall is not between the walls."""
    with pytest.raises(Rejected, match="box is not certainly between"):
        passage(x, "0.5", [("1", "2")])


def test_a_start_at_rest():
    """A box that touches v = 0 is refused."""
    with pytest.raises(Rejected, match="velocity vanishes"):
        passage("0", "0.001", [("1", "2")], radius="0.001")


def test_a_turn_before_the_hit():
    """From (0, 0.1) at 0 the mass goes right and turns before it returns to the right wall."""
    with pytest.raises(Rejected, match="vanish before a hit"):
        passage("0", "0.1", [("3", "6")])


def test_a_turn_inside_the_flight_only():
    """s v is positive at both ends of the flight, and negative at its minimum between them."""
    parameters = {"F": "1", "omega": "1", "f": "0", "l": "-10", "r": "10"}
    with pytest.raises(Rejected, match="vanish between the last event"):
        passage("0", "0.5", [], parameters)  # v = 1/2 + sin t
    passage("0", "1.1", [], parameters)
    with pytest.raises(Rejected, match="vanish between the last event"):
        passage("0", "1", [], parameters)  # v = 1 + sin t touches zero
    passage("0", "-1.1", [], parameters)
    with pytest.raises(Rejected, match="vanish between the last event"):
        passage("0", "-0.9", [], parameters)


@pytest.mark.parametrize("x", ["2", "5", "-2"])
def test_the_end_must_lie_between_the_walls(x):
    """x(T) = x + 2 pi v, and no hit is named."""
    parameters = {"F": "1", "omega": "1", "f": "0", "l": "-10", "r": "10"}
    with pytest.raises(Rejected, match="x\\(T\\)"):
        passage(x, "1.5" if Fraction(x) > 0 else "-1.5", [], parameters)


@pytest.mark.parametrize(("v", "least"), [("1.5", "0.5"), ("-1.5", "0.5")])
def test_the_least_speed_of_a_flight(v, least):
    """v = sin t ± 3/2 has the least speed 1/2, enclosed within 100 ulps."""
    parameters = {"F": "1", "omega": "1", "f": "0", "l": "-20", "r": "20"}
    result = passage("0", v, [], parameters).least_speed
    assert result.lower <= Fraction(least) <= result.upper
    assert result.width < 100


def test_the_passage_of_the_free_mass():
    """With a weak force the hits are at 3/4, 7/4, ... of a flight of length 2 with speed 2."""
    parameters = {"F": "1/1000000", "omega": "1", "f": "0", "l": "-1", "r": "1"}
    windows = [
        (Fraction(1, 2) + k - Fraction(1, 9), Fraction(1, 2) + k + Fraction(1, 9)) for k in range(6)
    ]
    result = passage("0", "2", windows, parameters)
    for k, hit in enumerate(result.events):
        assert abs(float(hit.moment.t[0, 0].lower) - 0.5 - k) < 1e-4
    assert abs(float(result.v[0, 0].lower) - 2) < 1e-4
    other = passage("0", "-2", windows, parameters)
    assert [hit.word for hit in result.events] == ["hit r", "hit l"] * 3
    assert [hit.word for hit in other.events] == ["hit l", "hit r"] * 3
