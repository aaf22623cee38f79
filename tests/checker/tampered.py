"""Every number claimed moved out of its place, for the theorems on (1,1) orbits."""

from __future__ import annotations

import json
from fractions import Fraction

from cap.checker.kernel.rejection import Rejected
from cap.checker.verdict import check
from checker.altered import changed, encode, leaves


def accepted(certificate):
    """Return whether a certificate is verified; any exception but a rejection is an error."""
    try:
        check(encode(certificate), lambda _: None)
    except Rejected:
        return False
    return True


def moved(pair):
    """Give enclosures that miss the number and are as narrow, or are much wider."""
    low, high = map(Fraction, pair)
    shift = 10 * (high - low) or Fraction(1, 10**8)
    yield from ([low - shift, high - shift], [low + shift, high + shift])
    width = max(high - low, Fraction(1, 10**8)) * 1000 * max(1, abs(high), abs(low))
    yield from ([low - width, low - width / 2], [high + width / 2, high + width])
    yield from ([low - width, high], [low, high + width])


def survivors(certificate, skipped=()):
    """Return the claims that can be moved unnoticed; paths, or their beginnings, are skipped."""
    result = []
    for path, pair in leaves(certificate["claims"]):
        if path[0] not in skipped and path not in skipped:
            for ends in moved(pair):
                value = [str(end) for end in ends]
                if accepted(changed(certificate, "claims", *path, value)):
                    result.append((path, value))
    return result


def containers(value, path=()):
    """Give the path of every object and list, but those of enclosures' ends."""
    if isinstance(value, dict | list):
        yield path
        for key in value if isinstance(value, dict) else range(len(value)):
            yield from containers(value[key], (*path, key))


def at(value, path):
    """Return the part at a path."""
    for key in path:
        value = value[key]
    return value


def malformed(certificate):
    """Give copies with a field or an item more, less, or of another type."""
    for path in containers(certificate):
        part = at(certificate, path)
        if path[:1] == ("provenance",):
            continue
        keys = list(part) if isinstance(part, dict) else range(len(part))
        for key in keys:
            bad = json.loads(encode(certificate))
            del at(bad, path)[key]
            yield (*path, key), bad
            for junk in (None, 1, 0.5, True, [], {}, "", "nan", "None", ["2", "1"]):
                if junk != part[key] and ((*path, key) != ("provenance",) or junk != {}):
                    yield (*path, key, junk), changed(certificate, *path, key, junk)
        bad = json.loads(encode(certificate))
        if isinstance(part, dict):
            at(bad, path)["surplus"] = "1"
        else:
            at(bad, path).append("1")
        yield (*path, "more"), bad
