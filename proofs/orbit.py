"""The claims on a periodic orbit: its state at t = 0, its events, the Jacobian of Φⁿ.

In two forms: orbits that only hit the walls, elastic ones, and with dry friction alone; and orbits
with any events, that may lose speed at the walls and to viscous friction.
"""

from typing import Any

from cap.certificate import writer as certificate
from cap.certificate.writer import Pair
from cap.errors import BadInput
from cap.flow.model import Oscillator
from cap.flow.strobe import Orbit
from cap.parameters import Parameters
from cap.proofs.fixed_point import Around, Form, Located, Setting
from cap.sets import matrix
from cap.sets.interval import Ball

TURNS = {"turn right": -1, "turn left": 1}  # and the sign of the velocity before


def of_hits(orbit: Located, around: Around) -> dict[str, Any]:
    """Return the claims on an orbit that never turns or stops, rounded outwards."""
    units, pair, osc = orbit.setting.units, orbit.setting.rounding.pair, orbit.osc
    found = orbit.point.orbit
    return {
        "box": around.box,
        **_state(orbit),
        "hit_times": [pair(hit.time, units.time) for hit in found.hits],
        "hit_speeds": _hit_speeds(orbit),
        "hit_forcing": [pair(abs(osc.F * hit.cos) - osc.f, units.force) for hit in found.hits],
        "least_speed": pair(found.least_speed, units.speed),
        "jacobian": orbit.setting.rounding.matrix(found.monodromy, units),
        "trace": pair(matrix.trace(found.monodromy)),
        "determinant": pair(matrix.determinant(found.monodromy)),
    }


def of_events(orbit: Located, around: Around) -> dict[str, Any]:
    """Return the claims on an orbit with any events, rounded outwards."""
    setting, found = orbit.setting, orbit.point.orbit
    return {
        "period": str(orbit.point.periods),
        "itinerary": [event.word for event in found.events],
        "box": around.box,
        **_state(orbit),
        "event_times": _event_times(orbit, around),
        "hit_speeds": _hit_speeds(orbit),
        "turning_factors": [setting.rounding.pair(q) for q in turning_factors(orbit.osc, found)],
        "jacobian": setting.rounding.matrix(found.monodromy, setting.units),
    }


HITS = Form(of_hits, "hit_times", Parameters.elastic_strings)
EVENTS = Form(of_events, "events", Parameters.strings)


def _state(orbit: Located) -> dict[str, Pair]:
    """Return the claims on P*."""
    (x, v), units, pair = orbit.point.box, orbit.setting.units, orbit.setting.rounding.pair
    return {"x": pair(x, units.length), "v": pair(v, units.speed)}


def _hit_speeds(orbit: Located) -> list[Pair]:
    pair, unit = orbit.setting.rounding.pair, orbit.setting.units.speed
    return [pair(abs(hit.velocity), unit) for hit in orbit.point.orbit.hits]


def _event_times(orbit: Located, around: Around) -> list[Pair]:
    """Return when the events of P* happen; of a capture the window of its lemma.

    That of the whole box is what a looser arithmetic finds room in.
    """
    pair, unit = orbit.setting.rounding.pair, orbit.setting.units.time
    return [
        certificate.window(near.window)
        if near.word.startswith("capture")
        else pair(event.time, unit)
        for event, near in zip(orbit.point.orbit.events, around.proved.expected, strict=True)
    ]


def turning_factors(osc: Oscillator[Any], orbit: Orbit[Ball]) -> list[Ball]:
    """Return (|F cos ωt| - f)/(|F cos ωt| + f) at each turning."""
    return [
        osc.turning_factor(TURNS[event.word], event.cos)
        for event in orbit.events
        if event.word in TURNS
    ]


def need_hits(theorem: str, setting: Setting) -> None:
    """Raise `BadInput` unless the guess is of a T-periodic orbit that only hits the walls."""
    kinds = {word.split()[0] for word, _ in setting.start.events}
    if kinds != {"hit"} or setting.start.periods != 1:
        raise BadInput(f"{theorem} is about T-periodic orbits with hits only")
