"""Float orbits from which proofs start: the only module of the float mode that proofs import.

Nothing here is proved.  Each function returns what it found, in words, and the candidates.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

from cap.errors import BadInput
from cap.floats.coverings import planar
from cap.floats.coverings.search import (
    Family,
    families,
    families_by_cells,
    families_of_contacts,
)
from cap.floats.masses.particle_candidates import attracting, lighter, particles, touching_nothing
from cap.floats.models.releases import Stay, stays
from cap.floats.search import passage, periodic, spanning, tori
from cap.floats.search.cycles import Cycle, near
from cap.floats.search.homoclinic import Excursion, Saddle, excursions
from cap.floats.search.orbits import from_hit_times, search
from cap.floats.search.periodic import Guess
from cap.floats.search.request import Candidate, Found, Release, Request, Search, Turning
from cap.flow.itinerary import itinerary
from cap.maps.fixed_point import Start
from cap.parameters import Parameters
from cap.release.trap import critical_points

__all__ = [
    "Candidate",
    "Excursion",
    "Family",
    "Found",
    "Release",
    "Request",
    "Saddle",
    "Search",
    "Stay",
    "Turning",
    "attracting",
    "capturing",
    "closed_form",
    "continued",
    "cyclic",
    "elliptic",
    "elliptic_particles",
    "every_motion",
    "excursions",
    "families",
    "families_by_cells",
    "families_of_contacts",
    "fates",
    "formulas",
    "half_period",
    "lighter",
    "non_sticking",
    "particles",
    "passage",
    "releasing",
    "releasing_again",
    "saddles",
    "spanning",
    "stays",
    "tori",
    "touching_nothing",
    "turning",
    "with_islands",
]

half_period, formulas = planar.half_period, planar.formulas
TYPES = ("sink focus", "sink node", "superstable", "elliptic", "saddle", "flip saddle")
SMALLEST = Fraction(1, 64)  # of the first step, when an orbit is continued
PATIENCE = 10  # periods after which an orbit that has not been captured is given up


def non_sticking(request: Request) -> Found:
    """Find elliptic orbits or saddles that never turn."""
    return _listed(request, lambda guess: guess.x, "(smallest x)")


def _listed(request: Request, rank: Callable[[Guess], float], first: str) -> Found:
    """Return the orbits of a kind in an order; the ``first`` is proved unless all are asked for."""
    request.parameters.elastic_strings()
    if request.orbit:
        guess = periodic.near(request.parameters, *request.orbit)
        if guess.kind != request.kind:
            raise BadInput(
                f"the orbit that {_state(request.orbit)} leads to is no {request.kind} orbit: its "
                f"trace is {guess.trace:.6g}"
            )
        return Found([_newton(request), f"  {_shown(guess)}"], [_candidate(guess)])
    found = sorted(_never_stopping(request), key=rank)
    if not found:
        raise BadInput(
            f"no {request.kind} non-sticking T-periodic orbit was found (a guess can be given with "
            "--orbit X V)"
        )
    numbers = sorted({len(guess.hit_times) for guess in found})
    heading = (
        f"Found {_counted(len(found), f'{request.kind} orbit')} with "
        f"{' or '.join(map(str, numbers))} hits per period; "
        f"proving {_which(request, len(found), first)}:"
    )
    lines = [heading, *(f"  {k}  {_shown(guess)}" for k, guess in enumerate(found, 1))]
    return Found(lines, [_candidate(guess) for guess in (found if request.every else found[:1])])


def saddles(request: Request) -> Found:
    """Find saddles that never turn, the weakest first."""
    request = replace(request, kind="saddle")
    return _listed(request, lambda guess: abs(guess.trace), "(least trace)")


def elliptic(request: Request) -> Found:
    """Find elliptic orbits that never turn, for a theorem of another name."""
    return non_sticking(replace(request, kind="elliptic"))


def with_islands(request: Request) -> Found:
    """Find elliptic orbits, and say how long what is asked for may take."""
    found = elliptic(request)
    if "largest" in request.options:
        found.lines.append(
            "Curves are tried from the outside inwards: minutes, at the paper's parameters three."
        )
    return found


def elliptic_particles(request: Request) -> Found:
    """Find an elliptic orbit of two masses, for a theorem of another name."""
    return particles(replace(request, kind="particles"))


def _never_stopping(request: Request) -> list[Guess]:
    """Return the orbits of one kind: all that are found, or the first ones if one is enough."""
    p, kind = request.parameters, request.kind
    if not request.every:
        for guesses in from_hit_times(p):
            if own := [guess for guess in guesses if guess.kind == kind]:
                return own
    found = search(p, tell=_telling(request)).never_stopping
    return [guess for guess in found if guess.kind == kind]


def _telling(request: Request) -> Callable[[float], None]:
    """Return the function that tells the progress of a search."""
    return lambda part: request.progress(f"searching: {part:.0%} done")


def cyclic(request: Request) -> Found:
    """Find nT-periodic orbits with any itinerary."""
    p, n = request.parameters, request.periods
    if request.orbit:
        cycle = near(p, *request.orbit, n)
        return Found([_newton(request), f"  {_described(p, cycle)}"], [_of_cycle(p, cycle)])
    orbits = search(p, n, _telling(request))
    families = [f"A family of orbits that touch no wall: {each.line()}" for each in orbits.families]
    found = sorted(orbits.isolated, key=lambda c: _rank(c.kind(conserves=p.conserves)))
    if not found:
        also = "".join(f"; {each[0].lower()}{each[1:]}" for each in families)
        raise BadInput(
            f"no isolated periodic orbit of period {n} T was found (a guess can be given with "
            f"--orbit X V){also}"
        )
    period = "T" if n == 1 else f"{n}T"
    heading = (
        f"Found {_counted(len(found), 'isolated orbit')} of period {period}; proving "
        f"{_which(request, len(found), '(sinks first)')}:"
    )
    lines = [heading, *(f"  {k}  {_described(p, cycle)}" for k, cycle in enumerate(found, 1))]
    lines += families
    chosen = found if request.every else found[:1]
    return Found(lines, [_of_cycle(p, cycle) for cycle in chosen])


def continued(request: Request) -> Found:
    """Follow an elliptic orbit from e = 1, μ = 0 to the parameters, in small steps."""
    p = request.parameters
    if p.conserves:
        raise BadInput("with epsilon = mu = 0 nothing is lost: the theorem is `elliptic`")
    elastic = replace(p, e=Fraction(1), mu=Fraction(0))
    before = non_sticking(replace(request, kind="elliptic", parameters=elastic))
    candidates = []
    for each in before.candidates:
        cycle = _continued(p, each.start)
        candidates.append(_of_cycle(p, cycle)._replace(shown=f"continued from {each.shown}"))
    lines = [line.replace("proving", "continuing") for line in before.lines]
    return Found(lines, candidates)


def _continued(p: Parameters, start: Start, steps: int = 10) -> Cycle:
    """Follow the orbit of ``start``, at e = 1 and μ = 0, to the parameters.

    Raises `BadInput` with the parameters reached, if even small steps lead nowhere or elsewhere.
    """
    z, words = (start.x, start.v), tuple(word for word, _ in start.events)
    part, step = Fraction(0), Fraction(1, steps)
    while True:
        then = min(part + step, Fraction(1))
        partial = replace(p, e=1 - (1 - p.e) * then, mu=p.mu * then)
        following = _near(partial, z)
        if following and following.path.words == words:
            if then == 1:
                return following
            part, z = then, (following.x, following.v)
        elif step * steps > SMALLEST:
            step /= 2
        else:
            why = "changes its itinerary" if following else "is lost by Newton's method"
            raise BadInput(
                f"the elliptic orbit cannot be continued from epsilon = mu = 0 to epsilon = "
                f"{float(1 - p.e):.6g}, mu = {float(p.mu):.6g}: beyond epsilon = "
                f"{float((1 - p.e) * part):.6g}, mu = {float(p.mu * part):.6g} it {why}"
            )


def _near(p: Parameters, z: tuple[float, float]) -> Cycle | None:
    try:
        return near(p, *z)
    except BadInput:
        return None


def capturing(request: Request) -> Found:
    """Find the events of a state up to its capture; without a state, the right wall itself."""
    p = request.parameters
    if not request.orbit:
        lines = ["All states near the right wall at t = 0, where the forcing presses to it most."]
        start = Start(float(p.r), 0.0, (("capture r", 0.0),))
        return Found(lines, [Candidate(start, "at the right wall")])
    end = PATIENCE * 2 * math.pi / float(p.omega)
    path = itinerary(p, *request.orbit, end)
    events = [(event.word, event.time) for event in path.events]
    ends = [k for k, (word, _) in enumerate(events, 1) if word.startswith("capture")]
    if not ends:
        raise BadInput(
            f"the orbit of {_state(request.orbit)} is not captured within {PATIENCE} periods"
        )
    before = events[: ends[0]]
    lines = [f"The orbit of {_state(request.orbit)}: " + ", ".join(word for word, _ in before)]
    return Found(lines, [Candidate(Start(*request.orbit, tuple(before)), "captured")])


def releasing(request: Request) -> Found:
    """Find critical points of the release map, on the branches on which its orbits end."""
    if not request.parameters.f:
        raise BadInput(f"the theorem {request.kind} needs friction: f > 0")
    if request.orbit:
        x = request.orbit[0]
        if not request.parameters.l < x < request.parameters.r:
            raise BadInput(f"a release at x = {x:.10g} is not between the walls")
        return Found([f"A release at x = {x:.10g}."], [_release(x)])
    found = critical_points(request.parameters)
    if not found:
        raise BadInput("no critical point was found on the branches on which releases end")
    places = ", ".join(f"{x:.6g}" for x in found)
    heading = f"The release map has critical points near x = {places}; proving "
    chosen = found if request.every else found[:1]
    which = "all:" if request.every else "the first:" if len(found) > 1 else "it:"
    return Found([heading + which], [_release(x) for x in chosen])


def _release(x: float) -> Candidate:
    return Candidate(Start(x, 0.0, ()), f"around x = {x:.6g}")


def closed_form(request: Request) -> Found:
    """Return a candidate without an orbit: these theorems start from formulas."""
    if request.kind != "segment":
        request.parameters.elastic_strings()
    found = _nothing(request, "closed form")
    if not request.parameters.f:
        raise BadInput(f"the theorem {request.kind} needs friction: f > 0")
    return found


def fates(request: Request) -> Found:
    """Find nothing: the proof looks for what attracts."""
    request.parameters.elastic_strings()
    if not request.parameters.f:
        raise BadInput(f"the theorem {request.kind} needs friction: f > 0")
    found = _nothing(request, "the fates of states")
    return found._replace(lines=["What attracts the states is looked for in the proof."])


def releasing_again(p: Parameters) -> list[list[Release]]:
    """Return the attracting cycles on which releases end."""
    from cap.floats.search.release_cycles import release_cycles  # noqa: PLC0415 (the compiled flow)

    return release_cycles(p)


def turning(p: Parameters) -> list[Turning]:
    """Return the states of attracting cycles that turn and never stick."""
    from cap.floats.search.turning_cycles import turning_cycles  # noqa: PLC0415 (the compiled flow)

    return turning_cycles(p)


def every_motion(request: Request) -> Found:
    """Find nothing: the theorem is about all motions."""
    return _nothing(request, "every motion")


def range_of_f(request: Request) -> Found:
    """Find nothing: the proof searches at each f of a range."""
    return _nothing(request, "range of f")


def _nothing(request: Request, about: str) -> Found:
    request.no_orbit(f"the theorem {request.kind} needs no orbit")
    line = f"{about.capitalize()}: no search is needed."
    return Found([line], [Candidate(Start(0.0, 0.0, ()), about)])


def _newton(request: Request) -> str:
    return f"Newton's method leads from {_state(request.orbit)} to:"


def _state(z: tuple[float, float] | None) -> str:
    return f"({z[0]:.10g}, {z[1]:.10g})" if z else ""


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'s' if number > 1 else ''}"


def _which(request: Request, number: int, order: str) -> str:
    return "all" if request.every else f"the first {order}" if number > 1 else "it"


def _rank(kind: str) -> int:
    return TYPES.index(kind) if kind in TYPES else len(TYPES)


def _candidate(guess: Guess) -> Candidate:
    start = Start.non_sticking(guess.x, guess.v, guess.hit_times)
    return Candidate(start, _shown(guess))


def _shown(guess: Guess) -> str:
    return (
        f"x = {guess.x:.6g}, v = {guess.v:.6g}, {len(guess.hit_times)} hits, "
        f"trace {guess.trace:.6g}, least speed {guess.least_speed:.6g}"
    )


def _of_cycle(p: Parameters, cycle: Cycle) -> Candidate:
    start = Start(cycle.x, cycle.v, cycle.events, cycle.periods)
    return Candidate(start, _described(p, cycle))


def _described(p: Parameters, cycle: Cycle) -> str:
    """Return an orbit in words: its events as counts."""
    words = [word.split()[0] for word, _ in cycle.events]
    counts = ", ".join(
        _counted(words.count(kind), kind)
        for kind in ("hit", "turn", "stick", "capture")
        if kind in words
    )
    return (
        f"x = {cycle.x:.6g}, v = {cycle.v:.6g}, {cycle.kind(conserves=p.conserves)}, trace "
        f"{cycle.trace:.6g}, det {cycle.determinant:.4g}; {counts or 'no event'}"
    )
