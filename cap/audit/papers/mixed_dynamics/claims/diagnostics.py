"""Sections 10.2 to 10.4: the alignment index, the basin entropy, and the map over (f, R)."""

from fractions import Fraction

from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity, same, symbols
from cap.audit.means.balls import between, pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.orbits import States
from cap.audit.means.paper_equation import Equation
from cap.audit.means.printed import stated
from cap.audit.means.stored import stored
from cap.audit.verdict import Verdict, confirmed, imprecise, refuted, uncheckable
from cap.sets import interval

LEAVES = States("0.0653", "0.5069")  # a state in the box of the map of fig:sali


@claim("eq:sali-def", Kind.INEQUALITY, stated="SALI in [0, sqrt 2]")
def range_of_the_index() -> Verdict:
    """SALI, the smaller of |a + b| and |a - b| for unit vectors a, b, is in [0, sqrt 2]."""
    phi = sp.Symbol("phi", real=True)  # the angle between them
    plus = (1 + sp.cos(phi)) ** 2 + sp.sin(phi) ** 2
    minus = (1 - sp.cos(phi)) ** 2 + sp.sin(phi) ** 2
    identity("|a + b|² + |a - b|² = 4", plus + minus, 4)
    return confirmed(
        "|a + b|² + |a - b|² = 4, so the smaller square is at most 2; sqrt 2 for orthogonal ones",
        "Symbolic identity.",
    )


@claim("eq:sali-def", Kind.FORMULA, stated="SALI(N) ~ exp(-(σ₁ - σ₂) N) on chaotic orbits")
def decay_on_chaotic_orbits() -> Verdict:
    """Along a hyperbolic orbit SALI decays like exp(-(σ₁ - σ₂) N)."""
    a, b, z = symbols("a b z")  # the slopes at first, and exp(-(σ₁ - σ₂) N)
    limit = sp.limit((sp.atan(a * z) - sp.atan(b * z)) / z, z, 0, "+")
    identity("the angle between the deviations, over exp(-(σ₁ - σ₂) N)", limit, a - b)
    return confirmed(
        "in the plane: the angle between two deviations falls like exp(-(σ₁ - σ₂) N); where area "
        "is preserved σ₂ = -σ₁, so the rate is 2σ₁, twice the exponent",
        "Two vectors under a diagonal matrix, by sympy.",
    )


@claim("eq:jacobian-fd", Kind.NUMBER, stated="four integrations over a period")
def cost_of_the_differences() -> Verdict:
    """Each Jacobian by central differences costs four integrations over a period."""
    starts = {(s * i, s * j) for i, j in ((1, 0), (0, 1)) for s in (1, -1)}
    need(len(starts) == 4, "another number of states")
    return confirmed("two for each of the two columns", "z ± h e₁, z ± h e₂.")


@claim("ssec:num-diag", Kind.WORDS, stated="Ω_NS if no stop is seen in 15 periods")
def classes_of_the_map() -> Verdict:
    """Cells of the map without a stop in N = 15 periods lie in Ω_NS, regular or chaotic."""
    early, late = LEAVES.follow(15), LEAVES.follow(30)
    need(early.only_hits(), "it stops within 15 periods")
    need(late.has("turn") or late.has("stick"), "it does not stop within 30 periods")
    word = next(word for word in late.words if not word.startswith("hit"))
    return refuted(
        f"a stop in [0, NT] puts a state in Ω_dissip, none in [0, NT] does not put it in Ω_NS: "
        f"{LEAVES}, in the box of the map, only hits walls for 15 periods, and has a {word} within "
        "30. So the classes depend on N",
        "One orbit followed in balls; how many cells change is a row of the table of fig:sali.",
    )


@claim("ssec:num-saddle", Kind.THEOREM, stated="a Jordan block at +1 where the branch ends")
def jordan_block_at_the_end() -> Verdict:
    """Where the branch of P* ends, the multipliers are 1, with a Jordan block."""
    kappa = sp.Symbol("kappa", real=True)
    impact, flight = sp.Matrix([[-1, 0], [kappa, -1]]), sp.Matrix([[1, sp.pi], [0, 1]])
    half = (-1) * impact * flight  # and the reflection, which is -1; in units F = ω = 1
    at = sp.solve(half.trace() + 2, kappa)[0]
    whole = (half**2).subs(kappa, at)
    identity("the trace of Φ'", whole.trace(), 2)
    need(not same(whole, sp.eye(2)), "Φ' is the identity")
    claims = stored("pitchfork.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    return confirmed(
        f"true, at f in {pair(claims['f'], 8)}; but it is a pitchfork of the pair with the "
        "symmetric orbit, no fold, and the half-period map has a double multiplier -1",
        "Hit and flight of the symmetric orbit as matrices, by sympy; the stored certificate.",
        certificate="pitchfork.json",
    )


