"""Section 7: the decomposition of the state space, contraction, and what is forward invariant."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means import block
from cap.audit.means.balls import pair
from cap.audit.means.need import need
from cap.audit.means.orbits import States, hits_only
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.papers.mixed_dynamics.claims.saltation import LATER
from cap.audit.verdict import (
    Verdict,
    confirmed,
    corrected,
    imprecise,
    refuted,
    still_open,
    vacuous,
)
from cap.flow.propagation import after_periods
from cap.parameters import PAPER
from cap.sets import interval

HEIGHT = Fraction(8, 10**9)  # of the block around the saddle, half
ARC = Fraction("-0.39"), Fraction("1.437170054123255357625761233795"), Fraction(2, 10**17)
RETURNS = States("-0.73", "2.08", "0.001")  # turns in the first period, and not in the second


@claim("fig:decomp-schematic", Kind.WORDS, stated="a velocity-zero event in every period")
def stop_in_every_period() -> Verdict:
    """Ω_dissip consists of the trajectories with at least one velocity-zero event per period."""
    first, second = hits_only(LATER, 1), LATER.follow(2)
    need(second.has("turn"), "they do not stop in the second period either")
    return refuted(
        f"states of Ω_dissip may have periods without: from {LATER} nothing but hits in [0, T]: "
        f"{first.shown()}. Ω_dissip is where a velocity-zero event comes some time",
        "A box of states followed in balls.",
    )


@claim("fig:decomp-schematic", Kind.WORDS, stated="trajectories funnel into asymptotic attractors")
def funnel() -> Verdict:
    """Trajectories of Ω_dissip funnel into a dissipative attractor."""
    found = [stored(name) for name in ("periodic-1.json", "periodic-3.json")]
    need(found[0].parameters == found[1].parameters, "the sinks are at different parameters")
    need(found[0].parameters["F"] == 3, "the sinks are at another F")
    sinks = [each.claims["type"] for each in found]
    need(all(kind.startswith(("sink", "superstable")) for kind in sinks), "one is no sink")
    chaos, segment = (stored(name) for name in ("attractor.json", "segment.json"))
    need(all(at_the_paper(each) for each in (chaos, segment)), "they are at other parameters")
    entropy, room = chaos.claims["entropy_per_period"], segment.claims["basin_area"]
    need(entropy.lower > 0 and room.lower > 0, "the entropy or the area may be zero")
    return imprecise(
        "there may be several attractors: at F = 3 two different periodic sinks are certified "
        f"({sinks[0]}, {sinks[1]}). At the paper's parameters an open set of states tends to a set "
        f"with the topological entropy {pair(entropy, 6)} per period, and one of the area "
        f"{pair(room, 5)} to T-periodic orbits that touch no wall, of stroke "
        f"{pair(segment.claims['stroke'], 5)} < R, a segment of them, along which they attract "
        "nothing",
        "Stored certificates: of two sinks, of the attractor and of the segment (segment.json).",
        certificate="attractor.json",
    )


@claim("thm:OmNS-structure", Kind.STEP, stated="a neighbourhood of P* is in Ω_NS, by continuity")
def neighbourhood_in_the_set() -> Verdict:
    """Φ is C^∞ on a neighbourhood of P* contained in Ω_NS, by continuity of the impact times."""
    with interval.workprec(block.BITS):
        around = block.around_the_saddle(HEIGHT, 2 * HEIGHT)
        around.covers_itself()
        words = [event.word for event in block.followed(around.edge(-1), 3).events]
    need(any(word.startswith("turn") for word in words), "not all stop", events=words)
    return corrected(
        "continuity gives one period only; the same words would put a neighbourhood of the saddle "
        "of saddle.json in Ω_NS, which is false. For P* the inside of an invariant curve is such a "
        "neighbourhood: so it follows from Theorem 5.6, and is not needed for it",
        "States that stop in every neighbourhood of that saddle: smoothness.interior-of-the-set.",
        certificate="saddle.json",
        proof="kam.md#smoothness-and-openness",
    )


@claim("thm:OmNS-structure", Kind.THEOREM, stated="KAM curves in Ω_NS")
def curves_in_the_set() -> Verdict:
    """Every elliptic never-stopping T-periodic orbit with the hypotheses of Theorem 5.6 is
    surrounded by invariant curves in Ω_NS.
    """
    claims = stored("elliptic.json").claims
    need(claims["twist"].lower > 0 and claims["least_speed"].lower > 0, "a hypothesis fails")
    return confirmed(
        "true, with the closed curves and all that is inside; at the paper's parameters for P* and "
        "its mirror image, where one curve is explicit (strobe.never-stopping-orbits-exist)",
        "Orbits between an invariant curve and P* stay there, so they never stop: Moser, with the "
        "stored certificate.",
        certificate="elliptic.json",
        proof="kam.md#smoothness-and-openness",
    )


@claim("thm:OmNS-structure", Kind.THEOREM, stated="saddles with Melnikov zeros carry a Cantor set")
def saddles_of_the_theorem() -> Verdict:
    """Every saddle whose Melnikov function has transverse zeros carries a hyperbolic Cantor set."""
    p = {name: stored(name).parameters["f"] for name in ("saddle.json", "saddle-2.json")}
    need(set(p.values()) == {Fraction(2, 5)}, "the saddles are at other parameters")
    return vacuous(
        "no saddle has a Melnikov function in the sense of Section 6: that is defined for the "
        "colliding orbits of Theorem 4.8, which do not exist. Saddles exist: two that never stop "
        "are certified at the paper's parameters, and one of them has a horseshoe "
        "(homoclinic.horseshoe)",
        "See fold.colliding-orbits, melnikov.amplitudes; stored certificates of the saddles.",
        certificate="saddle-2.json",
        proof="periodic.md#no-orbit-has-the-pattern",
    )


@claim("prop:contraction", Kind.THEOREM, stated="Leb(Φ(A)) < Leb(A) for A in Ω_dissip")
def contraction() -> Verdict:
    """Leb(Φ(A)) < Leb(A) for every measurable A of positive measure in Ω_dissip."""
    first, second = hits_only(LATER, 1), LATER.follow(2)
    need(second.has("turn") or second.has("stick"), "the box is not in Ω_dissip")
    with interval.workprec(100):
        (a, b), (c, d) = first.monodromy
        need((a * d - b * c).contains(1), "the determinant is not 1")
    return refuted(
        f"Leb(Φ(A)) = Leb(A) for A = {{{LATER}}}, an open box in Ω_dissip: its orbits only hit "
        "walls in [0, T], and stop later. It is true for A in X \\ Ω_NS^[0,T], the states that "
        "stop in the first period",
        "A box of states followed in balls: Φ is injective on it, with det Φ' = 1.",
        proof="lift.md#where-the-map-is-symplectic",
    )


@claim("eq:vol-contract", Kind.STEP, stated="Leb(Φ(A)) = ∫_A |det Φ'|")
def change_of_variables() -> Verdict:
    """Leb(Φ(A)) = ∫ |det Φ'| over A."""
    capture = stored("capture.json").claims
    box = capture["box"]
    need(box["v"].lower < box["v"].upper, "the box is flat")
    need("capture r" in capture["itinerary"], "nothing is captured")
    return corrected(
        "<= in general: Φ is not injective (states that stick or are captured merge); the "
        "inequality is all that is used",
        "All states of the certified capture box have the same image at the same time.",
        certificate="capture.json",
    )


