"""Appendix, A.4 and A.5: the symmetry and the half-period map, chatter and grazing."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity, same, symbols
from cap.audit.means.balls import between, pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.orbits import until
from cap.audit.means.stored import stored
from cap.audit.papers.mixed_dynamics.claims.saltation import hit
from cap.audit.verdict import Verdict, confirmed, corrected, imprecise, refuted, vacuous
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval
from cap.sets.interval import Box

BITS = 100


@claim("eq:hist-sigma", Kind.THEOREM, stated="Σ maps trajectories to trajectories")
def sigma_of_the_appendix() -> Verdict:
    """(x, v, t) -> (-x, -v, t + π/ω) maps trajectories to trajectories."""
    F, f, w = symbols("F f omega")
    t, s = sp.symbols("t s", real=True)
    force = F * sp.cos(w * t) - f * s  # at the time t, for the sign s of the velocity
    image = force.subs(t, t + sp.pi / w).subs(s, -s)
    identity("the image obeys the law", -force, image)
    need(PAPER.r == -PAPER.l, "the walls are not symmetric about 0")
    return confirmed(
        "for r = -l as stated; for all walls with x -> l + r - x",
        "The force at the image is minus the force, and walls are exchanged: by sympy.",
    )


def _elliptic() -> Box:
    """Return a box around P*, whose orbit never stops."""
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    x, v = (interval.hull(interval.ball(e.lower), interval.ball(e.upper))
            for e in (claims["x"], claims["v"]))  # fmt: skip
    return x, v


def _half(state: Box) -> Box:
    """Return the states after half a period from the time 0."""
    return until(state, interval.pi()).state


def _mirrored(state: Box) -> Box:
    return -state[0], -state[1]


@claim("prop:hist-sigma", Kind.THEOREM, stated="σ = Φ_(T/2) ∘ (-1) has σ² = Φ")
def square_of_sigma() -> Verdict:
    """σ(x, v) := Φ_(T/2)(-x, -v), with the flow from the time 0, has σ² = Φ."""
    with interval.workprec(BITS):
        start = _elliptic()
        whole = after_periods(PAPER, *start, 1).state
        stated, true = start, start
        for _ in range(2):
            stated = _half(_mirrored(stated))
            true = _mirrored(_half(true))
        gap = abs(stated[0] - whole[0])
        need(gap > interval.ball(Fraction(1, 1000)), "they agree", gap=gap)
        need(all((a - b).contains(0) for a, b in zip(true, whole, strict=True)), "they differ")
        words = between(gap, 4)
    return corrected(
        "the other order, σ = (-1) ∘ Φ_(T/2): first the flow, then the reflection. Then σ² = Φ, as "
        "(-1) ∘ Φ_(T/2) ∘ (-1) is the flow from T/2 to T. With the order stated σ² is the return "
        f"map at the time T/2: at P*, in Ω_NS, its first component is {words} away from Φ(P*) = P*",
        "Both compositions for P* in balls; the identity is eq:hist-sigma.",
        certificate="elliptic.json",
    )


@claim("prop:hist-sigma", Kind.STEP, stated="the solution from (-x, -v) at 0 is -x(t + T/2)")
def step_of_the_proof() -> Verdict:
    """The solution from (-x, -v) at the time 0 is -x(t + T/2), so σ(x, v) = -(x, v)(T/2)."""
    with interval.workprec(BITS):
        start = _elliptic()
        claimed = _mirrored(_half(start))  # its value at t = 0
        gap = abs(claimed[0] + start[0])
        need(gap > interval.ball(Fraction(1, 1000)), "they agree", gap=gap)
        words = between(gap, 4)
    return refuted(
        "-x(t + T/2) is a solution, which has the value (-x, -v) at t = -T/2, not at t = 0: there "
        f"it is -(x, v)(T/2), whose first component is {words} away from -x for P*",
        "The orbit of P* in balls. With the reflection after the flow the step is right.",
        certificate="elliptic.json",
    )


@claim("rem:hist-pitchfork", Kind.STEP, stated="possible even where Φ' remains hyperbolic")
def hyperbolic_at_a_pitchfork() -> Verdict:
    """The pitchfork of σ, at an eigenvalue -1 of σ', can occur where Φ' remains hyperbolic."""
    half = sp.Symbol("h", real=True)  # the trace of σ', whose determinant is 1
    trace = half**2 - 2
    identity("the trace of Φ' = σ'² there", trace.subs(half, -2), 2)
    claims = stored("pitchfork.json").claims
    return refuted(
        "an eigenvalue -1 of σ' is an eigenvalue +1 of Φ' = σ'²: Φ' has the trace 2 there and is "
        f"not hyperbolic. At the paper's F, ω, R this is at f in {pair(claims['f'], 10)}",
        "tr Φ' = (tr σ')² - 2 det σ' by Cayley and Hamilton; the stored certificate of the "
        "pitchfork.",
        certificate="pitchfork.json",
    )


@claim("ssec:hist-pitchfork", Kind.WORDS, stated="period doubling: tr Φ' from 0 to -2")
def period_doubling() -> Verdict:
    """In an area-preserving family period doubling has the transition tr Φ' : 0 -> -2."""
    trace = sp.Symbol("trace", real=True)
    e = sp.Symbol("e")
    roots = sp.solve(e**2 - trace * e + 1, e)
    need(all(same(each.subs(trace, -2), sp.Integer(-1)) for each in roots), "another trace")
    need(all(same(abs(each.subs(trace, 0)), sp.Integer(1)) for each in roots), "0 is special")
    return corrected(
        "it happens where tr Φ' passes -2, the multipliers meeting at -1; the trace 0 is where the "
        "rotation number is 1/4, and nothing doubles there. For det Φ' < 1 it is tr = -1 - det",
        "Multipliers from trace and determinant, by sympy.",
    )