@claim("ssec:num-saddle", Kind.WORDS, stated="fractal boundaries give S_bb close to log 2")
def threshold_of_the_entropy() -> Verdict:
    """Smooth boundaries give S_bb well below log 2, fractal ones S_bb close or equal to it."""
    p = sp.Symbol("p", positive=True)
    entropy = -p * sp.log(p) - (1 - p) * sp.log(1 - p)
    at = sp.solve(sp.diff(entropy, p), p)
    need(at == [sp.Rational(1, 2)], "the maximum is elsewhere")
    identity("the largest entropy of two colours", entropy.subs(p, at[0]), sp.log(2))
    line = sp.simplify(sp.integrate(entropy, (p, 0, 1)))
    identity("of a straight border parallel to a side, at any place", line, sp.Rational(1, 2))
    boundary = Fraction(stated("S_bb", "fig:basin"))
    need(boundary < Fraction(1, 2), "the paper's value is above that of a line")
    return imprecise(
        "with two colours no box has more than log 2, so S_bb never exceeds it, and the criterion "
        "of Daza et al. (S_bb > log 2 implies a fractal border) decides nothing here; a straight "
        "border along a side of the boxes has S_bb = 1/2 in the limit of fine cells. The paper's "
        f"{float(boundary)} is below even that: it tells nothing of a fractal border",
        "Maximum and mean of the entropy of two colours, by sympy.",
    )


@claim("fig:continuation", Kind.CONSISTENCY, stated="one orbit, elliptic, where f_sc(R) <= 0")
def elliptic_only_region() -> Verdict:
    """Where f_sc(R) <= 0 only the elliptic orbit exists below the impulse bound."""
    with interval.workprec(100):
        pi = interval.pi()
        critical = 4 * (2 + 1 - pi) / (pi * pi)  # at R = 1
        need(critical < 0, "f_sc is not negative there")
        equation = Equation(Fraction(11, 20), Fraction(1))
        found = equation.roots()
        need(len(found) == 2, "the number of roots is another", roots=found)
        words = " and ".join(between(equation.bisected(each), 5) for each in found)
    return refuted(
        "by Proposition 4.4 (iii) the equation has two roots for every f > f_sc, negative or not: "
        f"at R = 1, f = 0.55 they are θ in {words}, and f_sc(1) < 0. The proposition has no region "
        "with one of the two only",
        "All roots of eq:theta-eq in [0, π], in balls. (None of them is an orbit; the orbits that "
        "exist are in the table of this figure.)",
    )


@claim("ssec:num-cont", Kind.WORDS, stated="spot-checks confirm the assigned label in every case")
def spot_checks() -> Verdict:
    """Doubling the iteration limit, and three additional seeds, change no label."""
    return uncheckable(
        "neither the four seeds nor the three additional ones are given. What can be said of the "
        "labels without a search: all orbits with one hit of each wall at the nine points are "
        "enclosed, in the table of fig:continuation",
        "The text of the error analysis.",
    )


@claim("ssec:num-coexist", Kind.STEP, stated="both orbits lie in Ω_dissip since det Φ' != 1")
def coexisting_orbits_stop() -> Verdict:
    """The focus and the saddle at F = 3 lie in Ω_dissip."""
    found = [stored(name) for name in ("periodic-1.json", "periodic-2.json")]
    need(all(each.parameters["F"] == 3 for each in found), "they are at another F")
    need([each.claims["type"] for each in found] == ["sink focus", "saddle"], "other types")
    for each in found:
        turns = [word for word in each.claims["itinerary"] if word.startswith("turn")]
        need(len(turns) == 2, "another number of turns", turns=turns)
        need(each.claims["determinant"].upper < 1, "the determinant may be 1")
    return confirmed(
        "both turn twice in each period, and det Φ' < 1",
        "Two stored certificates (periodic-1.json and periodic-2.json).",
        certificate="periodic-2.json",
    )


@claim("ssec:num-coexist", Kind.WORDS, stated="the orbit count grows with F")
def orbit_count() -> Verdict:
    """The number of T-periodic orbits grows with F."""
    table = "fig:hist-cont"
    counts = {}
    for F in ("1.5", "2", "3.5"):
        words = stated(f"F = {F}: elliptic + saddle, grid-Newton", table)
        counts[F] = sum(int(each) for each in words.split("+"))
    need(counts["2"] < counts["1.5"], "the counts of the appendix grow", counts=counts)
    segment = stored("segment.json")
    left, right = segment.claims["left"], segment.claims["right"]
    need(segment.parameters["F"] == 1 and left.upper < right.lower, "there is no segment at F = 1")
    return imprecise(
        "the counts of the appendix do not grow: "
        + ", ".join(f"{n} at F = {F}" for F, n in counts.items())
        + ". They are what a search found, not how many there are. At F = 1 there is one for "
        f"each x at t = 0 between {pair(left, 5)} and {pair(right, 5)} that touches no wall: "
        'without "isolated" they cannot be counted',
        "The numbers that the paper prints at fig:hist-cont, where it says itself that the count "
        "fluctuates; the stored certificate of the segment.",
        certificate="segment.json",
    )
