"""Orbits of two masses from which proofs start, continued from equal masses."""

from collections import Counter
from dataclasses import replace
from fractions import Fraction

from cap.errors import BadInput
from cap.floats.masses.masses import drawn
from cap.floats.masses.particle_limits import limits
from cap.floats.masses.particle_orbits import Continued, NotFound, from_equal_masses
from cap.floats.masses.particles import Particles, Path, Unresolved, follow
from cap.floats.search.request import Candidate, Found, Request
from cap.maps.fixed_point import Start
from cap.particles.guess import Guess


def particles(request: Request) -> Found:
    """Continue pairs of orbits of one mass, from equal masses, to an orbit of the kind asked for.

    `particles` asks for two pairs of multipliers on the unit circle, `particles_saddle` for one.
    """
    _two_masses(request)
    request.no_orbit(f"{request.kind} finds its orbit itself")
    system = Particles(request.parameters, request.masses)
    wanted, others = (2 if request.kind == "particles" else 1), list[Continued | NotFound]()
    for found in from_equal_masses(system):
        others.append(found)
        if isinstance(found, Continued) and _pairs_on_the_circle(found) == wanted:
            lines = ["Two orbits of one mass, continued from equal masses, lead to:"]
            return Found([*lines, f"  {_told(found)}"], [_of_masses(system, found)])
    raise BadInput(_without(request, others))


def touching_nothing(request: Request) -> Found:
    """Return two masses without an orbit: what they do while they touch nothing has formulas."""
    _two_masses(request)
    request.parameters.elastic_strings()
    request.no_orbit(f"the theorem {request.kind} needs no orbit")
    masses = ", ".join(map(str, request.masses))
    candidate = Candidate(Start(0.0, 0.0, ()), f"m = {masses}", particles=Guess(request.masses, ()))
    return Found(["Closed form: no search is needed."], [candidate])


def attracting(request: Request) -> Found:
    """Follow random states until one repeats itself after a few periods, with contacts."""
    _two_masses(request)
    request.no_orbit(f"{request.kind} finds its orbit itself")
    if not request.parameters.f:
        raise BadInput(f"the theorem {request.kind} needs friction: f > 0")
    system = Particles(request.parameters, request.masses)
    ends = Counter[str]()
    for k, seed in enumerate(drawn(system, SEEDS, 3)):
        request.progress(f"searching: {k} of {SEEDS} random states followed")
        found = _settled(system, tuple(seed.tolist()))
        if isinstance(found, str):
            ends[found] += 1
        else:
            periods, state, path = found
            events = tuple((e.word, e.time, e.positions, e.before) for e in path.events)
            guess = Guess(request.masses, events, periods=periods)
            start = Start(state[0], state[2], tuple((e.word, e.time) for e in path.events))
            shown = f"period {periods} T: {', '.join(path.words)}"
            lines = [f"Of random states, some end on an orbit of {shown}"]
            return Found(lines, [Candidate(start, shown, particles=guess)])
    masses, f = ", ".join(map(str, request.masses)), request.parameters.f
    told = "; ".join(f"{count} {end}" for end, count in ends.most_common())
    raise BadInput(
        f"no periodic orbit with contacts was found for m = {masses}, f = {f}: of {SEEDS} random "
        f"states {told}; try other --masses, --f, --l or --r"
    )


SEEDS, SETTLING, LONGEST = 40, 150, 8  # states, periods before, and of the period
RETURNED = 1e-9
NOT_PERIODIC = f"did not repeat in {LONGEST} T after {SETTLING} T"
NO_CONTACT = "came to an orbit without contacts"
NOT_FOLLOWED = "came to contacts that accumulate or last, which are not followed"


def _settled(
    system: Particles, state: tuple[float, ...]
) -> tuple[int, tuple[float, ...], Path] | str:
    """Return the period, a state and the path of the orbit on which a state ends, or why not."""
    T = system.period
    try:
        for _ in range(SETTLING):
            path = follow(system, state[:2], state[2:], T)
            state = (*path.x, *path.v)
        for n in range(1, LONGEST + 1):
            path = follow(system, state[:2], state[2:], n * T)
            end = (*path.x, *path.v)
            contacts = any(word.startswith(("hit", "meet")) for word in path.words)
            if max(abs(a - b) for a, b in zip(state, end, strict=True)) < RETURNED:
                return (n, state, path) if contacts else NO_CONTACT
    except (BadInput, Unresolved):
        return NOT_FOLLOWED
    return NOT_PERIODIC


def _two_masses(request: Request) -> None:
    """Raise `BadInput` unless two positive masses are given."""
    if len(request.masses) != 2:
        raise BadInput(f"{request.kind} is about two masses: give --masses M1,M2, as 1,9/10")
    Particles(request.parameters, request.masses)


def lighter(request: Request) -> Found:
    """Make the second of two equal masses lighter, to the ends of the elliptic orbits, and of all.

    The guess is the last elliptic orbit, with the last one as a further one.
    """
    if len(request.masses) != 2 or request.masses[0] != request.masses[1]:
        raise BadInput(f"{request.kind} begins with two equal masses: give --masses M,M, as 1,1")
    request.no_orbit(f"{request.kind} finds its orbits itself")
    system = Particles(request.parameters, request.masses)
    try:
        flip, stop = limits(system)
    except NotFound as reason:
        raise BadInput(str(reason)) from None
    lines = [
        "As the second of two equal masses is made lighter, their orbit is elliptic down to "
        f"{float(flip.mass):.6g}, and found down to {float(stop.mass):.6g}."
    ]
    first, last = (_guess((system.masses[0], near.mass), near.path) for near in (flip, stop))
    start = Start(flip.state[0], flip.state[2], ())
    shown = f"m = {', '.join(map(str, system.masses))}"
    return Found(lines, [Candidate(start, shown, particles=replace(first, further=(last,)))])


def _pairs_on_the_circle(found: Continued) -> int:
    return found.kind.split(" x ").count("elliptic")


def _without(request: Request, others: list[Continued | NotFound]) -> str:
    """Return in words that there is no candidate, and what was found instead."""
    if not others:
        return "one mass alone has no T-periodic orbits that never stop, to continue from"
    continued = [found for found in others if isinstance(found, Continued)]
    if not continued:
        return f"no orbit for {request.kind} was found: {others[0]}"
    theorems = {1: "particles_saddle", 2: "particles"}
    other = theorems.get(_pairs_on_the_circle(continued[0]))
    advice = f"; the theorem {other} is about such orbits" if other else ""
    return (
        f"no orbit for {request.kind} was found; the one continued from equal masses is "
        f"{_kind(continued[0])}{advice}"
    )


def _told(found: Continued) -> str:
    return (
        f"{', '.join(found.path.words)}: {_kind(found)}, least speed {found.path.least_speed:.6g}"
    )


def _kind(found: Continued) -> str:
    high, low = found.traces
    second = f" +- {high.imag:.6g}i" if high.imag else f", {low.real:.6g}"
    return f"{found.kind} (lambda + 1/lambda = {high.real:.6g}{second})"


def _of_masses(system: Particles, found: Continued) -> Candidate:
    path, n = found.path, len(system.masses)
    start = Start(found.state[0], found.state[n], tuple((e.word, e.time) for e in path.events))
    masses = ", ".join(map(str, system.masses))
    guess = _guess(system.masses, path)
    return Candidate(start, f"m = {masses}, {found.kind}", particles=guess)


def _guess(masses: tuple[Fraction, ...], path: Path) -> Guess:
    return Guess(masses, tuple((e.word, e.time, e.positions, e.before) for e in path.events))
