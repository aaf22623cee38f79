"""The strict reading of a certificate: bytes -> exact numbers, or a rejection.

A certificate is a JSON object in which every leaf is a string.  It must match its shape exactly:
the same keys, the same lengths.  A shape is built of dictionaries, lists and the readers ``number``
and ``enclosure`` at the leaves; how many hits and which order it has follows from the hints.
Numbers are exact rationals.  Nothing is evaluated whose size was not bounded before.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple, NoReturn

from cap.checker.citations import CITES
from cap.checker.mechanics import Parameters
from cap.checker.rejection import Rejected, need

MAX_BYTES = 1 << 20
MAX_CHARACTERS = 4000
MAX_HITS = 64
MAX_BITS = 8192
MAX_WORK = 1 << 15  # bits times hits
MAX_DEPTH = 16
ORDERS = (3, 5, 7, 9)
_INTEGER = "-?(?:0|[1-9][0-9]*)"
_NUMBER = re.compile(f"{_INTEGER}(?:\\.[0-9]+|/[1-9][0-9]*)?")


class Enclosure(NamedTuple):
    """The closed interval [lower, upper], with the two strings that state it."""

    lower: Fraction
    upper: Fraction
    text: tuple[str, str]


class Certificate(NamedTuple):
    """What a certificate says; ``claims`` and ``hints`` have the shapes below."""

    theorem: str
    parameters: Parameters
    digits: int
    claims: dict[str, Any]
    hints: dict[str, Any]


def read(data: bytes) -> Certificate:
    """Return the certificate in these bytes; anything that is not exactly of its form rejects."""
    fields = matched(parsed(data), _FIELDS, "certificate")
    need(fields["format"] == "cap-certificate/1", "the format is not cap-certificate/1")
    theorem = fields["theorem"]
    need(theorem in CITES, "the theorem is neither elliptic nor saddle")
    need(fields["cites"] == CITES[theorem], "cites is not the checker's own list")
    need(isinstance(fields["provenance"], dict), "provenance is not an object")
    p = Parameters(**matched(fields["parameters"], _PARAMETERS, "parameters"))
    need(p.omega > 0, "omega is not positive")
    need(0 <= p.f < p.F, "0 <= f < F does not hold")
    need(p.l < p.r, "l < r does not hold")
    hints = read_hints(theorem, fields["hints"])
    shape = claim_shape(theorem, len(hints["hit_times"]), hints.get("order", 0))
    claims = matched(fields["claims"], shape, "claims")
    return Certificate(theorem, p, bounded(fields["digits"], 6, 1000, "digits"), claims, hints)


def read_hints(theorem: str, value: object) -> dict[str, Any]:
    """Return the hints: exact numbers, precision and order as integers."""
    need(isinstance(value, dict), "hints is not an object")
    times = value.get("hit_times") if isinstance(value, dict) else None
    need(
        isinstance(times, list) and 1 <= len(times) <= MAX_HITS,
        "hints.hit_times is not a list of 1 to 64",
    )
    shape: dict[str, Any] = {
        "bits": text,
        "centre": [number] * 2,
        "radius": number,
        "preconditioner": [[number] * 2] * 2,
        "hit_times": [enclosure] * (len(times) if isinstance(times, list) else 0),
    }
    if theorem == "elliptic":
        shape["order"] = text
    hints: dict[str, Any] = matched(value, shape, "hints")
    hints["bits"] = bounded(hints["bits"], 64, MAX_BITS, "bits")
    need(hints["bits"] * len(hints["hit_times"]) <= MAX_WORK, "bits times hits is too large")
    if "order" in hints:
        hints["order"] = bounded(hints["order"], ORDERS[0], ORDERS[-1], "order")
        need(hints["order"] in ORDERS, "order is not odd")
    need(hints["radius"] > 0, "radius is not positive")
    return hints


def claim_shape(theorem: str, hits: int, order: int) -> dict[str, Any]:
    """Return the shape of the claims."""
    shape: dict[str, Any] = dict.fromkeys(
        ("x", "v", "least_speed", "trace", "determinant"), enclosure
    )
    shape |= {name: [enclosure] * hits for name in ("hit_times", "hit_speeds", "hit_forcing")}
    shape |= {"box": {"x": enclosure, "v": enclosure}, "jacobian": [[enclosure] * 2] * 2}
    if theorem == "saddle":
        return shape | {"multipliers": [enclosure] * 2}
    component = {f"{i},{n - i}": enclosure for n in range(2, order + 1) for i in range(n + 1)}
    shape |= dict.fromkeys(
        ("rotation_angle", "rotation_number", "twist", "twist_action"), enclosure
    )
    return shape | {
        "resonance_distances": dict.fromkeys(("0", "1/4", "1/3", "1/2"), enclosure),
        "taylor": {"x": component, "v": component},
        "higher_twists": [enclosure] * ((order - 3) // 2),
        "remainder": {"degree": exactly(str(order)), "radius": number, "x": number, "v": number},
    }


def matched(value: Any, shape: Any, where: str) -> Any:
    """Return the value with its leaves read; it must have exactly the given shape."""
    if isinstance(shape, dict):
        need(isinstance(value, dict), f"{where} is not an object")
        need(value.keys() == shape.keys(), f"{where} has missing or unknown fields")
        return {key: matched(value[key], part, f"{where}.{key}") for key, part in shape.items()}
    if isinstance(shape, list):
        need(
            isinstance(value, list) and len(value) == len(shape),
            f"{where} is not a list of {len(shape)}",
        )
        return [
            matched(v, part, f"{where}[{n}]")
            for n, (v, part) in enumerate(zip(value, shape, strict=True))
        ]
    return shape(value, where)


def anything(value: Any, _: str) -> Any:
    """Return the value as it is."""
    return value


def text(value: Any, where: str) -> str:
    """Return a string."""
    if not isinstance(value, str):
        raise Rejected(f"{where} is not a string")
    return value


def exactly(expected: str) -> Callable[[Any, str], str]:
    """Return a reader that accepts this string alone."""

    def reader(value: Any, where: str) -> str:
        need(value == expected, f"{where} is not {expected}")
        return expected

    return reader


def number(value: Any, where: str) -> Fraction:
    """Return an exact number: an integer, a decimal without exponent, or a fraction."""
    literal = text(value, where)
    need(len(literal) <= MAX_CHARACTERS, f"{where} is longer than {MAX_CHARACTERS} characters")
    need(_NUMBER.fullmatch(literal) is not None, f"{where} is not a number of the format")
    whole, _, decimals = literal.partition(".")
    if decimals:
        return Fraction(int(whole + decimals), 10 ** len(decimals))
    numerator, _, denominator = literal.partition("/")
    return Fraction(int(numerator), int(denominator or "1"))


def enclosure(value: Any, where: str) -> Enclosure:
    """Return a pair of numbers with lower <= upper."""
    lower, upper = matched(value, [number, number], where)
    need(lower <= upper, f"{where} has lower > upper")
    return Enclosure(lower, upper, (value[0], value[1]))


def bounded(literal: str, least: int, most: int, name: str) -> int:
    """Return an integer between least and most."""
    need(re.fullmatch("0|[1-9][0-9]{0,5}", literal) is not None, f"{name} is not a small integer")
    need(least <= int(literal) <= most, f"{name} is not between {least} and {most}")
    return int(literal)


def parsed(data: bytes) -> object:
    """Return the JSON value, built of objects, lists and strings; anything else rejects."""
    need(len(data) <= MAX_BYTES, "the file is larger than 1 MiB")
    try:
        value = json.loads(
            data.decode("utf-8"),
            object_pairs_hook=_object,
            parse_float=_no_number,
            parse_int=_no_number,
            parse_constant=_no_number,
        )
        _refuse_literals(value)
    except UnicodeDecodeError:
        raise Rejected("the file is not UTF-8") from None
    except json.JSONDecodeError:
        raise Rejected("the file is not JSON") from None
    except RecursionError:
        raise Rejected("the JSON is nested too deeply") from None
    return value


def _object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    """Return the JSON object; a repeated key rejects."""
    result = dict(pairs)
    need(len(result) == len(pairs), "a JSON object repeats a key")
    return result


def _no_number(_: str) -> NoReturn:
    """Reject a JSON number."""
    raise Rejected("the file contains a JSON number; numbers must be strings")


def _refuse_literals(value: object, depth: int = 0) -> None:
    """Reject true, false and null, anywhere, and deep nesting."""
    need(depth <= MAX_DEPTH, "the JSON is nested too deeply")
    if isinstance(value, dict | list):
        for part in value.values() if isinstance(value, dict) else value:
            _refuse_literals(part, depth + 1)
    else:
        text(value, "a value (true, false or null)")


_PARAMETERS = dict.fromkeys(Parameters._fields, number)
_FIELDS = dict.fromkeys(("format", "theorem", "digits"), text) | dict.fromkeys(
    ("parameters", "claims", "hints", "cites", "provenance"), anything
)