@claim("prop:Omdissip-flag", Kind.THEOREM, stated="Ω_dissip is not forward invariant")
def not_forward_invariant() -> Verdict:
    """Ω_dissip is in general not forward invariant."""
    x, v, reach = ARC
    with interval.workprec(block.BITS):
        around = block.around_the_saddle(HEIGHT, 2 * HEIGHT)
        around.covers_itself()
        arc = after_periods(PAPER, interval.ball(x), interval.around(v, reach), 4)
        ends = [
            after_periods(PAPER, interval.ball(x), interval.ball(v + s * reach), 4) for s in (-1, 1)
        ]
        h, k = interval.ball(HEIGHT), interval.ball(2 * HEIGHT)
        need(abs(around.coordinates(arc.state)[1]) < k, "the arc is not within the block's height")
        left, right = (around.coordinates(end.state)[0] for end in ends)
        need(left > h and right < -h, "the arc does not cross the block", ends=(left, right))
    words = [event.word for event in arc.events]
    times = [event.time for event in arc.events]
    first = [w for w, t in zip(words, times, strict=True) if t < 2 * interval.pi()]
    need(first[2:] == ["turn left", "turn right"], "the first period is another", words=words)
    need(all(word.startswith("hit") for word in words[4:]), "a later period has a stop")
    return confirmed(
        f"true: a state with x = -0.39 and v within 2·10⁻¹⁷ of {v} turns twice in its first period "
        "and never stops again: it is in Ω_dissip, its image in Ω_NS. Such states are exceptional: "
        "those of them that turn in [0, T], but do not stick, form a null set",
        "A short arc of states, followed over four periods in balls, crosses a block around the "
        "saddle of saddle.json from side to side; every such arc contains a point that stays in "
        "the block for ever (cap.audit.means.block).",
        certificate="saddle.json",
        proof="decomposition.md#who-enters-the-never-stopping-set",
    )


@claim("prop:Omdissip-flag", Kind.STEP, stated="turning in one period, free in the next")
def example_of_non_invariance() -> Verdict:
    """A datum that turns in [0, T] and not in [T, 2T] shows that Ω_dissip is not forward
    invariant.
    """
    first, both = RETURNS.follow(1), RETURNS.follow(2)
    later = both.words[len(first.words) :]
    need(first.has("turn"), "they do not turn in the first period")
    need(all(word.startswith("hit") for word in later), "they stop in the second", words=later)
    long = States("-0.73", "2.08").follow(4)
    need(long.has("turn") and long.has("stick"), "it does not stop later", words=long.words)
    return refuted(
        f"such data are many, as {RETURNS}; but this is about Ω_dissip^[0,T]. The image is in Ω_NS "
        f"only if no stop ever comes: here one comes in the next periods ({', '.join(long.words)})",
        "A box of states over two periods, and its centre over four, followed in balls. The "
        "conclusion is true: decomposition.not-forward-invariant.",
    )


@claim("prop:Omdissip-flag", Kind.THEOREM, stated="no T-periodic orbit implies entry into Ω_dissip")
def without_periodic_orbits() -> Verdict:
    """Where Φ has no never-stopping T-periodic orbit, every datum eventually enters Ω_dissip and
    remains there.
    """
    return still_open(
        "neither shown nor refuted: orbits that are not T-periodic might never stop although no "
        "T-periodic one exists. For f > 2F/π it is true, as Ω_NS is empty",
        "The argument given is for f > f_imp only; for its truth there see impulse.eventual-entry.",
    )
