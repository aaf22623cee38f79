"""Make the files in accept/, reject/ and malformed/ anew from the stored certificates.

    python tests/certificates/make.py

Needed when the format or the stored certificates change; `tests/checker/test_certificates.py` reads
them.
"""

import copy
import json
import sys
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))


from checker import mixed_small  # noqa: E402
from checker.forge_hybrid import forge_persistence  # noqa: E402

STORED = HERE.parent.parent / "certificates"


def load(name):
    """Return a stored certificate, without its provenance."""
    return {
        **json.loads((STORED / name).read_text("utf-8")),
        "provenance": {"cap": "a test certificate"},
    }


def put(kind, name, certificate, *changes):
    """Write a certificate with some values changed: each change is (path..., value)."""
    certificate = copy.deepcopy(certificate)
    for *path, last, value in changes:
        part = certificate
        for key in path:
            part = part[key]
        part[last] = value
    (HERE / kind / f"{name}.json").write_text(json.dumps(certificate, indent=1) + "\n")


def accepted(saddle):
    """Write what is true, though not as the prover writes it."""
    box = {"x": ["0.34", "0.35"], "v": ["0.77", "0.78"]}
    other = {"F": "1.0", "omega": "2/2", "f": "0.4", "l": "-1.00", "r": "3/3"}
    windows = [["0.6", "0.75"], ["3.7", "3.95"]]
    put("accept", "saddle_wider_windows", saddle, ("hints", "hit_times", windows))
    put("accept", "saddle_smaller_box", saddle, ("claims", "box", box))
    put("accept", "saddle_parameters_written_otherwise", saddle, ("parameters", other))
    put("accept", "persistence_small", forge_persistence())


def rejected(saddle, elliptic):
    """Write what is false, or hints that prove nothing."""
    claims, wide = saddle["claims"], {"x": ["0.1", "0.6"], "v": ["0.5", "1.1"]}
    two = {"x": ["0.34", "0.57"], "v": ["0.77", "1.08"]}
    minus = ["-" + end for end in elliptic["claims"]["twist"][::-1]]
    hypotheses = elliptic["cites"][1]["hypotheses"][:-1]
    for name, certificate, *change in (
        ("saddle_called_elliptic", saddle, "theorem", "elliptic"),
        ("other_friction", saddle, "parameters", "f", "41/100"),
        ("friction_a_double", saddle, "parameters", "f", str(Fraction(0.4))),
        ("box_too_large", saddle, "claims", "box", wide),
        ("box_of_two_fixed_points", elliptic, "claims", "box", two),
        ("box_past_the_wall", saddle, "claims", "box", "x", ["0.33", "1.5"]),
        ("box_without_the_fixed_point", saddle, "claims", "box", "x", ["0.3436", "0.3500"]),
        ("window_without_hit", saddle, "hints", "hit_times", 0, ["0.1", "0.2"]),
        (
            "windows_in_wrong_order",
            saddle,
            "hints",
            "hit_times",
            saddle["hints"]["hit_times"][::-1],
        ),
        ("multipliers_swapped", saddle, "claims", "multipliers", claims["multipliers"][::-1]),
        ("trace_of_the_paper_orbit", saddle, "claims", "trace", elliptic["claims"]["trace"]),
        ("twist_with_the_other_sign", elliptic, "claims", "twist", minus),
        ("twist_of_the_paper", elliptic, "claims", "twist", ["-0.43", "-0.41"]),
        ("remainder_too_small", elliptic, "claims", "remainder", "x", "0.00000000000000001"),
        ("hypothesis_dropped", elliptic, "cites", 1, "hypotheses", hypotheses),
        ("more_digits_than_certain", saddle, "digits", "40"),
    ):
        put("reject", name, certificate, tuple(change))