@claim("ssec:hist-pitchfork", Kind.WORDS, stated="torus bifurcations by Krein collisions")
def krein_collisions() -> Verdict:
    """A torus bifurcation of Φ on Ω_NS requires a Krein collision of complex multipliers."""
    phi = sp.Symbol("phi", positive=True)
    gap = sp.simplify(sp.exp(sp.I * phi) - sp.exp(-sp.I * phi))
    identity("e^(iφ) - e^(-iφ)", gap.rewrite(sp.sin), 2 * sp.I * sp.sin(phi))
    return vacuous(
        "a map of the plane that preserves area has two multipliers, e^(±iφ) or real, which meet "
        "at 1 and -1 only: there are no Krein collisions, and no torus bifurcation, to be observed",
        "2i sin φ = 0 only at multiples of π. (They exist for two and more particles.)",
    )


@claim("ssec:hist-chatter", Kind.FORMULA, stated="the ratio depends on how near the orbit grazes")
def ratio_of_chatter() -> Verdict:
    """Speeds of successive hits decay geometrically, the ratio depending on parameters and on how
    close the orbit is to grazing.
    """
    a, f, u = symbols("a f u")
    back = u**2 / (2 * (a + f))  # how far it comes, leaving r at the speed u against a + f
    again = sp.sqrt(2 * back * (a - f))
    identity("the ratio", again / u, sp.sqrt((a - f) / (a + f)))
    claims = stored("capture.json").claims
    ratio = claims["ratio"]
    bound = ratio.upper if hasattr(ratio, "upper") else Fraction(ratio)
    need(bound < 1, "the ratio may be 1")
    return corrected(
        "decay is geometric, with the ratio sqrt((a - f)/(a + f)), a = F cos ωt at the wall, in "
        "the limit of small speeds, whatever the orbit; so hits accumulate, in finite time, "
        f"wherever a > f: the certified box has ratios of at most {float(bound):.3g}",
        "Constant force by sympy; the stored certificate of a capture.",
        certificate="capture.json",
    )


@claim("ssec:hist-chatter", Kind.WORDS, stated="a square-root singularity at grazing")
def square_root_at_grazing() -> Verdict:
    """Orbits that approach grazing acquire the square-root term of Nordmark."""
    M, u, c, _ = hit(1)
    need(same(sp.limit(M[1, 0] * u, u, 0), 2 * c), "the entry is not of the order 1/u")
    speed = sp.sqrt(2 * symbols("d") * symbols("b"))  # reached at the wall, d short of grazing
    need(sp.diff(speed, symbols("d")).subs(symbols("d"), 0) in (sp.oo, sp.zoo), "it is smooth")
    return confirmed(
        "for hits at a small speed u: the entry 2F cos ωt/u of the saltation matrix is unbounded, "
        "and u goes with the square root of the distance from grazing. The orbits shown in panel "
        "(b) hit at speeds above 1: see the table of fig:hist-chatter",
        "The saltation matrix as u tends to 0, by sympy.",
    )


@claim("ssec:hist-connection", Kind.WORDS, stated="non-symmetric orbits need asymmetric walls")
def orbits_without_symmetry() -> Verdict:
    """The fully non-symmetric case is the problem of asymmetric walls, which is open."""
    found = stored("elliptic.json")
    need(found.parameters["r"] == -found.parameters["l"], "the walls are not symmetric")
    first, second = found.claims["hit_times"]
    with interval.workprec(BITS):
        gap = interval.ball(second.upper) - interval.ball(first.lower)
        need(gap < interval.pi(), "the hits may be half a period apart", gap=gap)
    return refuted(
        "P* itself has no symmetry, between symmetric walls: its hits are "
        f"{between(gap, 4)} apart, not half a period π. It is one of a pair, born in a pitchfork",
        "Hit times from the stored certificate. For asymmetric walls see "
        "conclusion.asymmetric-walls.",
        certificate="elliptic.json",
    )


@claim("ssec:hist-connection", Kind.WORDS, stated="no period doubling: observed here, proved there")
def absence_of_period_doubling() -> Verdict:
    """That period doubling is absent in the conservative regime is proved in the main body."""
    claims = stored("branch.json").claims
    least = claims["trace_end"].lower
    need(least > -2, "the trace may reach -2")
    return imprecise(
        "no statement of the main body is about period doubling. On the branch of P* it is true: "
        "from the pitchfork to the end of the branch, where its speed vanishes, the orbit is "
        f"elliptic, with a trace that goes from 2 to {pair(claims['trace_end'], 6)}",
        "The stored certificate: an elliptic orbit for every f of the range.",
        certificate="branch.json",
    )
