"""Section 2.4: the stroboscopic map and the never-stopping set."""

from itertools import product

from cap.audit import labels
from cap.audit.claim import Kind, claim
from cap.audit.means.algebra import identity, symbols
from cap.audit.means.balls import pair
from cap.audit.means.lazy import sympy as sp
from cap.audit.means.need import need
from cap.audit.means.stored import at_the_paper, stored
from cap.audit.verdict import Verdict, confirmed, imprecise, still_open

STATES = range(4)


@claim("def:Phi", Kind.STEP, stated="Φ is well defined on X")
def strobe_is_well_defined() -> Verdict:
    """Φ: X -> X is well defined."""
    f, excess = symbols("f excess")
    force = excess - f  # towards the right wall, F cos ωt >= -f
    need((-force - f).is_negative is True, "a mass at rest there may leave")
    return imprecise(
        "it is, with a contact law at the walls and (r, v) identified with (r, -v), (l, v) with "
        "(l, -v); and it is discontinuous where an orbit hits a wall just at T, unless these are",
        "See inclusion.rest-at-a-wall, inclusion.outward-data, wellposed.continuous-dependence, "
        "and wellposed.no-accumulation: the flow goes on uniquely after infinitely many hits.",
        proof="setup.md#the-contact-law",
    )


@claim("ssec:setup-strob", Kind.THEOREM, stated="Φ is differentiable almost everywhere")
def almost_everywhere_differentiable() -> Verdict:
    """Φ is differentiable Lebesgue-almost everywhere."""
    return still_open(
        "not proved by what is said: it rests on Remark 2.6, which fails for one value of f/F "
        "(stops.tangential-touch-on-an-open-set), and on finitely many events",
        "Where Φ is differentiable, its determinant is as Corollary 3.4 says for one period. No "
        "state at which it is not, outside curves, is known here.",
    )


@claim("def:trajectory-types", Kind.DEFINITION, stated="sticking, turning, non-sticking")
def three_types() -> Verdict:
    """Every solution on [0, T] is of one and only one of the three types."""
    title = labels.stored().place("thm:symmetric").title
    need("non-sticking" in title, "Theorem 4.2 is not about non-sticking orbits")
    return imprecise(
        "they are exclusive and exhaustive; but 'non-sticking' here means that the velocity never "
        "vanishes, and Section 4 calls orbits with turning points non-sticking",
        "By cases: no zero; a zero but no interval of zeros; an interval. Theorem 4.2 is about "
        "non-sticking orbits with turning points, by its title and its ansatz. We say "
        "never-stopping for orbits whose velocity never vanishes.",
    )


@claim("prop:Om-NS-invariant", Kind.THEOREM, stated="Φ(Ω_NS) is contained in Ω_NS")
def forward_invariance() -> Verdict:
    """Ω_NS, the intersection of the Φ⁻ⁿ(Ω_NS^[0,T]), is forward invariant."""
    need(all(_invariant(image, good) for image, good in _all_maps()), "a map refutes it")
    return confirmed(
        "it is, and it is the largest forward invariant subset of Ω_NS^[0,T]",
        "The proof is right: n + 1 for n in the definition, Φⁿ⁺¹ = Φⁿ Φ since the forcing has the "
        "period T. Both statements also checked for all 256 maps of a set of four points and all "
        "its 16 subsets.",
        proof="setup.md#the-largest-forward-invariant-subset",
    )


def _all_maps() -> "product[tuple[tuple[int, ...], tuple[bool, ...]]]":
    maps = product(STATES, repeat=len(STATES))
    subsets = product((False, True), repeat=len(STATES))
    return product(maps, subsets)


def _invariant(image: tuple[int, ...], good: tuple[bool, ...]) -> bool:
    """Return whether the set of the definition is invariant, and the largest such subset."""
    kept = {z for z in STATES if all(good[w] for w in _orbit(z, image))}
    largest = {z for z in STATES if good[z]}
    while any(image[z] not in largest for z in largest):
        largest = {z for z in largest if image[z] in largest}
    return all(image[z] in kept for z in kept) and kept == largest


def _orbit(z: int, image: tuple[int, ...]) -> set[int]:
    seen = set[int]()
    while z not in seen:
        seen.add(z)
        z = image[z]
    return seen


@claim("eq:Om-NS-def", Kind.THEOREM, stated="Ω_NS is not empty")
def never_stopping_orbits_exist() -> Verdict:
    """There are orbits in Ω_NS at the parameters of the paper."""
    claims = stored("elliptic.json").claims
    need(claims["least_speed"].lower > 0, "the orbit may stop")
    distances = claims["resonance_distances"].values()
    need(all(each.lower > 0 for each in distances), "a resonance is possible")
    twist = claims["twist"]
    need(twist.lower > 0 or twist.upper < 0, "the twist may vanish")
    disk = stored("island.json")
    need(at_the_paper(disk), "the invariant disk is at other parameters")
    area = disk.claims["area"]
    need(area.lower > 0, "the disk may have no area")
    return confirmed(
        "P* is in it, and so is the inside of an explicit invariant curve around P*, an open disk "
        f"with an area in {pair(area, 8)}, and its mirror image",
        "Stored certificates: of the curve and its inside; of P*, whose velocity never vanishes, "
        "elliptic, without resonance of order at most four, with a twist.",
        certificate="island.json",
    )


@claim("ssec:setup-strob", Kind.STEP, stated="the semigroup identity Φⁿ⁺¹ = Φⁿ Φ")
def semigroup() -> Verdict:
    """The T-periodicity of the forcing makes the iterates of Φ the flow over nT."""
    F, w = symbols("F omega")
    t = sp.Symbol("t", real=True)
    force = F * sp.cos(w * t)
    identity("F cos ωt has the period T", force.subs(t, t + 2 * sp.pi / w), force)
    half = force.subs(t, t + sp.pi / w)
    identity("and changes its sign after T/2", half, -force)
    return confirmed("F cos ω(t + T) = F cos ωt", "Symbolic identity.")