def captured(at_once, after_hits):
    """Write captures whose claims contain what is true, but are out of order, or too wide."""
    late = [after_hits["claims"]["event_times"][0][0], "0.3"]
    for name, certificate, *change in (
        ("capture_by_a_force_below_friction", at_once, "forcing", ["0.3", "1.0001"]),
        ("capture_before_the_start", at_once, "accumulation_time", ["-1", "0.6550"]),
        ("capture_after_its_release", at_once, "accumulation_time", ["0", "1.99"]),
        ("capture_with_events_out_of_order", after_hits, "event_times", 0, late),
    ):
        put("reject", name, certificate, ("claims", *change))


def two_masses(tori, saddle):
    """Write lies about two masses."""
    minus = [
        [["-" + end for end in pair[::-1]] for pair in row]
        for row in tori["claims"]["twist_matrix"]
    ]
    turned = copy.deepcopy(tori)
    v = turned["hints"]["centre"][1][2:]  # at the first collision, after which both turn now
    slow = str(-Fraction(v[0]) / 40)
    turned["hints"]["centre"][1][3] = slow
    turned["claims"]["box"][1]["v2"] = [slow, slow]
    put("reject", "particles_with_a_collision_that_turns_one_mass", turned)
    for name, certificate, *change in (
        ("particles_twist_with_the_other_sign", tori, "claims", "twist_matrix", minus),
        ("particles_with_their_masses_exchanged", tori, "parameters", "masses", ["9/10", "1"]),
        ("particles_with_unequal_friction", tori, "parameters", "f", ["91/200", "9/20"]),
        ("particles_saddle_called_elliptic", saddle, "theorem", "particles"),
    ):
        put("reject", name, certificate, tuple(change))


def lighter(limits):
    """Write lies about where an orbit of two masses loses its ellipticity, and ends."""
    nodes = limits["hints"]["nodes"]
    stop = [str(Fraction(end) - Fraction(1, 10**20)) for end in limits["claims"]["stop"]]
    for name, *change in (
        ("particles_limits_with_a_gap_between_cells", "hints", "nodes", nodes[:5] + nodes[7:]),
        ("particles_limits_that_stop_too_late", "claims", "stop", stop),
        ("particles_limits_that_begin_with_other_masses", "parameters", "masses", ["1", "9/10"]),
    ):
        put("reject", name, limits, tuple(change))


def released(window, entropies, cascade):
    """Write lies about the release map: a window, entropies for a range of f, doublings."""
    two = copy.deepcopy(cascade)
    two["hints"]["cycles"] = two["hints"]["cycles"][:2]
    for name, number in (("parameters", 2), ("places", 2), ("ratios", 0)):
        two["claims"][name] = two["claims"][name][:number]
    later = [str(Fraction(end) + Fraction(1, 10**19)) for end in two["claims"]["parameters"][1]]
    piece = "strips", 0, "pieces", 0
    for name, certificate, *change in (
        ("attracting_cycle_without_entropy", window, "entropy", ["0", "0"]),
        ("attracting_cycle_with_shifted_symbols", window, "repeated", "RLL"),
        ("entropies_that_are_too_large", entropies, *piece, "entropy", ["0.482", "0.483"]),
        ("entropies_with_a_larger_share_of_cycles", entropies, "periodic", "9/8"),
        ("entropies_with_a_cycle_followed_twice", entropies, *piece, "cycle", "period", "6"),
        ("cascade_with_a_later_doubling", two, "parameters", 1, later),
        ("cascade_to_the_other_side", two, "direction", "up"),
    ):
        put("reject", name, certificate, ("claims", *change))


def attracting(sink):
    """Write lies about an attracting orbit of two masses."""
    words = sink["claims"]["itinerary"]
    k = words.index("stick 1")
    for name, *change in (
        ("particles_sink_that_does_not_stick", "itinerary", k, "turn 1 right"),
        ("particles_sink_that_contracts_at_once", "power", "1"),
    ):
        put("reject", name, sink, ("claims", *change))


