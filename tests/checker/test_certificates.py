"""Certificates kept as files: what they claim is accepted, rejected, or not a certificate at all.

The names tell the attack.  Each rejected one is rejected for its own reason, listed here, so that
a change of the format does not leave files which are rejected for another.
"""

from pathlib import Path

import pytest

from cap import verify

pytestmark = pytest.mark.usefixtures("releases_computed_once")

HERE = Path(__file__).parents[1] / "certificates"
REASONS = {
    "attracting_cycle_with_shifted_symbols": "symbol 1 of those repeated",
    "attracting_cycle_without_entropy": "may be positive",
    "cascade_to_the_other_side": "in the direction claimed",
    "cascade_with_a_later_doubling": "parameters[1] does not contain",
    "entropies_that_are_too_large": "below its lower bound",
    "entropies_with_a_cycle_followed_twice": "period of a cycle may be smaller",
    "entropies_with_a_larger_share_of_cycles": "the share with cycles",
    "box_of_two_fixed_points": "before a window begins",
    "box_past_the_wall": "between the walls",
    "box_too_large": "before a window begins",
    "box_without_the_fixed_point": "centre is not in the box",
    "capture_after_its_release": "time of event 2 is not after",
    "capture_before_the_start": "time of the first event may be negative",
    "capture_by_a_force_below_friction": "forcing claimed is not above f",
    "capture_with_events_out_of_order": "time of event 2 is not after",
    "effective_stability_for_longer": "leave the ellipse before",
    "effective_stability_of_another_integral": "leave the ellipse before",
    "friction_a_double": "interior of its box",
    "hypothesis_dropped": "cites",
    "mixed_box_past_the_wall": "from wall to wall",
    "mixed_early_sticks_dropped": "shares.attractor does not contain",
    "mixed_no_cycle": "leave their cycle",
    "mixed_no_sink": "may stick",
    "mixed_sticks_dropped": "shares.attractor does not contain",
    "mixed_turns_dropped": "shares.attractor does not contain",
    "mixed_other_interval": "interval",
    "mixed_places_all_at_once": "shares.attractor does not contain",
    "mixed_places_dropped": "shares.attractor does not contain",
    "mixed_share_enlarged": "shares.attractor does not contain",
    "mixed_share_of_both_enlarged": "shares.either does not contain",
    "more_digits_than_certain": "wider than its digits allow",
    "multipliers_swapped": "multipliers",
    "other_friction": "when a window ends",
    "particles_limits_that_begin_with_other_masses": "not equal",
    "particles_limits_that_stop_too_late": "interior of its box",
    "particles_limits_with_a_gap_between_cells": "interior of its box",
    "particles_saddle_called_elliptic": "claims has missing or unknown fields",
    "particles_sink_that_contracts_at_once": "may be larger than claimed",
    "particles_sink_that_does_not_stick": "interior of its box",
    "particles_stability_of_more_states": "not the smaller one",
    "particles_stability_with_a_late_window": "may be before its window",
    "particles_twist_with_the_other_sign": "twist_matrix",
    "particles_with_a_collision_that_turns_one_mass": "interior of its box",
    "particles_with_their_masses_exchanged": "interior of its box",
    "particles_with_unequal_friction": "parameters.f is not a string",
    "remainder_too_small": "remainder",
    "saddle_called_elliptic": "hints has missing or unknown fields",
    "trace_of_the_paper_orbit": "trace does not contain",
    "twist_of_the_paper": "twist does not contain",
    "twist_with_the_other_sign": "twist does not contain",
    "window_without_hit": "when a window ends",
    "windows_in_wrong_order": "velocity may vanish",
}


SLOW = {  # like others of their theorems, and as long to check as a true one
    "ball_curve_small",
    "converse_small",
    "conservative_by_three_flights",
    "effective_stability_for_longer",
    "entropies_with_a_larger_share_of_cycles",
    "mixed_early_sticks_dropped",
    "mixed_places_all_at_once",
    "mixed_share_of_both_enlarged",
    "mixed_sticks_dropped",
    "mixed_turns_dropped",
}


def files(kind):
    """Return the files of a folder, for `parametrize`; some are slow."""
    paths = sorted((HERE / kind).glob("*.json"))
    marks = {path: [pytest.mark.slow] * (path.stem in SLOW) for path in paths}
    return [pytest.param(path, id=path.stem, marks=marks[path]) for path in paths]


def run(capsys, path):
    """Return the exit status and the one line printed."""
    status = verify.main([str(path)])
    out, err = capsys.readouterr()
    assert err == ""
    assert out.count("\n") == 1
    return status, out


@pytest.mark.parametrize("path", files("accept"))
def test_accepted(capsys, path):
    """True, though not as the prover writes it."""
    status, out = run(capsys, path)
    assert status == 0
    assert out.startswith("VERIFIED: ")


@pytest.mark.parametrize("path", files("reject"))
def test_rejected(capsys, path):
    """A false claim, or hints that prove nothing."""
    status, out = run(capsys, path)
    assert status == 1
    assert out.startswith(f'REJECTED: "{path}"'[:200])
    assert REASONS[path.stem] in out


@pytest.mark.parametrize("path", files("malformed"))
def test_malformed(capsys, path):
    """Not a certificate."""
    status, out = run(capsys, path)
    assert status == 1
    assert out.startswith("REJECTED: ")


def test_every_reason_has_its_file():
    """The table and the folder agree."""
    assert {path.stem for path in (HERE / "reject").glob("*.json")} == set(REASONS)
