"""Orbits of two masses from which proofs start, continued from equal masses."""

from cap.errors import BadInput
from cap.floats.particle_orbits import Continued, from_equal_masses
from cap.floats.particles import Particles
from cap.floats.request import Candidate, Found, Request
from cap.maps.fixed_point import Start
from cap.particles.model import Guess


def particles(request: Request) -> Found:
    """Continue pairs of orbits of one mass, from equal masses, to an orbit of the kind asked for.

    `particles` asks for two pairs on the unit circle, `particles_saddle` for one.
    """
    if request.orbit or request.every:
        raise BadInput(f"{request.kind} finds its orbit itself: leave out --orbit and --all")
    system = Particles(request.parameters, request.masses)
    if len(request.masses) != 2:
        raise BadInput(f"{request.kind} is about two masses: give --masses M1,M2, as 1,9/10")
    wanted, others = (2 if request.kind == "particles" else 1), list[str]()
    for found in from_equal_masses(system):
        if isinstance(found, Continued):
            if found.kind.split(" x ").count("elliptic") == wanted:
                lines = ["Two orbits of one mass, continued from equal masses, lead to:"]
                return Found([*lines, f"  {_told(found)}"], [_of_masses(system, found)])
            others.append(_told(found))
        else:
            others.append(str(found))
    reached = "; ".join(others[:1]) or "one mass alone has no T-periodic orbits that never stop"
    other = "particles_saddle" if request.kind == "particles" else "particles"
    advice = f" (see the theorem {other})" if "elliptic" in reached else ""
    raise BadInput(f"no orbit for {request.kind} was found: {reached}{advice}")


def _told(found: Continued) -> str:
    high, low = found.traces
    second = f" +- {high.imag:.6g}i" if high.imag else f", {low.real:.6g}"
    return (
        f"{', '.join(found.path.words)}: {found.kind}, lambda + 1/lambda = "
        f"{high.real:.6g}{second}, least speed {found.path.least_speed:.6g}"
    )


def _of_masses(system: Particles, found: Continued) -> Candidate:
    path, n = found.path, len(system.masses)
    guess = Guess(
        system.masses, tuple((e.word, e.time, e.positions, e.before) for e in path.events)
    )
    start = Start(found.state[0], found.state[n], tuple((e.word, e.time) for e in path.events))
    masses = ", ".join(map(str, system.masses))
    return Candidate(start, f"m = {masses}, {found.kind}", particles=guess)