def mixed(true):
    """Write shares that are too good, a box that is another, an interval that G does not keep."""
    shares = true["claims"]["shares"]
    larger, either = (
        [f"{float(shares[name][0]) + 1e-4:.6f}", shares[name][1]]
        for name in ("attractor", "either")
    )
    no_sink = {"x": "0", "v": "1", "matrix": [["100", "0"], ["0", "100"]], "halves": "2"}
    for name, *change in (
        ("mixed_share_enlarged", "claims", "shares", "attractor", larger),
        ("mixed_share_of_both_enlarged", "claims", "shares", "either", either),
        ("mixed_places_dropped", "hints", "places", "tree", "0"),
        ("mixed_places_all_at_once", "hints", "places", "tree", "1"),
        ("mixed_sticks_dropped", "hints", "stops", "late", mixed_small.written([0])),
        ("mixed_early_sticks_dropped", "hints", "stops", "early", mixed_small.written([0])),
        ("mixed_no_cycle", "claims", "cycles", [[["-0.9", "-0.899"]]]),
        ("mixed_no_sink", "claims", "sinks", [no_sink]),
        ("mixed_turns_dropped", "hints", "stops", "turns", mixed_small.written([0])),
        ("mixed_box_past_the_wall", "claims", "box", "x", ["-1", "1.1"]),
        ("mixed_other_interval", "claims", "attractor", "interval", ["-0.7", "-0.5"]),
    ):
        put("reject", name, true, tuple(change))


def held(ellipse, ellipsoid):
    """Write lies about how long motions stay near an elliptic orbit."""
    flat = [row if n else ["1", "0"] for n, row in enumerate(ellipse["hints"]["integral"])]
    late = [["0.7", "0.8"], *ellipsoid["hints"]["windows"][1:]]
    for name, certificate, *change in (
        ("effective_stability_for_longer", ellipse, "claims", "periods", "1000000000000"),
        ("effective_stability_of_another_integral", ellipse, "hints", "integral", flat),
        ("particles_stability_of_more_states", ellipsoid, "claims", "part", "1"),
        ("particles_stability_with_a_late_window", ellipsoid, "hints", "windows", late),
    ):
        put("reject", name, certificate, tuple(change))


def malformed(saddle):
    """Write what is no certificate."""
    good = json.dumps(saddle, indent=1)
    lower, upper = saddle["claims"]["box"]["x"]
    digits = '"digits": "30"'
    for name, text in {
        "empty": "",
        "truncated": good[: len(good) // 2],
        "trailing": good + "{}",
        "list": "[]",
        "string": '"certificate"',
        "nested": "[" * 20000,
        "nan": good.replace(digits, '"digits": NaN'),
        "number": good.replace(digits, '"digits": 30'),
        "boolean": good.replace(digits, '"digits": true'),
        "duplicate_key": good.replace(digits, f"{digits}, {digits}"),
        "unknown_field": good.replace(digits, f'{digits}, "note": "x"'),
        "missing_field": good.replace(f"{digits},", ""),
        "float_in_claim": good.replace(f'"{lower}"', lower),
        "exponent": good.replace(lower, f"{lower}e0"),
        "full_width_digits": good.replace(lower, "０" + lower[1:]),
        "underscore": good.replace(lower, lower[:-3] + "_" + lower[-3:]),
        "inverted": good.replace(lower, "@").replace(upper, lower).replace("@", upper),
        "zero_denominator": good.replace('"2/5"', '"2/0"'),
        "not_utf8": b"\xff\xfe" + good.encode(),
    }.items():
        data = text if isinstance(text, bytes) else text.encode()
        (HERE / "malformed" / f"{name}.json").write_bytes(data)


if __name__ == "__main__":
    accepted(load("saddle-2.json"))
    rejected(load("saddle-2.json"), load("elliptic-2.json"))
    captured(load("capture.json"), load("capture-2.json"))
    two_masses(load("particles.json"), load("particles_saddle.json"))
    lighter(load("particles_limits.json"))
    released(load("window-1.json"), load("entropies-1.json"), load("cascade-1.json"))
    attracting(load("particles_sink.json"))
    mixed(mixed_small.certificate())
    held(load("effective_stability.json"), load("particles_stability.json"))
    malformed(load("saddle-2.json"))
